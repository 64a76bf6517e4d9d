#pragma once
/// Numbers and formulas as printed in the paper, in its units: kN, t, m, s.

#include <array>
#include <cmath>

#include <pounding/laws/damping_formulas.hpp>
#include <pounding/laws/exact_damping.hpp>

namespace pounding::reproduce::paper {

/// Restitutions of Table 2 and of all comparisons in the paper.
inline constexpr std::array<double, 9> restitutions{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};

/// Section 5, "SDOF mass of two bodies 755.76 kN": read as 755.76 kg, see item table2.
namespace example {
inline constexpr double mass = 755.76, stiffness = 30000e3, speed = 10, restitution = 0.7;  // [kg], [N/m^1.5], [m/s]
}
/// Section 5.1: bodies of 100 t and 150 t.
namespace accuracy {
inline constexpr double mass = 60e3, stiffness = 22000e3, speed = 15;  // reduced [kg], [N/m^1.5], [m/s]
}
/// Section 6: kinetic energy losses of the reference and of the second model [kJ].
namespace pair {
inline constexpr double reference_speed = 10, reference_restitution = 0.5, reference_loss = 28.33261;
inline constexpr double second_speed = 11, second_restitution = 0.45, second_loss = 28.64157;
}  // namespace pair

/// Eq. 19, from the highest power down: v_imp [m/s] of CR.
inline constexpr std::array<double, 5> velocity_curve{494.32, -1299, 1285, -595.9, 116.67};

/// Starting values of the curves of Fig. 12 according to the text: Eq. 38, Jankowski, Mahmoud.
inline constexpr double start_eq38 = 61, start_jankowski = 3.5, start_mahmoud = 3.2;

}  // namespace pounding::reproduce::paper

// The paper's Eq. 16 with its Table 2 as functions of the asked restitution and of the number k/v.
namespace pounding::reproduce {

/// a = c_imp v/k of Eq. 16; k/v is a number that depends on the units chosen.
inline double proposed_factor(double restitution, double k_over_v) {
  return laws::naderpour_2015({.restitution = restitution, .closing_speed = 1, .stiffness = 1e3 * k_over_v});
}

/// Restitution of a free impact with this damping.
inline double proposed_restitution(double restitution, double k_over_v) {
  return laws::restitution_of_factor(proposed_factor(restitution, k_over_v));
}

/// N - 1 of Table 2 at this restitution.
inline double excess_exponent(double restitution) {
  return std::log10(proposed_factor(restitution, 10) / proposed_factor(restitution, 1));
}

/// Value of k/v for which Eq. 16 yields exactly the target restitution.
inline double fitting_k_over_v(double restitution) {
  const double needed = laws::exact_factor({.restitution = restitution}) / proposed_factor(restitution, 1);
  return std::pow(needed, 1 / excess_exponent(restitution));
}

}  // namespace pounding::reproduce
