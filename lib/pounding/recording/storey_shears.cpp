#include <pounding/recording/storey_shears.hpp>

#include <pounding/recording/histories.hpp>

namespace pounding {

StoreyShears::StoreyShears(const Model& model, const StepView& stepper, Results& results)
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
      results_.structures[k].envelope.storey_shear =
          Extremes(s.floors.size() * results_.structures[k].storey_directions());
  }
  visit_storeys(false, [&](int, std::size_t) { has_inelastic_ = true; });
}

template <class Visit>
void StoreyShears::visit_storeys(bool elastic, Visit&& visit) const {
  for (std::size_t k = 0; k < model_.structures.size(); ++k) {
    const Structure& s = model_.structures[k];
    for (std::size_t i = 0; i < s.storey_stiffness.size(); ++i)
      if (elastic == (i >= s.members_that_yield() && s.floors[i].storey_shear_by_yielding.empty()))
        visit(static_cast<int>(k), i);
  }
}

void StoreyShears::begin(const Eigen::MatrixXd& floors) {
  visit_storeys(false, [&](int k, std::size_t i) {
    const Structure& s = model_.structures[k];
    const int at = first_row_[k] + static_cast<int>(i);
    const double drift = floors(at, 0) - (i > 0 ? floors(at - 1, 0) : 0);
    double force = s.storey_stiffness[i] * drift;
    if (i < s.members_that_yield())
      force += stepper_.links().law(static_cast<int>(first_spring_[k] + i), {.penetration = drift}).force;
    force += shear_by_devices(s.floors[i], [&](std::size_t part) {
      return stepper_.link_forces()[static_cast<int>(first_spring_[k] + part)];
    });
    results_.structures[k].envelope.storey_shear.update(i, stepper_.time(), force);
  });
}

void StoreyShears::show() {
  visit_storeys(true, [&](int k, std::size_t i) {
    StructureEnvelope& envelope = results_.structures[k].envelope;
    envelope.storey_shear.copy(i, envelope.drift, i, model_.structures[k].storey_stiffness[i]);
  });
}

void StoreyShears::step(const StepMotion& step) {
  if (has_inelastic_) visit_storeys(false, [&](int k, std::size_t i) { step_storey(k, i, step); });
}

void StoreyShears::step_storey(int k, std::size_t i, const StepMotion& step) {
  const Structure& s = model_.structures[k];
  Extremes& shear = results_.structures[k].envelope.storey_shear;
  const int at = first_row_[k] + static_cast<int>(i);
  const auto drift = [&](const Eigen::MatrixXd& floors, int column) {
    return floors(at, column) - (i > 0 ? floors(at - 1, column) : 0);
  };
  const double k_i = s.storey_stiffness[i], d0 = drift(step.begin, 0), d1 = drift(step.end_minus, 0);
  const double v0 = drift(step.begin, 1), v1 = drift(step.end_minus, 1);
  const bool yields = i < s.members_that_yield(), has_device = !s.floors[i].storey_shear_by_yielding.empty();
  const auto force_of = [&](std::size_t part, double time, double deformation) {
    const int link = static_cast<int>(first_spring_[k] + part);
    return spring_force(stepper_.links(), link, stepper_.link_step(link), time, deformation);
  };
  const auto update = [&](double part, double d) {
    const double time = step.begin_time + part * step.h;
    double force = k_i * d + (yields ? force_of(i, time, d) : 0);
    force += shear_by_devices(s.floors[i], [&](std::size_t j) {
      const LinkStep& device = stepper_.link_step(static_cast<int>(first_spring_[k] + j));
      return force_of(j, time, interpolate(device, part).penetration);
    });
    shear.update(i, time, force);
  };
  const auto update_inside = [&](double part) {
    const Cubic cubic(part, step.h);
    update(part, cubic.begin * d0 + cubic.end * d1 + cubic.slope_begin * v0 + cubic.slope_end * v1);
  };
  const double turn = v0 * v1 < 0 ? v0 / (v0 - v1) : 0.5;
  update_inside(turn);
  if (turn != 0.5) update_inside(0.5);
  // The largest sum of two forces may occur away from the extremes of each.
  if (has_device)
    for (const double part : {0.125, 0.25, 0.375, 0.625, 0.75, 0.875}) update_inside(part);
  update(1, d1);
}

}  // namespace pounding
