#include <pounding/run/storey_shears.hpp>

#include <pounding/run/histories.hpp>

namespace pounding {

StoreyShears::StoreyShears(const Model& model, const Stepper& stepper, Results& results)
    : model_(model), stepper_(stepper), results_(results) {
  std::size_t spring = stepper.system().contact_count();
  int row = 0;
  for (std::size_t k = 0; k < model.structures.size(); ++k) {
    const Structure& s = model.structures[k];
    first_spring_.push_back(spring);
    first_row_.push_back(row);
    spring += s.yielding.size();
    row += s.floors.empty() ? 0 : static_cast<int>(s.floors.size() * s.floors.front().motion.size());
    if (s.dimension == 1 && s.has_storeys())
      results_.structures[k].envelope.storey_shear = Extremes(s.floors.size() * results_.structures[k].storey_directions());
  }
}

void StoreyShears::begin(const Eigen::MatrixXd& floors) {
  for (std::size_t k = 0; k < model_.structures.size(); ++k) {
    const Structure& s = model_.structures[k];
    for (std::size_t i = 0; i < s.storey_stiffness.size(); ++i) {
      const int at = first_row_[k] + static_cast<int>(i);
      const double drift = floors(at, 0) - (i > 0 ? floors(at - 1, 0) : 0);
      double force = s.storey_stiffness[i] * drift;
      if (!s.yielding.empty()) force += s.yielding[i].spring->evaluate({.penetration = drift}).force;
      results_.structures[k].envelope.storey_shear.update(i, stepper_.time(), force);
    }
  }
}

void StoreyShears::step(const StepMotion& step) {
  for (std::size_t k = 0; k < model_.structures.size(); ++k)
    if (!model_.structures[k].storey_stiffness.empty()) this->step(static_cast<int>(k), first_row_[k], step);
}

void StoreyShears::step(int k, int row, const StepMotion& step) {
  const Structure& s = model_.structures[k];
  Extremes& shear = results_.structures[k].envelope.storey_shear;
  for (std::size_t i = 0; i < s.storey_stiffness.size(); ++i) {
    const int at = row + static_cast<int>(i);
    const auto drift = [&](const Eigen::MatrixXd& floors, int column) {
      return floors(at, column) - (i > 0 ? floors(at - 1, column) : 0);
    };
    const double k_i = s.storey_stiffness[i], d0 = drift(step.begin, 0), d1 = drift(step.end_minus, 0);
    const double v0 = drift(step.begin, 1), v1 = drift(step.end_minus, 1);
    if (s.yielding.empty()) {
      shear.update(i, step.begin_time, step.h, k_i * d0, k_i * v0, k_i * d1, k_i * v1);
      continue;
    }
    const LinkStep& spring = stepper_.link_steps()[first_spring_[k] + i];
    const auto update = [&](double part, double d) {
      const double time = step.begin_time + part * step.h;
      shear.update(i, time, k_i * d + spring_force(*s.yielding[i].spring, spring, time, d));
    };
    const double turn = v0 * v1 < 0 ? v0 / (v0 - v1) : 0.5;
    const Cubic at_turn(turn, step.h), at_middle(0.5, step.h);
    update(turn, at_turn.begin * d0 + at_turn.end * d1 + at_turn.slope_begin * v0 + at_turn.slope_end * v1);
    if (turn != 0.5) update(0.5, at_middle.begin * d0 + at_middle.end * d1 + at_middle.slope_begin * v0 + at_middle.slope_end * v1);
    update(1, d1);
  }
}

}  // namespace pounding
