#pragma once
/// Common part of the piecewise-linear laws whose backbone is given by points.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <pounding/hysteresis/piecewise_linear.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// Backbone of one side through the origin and n points (e, s) [m], [N], by magnitudes. Beyond the last point, the last
/// line continues if it rises; otherwise the force is constant.
template <std::size_t n>
struct BackboneSide {
  std::array<double, n> e{}, s{};

  /// Slope of the first line [N/m].
  double stiffness() const noexcept { return s[0] / e[0]; }
  /// Index of the line that begins at or before x; n beyond the last point.
  std::size_t line(double x) const noexcept {
    return static_cast<std::size_t>(std::ranges::upper_bound(e, x) - e.begin());
  }
  /// Slope of a line [N/m].
  double slope(std::size_t i) const noexcept {
    if (i == 0) return stiffness();
    return i < n ? (s[i] - s[i - 1]) / (e[i] - e[i - 1]) : std::max(slope(n - 1), 0.0);
  }
  /// Force at x, by the line i [N].
  double force(double x, std::size_t i) const noexcept {
    return i == 0 ? stiffness() * x : s[i - 1] + slope(i) * (x - e[i - 1]);
  }
  /// Force at x [N].
  double force(double x) const noexcept { return force(x, line(x)); }
  /// Deformation at the end of a line [m].
  double end(std::size_t i) const noexcept { return i < n ? e[i] : HUGE_VAL; }
  /// Area up to the last point [J].
  double area() const noexcept {
    double sum = 0.5 * s[0] * e[0];
    for (std::size_t i = 1; i < n; ++i) sum += 0.5 * (s[i] + s[i - 1]) * (e[i] - e[i - 1]);
    return sum;
  }
};

/// Points of a backbone: forces s [N] and deformations e [m]; p in the positive direction, n in the negative one, with
/// negative values. The first point is (yield_force/initial_stiffness, yield_force).
struct BackbonePoints {
  double initial_stiffness = 0;                                    ///< slope of the first line > 0 [N/m]
  double yield_force = 0;                                          ///< force of the first point > 0 [N]
  double s2p = 0, e2p = 0, s3p = 0, e3p = 0;                       ///< further points [N], [m]
  std::optional<double> s1n{}, e1n{}, s2n{}, e2n{}, s3n{}, e3n{};  ///< negative side; each by default mirrored [N], [m]
};

/// Names and typical values of n points per side, in the order s1, e1, s2, ..., for the rows of a table. The stiffness
/// defines e1 of the positive side.
template <std::size_t n>
struct BackboneNames {
  std::array<std::string_view, 2 * n> positive, negative;  ///< of both sides
  std::array<double, 2 * n> typical;                       ///< of the positive side [N], [m]

  /// Force of point i of the positive side.
  constexpr ParameterInfo force(std::size_t i) const {
    if (i == 0)
      return {.name = positive[0],
              .unit = "N",
              .meaning = "force of the first point of the backbone; its deformation is this force over the stiffness",
              .typical = typical[0],
              .at_hinge = "yield_moment"};
    return {positive[2 * i], "N", "force of a point of the backbone", typical[2 * i]};
  }
  /// Its deformation.
  constexpr ParameterInfo deformation(std::size_t i) const {
    return {positive[2 * i + 1], "m", "deformation of a point of the backbone", typical[2 * i + 1]};
  }
  /// Force of point i of the negative side.
  constexpr ParameterInfo negative_force(std::size_t i) const {
    return {negative[2 * i], "N", "force of a point in the negative direction, negative (default: mirrored)",
            -typical[2 * i], Need::extra};
  }
  /// Its deformation.
  constexpr ParameterInfo negative_deformation(std::size_t i) const {
    return {negative[2 * i + 1], "m", "deformation of a point in the negative direction, negative (default: mirrored)",
            -typical[2 * i + 1], Need::extra};
  }
};

/// Base of such a law Self with n points per side, whose table of parameters begins with the stiffness, s1p, s2p, e2p,
/// ..., s1n, e1n, s2n, ...
template <class Self, class State, std::size_t n>
struct Backbone : PiecewiseLinear<Self, State>, BackbonePoints {
  double stiffness() const noexcept { return initial_stiffness; }
  /// Minimum of both directions.
  double yield_deformation() const noexcept { return std::min(yield_deformation(1), yield_deformation(-1)); }
  double yield_deformation(double way) const noexcept { return side_of(way).e[0]; }
  /// Ratio of the second to the first slope of the positive side.
  double hardening_ratio() const noexcept { return side_of(1).slope(1) / initial_stiffness; }
  /// The law with the positive and the negative direction exchanged.
  Self mirrored() const noexcept {
    Self law = self();
    const Side positive = side_of(1), negative = side_of(-1);
    law.initial_stiffness = negative.stiffness();
    law.yield_force = negative.s[0];
    law.s1n = -positive.s[0];
    if (e1n) law.e1n = -positive.e[0];
    for (std::size_t i = 1; i < n; ++i) {
      Self::parameters[force_row(i, 1)].set(law, negative.s[i]);
      Self::parameters[force_row(i, 1) + 1].set(law, negative.e[i]);
      Self::parameters[force_row(i, -1)].set(law, -positive.s[i]);
      Self::parameters[force_row(i, -1) + 1].set(law, -positive.e[i]);
    }
    return law;
  }

 protected:
  using Side = BackboneSide<n>;

  void check_points(Use use) const {
    laws::require_positive("stiffness", initial_stiffness);
    const auto name = [use](std::size_t row) { return std::string(name_at(use, Self::parameters[row].info)); };
    for (const int way : {1, -1}) {
      const Side side = side_of(way);
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t row = force_row(i, way);
        const std::string force = name(row);
        const double least = i > 0 ? side.e[i - 1] : 0;
        if (!(std::isfinite(side.s[i]) && side.s[i] >= 0) || (i == 0 && side.s[0] == 0))
          laws::refuse(force, way * side.s[i], way > 0 ? "finite and not negative" : "finite and not positive");
        if (!(std::isfinite(side.e[i]) && side.e[i] > least))
          laws::refuse(name(row + 1), way * side.e[i],
                       "beyond the previous point, at " + laws::number_text(way * least));
        const double highest = i > 0 ? side.s[i - 1] + side.stiffness() * (side.e[i] - least) : HUGE_VAL;
        if (side.s[i] > highest * (1 + 1e-9))
          laws::refuse(force, way * side.s[i],
                       "at most " + laws::number_text(highest) + " in magnitude: the first line is the steepest");
      }
    }
  }
  Side side_of(double way) const noexcept {
    Side side;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t row = force_row(i, 1), other = force_row(i, -1);
      side.s[i] = way < 0 ? -value(other).value_or(-*value(row)) : *value(row);
      side.e[i] = i > 0 ? *value(row + 1) : side.s[0] / initial_stiffness;
      if (way < 0) side.e[i] = -value(other + 1).value_or(-side.e[i]);
    }
    return side;
  }
  /// Deformation at which the first line ends; 0 if the other side has another stiffness.
  double end_of_elastic(int way) const noexcept { return way > 0 || !e1n ? way * side_of(way).e[0] : 0; }
  static std::size_t index(double way) noexcept { return way > 0 ? 0 : 1; }

 private:
  const Self& self() const noexcept { return static_cast<const Self&>(*this); }
  std::optional<double> value(std::size_t row) const noexcept { return Self::parameters[row].get(self()); }
  static std::size_t force_row(std::size_t i, double way) noexcept {
    if (way < 0) return 2 * n + 2 * i;
    return i == 0 ? 1 : 2 * i;
  }
};

}  // namespace pounding::hysteresis
