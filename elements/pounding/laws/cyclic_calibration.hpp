#pragma once
/// Calibration by the cyclic process of Naderpour, Barros & Khatami 2015 (section 6, Fig. 9). A formula is evaluated
/// for an assumed restitution and the impact is analysed. The area of its hysteresis loop is compared with the kinetic
/// energy that an impact with the target restitution loses (Eq. 18). The assumed restitution is adjusted until both are
/// equal.
///
/// It needs no closed form. If it converges, it yields the exact calibration, whatever the initial formula.

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include <pounding/base/root.hpp>
#include <pounding/laws/all.hpp>
#include <pounding/laws/free_impact.hpp>

namespace pounding::laws {

/// One analysis of the process.
struct CyclicAnalysis {
  double assumed = 0;      ///< restitution passed to the formula
  double loop_area = 0;    ///< [J]
  double restitution = 0;  ///< restitution of the analysed impact
};

/// All analyses of the process.
struct CyclicCalibration {
  double kinetic_loss = 0;               ///< target area: (1/2) m (1-e^2) v^2 with the target restitution [J]
  std::vector<CyclicAnalysis> analyses;  ///< in the order of analysis; the last one reaches the target area

  double assumed() const { return analyses.back().assumed; }  ///< restitution to pass to the formula
};

/// Runs the process for the law and the formula of `settings`, whose own restitution is ignored: target e in (0, 1),
/// reduced mass [kg], closing speed [m/s]. Stops at a relative error of the area of 1e-9. Throws std::invalid_argument
/// for invalid settings, for a law without a loop or without a formula, and if no admissible restitution of the formula
/// yields the target area.
inline CyclicCalibration calibrate_cyclically(Settings settings, double restitution, double reduced_mass,
                                              double closing_speed) {
  constexpr double accuracy = 1e-9;
  if (!(restitution > 0 && restitution < 1)) refuse("restitution", restitution, "in (0, 1) for the cyclic process");
  settings.restitution = restitution;
  settings.reduced_mass = reduced_mass;
  integrated_free_impact(make_law({.law = settings.law,
                                   .formula = "exact",
                                   .restitution = restitution,
                                   .impact_velocity = settings.impact_velocity,
                                   .reduced_mass = reduced_mass,
                                   .values = settings.values}),
                         reduced_mass, closing_speed);  // reports invalid settings here rather than in the search

  CyclicCalibration result;
  result.kinetic_loss = 0.5 * reduced_mass * closing_speed * closing_speed * (1 - restitution) * (1 + restitution);
  // Relative excess of the loop area over its target; `nullopt` if the formula is undefined.
  const auto excess = [&](double assumed) -> std::optional<double> {
    settings.restitution = assumed;
    std::optional<AnyLaw> law;
    try {
      law = make_law(settings);
    } catch (const std::invalid_argument&) {
      return std::nullopt;
    }
    const FreeImpact impact = integrated_free_impact(*law, reduced_mass, closing_speed);
    result.analyses.push_back({assumed, impact.energy_lost, impact.restitution});
    const double share = impact.energy_lost / result.kinetic_loss - 1;
    return std::abs(share) <= accuracy ? 0 : share;
  };

  double known = restitution;
  std::optional<double> at_known = excess(known);
  if (!at_known) {
    settings.restitution = restitution;
    make_law(settings);  // throws with the reason
  }
  // Brackets the root: towards a lower restitution if the loop is too small, halving the distance to the limit each
  // time.
  double limit = *at_known < 0 ? 0 : 1, next = known;
  std::optional<double> at_next = at_known;
  while (*at_next * *at_known > 0) {
    known = next, at_known = at_next;
    do {
      next = 0.5 * (known + limit);
      if (std::abs(next - limit) < 1e-9)
        throw std::invalid_argument("the cyclic process does not converge: formula \"" + settings.formula + "\" of " +
                                    settings.law + " cannot reach a restitution of " + number_text(restitution) +
                                    "; the nearest is " + number_text(result.analyses.back().restitution));
      at_next = excess(next);
      if (!at_next) limit = next;
    } while (!at_next);
  }
  if (*at_next != 0) {
    const auto root = [&](double assumed) { return *excess(assumed); };
    find_root(root, known, *at_known, next, *at_next);
  }
  return result;
}

}  // namespace pounding::laws
