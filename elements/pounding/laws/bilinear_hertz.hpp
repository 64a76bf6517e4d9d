#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <pounding/base/root.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// Restitution of the bilinear law at its design speed, at which a Hertz spring with the same k reaches d_m; loss is
/// the ratio of dE to the kinetic energy. In units with k d_m^(n-1) = d_m = 1, the loading curve stores 1/(n+1) up to
/// the penetration reached.
inline double restitution_of_bilinear_loss(double loss, double exponent, double yield_ratio) {
  const double y = yield_ratio, share = loss / (exponent + 1), energy = 1 / (exponent + 1);
  const double k1 = 1 + share / y, k2 = 1 - share / (1 - y);
  const double left = energy - 0.5 * k1 * y * y;  // beyond the yield point, = k1 y q + k2 q^2/2
  if (left <= 0) return 1;
  const double q = 2 * left / (k1 * y + std::sqrt(k1 * k1 * y * y + 2 * k2 * left));
  return std::sqrt(std::max(0.0, 1 - (k1 - k2) * y * q / energy));
}

/// Upper bound on the loss that a bilinear law can be designed for; the second stiffness vanishes there.
inline double largest_bilinear_loss(double exponent, double yield_ratio) { return (exponent + 1) * (1 - yield_ratio); }

/// loss = 1 - e^2. Muthukumar & DesRoches 2006: assumes that the impact reaches d_m, which it does not.
inline double muthukumar_desroches(const CalibrationTarget& q) { return 1 - q.restitution * q.restitution; }

/// loss at which the law has restitution e at its design speed. Throws std::invalid_argument if there is none.
inline double exact_bilinear_loss(const CalibrationTarget& q) {
  const double e = q.restitution, high = largest_bilinear_loss(q.exponent, q.yield_ratio);
  const double minimum = restitution_of_bilinear_loss(high, q.exponent, q.yield_ratio);
  if (e <= minimum)
    throw std::invalid_argument("restitution " + number_text(e) +
                                " is out of reach of bilinear_hertz with yield_ratio " + number_text(q.yield_ratio) +
                                "; the restitution must exceed " + number_text(minimum) +
                                "; change restitution, yield_ratio or law");
  // The square of the restitution is a smoother function of the loss than the restitution itself, where e is small.
  const auto miss = [&](double loss) {
    const double obtained = restitution_of_bilinear_loss(loss, q.exponent, q.yield_ratio);
    return obtained * obtained - e * e;
  };
  return find_root(miss, 0, 1 - e * e, high, miss(high));
}

/// Stiffness K1 up to the yield point, then K2; unloading along K1 to the line K2 d, then along that line to zero.
///
/// F = K2 d + clamp[(K1-K2)(d-s), 0, (K1-K2) d_y]: a spring K2 in parallel with an elastic-plastic spring with slip s
/// [m]. K1 = K_eff + dE/(a_y d_m^2), K2 = K_eff - dE/((1-a_y) d_m^2) [N/m], d_y = a_y d_m [m], K_eff = k d_m^(n-1), dE
/// = loss k d_m^(n+1)/(n+1) [J]; k [N/m^n], n >= 1 [-], a_y [-] yield_ratio, m [kg] reduced mass, d [m]. d_m [m] is the
/// penetration of a Hertz spring at the closing speed, or at impact_velocity. Never pulls.
///
/// A contact that closes almost at rest would be very soft. Without a fixed impact_velocity it is rejected at a closed
/// gap, and if other forces press it far beyond d_m. Muthukumar 2003; Muthukumar & DesRoches 2006, EESD 35:811;
/// OpenSees ImpactMaterial. The published loss yields a higher restitution than its target (0.69 for 0.50), because the
/// loading curve stores more energy than the Hertz spring.
///
/// Alternatively K1, K2 and d_y are given as initial_stiffness, secondary_stiffness and yield_penetration, as in
/// OpenSees. They are then the same for every impact.
struct BilinearHertz {
  static constexpr std::string_view name = "bilinear_hertz", shape = "F = K2 d + clamp[(K1-K2)(d-s), 0, (K1-K2) d_y]";
  static constexpr std::string_view summary =
      "bilinear hysteresis instead of a dashpot (truss contact, ImpactMaterial)";
  static constexpr std::string_view source = "Muthukumar & DesRoches 2006, EESD 35:811; OpenSees ImpactMaterial";
  static constexpr std::string_view symbols =
      "K1, K2 = k d_m^(n-1) + dE/(a_y d_m^2), k d_m^(n-1) - dE/((1-a_y) d_m^2) [N/m], d_y = a_y d_m [m] yield "
      "penetration, s [m] slip, d_m [m] penetration of a Hertz spring k at the closing speed, dE = loss k "
      "d_m^(n+1)/(n+1) [J]";
  static constexpr std::string_view range =
      "n >= 1, restitutions for which K2 is positive: for a_y = 0.1 and n = 1.5, above 0.354 with exact, any with the "
      "published loss";
  static constexpr std::string_view beware =
      "the stiffnesses are designed for the closing speed of each impact, so a contact that closes almost at rest and "
      "is then pressed deeper is rejected: give a fixed impact_velocity, or K1, K2 and d_y. The slopes jump at yield "
      "and at the start of unloading. The force never pulls";
  static constexpr Quantity number{"loss_ratio", ""}, coefficient{"loss_ratio", ""};

