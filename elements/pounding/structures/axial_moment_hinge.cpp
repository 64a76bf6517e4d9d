#include <pounding/structures/axial_moment_hinge.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <pounding/base/runge_kutta.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding {
namespace {

using Pair = CoupledYielding::Pair;

constexpr double hinge_accuracy = 1e-9;

double dot_product(const Pair& a, const Pair& b) noexcept { return a[0] * b[0] + a[1] * b[1]; }
Pair turned_left(const Pair& a) noexcept { return {-a[1], a[0]}; }

/// Largest root >= 0 of a convex parabola a s^2 + 2 h s + f that is not positive at 0, up to round-off: where a
/// straight line leaves a convex set. Infinite if it does not.
double exit_root(double a, double h, double f) noexcept {
  const double root = std::sqrt(std::max(0.0, h * h - a * f));
  if (h > 0) return std::max(0.0, -f / (h + root));
  return a > 0 ? (root - h) / a : std::numeric_limits<double>::infinity();
}

/// The yield surface in coordinates in which the plastic flow is normal to it: sqrt(k) times the elastic deformation,
/// divided by a length of the surface. The position on it is t: an angle on the ellipse, n on each half of the
/// parabola.
struct YieldSurface {
  bool is_ellipse;
  double axial, bending, centre;  // half axes; axial coordinate of the largest moment
  double half = 1;                // sign of the moment on the parabola

  /// A point with the derivatives by t.
  struct Point {
    Pair at, tangent, bend;
  };
  Point point(double t) const noexcept {
    if (!is_ellipse)
      return {{axial * t, half * bending * (1 - t * t)}, {axial, -2 * half * bending * t}, {0, -2 * half * bending}};
    const double c = axial * std::cos(t), s = bending * std::sin(t), x = -axial / bending * s, y = bending / axial * c;
    return {{centre + c, s}, {x, y}, {-c, -s}};
  }
  /// Length of the path from here in this direction to the surface; selects the half.
  double reach(const Pair& from, const Pair& way) noexcept {
    const double n = (from[0] - centre) / axial, m = from[1] / bending, dn = way[0] / axial, dm = way[1] / bending;
    if (is_ellipse) return exit_root(dn * dn + dm * dm, n * dn + m * dm, n * n + m * m - 1);
    const double up = exit_root(dn * dn, n * dn + 0.5 * dm, n * n + m - 1);
    const double down = exit_root(dn * dn, n * dn - 0.5 * dm, n * n - m - 1);
    half = down < up ? -1 : 1;
    return std::min(up, down);
  }
  double position(const Pair& at) const noexcept {
    const double n = (at[0] - centre) / axial;
    return is_ellipse ? std::atan2(at[1] / bending, n) : std::clamp(n, -1.0, 1.0);
  }
};

/// Position on the surface during a straight path of unit direction.
struct SurfacePlace {
  double t = 0;
  double turned = 0;  // derivative of t by the angle of the path, at constant length
  double lost = 0;
  bool at_corner = false;  // and stays there

  /// Derivatives of t, turned and lost by the length of the path.
  static std::array<double, 3> rates(const YieldSurface& surface, const Pair& way, double t, double turned) noexcept {
    const auto [at, tangent, bend] = surface.point(t);
    const double square = dot_product(tangent, tangent), speed = dot_product(tangent, way) / square;
    const double by_t = (dot_product(bend, way) - 2 * speed * dot_product(tangent, bend)) / square;
    const Pair flow{way[0] - speed * tangent[0], way[1] - speed * tangent[1]};
    return {speed, by_t * turned + dot_product(tangent, turned_left(way)) / square, dot_product(at, flow)};
  }

