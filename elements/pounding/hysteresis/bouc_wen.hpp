#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <pounding/hysteresis/integral.hpp>
#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// f = a k d + (1-a) k z, dz/dd = 1 - |z/dy|^n (g + (1-g) sign(z dd)), dy = Fy/k: smooth transition from elastic to
/// plastic.
///
/// k [N/m] initial stiffness, Fy [N] yield force, a [-] ratio of post-yield to initial stiffness, n >= 1 [-] sharpness
/// of the transition, g = gamma/(beta + gamma) in [0, 1/2] [-], z [m] elastic part of the deformation. Wen 1976, J.
/// Eng. Mech. Div. 102:249; Baber & Wen 1981, J. Eng. Mech. Div. 107:1069. The law is rate-independent, so z is a
/// function of the path and not of time. For n = 1 it is exponential; for n = 2 a hyperbolic tangent in loading and a
/// tangent in unloading; for g = 1/2 linear in unloading. For other n it is the inverse of an integral, computed to
/// 1e-13.
///
/// With the stored energy (1-a) k z^2/2, unloading dissipates (1 - 2g)|z/dy|^n. Values of g above 1/2 would generate
/// energy and are rejected (Erlicher & Point 2004, C. R. Mecanique 332:51). The law violates Drucker's postulate: under
/// force cycles between 0.2 and 0.8 Fy (a = 0, g = 1/2) it ratchets by 0.79, 0.30, 0.05 dy per cycle for n = 1, 2, 5.
struct BoucWen {
  static constexpr std::string_view name = "bouc_wen",
                                    shape = "f = a k d + (1-a) k z, dz/dd = 1 - |z/dy|^n [g + (1-g) sign(z dd)]";
  static constexpr std::string_view summary = "smooth elastic-plastic transition (BoucWen, plastic Wen link)";
  static constexpr std::string_view source =
      "Wen 1976, J. Eng. Mech. Div. 102:249; Baber & Wen 1981, J. Eng. Mech. Div. 107:1069";
  static constexpr std::string_view symbols =
      "k [N/m] initial stiffness, dy = Fy/k [m], Fy [N] yield force, a [-] hardening ratio, n [-] sharpness of the "
      "transition, g = gamma/(beta + gamma) [-], z [m] elastic part of the deformation";
  static constexpr std::string_view range = "0 <= a < 1, n >= 1, 0 <= g <= 1/2";
  static constexpr std::string_view beware =
      "small cycles about a constant force ratchet: between 0.2 and 0.8 Fy by 0.79, 0.30, 0.05 dy per cycle for n = 1, "
      "2, 5. In contrast to codes that integrate z numerically, results do not depend on the step";
  static constexpr bool has_corners = false;