  static constexpr std::array formulas{
      Formula{"exact", "root of e(loss) = e at the design speed", "closed form",
              "reaches the target restitution at the design speed", &exact_bilinear_loss},
      Formula{"muthukumar_desroches", "loss = 1 - e^2", "Muthukumar & DesRoches 2006, EESD 35:811",
              "yields 0.69 for a target of 0.50", &muthukumar_desroches}};

  double stiffness = 0;                     ///< k [N/m^n]
  double exponent = 1.5;                    ///< n [-]
  double yield_ratio = 0.1;                 ///< a_y = d_y/d_m [-]
  std::optional<double> restitution{};      ///< e in (0, 1]
  std::optional<double> impact_velocity{};  ///< fixed design velocity; default: closing speed of each impact [m/s]
  double reduced_mass = 0;                  ///< m [kg]
  DampingFormula formula = formulas[0].function;

  std::optional<double> initial_stiffness{};    ///< K1 [N/m]; given with the next two instead of all parameters above
  std::optional<double> secondary_stiffness{};  ///< K2 <= K1 [N/m]
  std::optional<double> yield_penetration{};    ///< d_y [m]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^n", "Hertz stiffness k", 2.75e9}, &BilinearHertz::stiffness},
      Parameter{{"exponent", "", "exponent n", 1.5, Need::optional}, &BilinearHertz::exponent},
      Parameter{{"yield_ratio", "", "ratio a_y of yield penetration to design penetration", 0.1, Need::optional},
                &BilinearHertz::yield_ratio},
      Parameter{{"initial_stiffness", "N/m", "stiffness K1 up to yield", 1.2e9, Need::together},
                &BilinearHertz::initial_stiffness},
      Parameter{{"secondary_stiffness", "N/m", "stiffness K2 after yield", 1.5e8, Need::together},
                &BilinearHertz::secondary_stiffness},
      Parameter{{"yield_penetration", "m", "yield penetration d_y", 8.6e-4, Need::together},
                &BilinearHertz::yield_penetration}};

  /// True if K1, K2 and d_y are given; false if they are designed for a restitution.
  bool is_given() const noexcept { return initial_stiffness.has_value(); }

  void check() const {
    if (is_given() || secondary_stiffness || yield_penetration) return check_given();
    require_positive("stiffness", stiffness);
    require_exponent(exponent);
    if (!(yield_ratio > 0 && yield_ratio < 1)) refuse("yield_ratio", yield_ratio, "in (0, 1)");
    require_restitution(restitution);
    require_one_damping(*this);
    require_positive("impact_velocity", impact_velocity);
    require_positive("reduced_mass", reduced_mass);
    if (damping_number(1) > largest_bilinear_loss(exponent, yield_ratio))
      refuse("yield_ratio", yield_ratio, "small enough for a positive second stiffness at this restitution");
  }

  /// loss, the ratio of dE to the kinetic energy at the design speed [-]; 0 for given K1, K2 and d_y.
  double damping_number(double) const {
    if (is_given()) return 0;
    return formula({.restitution = *restitution, .exponent = exponent, .yield_ratio = yield_ratio});
  }
  double damping_for(double closing_speed) const { return damping_number(closing_speed); }

  /// Bilinear curve of an impact [N/m], [N/m], [m].
  struct Curve {
    double k1 = 0, k2 = 0, yield = 0;
  };
  Curve curve(const Impact& impact) const noexcept {
    if (is_given()) return {*initial_stiffness, *secondary_stiffness, *yield_penetration};
    const double v = std::max(impact.closing_speed, slowest_closing_speed), dm = design_penetration(v);
    const double k = reduced_mass * v * v * (exponent + 1) / (2 * dm * dm), share = impact.damping / (exponent + 1);
    return {k * (1 + share / yield_ratio), k * (1 - share / (1 - yield_ratio)), yield_ratio * dm};
  }

  /// True if the curve depends on the closing speed of each impact.
  bool needs_closing_speed() const noexcept { return !is_given() && !impact_velocity; }
  /// Ratio of k p^(n-1) to K_eff, see designed_for_speed.
  double softening(double penetration, const Impact& impact) const noexcept {
    const double dm = design_penetration(std::max(impact.closing_speed, slowest_closing_speed));
    return std::pow(std::max(penetration, 0.0) / dm, exponent - 1);
  }

  Response contact(double penetration, double, const Impact& impact) const noexcept {
    const auto [k1, k2, yield] = curve(impact);
    const double stretch = penetration - impact.slip, line = k2 * penetration;
    const double loaded = line + (k1 - k2) * std::min(stretch, yield);
    return {stretch > 0 ? loaded : line, ((stretch > 0) & (stretch < yield)) ? k1 : k2, 0};
  }
  /// Energy of both springs [J]; the slip stores none.
  double stored_energy(double penetration, const Impact& impact) const noexcept {
    const auto [k1, k2, yield] = curve(impact);
    const double stretch = std::clamp(penetration - impact.slip, 0.0, yield);
    return 0.5 * (k2 * penetration * penetration + (k1 - k2) * stretch * stretch);
  }
  /// Changes sign at both ends of the elastic range, where the slope jumps [m].
  double corner(double penetration, double, const Impact& impact) const noexcept {
    const double stretch = penetration - impact.slip;
    return std::min(stretch, curve(impact).yield - stretch);
  }
  /// Moves the slip if the penetration is outside [s, s + d_y].
  void keep(double penetration, double, Impact& impact) const noexcept {
    impact.slip = std::clamp(impact.slip, penetration - curve(impact).yield, std::max(penetration, 0.0));
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }

 private:
  /// d_m: penetration of a Hertz spring at this closing speed [m].
  double design_penetration(double speed) const noexcept {
    return std::pow((exponent + 1) * reduced_mass * speed * speed / (2 * stiffness), 1 / (exponent + 1));
  }
  void check_given() const {
    if (!(initial_stiffness && secondary_stiffness && yield_penetration))
      throw std::invalid_argument(
          "bilinear_hertz needs all three of initial_stiffness, secondary_stiffness and yield_penetration, or none");
    require_positive("initial_stiffness", initial_stiffness);
    require_positive("secondary_stiffness", secondary_stiffness);
    require_positive("yield_penetration", yield_penetration);
    require_not_negative("reduced_mass", reduced_mass);
    if (*secondary_stiffness > *initial_stiffness)
      refuse("secondary_stiffness", *secondary_stiffness,
             "at most the initial_stiffness, " + number_text(*initial_stiffness));
    if (restitution || impact_velocity)
      throw std::invalid_argument(
          "with initial_stiffness, secondary_stiffness and yield_penetration, bilinear_hertz takes no " +
          std::string(restitution ? "restitution" : "impact_velocity") + "; remove it");
  }
};

}  // namespace pounding::laws
