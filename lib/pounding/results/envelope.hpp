#pragma once
/// Extremes over a run: minimum and maximum of every quantity of a structure, with their times.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pounding/core/archive.hpp>

namespace pounding {

/// A quantity over a step: the parabola through its values at both ends and the midpoint, plus the correction w (alpha
/// + beta t) with t = s - 1/2, w = t (t^2 - 1/4) and s from 0 to 1.
struct Quartic {
  double begin, middle, end, alpha, beta;

  /// Value at s.
  double at(double s) const {
    const double t = s - 0.5;
    return middle + t * (end - begin + t * 2 * (begin - 2 * middle + end)) + t * (t * t - 0.25) * (alpha + t * beta);
  }
  /// Lower and upper bounds on the whole path.
  std::pair<double, double> bounds() const {
    // |w| < 1/20 and |w t| < 1/64. The parabola lies in the hull of its ends and the point where its end tangents meet.
    const double away = std::abs(alpha) / 20 + std::abs(beta) / 64, hull = 2 * middle - 0.5 * (begin + end);
    return {std::min({begin, middle, end, hull}) - away, std::max({begin, middle, end, hull}) + away};
  }
};

/// Running minimum and maximum of a list of quantities, signed, and their times [s]. Of equal values the first counts.
struct Extremes {
  std::vector<double> min, max, t_min, t_max;

  Extremes() = default;
  /// Creates extremes without any value.
  explicit Extremes(std::size_t count)
      : min(count, std::numeric_limits<double>::infinity()),
        max(count, -std::numeric_limits<double>::infinity()),
        t_min(count),
        t_max(count) {}

  /// Number of quantities.
  std::size_t size() const { return min.size(); }
  /// Largest absolute value of a quantity; 0 before the first.
  double peak(std::size_t i) const;

  /// Updates with one value at a time [s].
  void update(std::size_t i, double time, double value) {
    if (value < min[i]) {
      min[i] = value;
      t_min[i] = time;
    }
    if (value > max[i]) {
      max[i] = value;
      t_max[i] = time;
    }
  }
  /// Updates with values and slopes at the ends of a step of length h that starts at `time`; interior extrema are those
  /// of the cubic through them. False if a quick bound shows that the step adds no new extreme.
  bool update(std::size_t i, double time, double h, double begin, double slope_begin, double end, double slope_end) {
    // The cubic lies in the hull of its Bezier points: the end values, and those plus a third of the step along the end
    // slopes.
    const double third = h / 3;
    if (holds(i, end) &&
        (slope_begin * slope_end >= 0 || (holds(i, begin + third * slope_begin) && holds(i, end - third * slope_end))))
      return false;
    add_cubic(i, time, h, begin, slope_begin, end, slope_end);
    return true;
  }
  /// Updates one quantity, known at `time`, with values and slopes at several later times.
  void update(std::size_t i, double time, std::span<const double> times, double value, double slope,
              const double* values, const double* slopes);
  /// Updates with values at the start, the midpoint and the end of a step; interior extrema are those of the parabola
  /// through them.
  void update(std::size_t i, double time, double h, double begin, double middle, double end) {
    // The parabola lies in the hull of its ends and the point where its end tangents meet.
    if (!holds(i, middle) || !holds(i, end) || !holds(i, 2 * middle - 0.5 * (begin + end)))
      add_parabola(i, time, h, begin, middle, end);
  }
  /// Updates with a step on a quartic path.
  void update(std::size_t i, double time, double h, const Quartic& path) {
    const auto [low, high] = path.bounds();
    if (!holds(i, low) || !holds(i, high)) update_by_quarters(i, time, h, path);
  }
  /// Updates with a step on any smooth path, a function of s from 0 to 1: one parabola per quarter of the step.
  template <class Path>
  void update_by_quarters(std::size_t i, double time, double h, const Path& path) {
    const double quarter = h / 4;
    double begin = path.at(0);
    for (int q = 0; q < 4; ++q) {
      const double end = path.at(0.25 * (q + 1));
      update(i, time + q * quarter, quarter, begin, path.at(0.25 * q + 0.125), end);
      begin = end;
    }
  }
  /// Copies quantity `from` of others, multiplied by a factor.
  void copy(std::size_t i, const Extremes& others, std::size_t from, double factor = 1);

  /// For a checkpoint.
  void archive(Archive& archive) { archive(min, max, t_min, t_max); }

 private:
  bool holds(std::size_t i, double value) const { return value >= min[i] && value <= max[i]; }
  void add_cubic(std::size_t i, double time, double h, double begin, double slope_begin, double end, double slope_end);
  void add_parabola(std::size_t i, double time, double h, double begin, double middle, double end);
};

/// Extremes of one structure over all accepted steps, including interior extrema, independent of the output times.
/// Quantities are in the order of their histories (StructureHistory), the last index varying fastest. Lists are empty
/// if a structure has no such quantity.
struct StructureEnvelope {
  /// Edges of a floor in the order of edge_displacement.
  static constexpr std::array<const char*, 4> edges{"x at smallest y", "x at largest y", "y at smallest x",
                                                    "y at largest x"};

  Extremes displacement;  ///< [floor, direction] relative to the ground [m], [rad]
  /// [floor, edge] displacement of an edge along itself, relative to the ground [m]; NaN for a floor that is not rigid
  /// in space.
  Extremes edge_displacement;
  Extremes acceleration;  ///< [floor, direction] absolute [m/s^2], [rad/s^2]
  Extremes drift;         ///< [floor, storey direction] [m]
  Extremes storey_shear;  ///< [floor, storey direction] [N]
  Extremes member_force;  ///< [member, component] of every member, acting on its ends, local axes [N], [N m]
  Extremes reaction;      ///< [support, direction] of the ground on the structure, global axes [N], [N m]
  std::vector<std::string> members, components, supports, directions;  ///< labels of the last two
  bool with_gravity = false;  ///< the last two include the weights of the masses
  std::string included;       ///< other contributions to them, see InternalForces::included

  /// For a checkpoint, including the names.
  void archive(Archive& archive);
};

/// Internal forces on the sections at both ends of each member, in the order of `member_force`. They act on the face
/// towards the end of the member, so N > 0 is tension and the sign of a component is the same at both ends [N], [N m].
Extremes section_forces(const StructureEnvelope& envelope);

/// Axial force of each member, extremes over both ends, positive in tension [N]; empty without members.
Extremes axial_forces(const StructureEnvelope& envelope);

}  // namespace pounding
