#pragma once
/// One component of a ground motion: acceleration as a function of time, in closed form or as linearly interpolated
/// samples, and its exact integrals. Also used for time-dependent forces, with N instead of m/s^2.

#include <initializer_list>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include <pounding/core/units.hpp>
#include <pounding/ground/harmonic_sum.hpp>

namespace pounding {

/// No motion, as in collisions that start from an initial velocity.
struct Still {};

/// a = A sin(2 pi (t - start)/T + phase) for start <= t < start + duration, zero before and after.
struct Harmonic {
  double amplitude;  ///< A [m/s^2]
  double period;     ///< T [s]
  double duration;   ///< [s]
  double start = 0;  ///< [s]
  double phase = 0;  ///< [rad]
};

/// A single pulse from `start`: half sine, full sine or rectangle.
struct Pulse {
  /// Shape of the acceleration over the duration.
  enum class Shape { half_sine, sine, rectangle };
  Shape shape;
  double amplitude;  ///< [m/s^2]
  double duration;   ///< [s]
  double start = 0;  ///< [s]
};

/// A persistent value: zero before `start`, linear increase to the amplitude within `rise`, constant thereafter.
struct Step {
  double amplitude;  ///< [m/s^2]
  double start = 0;  ///< [s]
  double rise = 0;   ///< [s]
};

/// Samples with linear interpolation; zero before the first and after the last.
struct Samples {
  std::vector<double> times;               ///< increasing [s]
  std::vector<double> accelerations;       ///< [m/s^2], one per time
  bool uniform = false;                    ///< result of evenly_spaced(); uniform samples need no search
  std::vector<std::string> warnings = {};  ///< about implausible values, from the reader of a record
};

/// True if every time is within a millionth of a step of an even spacing between the first and the last.
bool evenly_spaced(const std::vector<double>& times);

/// A ground motion for integrators. Cheap to copy, because copies share the samples; thread-safe to read.
class GroundMotion {
 public:
  GroundMotion() : motion_(Still{}) {}
  /// Throws std::invalid_argument for a value that is not finite, times that do not increase, a duration or period that
  /// is not positive, fewer than two samples, and samples wrongly marked as uniform. `values` is the dimension of the
  /// values for source(): that of a force [N] or moment [N m] for a force history.
  explicit GroundMotion(Harmonic motion, const Dimension& values = dimension::acceleration);
  explicit GroundMotion(HarmonicSum motion, const Dimension& values = dimension::acceleration);
  explicit GroundMotion(Pulse motion, const Dimension& values = dimension::acceleration);
  explicit GroundMotion(Step motion, const Dimension& values = dimension::acceleration);
  explicit GroundMotion(Samples motion, std::string source = {});
  /// This motion with an initial velocity [m/s] and displacement [m] of the ground at t = 0. A harmonic acceleration
  /// does not drift if the initial velocity is -A T/(2 pi) cos(phase). Throws std::invalid_argument for a value that is
  /// not finite, and for a ground at rest.
  GroundMotion with_initial_motion(double velocity, double displacement = 0) const;

  /// Acceleration at time t [m/s^2]; exact at samples. At a jump (start and end of a rectangle, a record with a nonzero
  /// first or last sample) the value after it.
  double acceleration(double t) const noexcept;
  /// Acceleration just before t [m/s^2]: differs from acceleration(t) only at a jump.
  double acceleration_before(double t) const noexcept;
  /// Exact integrals of the acceleration from the initial motion, by default from rest [m/s], [m]. After the last
  /// sample the ground keeps its final velocity: without baseline correction.
  double velocity(double t) const noexcept { return initial_velocity_ + velocity_from_rest(t); }
  double displacement(double t) const noexcept {
    return initial_displacement_ + initial_velocity_ * t + displacement_from_rest(t);
  }
  /// Velocity [m/s] and displacement [m] of the ground at t = 0.
  double initial_velocity() const noexcept { return initial_velocity_; }
  double initial_displacement() const noexcept { return initial_displacement_; }
  /// First time after t at which the acceleration or its slope jumps [s]; infinity if there is none. With steps that
  /// end there, the right-hand side is smooth within each step.
  double next_break(double t) const noexcept;
  /// Maximum absolute acceleration [m/s^2], velocity [m/s] and displacement [m] during the motion, the latter two from
  /// rest; for a record, those of the samples. For a sum of harmonics see HarmonicSum::peak(); its velocity and
  /// displacement are maxima of 16 values per period.
  double peak() const noexcept { return peak_; }
  double peak_velocity() const noexcept { return peak_velocity_; }
  double peak_displacement() const noexcept { return peak_displacement_; }
  /// Time before which the acceleration is zero [s].
  double start() const noexcept { return start_; }
  /// Time after which the acceleration is zero [s]; infinity for a Step.
  double duration() const noexcept { return duration_; }
  /// Spacing of uniform samples [s]; 0 for a closed form and for uneven spacing.
  double sample_step() const noexcept { return per_step_ > 0 ? 1 / per_step_ : 0; }
  /// Shortest period of a closed form [s]; infinity for samples, which are linear between breaks.
  double shortest_period() const noexcept;
  /// Longest step from time t to the next break that resolves the motion [s]: a tenth of the shortest period during a
  /// closed form, the spacing of uniform samples during a record; infinity if breaks suffice.
  double longest_step(double t) const noexcept;
  /// Samples of a record; null for a closed form.
  const Samples* samples() const noexcept;
  /// This motion delayed by `delay` [s], including breaks and integrals. Throws std::invalid_argument for a motion with
  /// an initial velocity, which would become a velocity jump.
  GroundMotion delayed(double delay) const;
  bool is_still() const noexcept { return std::holds_alternative<Still>(motion_); }
  /// Kind and origin of the motion, one line for reports.
  const std::string& source() const noexcept { return source_; }

 private:
  // Samples with the integrals up to each of them.
  struct Record : Samples {
    explicit Record(Samples samples);
    std::vector<double> velocities, displacements;
  };
  using SharedSamples = std::shared_ptr<const Record>;
  template <class Closed>
  void describe(const Closed& motion, std::initializer_list<double> fastest);
  std::size_t interval(const Samples& samples, double t) const noexcept;
  double sampled(const Samples& samples, double t) const noexcept;
  template <class Lasts>
  double acceleration_if(const Lasts& lasts, double t) const noexcept;
  double velocity_from_rest(double t) const noexcept;
  double displacement_from_rest(double t) const noexcept;

  std::variant<Still, Harmonic, HarmonicSum, Pulse, Step, SharedSamples> motion_;
  double per_step_ = 0;  ///< number of uniform samples per second [1/s]; 0 otherwise
  double initial_velocity_ = 0, initial_displacement_ = 0;
  double peak_ = 0, peak_velocity_ = 0, peak_displacement_ = 0;
  double start_ = 0, duration_ = 0;
  std::string source_;
};

}  // namespace pounding
