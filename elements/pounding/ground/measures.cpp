#include <pounding/ground/record.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

/// One linear piece of acceleration, and the motion at its start.
struct Piece {
  double h, a0, a1;  ///< duration [s] and accelerations at both ends [m/s^2]
  double v0 = 0, u0 = 0;

  double slope() const { return (a1 - a0) / h; }
  double velocity(double t) const { return v0 + t * (a0 + t * slope() / 2); }
  double displacement(double t) const { return u0 + t * (v0 + t * (a0 / 2 + t * slope() / 6)); }
  /// Integral of the squared acceleration up to t.
  double square(double t) const { return t * (a0 * a0 + t * (a0 * slope() + t * slope() * slope() / 3)); }

  double peak_velocity() const {
    double peak = std::max(std::abs(v0), std::abs(velocity(h)));
    if (a0 * a1 < 0) peak = std::max(peak, std::abs(velocity(h * a0 / (a0 - a1))));
    return peak;
  }
  double peak_displacement() const {
    double peak = std::max(std::abs(u0), std::abs(displacement(h)));
    // The displacement is extreme at v0 + a0 t + slope t^2/2 = 0. This form of the roots avoids cancellation; a root
    // that does not exist is infinite or NaN and fails the comparison.
    const double root = std::sqrt(a0 * a0 - 2 * slope() * v0);
    const double q = -(a0 + std::copysign(root, a0));
    for (const double t : {q / slope(), 2 * v0 / q})
      if (t > 0 && t < h) peak = std::max(peak, std::abs(displacement(t)));
    return peak;
  }
};

/// Time within a piece at which `square` reaches `target`, by bisection, because `square` is monotonic.
double time_of_square(const Piece& piece, double target) {
  double low = 0, high = piece.h;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (piece.square(middle) < target ? low : high) = middle;
  }
  return high;
}

}  // namespace

RecordMeasures measure(const Samples& samples, double initial_velocity, double initial_displacement) {
  const std::vector<double>&times = samples.times, &accelerations = samples.accelerations;
  const auto piece = [&](std::size_t i) {
    return Piece{times[i + 1] - times[i], accelerations[i], accelerations[i + 1]};
  };
  RecordMeasures result;
  for (const double a : accelerations) result.pga = std::max(result.pga, std::abs(a));

  double v = initial_velocity, u = initial_displacement, square = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    Piece now = piece(i);
    now.v0 = v;
    now.u0 = u;
    result.pgv = std::max(result.pgv, now.peak_velocity());
    result.pgd = std::max(result.pgd, now.peak_displacement());
    v = now.velocity(now.h);
    u = now.displacement(now.h);
    square += now.square(now.h);
  }
  result.arias = std::numbers::pi / (2 * standard_gravity) * square;
  if (square == 0) return result;

  const auto time_of = [&](double target) {
    double before = 0;
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
      const Piece now = piece(i);
      const double here = now.square(now.h);
      if (before + here >= target) return times[i] + time_of_square(now, target - before);
      before += here;
    }
    return times.back();
  };
  result.t5 = time_of(0.05 * square);
  result.t95 = time_of(0.95 * square);
  return result;
}

double arias_fraction_after(const Samples& samples, double time) {
  double all = 0, later = 0;
  for (std::size_t i = 0; i + 1 < samples.times.size(); ++i) {
    const Piece piece{samples.times[i + 1] - samples.times[i], samples.accelerations[i], samples.accelerations[i + 1]};
    const double whole = piece.square(piece.h);
    all += whole;
    later += whole - piece.square(std::clamp(time - samples.times[i], 0.0, piece.h));
  }
  return all > 0 ? later / all : 0;
}

}  // namespace pounding
