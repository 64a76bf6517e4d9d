#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/points.hpp>

namespace pounding::hysteresis {

/// f is piecewise linear through the origin and the points (d_i, f_i); beyond the last point it continues with the last
/// slope. Elastic: unloading follows the same curve.
///
/// d_i [m] deformations, increasing; f_i [N] forces, not decreasing. If all d_i are positive, f(-d) = -f(d); otherwise
/// the points of both signs are given, with the same slope on both sides of the origin. The point (0, 0) may be given.
/// Known as MultiLinear Elastic link (SAP2000) and ElasticMultiLinear material (OpenSees).
struct MultilinearElastic {
  static constexpr std::string_view name = "multilinear_elastic",
                                    shape = "f = f_i + (f_j-f_i) (d-d_i)/(d_j-d_i), j = i+1";
  static constexpr std::string_view summary = "nonlinear elastic curve through given points (ElasticMultiLinear)";
  static constexpr std::string_view source = "SAP2000 MultiLinear Elastic link; OpenSees ElasticMultiLinear";
  static constexpr std::string_view symbols = "d_i [m], f_i [N] points of the curve, which passes through (0, 0)";
  static constexpr std::string_view range =
      "d_i increase, f_i do not decrease; points with d_i > 0 only are mirrored; beyond the last point the last slope "
      "continues";
  static constexpr std::string_view beware =
      "dissipates no energy. The slope jumps at each point. The stiffness of the storey is the slope at the origin";

  std::vector<double> deformation{};   ///< d_i [m]
  std::vector<double> force{};         ///< f_i [N]
  std::optional<double> slope_at_0{};  ///< must agree with the points; default: their slope at the origin [N/m]

