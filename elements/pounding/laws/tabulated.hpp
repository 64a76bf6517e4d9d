#pragma once
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <pounding/laws/law.hpp>
#include <pounding/laws/points.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F is piecewise linear through the origin and the points (d_i, F_i); beyond the last point it continues with the last
/// slope. Elastic: unloading follows the same curve.
///
/// d_i > 0 [m] penetrations, increasing; F_i [N] forces, not decreasing, the first one above zero. The point (0, 0) may
/// be given.
struct Tabulated {
  static constexpr std::string_view name = "tabulated", shape = "F = F_i + (F_j-F_i) (d-d_i)/(d_j-d_i), j = i+1";
  static constexpr std::string_view summary = "elastic curve through given points, such as those of a bumper";
  static constexpr std::string_view source = "piecewise linear interpolation of measured or specified points";
  static constexpr std::string_view symbols = "d_i [m], F_i [N] points of the curve, which begins at (0, 0)";
  static constexpr std::string_view range =
      "d_i increase, F_i do not decrease; beyond the last point the last slope continues";
  static constexpr std::string_view beware =
      "dissipates no energy. The slope jumps at each point, and beyond the last point the curve is extrapolated: "
      "compare the peak penetration with the last point";

  std::vector<double> penetration{};  ///< d_i [m]
  std::vector<double> force{};        ///< F_i [N]

  static constexpr std::array typical_penetration{1e-3, 5e-3}, typical_force{1e6, 8e6};
  static constexpr std::array parameters{
      Parameter{{"penetration", "m", "penetrations d_i of the points", 1e-3, Need::required, typical_penetration},
                &Tabulated::penetration},
      Parameter{{"force", "N", "forces F_i of the points", 1e6, Need::required, typical_force}, &Tabulated::force}};

  void check() const { curve().check("penetration", "force"); }
  /// Force over penetration.
  Polyline curve() const noexcept { return {penetration, force}; }

  Response contact(double d, double, const Impact&) const noexcept {
    const CurvePoint on = curve().at(d);
    return {on.value, on.slope, 0};
  }
  /// Area below the curve [J].
  double stored_energy(double d, const Impact&) const noexcept { return curve().area(d); }
  /// Changes sign at each point of the curve, where the slope jumps [m].
  double corner(double d, double, const Impact&) const noexcept {
    const std::size_t first = curve().first(), last = penetration.size() - 1, end = curve().segment(d);
    // The last point is no corner, because its slope continues.
    const double below = end == first ? penetration[last] : d - penetration[end - 1];
    const double above = end == last ? penetration[last] : penetration[end] - d;
    return ((end - first) % 2 == 0 ? 1 : -1) * std::min(below, above);
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
