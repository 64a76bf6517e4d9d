/// Engineering measures of a pushover.

#include <algorithm>
#include <cmath>
#include <limits>

#include <pounding/pushover/pushover.hpp>

namespace pounding {

std::optional<int> Pushover::first_yield() const {
  for (const PushEvent& event : path.events)
    if (event.is_first) return event.point;
  return {};
}

int Pushover::strongest() const {
  const auto by_size = [](const PushPoint& a, const PushPoint& b) {
    return std::abs(a.factor) < std::abs(b.factor) * (1 - 1e-12);
  };
  return static_cast<int>(std::max_element(path.points.begin(), path.points.end(), by_size) - path.points.begin());
}

double Pushover::overstrength(int point) const {
  const std::optional<int> first = first_yield();
  return first ? std::abs(path.points[point].factor / path.points[*first].factor)
               : std::numeric_limits<double>::quiet_NaN();
}

double Pushover::ductility(int part) const {
  ValueRange deformation, moment;
  const auto widen = [](ValueRange& range, double value) {
    range = {std::min(range.lowest, value), std::max(range.highest, value)};
  };
  for (int point = 0; point < static_cast<int>(path.points.size()); ++point) {
    widen(deformation, path.points[point].deformations[part]);
    widen(moment, force(point, part));
  }
  return parts[part].limits.ductility(deformation, moment);
}

double Pushover::force(int point, int part) const {
  return parts[part].stiffness * path.points[point].deformations[part] + path.points[point].forces[part];
}

double Pushover::plastic_deformation(int part) const {
  const double force = path.points.back().forces[part];
  return force == 0 ? 0 : -force / parts[part].stiffness;
}

BilinearCurve bilinear_curve(const std::vector<double>& displacements, const std::vector<double>& base_shears) {
  const auto largest =
      static_cast<std::size_t>(std::max_element(base_shears.begin(), base_shears.end()) - base_shears.begin());
  const std::size_t last = displacements.size() - 1;
  const std::size_t end = base_shears[largest] > base_shears[last] * (1 + 1e-9) ? largest : last;
  double energy = 0;
  for (std::size_t i = 1; i <= end; ++i)
    energy += 0.5 * (base_shears[i] + base_shears[i - 1]) * (displacements[i] - displacements[i - 1]);
  return {.base_shear = base_shears[end],
          .yield_displacement = 2 * (displacements[end] - energy / base_shears[end]),
          .displacement = displacements[end]};
}

std::optional<EquivalentOscillator> equivalent_oscillator(const Structure& s, const std::vector<double>& loads,
                                                          const BilinearCurve& curve) {
  for (const Floor& floor : s.floors)
    if (!(floor.mass > 0)) return {};
  if (!(loads.back() > 0)) return {};
  const double scale = s.floors.back().mass / loads.back();
  double mass = 0, squares = 0;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const double phi = scale * loads[i] / s.floors[i].mass;
    mass += s.floors[i].mass * phi;
    squares += s.floors[i].mass * phi * phi;
  }
  return EquivalentOscillator{.mass = mass,
                              .participation = mass / squares,
                              .period = 2 * M_PI * std::sqrt(mass * curve.yield_displacement / curve.base_shear)};
}

}  // namespace pounding