  void slide(YieldSurface& surface, const Pair& way, double length) noexcept {
    const double first = 0.1 * std::min(surface.axial, surface.bending);
    while (!surface.is_ellipse) {
      const double speed = rates(surface, way, t, turned)[0], corner = speed > 0 ? 1 : -1;
      if (t == corner) {
        // The corner at n = -1 or 1: stays, or continues on the other half.
        surface.half = -surface.half;
        const double other = rates(surface, way, t, turned)[0];
        if (other * corner < 0) {
          turned *= other / speed;
          continue;
        }
        lost += length * dot_product(surface.point(t).at, way);
        at_corner = true;
        return;
      }
      const Pair here = surface.point(t).at, there = surface.point(corner).at;
      if (length < std::hypot(there[0] - here[0], there[1] - here[1]) ||
          !(dot_product(surface.point(corner).tangent, way) * speed > 0))
        break;
      const auto by_t = [&, at = t](const std::array<double, 4>& v) {
        const auto rate = rates(surface, way, at + corner * v[3], v[1]);
        const double stretch = corner / rate[0];
        return std::array<double, 4>{stretch, rate[1] * stretch, rate[2] * stretch, 1};
      };
      std::array<double, 4> with_t{0, turned, lost, 0};  // length of the path, turned, lost, change of t
      runge_kutta(by_t, with_t, corner * (corner - t), 0.1, hinge_accuracy);
      if (!(with_t[0] <= length)) break;
      length -= with_t[0];
      t = corner;
      turned = with_t[1];
      lost = with_t[2];
    }
    std::array<double, 3> values{t, turned, lost};
    runge_kutta([&](const std::array<double, 3>& v) { return rates(surface, way, v[0], v[1]); }, values, length, first,
                hinge_accuracy);
    t = surface.is_ellipse ? values[0] : std::clamp(values[0], -1.0, 1.0);
    turned = values[1];
    lost = values[2];
  }
};

}  // namespace

void AxialMomentLaw::check() const {
  laws::require_positive("axial_stiffness", axial_stiffness);
  laws::require_positive("rotational_stiffness", rotational_stiffness);
  laws::require_positive("axial_capacity", axial_capacity);
  laws::require_positive("plastic_moment", plastic_moment);
  if (!(std::abs(balanced_force) < axial_capacity))
    laws::refuse("balanced_force", balanced_force,
                 "less than the axial capacity, " + laws::number_text(axial_capacity));
  if (surface == Surface::parabola && balanced_force != 0)
    laws::refuse("balanced_force", balanced_force, "0 for a parabola, or the surface an ellipse");
  if (!(hardening >= 0 && hardening < 1)) laws::refuse("hardening", hardening, "in [0, 1)");
}

double AxialMomentHinge::yield_deformation(int i) const noexcept {
  const double n = law_.balanced_force / law_.axial_capacity;
  return i == 0 ? law_.axial_capacity * (1 - std::abs(n)) / law_.axial_stiffness
                : law_.plastic_moment * std::sqrt(1 - n * n) / law_.rotational_stiffness;
}

CoupledYielding::Flow AxialMomentHinge::flow(const State& state, const Pair& to, double) const noexcept {
  const Pair root{std::sqrt(law_.axial_stiffness), std::sqrt(law_.rotational_stiffness)};
  const double axial = law_.axial_capacity / root[0], bending = law_.plastic_moment / root[1];
  const double unit = std::sqrt(axial * bending);
  YieldSurface surface{.is_ellipse = law_.surface == AxialMomentLaw::Surface::ellipse,
                       .axial = axial / unit,
                       .bending = bending / unit,
                       .centre = law_.balanced_force / (root[0] * unit)};
  Pair from, way;
  for (int i = 0; i < 2; ++i) {
    from[i] = root[i] / unit * (state.deformation[i] - state.plastic[i]);
    way[i] = root[i] / unit * (to[i] - state.deformation[i]);
  }
  Flow end{.plastic = state.plastic};
  const double length = std::hypot(way[0], way[1]);
  if (length == 0) return end;
  way = {way[0] / length, way[1] / length};
  const double elastic = surface.reach(from, way);
  if (elastic >= length) return end;

  SurfacePlace place{.t = surface.position({from[0] + elastic * way[0], from[1] + elastic * way[1]})};
  const Pair first = surface.point(place.t).tangent, normal = turned_left(way);
  place.turned = elastic * dot_product(first, normal) / dot_product(first, first);
  place.slide(surface, way, length - elastic);
  const auto [last, tangent, bend] = surface.point(place.t);
  const double along = place.at_corner ? 0 : dot_product(tangent, way) / dot_product(tangent, tangent);
  const double turned = place.at_corner ? 0 : place.turned / length;
  end.lost = (1 - law_.hardening) * unit * unit * place.lost;
  for (int i = 0; i < 2; ++i) {
    end.plastic[i] = to[i] - unit / root[i] * last[i];
    for (int j = 0; j < 2; ++j)
      end.by_deformation[i][j] = (i == j) - tangent[i] * (along * way[j] + turned * normal[j]) * root[j] / root[i];
  }
  return end;
}

}  // namespace pounding
