#pragma once
/// Published formulas for the damping as a function of the restitution e. Few of them reach it exactly; the notes in
/// the laws state the error. Valid for 0 < e <= 1 unless stated otherwise.
///
/// Displacement-proportional damping, F = k d^n (1 + a d'/v): a [-].
/// Linear dashpot, c = 2 zeta sqrt(k m): zeta [-]. Jankowski: xi [-]. Exact calibrations: exact_damping.hpp.

#include <array>
#include <cmath>
#include <numbers>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// a = 3(1-e)/2. Hunt & Crossley 1975.
inline double hunt_crossley(const CalibrationTarget& q) { return 1.5 * (1 - q.restitution); }

/// a = 6(1-e)/[(2e-1)^2 + 3]. Herbert & McWhannell 1977.
inline double herbert_mcwhannell(const CalibrationTarget& q) {
  const double e = q.restitution;
  return 6 * (1 - e) / ((2 * e - 1) * (2 * e - 1) + 3);
}

/// a = 3(1-e)/4. Lee & Wang 1983.
inline double lee_wang(const CalibrationTarget& q) { return 0.75 * (1 - q.restitution); }

/// a = 3(1-e^2)/4. Lankarani & Nikravesh 1990, J. Mech. Des. 112:369; paper Eq. 12.
inline double lankarani_nikravesh(const CalibrationTarget& q) { return 0.75 * (1 - q.restitution * q.restitution); }

/// a = (1-e^2)/e. Gonthier et al. 2004.
inline double gonthier(const CalibrationTarget& q) { return (1 - q.restitution * q.restitution) / q.restitution; }

/// a = 3(1-e^2) exp[2(1-e)]/4. Zhiying & Qishao 2006.
inline double zhiying_qishao(const CalibrationTarget& q) {
  return lankarani_nikravesh(q) * std::exp(2 * (1 - q.restitution));
}

/// a = 8(1-e)/(5e). Ye, Li & Zhu 2009, EESD 38:1135; Flores et al. 2011; paper Eq. 14.
inline double ye_2009(const CalibrationTarget& q) { return 1.6 * (1 - q.restitution) / q.restitution; }

/// a = 3(1-e)/(2e). Ye, Li & Zhu 2009, Earthq. Eng. Eng. Vib. 8:433 for n = 1 (paper Eq. 13); Hu & Guo 2015 for n
/// = 1.5.
inline double hu_guo(const CalibrationTarget& q) { return 1.5 * (1 - q.restitution) / q.restitution; }

/// a = 1/e, valid for small e only. Gharib & Hurmuzlu 2012.
inline double gharib_hurmuzlu(const CalibrationTarget& q) { return 1 / q.restitution; }

/// a = (k/v)^(N-1) (1-e^2)/e^M. Naderpour, Barros & Khatami 2015, Eqs. 15-17, from c_imp = (k/v)^N (1-e^2)/e^M = a k/v.
/// N and M are interpolated linearly in its Table 2; throws std::invalid_argument outside its range 0.1 <= e <= 0.9.
/// The formula is not homogeneous in units: k/v is in kN, m, s as printed.
inline double naderpour_2015(const CalibrationTarget& q) {
  static constexpr std::array<double, 9> N{1.05144, 1.04, 1.03092, 1.022, 1.0115, 0.9973, 0.9775, 0.95016, 0.9133};
  static constexpr std::array<double, 9> M{1.0025, 1.0017, 1.0005, 0.9945, 0.9862, 0.9754, 0.9668, 0.9551, 0.9512};
  const double e = q.restitution;
  if (!(e >= 0.1 && e <= 0.9)) refuse("restitution", e, "in [0.1, 0.9], the range of Table 2 of naderpour_2015");
  const double place = std::fmin(std::fmax(10 * e - 1, 0), 8);
  const auto row = static_cast<std::size_t>(std::fmin(place, 7));
  const double t = place - static_cast<double>(row);
  const double kilonewton = 1000;
  return std::pow(q.stiffness / kilonewton / q.closing_speed, std::lerp(N[row], N[row + 1], t) - 1) * (1 - e * e) /
         std::pow(e, std::lerp(M[row], M[row + 1], t));
}

/// zeta = -ln e/sqrt(pi^2 + ln^2 e): exact for a linear dashpot in contact until d = 0; the limit 1 for e = 0.
/// Anagnostopoulos 1988; paper Eq. 7.
inline double anagnostopoulos(const CalibrationTarget& q) {
  if (q.restitution == 0) return 1;
  const double log_e = std::log(q.restitution);
  return std::abs(log_e) / std::hypot(std::numbers::pi, log_e);
}

/// zeta = (1-e^2)/{e [e (pi-2) + 2]}, dashpot in the approach only. Mahmoud & Jankowski 2011.
inline double mahmoud_jankowski_2011(const CalibrationTarget& q) {
  const double e = q.restitution;
  return (1 - e * e) / (e * (e * (std::numbers::pi - 2) + 2));
}

/// zeta = (1-e^2)/(pi e), dashpot in the approach only. The first, simple form; paper Table 4.
inline double simple_approach(const CalibrationTarget& q) { return gonthier(q) / std::numbers::pi; }

/// zeta or xi = [2 (1-e^2)/(e sqrt(pi))]^2. Naderpour, Barros & Khatami 2015, Eq. 38: much too high below e = 0.85.
inline double naderpour_2015_eq38(const CalibrationTarget& q) {
  return 4 / std::numbers::pi * gonthier(q) * gonthier(q);
}

/// xi = sqrt(5) (1-e^2)/(2 pi e). Jankowski 2005, EESD 34:595; paper Eq. 10.
inline double jankowski_2005(const CalibrationTarget& q) { return std::sqrt(5.0) / 2 * simple_approach(q); }

/// xi = (9 sqrt(5)/2) (1-e^2)/{e [e (9 pi-16) + 16]}. Jankowski 2006, EESD 35:517.
inline double jankowski_2006(const CalibrationTarget& q) {
  const double e = q.restitution;
  return 4.5 * std::sqrt(5.0) * (1 - e * e) / (e * (e * (9 * std::numbers::pi - 16) + 16));
}

/// alpha = sqrt(2 (n+1)) (-ln e)/sqrt(pi^2 + ln^2 e), contact until d = 0. Antypov & Elliott 2011.
inline double antypov_elliott(const CalibrationTarget& q) {
  return std::sqrt(2 * (q.exponent + 1)) * anagnostopoulos(q);
}

}  // namespace pounding::laws
