#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/base/root.hpp>
#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// s = s_r + (s_0 - s_r) [b x + (1-b) x/(1 + |x|^R)^(1/R)], x = (e - e_r)/(e_0 - e_r): Steel02 as OpenSees computes it.
///
/// (e_r, s_r) last reversal; (e_0, s_0) intersection of the elastic line from it with the hardening line through (n ey,
/// n Fy), n = 1 + a1 (w/(2 a2 ey))^0.8 in compression, with a3, a4 in tension, w [-] the range of all reversals; R = R0
/// [1 - cR1 xi/(cR2 + xi)], xi [-] distance, divided by ey = Fy/E, from e_0 to the extreme reversal on its side.
struct Steel02 : ByPieces<Steel02> {
  static constexpr std::string_view name = "steel02", shape = "s = s_r + (s_0 - s_r) [b x + (1-b) x/(1 + |x|^R)^(1/R)]";
  static constexpr std::string_view summary = "steel of Menegotto and Pinto, as OpenSees computes it (Steel02)";
  static constexpr std::string_view source = "Menegotto & Pinto 1973; Filippou, Popov & Bertero 1983, EERC 83-19";
  static constexpr std::string_view symbols =
      "(e_r, s_r) last reversal, (e_0, s_0) intersection of the elastic line from it and the hardening line, x [-] = "
      "(e - e_r)/(e_0 - e_r), R [-] = R0 [1 - cR1 xi/(cR2 + xi)], b [-] hardening ratio";
  static constexpr std::string_view range = "0 <= b < 1, R0 (1 - cR1) >= 1";
  static constexpr std::string_view beware =
      "one reversal of 1e-9 Fy/E changes later stresses by up to 0.36 Fy, so no error tolerance applies. Use "
      "menegotto_pinto unless results of OpenSees are to be reproduced";
  /// Upper bound on the energy that a path can recover beyond stored(), divided by Fy^2/E, with the typical parameters.
  static constexpr double gives_back = 0.15;
  static constexpr bool has_corners = false, forgets_small_reversals = false;

  double Fy = 0;                            ///< > 0 [Pa]
  double E = 0;                             ///< > 0 [Pa]
  double b = 0;                             ///< in [0, 1) [-]
  double R0 = 20, cR1 = 0.925, cR2 = 0.15;  ///< [-]
  double a1 = 0, a2 = 1, a3 = 0, a4 = 1;    ///< isotropic hardening [-]

  static constexpr std::array parameters{
      Parameter{{"Fy", "Pa", "yield stress", 460e6}, &Steel02::Fy},
      Parameter{{"E", "Pa", "modulus", 200e9}, &Steel02::E},
      Parameter{{"b", "", "hardening ratio", 0.01}, &Steel02::b},
      Parameter{{"R0", "", "sharpness of the first transition", 20, hysteresis::Need::optional}, &Steel02::R0},
      Parameter{{"cR1", "", "maximum relative reduction of R0", 0.925, hysteresis::Need::optional}, &Steel02::cR1},
      Parameter{{"cR2", "", "plastic excursion, divided by Fy/E, at half of that reduction", 0.15,
                 hysteresis::Need::optional},
                &Steel02::cR2},
      Parameter{{"a1", "", "isotropic hardening in compression", 0, hysteresis::Need::optional}, &Steel02::a1},
      Parameter{{"a2", "", "range of reversals, divided by 2 Fy/E, for a1", 1, hysteresis::Need::optional},
                &Steel02::a2},
      Parameter{{"a3", "", "isotropic hardening in tension", 0, hysteresis::Need::optional}, &Steel02::a3},
      Parameter{{"a4", "", "range of reversals, divided by 2 Fy/E, for a3", 1, hysteresis::Need::optional},
                &Steel02::a4}};

  /// A curve from a reversal: e_r, s_r, e_0 - e_r, s_0 - s_r, R.
  struct Curve {
    double strain = 0, stress = 0, length = 1, height = 0, sharpness = 1;
  };
  /// Accepted strain and stress, extreme reversals (at least +-ey after the first loading), and current curve.
  struct State {
    double deformation = 0, stress = 0, maximum = 0, minimum = 0;
    Curve curve{};
    int way = 0;  // of the current curve: 1 up, -1 down, 0 before the first loading
  };
  /// Accepted strain, and the curves in both directions from it.
  struct Branch {
    double strain = 0;
    Curve up{}, down{};
  };
  static constexpr std::array state{
      StateValue<Steel02>{{"maximum", "", "maximum reversal"}, [](const State& kept) { return kept.maximum; }},
      StateValue<Steel02>{{"minimum", "", "minimum reversal"}, [](const State& kept) { return kept.minimum; }}};

