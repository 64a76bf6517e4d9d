#include <pounding/sections/bending.hpp>

#include <algorithm>
#include <cmath>
#include <variant>

namespace pounding::sections {
namespace {

/// Strains at which a material yields in tension and compression, and its crushing strain; infinite if there is none.
struct LimitStrains {
  double tension = HUGE_VAL, compression = HUGE_VAL, crushing = HUGE_VAL;
};

LimitStrains limits_of(const materials::AnyMaterial& material) {
  return std::visit(
      [](const auto& law) -> LimitStrains {
        const double yield = law.yield_deformation();
        if constexpr (requires { law.epsU; }) return {HUGE_VAL, yield, -law.epsU};
        if constexpr (requires { law.epscu; }) return {HUGE_VAL, yield, -law.epscu};
        return {yield, yield, HUGE_VAL};
      },
      material);
}

/// Strains of the fibres of one material at a point of a curve: maximum and minimum.
struct Range {
  double maximum = -HUGE_VAL, minimum = HUGE_VAL;
};

Range strains(const FibreSection& section, std::size_t material, const CurvePoint& point, Axis axis) {
  Range range;
  for (const Fibre& fibre : section.fibres()) {
    if (fibre.material != material) continue;
    const double strain = point.axial_strain + point.curvature * (axis == Axis::y ? fibre.z : -fibre.y);
    range.maximum = std::max(range.maximum, strain);
    range.minimum = std::min(range.minimum, strain);
  }
  return range;
}

/// Point between two points of a curve.
CurvePoint between(const CurvePoint& a, const CurvePoint& b, double fraction) {
  return {a.curvature + fraction * (b.curvature - a.curvature), a.moment + fraction * (b.moment - a.moment),
          a.axial_strain + fraction * (b.axial_strain - a.axial_strain)};
}

/// First point of a curve at which a ratio reaches 1, by linear interpolation; curvature 0 if there is none.
template <class Ratio>
CurvePoint first_reached(const std::vector<CurvePoint>& curve, const Ratio& ratio_at) {
  CurvePoint last;
  double ratio = 0;
  for (const CurvePoint& point : curve) {
    const double next = ratio_at(point);
    if (next >= 1) return between(last, point, next > ratio ? (1 - std::min(ratio, 1.0)) / (next - ratio) : 1);
    last = point, ratio = next;
  }
  return {};
}

}  // namespace

Bending bend(const FibreSection& section, double axial_force, std::span<const double> curvatures, Axis axis) {
  Bending result{.axial_force = axial_force, .curve = resisted_curve(section, axial_force, curvatures, axis)};
  std::vector<LimitStrains> limits;
  for (const materials::AnyMaterial& material : section.materials()) limits.push_back(limits_of(material));
  const CurvePoint yield = first_reached(result.curve, [&](const CurvePoint& point) {
    double ratio = 0;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const Range range = strains(section, i, point, axis);
      ratio = std::max({ratio, range.maximum / limits[i].tension, -range.minimum / limits[i].compression});
    }
    return ratio;
  });
  if (yield.curvature > 0) {
    // The moment is not linear between two points of the curve.
    std::vector<double> path(curvatures.begin(), std::ranges::lower_bound(curvatures, yield.curvature));
    path.push_back(yield.curvature);
    result.yield_curvature = yield.curvature;
    result.yield_moment = resisted_curve(section, axial_force, path, axis).back().moment;
  }
  // The cover may spall before the core crushes.
  std::size_t ductile = 0;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const auto crushing = [&](std::size_t of) { return std::isinf(limits[of].crushing) ? 0 : limits[of].crushing; };
    if (crushing(i) > crushing(ductile)) ductile = i;
  }
  const CurvePoint crushed = first_reached(result.curve, [&](const CurvePoint& point) {
    return -strains(section, ductile, point, axis).minimum / limits[ductile].crushing;
  });
  double largest = 0;
  const CurvePoint fallen = first_reached(result.curve, [&](const CurvePoint& point) {
    largest = std::max(largest, point.moment);
    return (largest - point.moment) / (0.2 * largest);
  });
  result.crushes = crushed.curvature > 0 && !(fallen.curvature > 0 && fallen.curvature < crushed.curvature);
  for (const CurvePoint& point : result.curve)
    if (!result.crushes || point.curvature <= crushed.curvature)
      result.largest_moment = std::max(result.largest_moment, point.moment);
  result.ultimate_curvature = result.crushes ? crushed.curvature : fallen.curvature;
  return result;
}

double initial_bending_stiffness(const FibreSection& section, Axis axis) {
  double ea = 0, es = 0, ei = 0;
  for (const Fibre& fibre : section.fibres()) {
    const double modulus =
        std::visit([](const auto& law) { return law.stiffness(); }, section.materials()[fibre.material]);
    const double at = axis == Axis::y ? fibre.z : fibre.y;
    ea += modulus * fibre.area, es += modulus * fibre.area * at, ei += modulus * fibre.area * at * at;
  }
  return ei - es * es / ea;
}

AxialStrength axial_strength(const FibreSection& section) {
  AxialStrength strength;
  const FibreStates states = section.states();
  for (double strain = 1e-5; strain < 0.05; strain *= 1.03) {
    strength.tension = std::max(strength.tension, section.evaluate(states, {strain, 0, 0}).force[0]);
    strength.compression = std::min(strength.compression, section.evaluate(states, {-strain, 0, 0}).force[0]);
  }
  return strength;
}

std::vector<double> forces_of_diagram(const FibreSection& section) {
  const AxialStrength strength = axial_strength(section);
  std::vector<double> forces;
  for (const double ratio : {0.99, 0.95, 0.85, 0.7, 0.55, 0.4, 0.25, 0.1}) forces.push_back(ratio * strength.tension);
  forces.push_back(0);
  for (int i = 1; i < 20; ++i) forces.push_back(0.05 * i * strength.compression);
  forces.insert(forces.end(), {0.98 * strength.compression, 0.99 * strength.compression});
  return forces;
}

}  // namespace pounding::sections
