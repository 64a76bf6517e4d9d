#pragma once
/// Calibration by the cyclic process of Naderpour, Barros & Khatami 2015 (section 6, Fig. 9): a formula is given an
/// assumed restitution, the impact is analysed, the area of its hysteresis loop is compared with the kinetic energy
/// that the restitution asked for would lose (Eq. 18), and the assumed restitution is changed until both are equal.
///
/// It needs no closed form, and where it converges it ends at the exact calibration, whichever formula it started from.

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/laws/all.hpp>
#include <pounding/laws/free_impact.hpp>
#include <pounding/laws/root.hpp>

namespace pounding::laws {

/// One analysis of the process.
struct CyclicAnalysis {
  double assumed = 0;      ///< restitution that the formula was given
  double loop_area = 0;    ///< [J]
  double restitution = 0;  ///< that the impact really had
};

/// All analyses of the process.
struct CyclicCalibration {
  double kinetic_loss = 0;               ///< (1/2) m (1-e^2) v^2 of the restitution asked, the area that is wanted [J]
  std::vector<CyclicAnalysis> analyses;  ///< in the order they were made; the last one has the area wanted

  double assumed() const { return analyses.back().assumed; }  ///< what the formula must be given
};

/// The process for the law and the formula of `settings`, whose own restitution is not used: e in (0, 1) asked, reduced
/// mass [kg], closing speed [m/s]. Ends when the area is right to 1e-9 of itself. Throws std::invalid_argument for
/// wrong settings, for a law without a loop or without a formula, and when no restitution that the formula takes makes
/// the loop lose what is asked.
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
                         reduced_mass, closing_speed);  // what is wrong in itself is refused here, not by the search

  CyclicCalibration result;
  result.kinetic_loss = 0.5 * reduced_mass * closing_speed * closing_speed * (1 - restitution) * (1 + restitution);
  // Loop area over the one wanted, less one; nothing where the formula has no value.
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
    make_law(settings);  // says why
  }
  // Outward, towards less restitution when the loop is too small, by half of what is left each time.
  double limit = *at_known < 0 ? 0 : 1, next = known;
  std::optional<double> at_next = at_known;
  while (*at_next * *at_known > 0) {
    known = next, at_known = at_next;
    do {
      next = 0.5 * (known + limit);
      if (std::abs(next - limit) < 1e-9)
        throw std::invalid_argument("the cyclic process does not end: formula \"" + settings.formula + "\" of " +
                                    settings.law + " comes no nearer to a restitution of " + number_text(restitution) +
                                    " than " + number_text(result.analyses.back().restitution));
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