  void check() const {
    laws::require_positive("Fy", Fy);
    laws::require_positive("E", E);
    if (!(b >= 0 && b < 1)) laws::refuse("b", b, "in [0, 1)");
    if (!(cR1 >= 0 && cR1 < 1)) laws::refuse("cR1", cR1, "in [0, 1)");
    laws::require_positive("cR2", cR2);
    if (!(std::isfinite(R0) && R0 * (1 - cR1) >= 1))
      laws::refuse("R0", R0,
                   "at least 1/(1 - cR1) = " + laws::number_text(1 / (1 - cR1)) + ", so that R is at least 1");
    laws::require_not_negative("a1", a1);
    laws::require_positive("a2", a2);
    laws::require_not_negative("a3", a3);
    laws::require_positive("a4", a4);
  }
  double stiffness() const noexcept { return E; }
  double yield_deformation() const noexcept { return Fy / E; }

  using ByPieces::respond;
  Branch branch(const State& kept) const noexcept {
    return {kept.deformation, towards(kept, 1).curve, towards(kept, -1).curve};
  }
  Answer respond(const Branch& from, double strain) const noexcept {
    const Curve& c = strain < from.strain ? from.down : from.up;
    const double x = (strain - c.strain) / c.length, power = 1 + std::pow(std::abs(x), c.sharpness);
    const double root = std::pow(power, 1 / c.sharpness);
    return {c.stress + c.height * (b * x + (1 - b) * x / root), c.height / c.length * (b + (1 - b) / (power * root))};
  }
  State advance(const State& kept, double strain) const noexcept {
    if (strain == kept.deformation) return kept;
    State next = towards(kept, strain > kept.deformation ? 1 : -1);
    next.stress = respond(branch(kept), strain).force;
    next.deformation = strain;
    return next;
  }
  std::array<double, 0> corners(const State&) const noexcept { return {}; }
  double unloaded(const State& kept) const noexcept {
    const Branch from = branch(kept);
    const auto stress = [&](double strain) { return respond(from, strain).force; };
    double step = -kept.stress / E, end = kept.deformation + step;
    if (end == kept.deformation) return end;
    while (stress(end) * kept.stress > 0 && std::abs(end) < 1e3) end += step *= 2;
    if (stress(end) * kept.stress > 0) return end;
    return find_root(stress, kept.deformation, kept.stress, end, stress(end));
  }

 private:
  /// The state with the curve of a direction: the current one, or a new one from a reversal at the accepted strain.
  State towards(const State& kept, int way) const noexcept {
    const double ey = Fy / E;
    if (kept.way == way) return kept;
    State next = kept;
    next.way = way;
    if (kept.way == 0) {
      next.maximum = ey, next.minimum = -ey;
      next.curve = {0, 0, way * ey, way * Fy, R0};
      return next;
    }
    next.maximum = way < 0 ? std::max(kept.maximum, kept.deformation) : kept.maximum;
    next.minimum = way > 0 ? std::min(kept.minimum, kept.deformation) : kept.minimum;
    const double span = (next.maximum - next.minimum) / (2 * ey * (way > 0 ? a4 : a2));
    const double shift = 1 + (way > 0 ? a3 : a1) * std::pow(span, 0.8);
    // At a reversal within round-off of the hardening line, the intersection is at the reversal.
    const double length = (way * shift * Fy * (1 - b) - kept.stress + b * E * kept.deformation) / (E * (1 - b));
    const double bounded = way * std::max(way * length, 1e-12 * ey);
    const double xi = std::abs((way > 0 ? next.maximum : next.minimum) - kept.deformation - bounded) / ey;
    next.curve = {kept.deformation, kept.stress, bounded, E * bounded, R0 * (1 - cR1 * xi / (cR2 + xi))};
    return next;
  }
};

}  // namespace pounding::materials
