#pragma once
/// Free impact of two bodies with a contact law: in closed form if there is one, otherwise integrated.

#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

#include <pounding/laws/all.hpp>
#include <pounding/laws/closed_impact.hpp>
#include <pounding/laws/integrated_impact.hpp>

namespace pounding::laws {

/// Free impact of two bodies with reduced mass m1 m2/(m1+m2) [kg] and this closing speed [m/s]. Values without a closed
/// form are integrated with tolerance 1e-10. Throws std::invalid_argument unless mass and speed are finite and
/// positive.
template <class L>
FreeImpact free_impact(const L& law, double reduced_mass, double closing_speed) {
  require_positive("reduced_mass", reduced_mass);
  require_positive("closing_speed", closing_speed);
  FreeImpact known = closed_impact(law, reduced_mass, closing_speed);
  if (known.closed_form.all()) return known;
  if constexpr (!instantaneous<L>) {
    const FreeImpact integrated = integrated_free_impact(law, reduced_mass, closing_speed);
    if (!known.closed_form.restitution) {
      known.restitution = integrated.restitution;
      known.energy_lost = integrated.energy_lost;
      known.impulse = integrated.impulse;
    }
    if (!known.closed_form.peak_force) known.peak_force = integrated.peak_force;
    if (!known.closed_form.time_of_peak) known.time_of_peak = integrated.time_of_peak;
    if (!known.closed_form.peak_penetration) known.peak_penetration = integrated.peak_penetration;
    if (!known.closed_form.duration) known.duration = integrated.duration;
  }
  return known;
}

/// free_impact for a law selected by name; throws the same exceptions.
template <class... L>
FreeImpact free_impact(const std::variant<L...>& law, double reduced_mass, double closing_speed) {
  return std::visit([&](const auto& chosen) { return free_impact(chosen, reduced_mass, closing_speed); }, law);
}

/// integrated_free_impact for a law selected by name; throws std::invalid_argument for an instantaneous law.
template <class... L>
FreeImpact integrated_free_impact(const std::variant<L...>& law, double reduced_mass, double closing_speed) {
  return std::visit(
      [&](const auto& chosen) -> FreeImpact {
        if constexpr (instantaneous<std::decay_t<decltype(chosen)>>)
          throw std::invalid_argument(std::string(chosen.name) + " has no force history to integrate");
        else
          return integrated_free_impact(chosen, reduced_mass, closing_speed);
      },
      law);
}

}  // namespace pounding::laws
