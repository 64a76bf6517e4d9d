#include <pounding/sections/moment_curvature.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace pounding::sections {
namespace {

double initial_stiffness(const FibreSection& section) { return section.evaluate(section.states(), {}).stiffness[0]; }

/// Axial strain; empty if there is no equilibrium. `stiffness` is the initial one.
std::optional<double> balance(const FibreSection& section, const FibreStates& states, double stiffness,
                              double axial_force, Deformation deformation) {
  const double allowed = 1e-15 * stiffness + 1e-13 * std::abs(axial_force);
  double low = -HUGE_VAL, high = HUGE_VAL;  // forces below and above the required one
  for (int i = 0; i < 200; ++i) {
    const SectionResponse response = section.evaluate(states, deformation);
    const double excess = response.force[0] - axial_force, strain = deformation[0];
    if (std::abs(excess) <= allowed) return strain;
    if (!std::isfinite(excess) || std::abs(strain) > 1) return {};
    if (excess < 0)
      low = std::max(low, strain);
    else
      high = std::min(high, strain);
    const double tangent = response.stiffness[0];
    double next = strain - excess / (tangent > 1e-6 * stiffness ? tangent : stiffness);
    if (low < high && std::isfinite(high - low) && !(next > low && next < high)) next = 0.5 * (low + high);
    if (next == strain) return strain;
    deformation[0] = next;
  }
  return {};
}

Deformation bent(double axial_strain, double curvature, Axis axis) {
  return axis == Axis::y ? Deformation{axial_strain, curvature, 0} : Deformation{axial_strain, 0, curvature};
}

[[noreturn]] void fail(double axial_force, double curvature) {
  throw std::invalid_argument("the section cannot resist an axial force of " + laws::number_text(axial_force / 1e3) +
                              " kN at a curvature of " + laws::number_text(curvature) +
                              " 1/m; type a smaller force, negative in compression, or smaller curvatures");
}

}  // namespace

double find_axial_strain(const FibreSection& section, const FibreStates& states, double axial_force,
                         Deformation deformation) {
  const auto found = balance(section, states, initial_stiffness(section), axial_force, deformation);
  if (!found) fail(axial_force, std::hypot(deformation[1], deformation[2]));
  return *found;
}

std::vector<CurvePoint> resisted_curve(const FibreSection& section, double axial_force,
                                       std::span<const double> curvatures, Axis axis) {
  const double stiffness = initial_stiffness(section);
  FibreStates states = section.states();
  double strain = 0;
  const auto go_to = [&](double curvature) {
    const auto balanced = balance(section, states, stiffness, axial_force, bent(strain, curvature, axis));
    if (balanced) strain = *balanced;
    return balanced.has_value();
  };
  if (!go_to(0)) fail(axial_force, 0);
  section.accept(states, bent(strain, 0, axis));
  std::vector<CurvePoint> curve;
  for (const double curvature : curvatures) {
    if (!go_to(curvature)) break;
    const Deformation deformation = bent(strain, curvature, axis);
    const SectionResponse response = section.evaluate(states, deformation);
    curve.push_back({curvature, response.force[axis == Axis::y ? 1 : 2], strain});
    section.accept(states, deformation);
  }
  return curve;
}

std::vector<CurvePoint> moment_curvature(const FibreSection& section, double axial_force,
                                         std::span<const double> curvatures, Axis axis) {
  std::vector<CurvePoint> curve = resisted_curve(section, axial_force, curvatures, axis);
  if (curve.size() < curvatures.size()) fail(axial_force, curvatures[curve.size()]);
  return curve;
}

std::vector<InteractionPoint> interaction(const FibreSection& section, std::span<const double> axial_forces,
                                          std::span<const double> curvatures, Axis axis) {
  std::vector<InteractionPoint> diagram;
  for (const double axial_force : axial_forces) {
    double largest = 0;
    for (const CurvePoint& point : resisted_curve(section, axial_force, curvatures, axis))
      largest = std::max(largest, point.moment);
    diagram.push_back({axial_force, largest});
  }
  return diagram;
}

}  // namespace pounding::sections
