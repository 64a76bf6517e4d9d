#pragma once
/// Motion of the ground as a function of time: an acceleration in closed form, or samples with straight lines between them,
/// and its exact integrals.

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace pounding {

/// No motion: collisions that start from an initial velocity.
struct Still {};

/// a = A sin(2 pi (t - start)/T) for start <= t < start + duration, zero before and after.
struct Harmonic {
  double amplitude;  ///< A [m/s^2]
  double period;     ///< T [s]
  double duration;   ///< [s]
  double start = 0;  ///< [s]
};

/// One pulse that starts at `start`: half sine, full sine, or rectangle.
struct Pulse {
  /// How the acceleration goes over the duration.
  enum class Shape { half_sine, sine, rectangle };
  Shape shape;
  double amplitude;  ///< [m/s^2]
  double duration;   ///< [s]
  double start = 0;  ///< [s]
};

/// Samples, linear between them, zero before the first and after the last.
struct Samples {
  std::vector<double> times;          ///< increasing [s]
  std::vector<double> accelerations;  ///< [m/s^2], as many as times
  bool uniform = false;               ///< as evenly_spaced() says; lets a value be found without a search
};

/// True when every time lies within a millionth of a step from an even spacing between the first and the last.
bool evenly_spaced(const std::vector<double>& times);

/// A ground motion, as the integrator sees it. Cheap to copy; safe to read from many threads.
class GroundMotion {
 public:
  GroundMotion() : motion_(Still{}) {}
  /// Throws std::invalid_argument when a value is not finite, a time does not increase, a duration or period is not
  /// positive, there are fewer than two samples, or samples that claim to be uniform are not.
  explicit GroundMotion(Harmonic motion);
  explicit GroundMotion(Pulse motion);
  explicit GroundMotion(Samples motion, std::string source = {});

  /// Acceleration at time t [m/s^2]; a sample's own value at its own time. At a jump (start and end of a rectangle,
  /// a record that begins or ends away from zero) the value just after it.
  double acceleration(double t) const noexcept;
  /// The value just before t: differs from acceleration(t) only at a jump.
  double acceleration_before(double t) const noexcept;
  /// Exact integrals of the acceleration from rest at its beginning [m/s], [m]. When it is over, the ground goes on with the
  /// velocity that it has then.
  double velocity(double t) const noexcept;
  double displacement(double t) const noexcept;
  /// The first time after t at which the acceleration or its slope jumps; infinity when there is none.
  /// An integrator that ends its steps at exactly this time sees a smooth right-hand side inside every step.
  double next_break(double t) const noexcept;
  /// Largest absolute acceleration [m/s^2].
  double peak() const noexcept { return peak_; }
  /// Time after which the acceleration is zero [s].
  double duration() const noexcept { return duration_; }
  /// Spacing of uniform samples [s]; 0 when the motion is a closed form or the spacing varies.
  double sample_step() const noexcept;
  /// Shortest period of a closed form [s]; infinity for samples, which are straight between breaks.
  double shortest_period() const noexcept;
  /// The samples; null for a closed form.
  const Samples* samples() const noexcept;
  /// The same motion so much later [s]; breaks and integrals move along.
  GroundMotion delayed(double delay) const;
  bool is_still() const noexcept { return std::holds_alternative<Still>(motion_); }
  /// What it is and where it came from, one line for reports.
  const std::string& source() const noexcept { return source_; }

 private:
  // With the integrals up to each sample.
  struct Record : Samples {
    explicit Record(Samples samples);
    std::vector<double> velocities, displacements;
  };
  using SharedSamples = std::shared_ptr<const Record>;
  std::size_t interval(const Samples& samples, double t) const noexcept;
  double sampled(const Samples& samples, double t) const noexcept;

  std::variant<Still, Harmonic, Pulse, SharedSamples> motion_;
  double per_step_ = 0;  ///< uniform samples in a second [1/s]; 0 otherwise
  double peak_ = 0;
  double duration_ = 0;
  std::string source_;
};

}  // namespace pounding
