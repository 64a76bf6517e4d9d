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
    const std::size_t yielding = s.members_that_yield();
    for (std::size_t i = 0; i < s.storey_stiffness.size(); ++i) {
      const int at = first_row_[k] + static_cast<int>(i);
      const double drift = floors(at, 0) - (i > 0 ? floors(at - 1, 0) : 0);
      double force = s.storey_stiffness[i] * drift;
      if (i < yielding) force += s.yielding[i].spring->evaluate({.penetration = drift}).force;
      force += shear_by_devices(s.floors[i], [&](std::size_t part) { return stepper_.link_forces()[static_cast<int>(first_spring_[k] + part)]; });
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
  const std::size_t yielding = s.members_that_yield();
  for (std::size_t i = 0; i < s.storey_stiffness.size(); ++i) {
    const int at = row + static_cast<int>(i);
    const auto drift = [&](const Eigen::MatrixXd& floors, int column) {
      return floors(at, column) - (i > 0 ? floors(at - 1, column) : 0);
    };
    const double k_i = s.storey_stiffness[i], d0 = drift(step.begin, 0), d1 = drift(step.end_minus, 0);
    const double v0 = drift(step.begin, 1), v1 = drift(step.end_minus, 1);
    const bool yields = i < yielding, has_device = s.floors[i].storey_shear_by_yielding.size() > 0;
    if (!yields && !has_device) {
      shear.update(i, step.begin_time, step.h, k_i * d0, k_i * v0, k_i * d1, k_i * v1);
      continue;
    }
    const LinkStep* spring = yields ? &stepper_.link_step(static_cast<int>(first_spring_[k] + i)) : nullptr;
    const auto update = [&](double part, double d) {
      const double time = step.begin_time + part * step.h;
      double force = k_i * d + (yields ? spring_force(*s.yielding[i].spring, *spring, time, d) : 0);
      force += shear_by_devices(s.floors[i], [&](std::size_t j) {
        const LinkStep& device = stepper_.link_step(static_cast<int>(first_spring_[k] + j));
        return spring_force(*s.yielding[j].spring, device, time, interpolate(device, part).penetration);
      });
      shear.update(i, time, force);
    };
    const auto update_inside = [&](double part) {
      const Cubic at(part, step.h);
      update(part, at.begin * d0 + at.end * d1 + at.slope_begin * v0 + at.slope_end * v1);
    };
    const double turn = v0 * v1 < 0 ? v0 / (v0 - v1) : 0.5;
    update_inside(turn);
    if (turn != 0.5) update_inside(0.5);
    // The largest sum of two forces need not be where one of them turns.
    if (has_device)
      for (const double part : {0.125, 0.25, 0.375, 0.625, 0.75, 0.875}) update_inside(part);
    update(1, d1);
  }
}

}  // namespace pounding