  double initial_stiffness = 0;  ///< k > 0 [N/m]
  double yield_force = 0;        ///< Fy > 0 [N]
  double hardening = 0;          ///< a in [0, 1) [-]
  double exponent = 2;           ///< n >= 1 [-]
  double gamma_share = 0.5;      ///< g in [0, 1/2] [-]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "initial stiffness k", 1e7}, &BoucWen::initial_stiffness},
      Parameter{yield_force_info, &BoucWen::yield_force},
      Parameter{hardening_info("ratio a of post-yield to initial stiffness"), &BoucWen::hardening},
      Parameter{{"exponent", "", "sharpness n of the transition", 2, Need::optional}, &BoucWen::exponent},
      Parameter{{"gamma_share", "", "g = gamma/(beta + gamma)", 0.5, Need::optional}, &BoucWen::gamma_share}};

  /// State [m].
  struct State {
    double deformation = 0, elastic = 0;
  };
  static constexpr std::array state{StateValue<BoucWen>{{"elastic", "m", "elastic part of the deformation z"},
                                                        [](const State& kept) { return kept.elastic; }}};

  void check() const {
    laws::require_positive("stiffness", initial_stiffness);
    laws::require_positive("yield_force", yield_force);
    if (!(hardening >= 0 && hardening < 1)) laws::refuse("hardening", hardening, "in [0, 1)");
    laws::require_exponent(exponent);
    if (!(gamma_share >= 0 && gamma_share <= 0.5))
      laws::refuse("gamma_share", gamma_share, "in [0, 0.5]: higher values would generate energy");
  }
  double stiffness() const noexcept { return initial_stiffness; }
  double yield_deformation() const noexcept { return yield_force / initial_stiffness; }

  Answer respond(const State& kept, double d) const noexcept {
    const double sign = d < kept.deformation ? -1 : 1, dy = yield_deformation(), y = elastic_at(kept, d);
    return {initial_stiffness * (hardening * d + (1 - hardening) * sign * dy * y),
            initial_stiffness * (hardening + (1 - hardening) * slope(y))};
  }
  State advance(const State& kept, double d) const noexcept {
    return {d, (d < kept.deformation ? -1 : 1) * yield_deformation() * elastic_at(kept, d)};
  }
  double stored(const State& kept) const noexcept {
    return 0.5 * initial_stiffness *
           (hardening * kept.deformation * kept.deformation + (1 - hardening) * kept.elastic * kept.elastic);
  }
  double work(const State& kept, double d) const noexcept {
    const double dy = yield_deformation(), before = (d < kept.deformation ? -1 : 1) * kept.elastic / dy,
                 after = elastic_at(kept, d);
    const double spring = 0.5 * (d - kept.deformation) * (d + kept.deformation);
    const double yielding = work_of(before, after, std::abs(d - kept.deformation) / dy);
    return initial_stiffness * (hardening * spring + (1 - hardening) * dy * dy * yielding);
  }
  std::optional<double> corner(const State&, double) const noexcept { return {}; }

 private:
  // Coordinates in the direction of the path, divided by dy: y = +-z/dy in [-1, 1], and the length x of the path.
  // Loading has y > 0.

  /// 1 - 2g, coefficient of |y|^n in the slope of unloading.
  double bend() const noexcept { return 1 - 2 * gamma_share; }
  double slope(double y) const noexcept {
    return y < 0 ? 1 + bend() * std::pow(-y, exponent) : 1 - std::pow(std::min(y, 1.0), exponent);
  }
  /// y at the end of the path to d.
  double elastic_at(const State& kept, double d) const noexcept {
    const double dy = yield_deformation(), way = std::abs(d - kept.deformation) / dy;
    const double y = std::clamp((d < kept.deformation ? -1 : 1) * kept.elastic / dy, -1.0, 1.0);
    if (way == 0) return y;
    if (!(y < 0)) return loaded(y, way);
    if (way * slope(y) < -y) return unloaded(y, way);  // the slope decreases on the path to zero
    const double to_zero = way_to_zero(y);
    return way < to_zero ? unloaded(y, way) : loaded(0, way - to_zero);
  }
  /// Length of the path from y < 0 to 0.
  double way_to_zero(double y) const noexcept {
    const double c = bend();
    if (c == 0) return -y;
    if (exponent == 1) return std::log1p(-c * y) / c;
    if (exponent == 2) return std::atan(-std::sqrt(c) * y) / std::sqrt(c);
    return unloading_way(y, 0);
  }
  double unloading_way(double from, double to) const noexcept {
    return integral([this](double y) { return 1 / (1 + bend() * std::pow(std::abs(y), exponent)); }, from, to,
                    accuracy);
  }
  /// y < 0 after a path of length x that does not reach zero.
  double unloaded(double y, double x) const noexcept {
    const double c = bend();
    if (c == 0) return y + x;
    if (exponent == 1) return y * std::exp(-c * x) - std::expm1(-c * x) / c;
    if (exponent == 2) return std::tan(std::sqrt(c) * x + std::atan(std::sqrt(c) * y)) / std::sqrt(c);
    double end = std::min(runge_kutta([this](double at) { return slope(at); }, y, x), 0.0);
    for (int i = 0; i < 50; ++i) {
      const double left = x - unloading_way(y, end);
      if (std::abs(left) * exponent < 3e-4 * std::min(1.0, -end)) return std::min(unloaded_further(end, left), 0.0);
      const double step = left * slope(end);
      end = std::min(end + step, 0.0);
      if (std::abs(step) < accuracy) break;
    }
    return end;
  }
  /// y < 0 after a short path of length x, with an error of fourth order in x.
  double unloaded_further(double y, double x) const noexcept {
    const double power = bend() * std::pow(-y, exponent), s = 1 + power;
    const double first = exponent * power / y, second = (exponent - 1) * first / y;  // derivatives of the slope
    return y + x * s * (1 + x / 2 * (first + x / 3 * (second * s + first * first)));
  }
  /// Solution of dy/dx = f(y) after one fourth-order step x.
  template <class F>
  static double runge_kutta(const F& f, double y, double x) noexcept {
    const double k1 = f(y), k2 = f(y + 0.5 * x * k1), k3 = f(y + 0.5 * x * k2), k4 = f(y + x * k3);
    return y + x / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  /// y >= 0 after a path of length x.
  double loaded(double y, double x) const noexcept {
    if (!(y < 1)) return 1;
    if (exponent == 1) return y * std::exp(-x) - std::expm1(-x);
    const double start = std::atanh(y);
    if (exponent == 2) return std::tanh(start + x);
    return std::tanh(loaded_angle(start, x));
  }
  /// dx/ds for y = tanh s: between 2/n and 1, so that the path length is a smooth function of s up to the maximum
  /// force.
  double way_by_angle(double s) const noexcept {
    const double e = std::exp(-2 * s), y = (1 - e) / (1 + e), rest = 4 * e / ((1 + e) * (1 + e));  // 1 - y^2
    // 1 - y^n without cancellation: directly for small y, from the distance to 1 near 1.
    const double fall = y < 0.7 ? 1 - std::pow(y, exponent) : -std::expm1(0.5 * exponent * std::log1p(-rest));
    return y > 0 ? (fall > 0 ? rest / fall : 2 / exponent) : 1;
  }
  double loaded_angle(double start, double x) const noexcept {
    constexpr double saturated = 20;  // tanh s = 1 - 8e-18 here
    if (start >= saturated) return start;
    const auto way = [this](double s) { return way_by_angle(s); };
    double end = std::clamp(runge_kutta([&](double s) { return 1 / way(s); }, start, x), start, saturated);
    for (int i = 0; i < 50; ++i) {
      const double left = x - integral(way, start, end, accuracy), here = way(end);
      const double step = left / here;
      if (left != 0 && std::abs(step) < 1e-5) {
        const double growth = (way(end + step) - here) / left;  // relative change of `way` per unit path length
        return std::clamp(end + step * (1 - 0.5 * growth * step), start, saturated);
      }
      end = std::clamp(end + step, start, saturated);
      if (std::abs(step) < accuracy || end == saturated) break;
    }
    return end;
  }
  /// Integral of y over the path of length x between two values of y.
  double work_of(double from, double to, double x) const noexcept {
    const auto unloading = [this](double y) { return y / (1 + bend() * std::pow(std::abs(y), exponent)); };
    if (!(from < 0)) return loading_work(from, to, x);
    if (!(to > 0)) return bend() == 0 ? 0.5 * (to - from) * (to + from) : integral(unloading, from, to, accuracy);
    const double first = bend() == 0 ? -0.5 * from * from : integral(unloading, from, 0, accuracy);
    return first + loading_work(0, to, x - way_to_zero(from));
  }
  /// For y >= 0: the path length minus the integral of 1 - y, which is the change of y for n = 1 and a logarithm for n
  /// = 2.
  double loading_work(double from, double to, double x) const noexcept {
    if (!(from < 1)) return x;
    if (exponent == 1) return x - (to - from);
    const double start = std::atanh(from);
    if (exponent == 2) return x + std::log1p(std::exp(-2 * (start + x))) - std::log1p(std::exp(-2 * start));
    const auto short_of = [this](double s) { return 2 / (1 + std::exp(2 * s)) * way_by_angle(s); };
    return x - integral(short_of, start, loaded_angle(start, x), accuracy);
  }

  static constexpr double accuracy = 1e-13;
};

}  // namespace pounding::hysteresis