  static constexpr std::array typical_deformation{5e-3, 2e-2}, typical_force{5e4, 1e5};
  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "slope at the origin, which must agree with the points", 1e7, Need::extra},
                &MultilinearElastic::slope_at_0},
      Parameter{{"deformation", "m", "deformations d_i of the points", 5e-3, Need::required, typical_deformation},
                &MultilinearElastic::deformation},
      Parameter{{"force", "N", "forces f_i of the points", 5e4, Need::required, typical_force},
                &MultilinearElastic::force}};

  /// State [m].
  struct State {
    double deformation = 0;
  };
  static constexpr std::array<StateValue<MultilinearElastic>, 0> state{};

  void check() const {
    if (deformation.size() != force.size() || deformation.empty())
      throw std::invalid_argument("force has " + std::to_string(force.size()) + " values and deformation has " +
                                  std::to_string(deformation.size()) + "; give one force per deformation");
    for (const double way : {1.0, -1.0}) {
      std::vector<double> x, y;
      for (std::size_t i = 0; i < deformation.size(); ++i)
        if (way > 0 ? !(deformation[i] < 0) : deformation[i] < 0)
          x.push_back(way * deformation[i]), y.push_back(way * force[i]);
      if (way < 0) std::ranges::reverse(x), std::ranges::reverse(y);
      if (way > 0 || is_two_sided())
        laws::Polyline{x, y}.check(is_two_sided() ? "deformation of one sign" : "deformation",
                                   is_two_sided() ? "force of one sign" : "force");
    }
    const double k = stiffness(), other = side(-1).slope(0);
    if (!agree(k, other))
      throw std::invalid_argument("force has the slopes " + laws::number_text(k) + " and " + laws::number_text(other) +
                                  " N/m on the two sides of the origin; they must be equal");
    if (slope_at_0 && !agree(*slope_at_0, k))
      laws::refuse("stiffness", *slope_at_0, laws::number_text(k) + ", the slope of the points at the origin");
  }
  double stiffness() const noexcept { return side(1).slope(0); }
  /// The corner next to the origin; the only point of a straight line.
  double yield_deformation() const noexcept { return std::min(yield_deformation(1), yield_deformation(-1)); }
  double yield_deformation(double way) const noexcept { return side(way).x(0); }

  Answer respond(const State& kept, double d) const noexcept {
    const Side on = side(d == 0 ? kept.deformation : d);
    const double far = std::abs(d), from = (d < 0) == (kept.deformation < 0) ? std::abs(kept.deformation) : 0;
    const std::size_t i = on.segment(far, far > from);
    return {std::copysign(on.force(far, i), d), on.slope(i)};
  }
  Answer excess(const State& kept, double d) const noexcept {
    const Range inside = elastic(kept);
    if (d > inside.low && d < inside.high) return {};
    const Answer all = respond(kept, d);
    return {all.force - stiffness() * d, all.slope - stiffness()};
  }
  State advance(const State&, double d) const noexcept { return {d}; }
  double stored(const State& kept) const noexcept {
    const Side on = side(kept.deformation);
    return on.area(0, std::abs(kept.deformation));
  }
  double stored_excess(const State& kept) const noexcept {
    const Range inside = elastic(kept);
    if (kept.deformation > inside.low && kept.deformation < inside.high) return 0;
    return stored(kept) - 0.5 * stiffness() * kept.deformation * kept.deformation;
  }
  double lost(const State&, double) const noexcept { return 0; }
  double work(const State& kept, double d) const noexcept {
    const Side before = side(kept.deformation), after = side(d);
    if ((kept.deformation < 0) != (d < 0))
      return after.area(0, std::abs(d)) - before.area(0, std::abs(kept.deformation));
    return after.area(std::abs(kept.deformation), std::abs(d));
  }
  /// Between the corners next to the origin; slightly smaller, as a margin for round-off.
  Range elastic(const State&) const noexcept {
    constexpr double inner = 1 - 1e-9;
    return {-inner * yield_deformation(-1), inner * yield_deformation(1)};
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    std::optional<double> nearest;
    for (const double way : {1.0, -1.0}) {
      const Side on = side(way);
      for (std::size_t i = 0; i + 1 < on.count; ++i) {
        const double x = way * on.x(i);
        if (is_strictly_between(x, kept.deformation, d) &&
            (!nearest || std::abs(x - kept.deformation) < std::abs(*nearest - kept.deformation)))
          nearest = x;
      }
    }
    return nearest;
  }

 private:
  // Points of one sign as a curve of magnitudes from the origin.
  struct Side {
    const double *xs, *ys;  // next to the origin
    std::size_t count;
    double sign;
    std::ptrdiff_t step;

    double x(std::size_t i) const noexcept { return sign * xs[static_cast<std::ptrdiff_t>(i) * step]; }
    double y(std::size_t i) const noexcept { return sign * ys[static_cast<std::ptrdiff_t>(i) * step]; }
    double begin_x(std::size_t i) const noexcept { return i == 0 ? 0 : x(i - 1); }
    double begin_y(std::size_t i) const noexcept { return i == 0 ? 0 : y(i - 1); }
    double slope(std::size_t i) const noexcept { return (y(i) - begin_y(i)) / (x(i) - begin_x(i)); }
    double force(double at, std::size_t i) const noexcept { return begin_y(i) + slope(i) * (at - begin_x(i)); }
    // Segment that contains `at`; at a point, the one before it if the magnitude grows.
    std::size_t segment(double at, bool grows) const noexcept {
      std::size_t i = 0;
      while (i + 1 < count && (grows ? x(i) < at : x(i) <= at)) ++i;
      return i;
    }
    // Area between two magnitudes, in trapezoids, to avoid cancellation on short paths.
    double area(double from, double to) const noexcept {
      if (to < from) return -area(to, from);
      double sum = 0;
      for (std::size_t i = segment(from, false); from < to; ++i) {
        const double end = i + 1 < count ? std::min(to, x(i)) : to;
        sum += 0.5 * (force(from, i) + force(end, i)) * (end - from);
        from = end;
      }
      return sum;
    }
  };
  Side side(double way) const noexcept {
    const auto negative = static_cast<std::size_t>(std::ranges::lower_bound(deformation, 0.0) - deformation.begin());
    const std::size_t positive = negative + (deformation[negative] == 0 ? 1 : 0);
    if (way < 0 && negative > 0) return {&deformation[negative - 1], &force[negative - 1], negative, -1, -1};
    return {&deformation[positive], &force[positive], deformation.size() - positive, 1, 1};
  }
  static bool agree(double a, double b) noexcept { return std::abs(a - b) <= 1e-6 * std::abs(b); }
  bool is_two_sided() const noexcept { return deformation.front() < 0; }
};

}  // namespace pounding::hysteresis
