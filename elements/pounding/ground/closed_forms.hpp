#pragma once
/// Closed forms of ground accelerations and their integrals, used by GroundMotion.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/ground/ground_motion.hpp>

namespace pounding::closed_forms {

inline constexpr double two_pi = 2 * std::numbers::pi;

/// End time of a motion [s].
template <class Closed>
double end_of(const Closed& motion) {
  return motion.start + motion.duration;
}

inline double end_of(const Step&) { return std::numeric_limits<double>::infinity(); }

/// Acceleration at time t during a motion [m/s^2].
inline double inside(const Harmonic& motion, double t) {
  return motion.amplitude * std::sin(two_pi * (t - motion.start) / motion.period + motion.phase);
}

inline double inside(const HarmonicSum& motion, double t) { return motion.acceleration(t - motion.start); }

inline double inside(const Pulse& pulse, double t) {
  const double part = (t - pulse.start) / pulse.duration;
  switch (pulse.shape) {
    case Pulse::Shape::half_sine: return pulse.amplitude * std::sin(std::numbers::pi * part);
    case Pulse::Shape::sine: return pulse.amplitude * std::sin(two_pi * part);
    case Pulse::Shape::rectangle: return pulse.amplitude;
  }
  return 0;
}

inline double inside(const Step& step, double t) {
  const double s = t - step.start;
  return s < step.rise ? step.amplitude * (s / step.rise) : step.amplitude;
}

/// Integrals of the acceleration from rest.
struct Moved {
  double velocity = 0;      ///< [m/s]
  double displacement = 0;  ///< [m]
};

/// Integrals of a = amplitude sin(w s + phase) from rest at s = 0.
inline Moved moved_by_sine(double amplitude, double w, double s, double phase = 0) {
  return {2 * amplitude / w * std::sin(0.5 * w * s + phase) * std::sin(0.5 * w * s),
          amplitude / w * (s * std::cos(phase) - (std::sin(w * s + phase) - std::sin(phase)) / w)};
}

/// Integrals at the time s after the start, during the motion [s].
inline Moved moved_inside(const Harmonic& motion, double s) {
  return moved_by_sine(motion.amplitude, two_pi / motion.period, s, motion.phase);
}

inline Moved moved_inside(const HarmonicSum& motion, double s) {
  Moved sum;
  for (const HarmonicSum::Part& part : motion.parts) {
    const auto [velocity, displacement] = moved_by_sine(part.amplitude, two_pi / part.period, s, part.phase);
    sum.velocity += velocity;
    sum.displacement += displacement;
  }
  return sum;
}

inline Moved moved_inside(const Pulse& pulse, double s) {
  switch (pulse.shape) {
    case Pulse::Shape::half_sine: return moved_by_sine(pulse.amplitude, std::numbers::pi / pulse.duration, s);
    case Pulse::Shape::sine: return moved_by_sine(pulse.amplitude, two_pi / pulse.duration, s);
    case Pulse::Shape::rectangle: return {pulse.amplitude * s, 0.5 * pulse.amplitude * s * s};
  }
  return {};
}

/// As a difference of two ramps, to avoid cancellation.
inline Moved moved(const Step& step, double t) {
  const double s = t - step.start;
  if (!(s > 0)) return {};
  if (s < step.rise) return {step.amplitude * s * (s / step.rise) / 2, step.amplitude * s * s * (s / step.rise) / 6};
  const double after = s - step.rise;
  return {step.amplitude * (step.rise / 2 + after),
          step.amplitude * (step.rise * step.rise / 6 + after * (step.rise + after) / 2)};
}

/// Integrals at time t [s]; after the motion, the ground keeps its velocity.
template <class Closed>
Moved moved(const Closed& motion, double t) {
  const double s = t - motion.start;
  if (!(s > 0)) return {};
  if (s <= motion.duration) return moved_inside(motion, s);
  const Moved end = moved_inside(motion, motion.duration);
  return {end.velocity, end.displacement + end.velocity * (s - motion.duration)};
}

/// Maxima of the integrals during the motion, from 16 values per period and at most 160000.
template <class Harmonics>
Moved largest_of(const Harmonics& motion) {
  double shortest;
  if constexpr (requires { motion.period; })
    shortest = motion.period;
  else
    shortest = motion.shortest_period();
  const double count = 16 * std::min(1e4, std::ceil(motion.duration / shortest));
  Moved largest;
  for (double i = 1; i <= count; ++i) {
    const auto [velocity, displacement] = moved_inside(motion, i / count * motion.duration);
    largest.velocity = std::max(largest.velocity, std::abs(velocity));
    largest.displacement = std::max(largest.displacement, std::abs(displacement));
  }
  return largest;
}

/// Throws std::invalid_argument, naming the value, unless it is finite.
inline void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("ground motion: {} must be finite", what));
}

inline void require_positive(double value, const char* what) {
  if (!(std::isfinite(value) && value > 0))
    throw std::invalid_argument(fmt::format("ground motion: {} is {:g}; it must be finite and > 0", what, value));
}

/// Amplitude for reports; moments in kN m rather than kJ.
inline std::string amplitude_text(double amplitude, const Dimension& values) {
  return values == dimension::energy ? format_quantity(amplitude, dimension::force) + " m"
                                     : format_quantity(amplitude, values);
}

/// Amplitude, period and phase for reports.
inline std::string described(double amplitude, double period, double phase, const Dimension& values) {
  const std::string text = fmt::format("{} at {:g} s", amplitude_text(amplitude, values), period);
  return phase == 0 ? text : fmt::format("{} and {:g} deg", text, phase * 180 / std::numbers::pi);
}

}  // namespace pounding::closed_forms
