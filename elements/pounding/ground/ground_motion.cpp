#include <pounding/ground/ground_motion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/ground/closed_forms.hpp>

namespace pounding {
namespace {

using namespace closed_forms;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Longest step as a fraction of the shortest period of a closed form.
constexpr double max_part_of_period = 0.1;

void check(const Samples& samples) {
  const std::vector<double>&times = samples.times, &accelerations = samples.accelerations;
  if (times.size() != accelerations.size() || times.size() < 2)
    throw std::invalid_argument(
        fmt::format("ground motion: {} times and {} accelerations; equal numbers, at least two, are needed",
                    times.size(), accelerations.size()));
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(accelerations[i]))
      throw std::invalid_argument(fmt::format("ground motion: sample {} must be finite", i));
    if (i > 0 && times[i] <= times[i - 1])
      throw std::invalid_argument(
          fmt::format("ground motion: the time of sample {} must be later than the previous one", i));
  }
  if (samples.uniform && !evenly_spaced(times))
    throw std::invalid_argument("ground motion: samples marked as uniform must be evenly spaced");
}

const char* name_of(Pulse::Shape shape) {
  switch (shape) {
    case Pulse::Shape::half_sine: return "half sine";
    case Pulse::Shape::sine: return "full sine";
    case Pulse::Shape::rectangle: return "rectangle";
  }
  return "";
}

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // required by Clang before 17

}  // namespace

bool evenly_spaced(const std::vector<double>& times) {
  if (times.size() < 2) return false;
  const double step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t i = 0; i < times.size(); ++i)
    if (!(std::abs(times[i] - (times.front() + static_cast<double>(i) * step)) <= 1e-6 * step)) return false;
  return true;
}

GroundMotion::GroundMotion(Harmonic motion, const Dimension& values) : motion_(motion) {
  require_finite(motion.amplitude, "amplitude");
  require_positive(motion.period, "period");
  require_positive(motion.duration, "duration");
  require_finite(motion.start, "start");
  require_finite(motion.phase, "phase");
  // The sine has an extremum a quarter of a period after each zero.
  const double turns = motion.phase / (2 * std::numbers::pi);
  const double first_crest = (0.25 + 0.5 * std::ceil((turns - 0.25) / 0.5) - turns) * motion.period;
  peak_ = motion.duration >= first_crest
              ? std::abs(motion.amplitude)
              : std::max(std::abs(inside(motion, motion.start)), std::abs(inside(motion, end_of(motion))));
  describe(motion, {(0.5 * std::ceil(2 * turns) - turns) * motion.period,
                    (0.5 * std::ceil(2 * turns) + 0.5 - turns) * motion.period});
  if (motion.phase != 0) peak_displacement_ = largest_of(motion).displacement;
  source_ = fmt::format("harmonic, {} for {:g} s", described(motion.amplitude, motion.period, motion.phase, values),
                        motion.duration);
}

GroundMotion::GroundMotion(Pulse motion, const Dimension& values) : motion_(motion) {
  require_finite(motion.amplitude, "amplitude");
  require_finite(motion.start, "start");
  require_positive(motion.duration, "duration");
  peak_ = std::abs(motion.amplitude);
  describe(motion, {motion.shape == Pulse::Shape::sine ? motion.duration / 2 : motion.duration});
  source_ = fmt::format("{} pulse, {} for {:g} s from {:g} s", name_of(motion.shape),
                        amplitude_text(motion.amplitude, values), motion.duration, motion.start);
}

GroundMotion::GroundMotion(Step motion, const Dimension& values) : motion_(motion) {
  require_finite(motion.amplitude, "amplitude");
  require_finite(motion.start, "start");
  if (!(motion.rise >= 0 && std::isfinite(motion.rise)))
    throw std::invalid_argument(
        fmt::format("ground motion: rise is {:g}; it must be finite and not negative", motion.rise));
  peak_ = std::abs(motion.amplitude);
  start_ = motion.start;
  duration_ = peak_velocity_ = peak_displacement_ = infinity;
  source_ = fmt::format("step to {} at {:g} s", amplitude_text(motion.amplitude, values), motion.start);
  if (motion.rise > 0) source_ += fmt::format(" within {:g} s", motion.rise);
}

GroundMotion::GroundMotion(Samples motion, std::string source) : source_(std::move(source)) {
  check(motion);
  for (const double a : motion.accelerations) peak_ = std::max(peak_, std::abs(a));
  start_ = motion.times.front();
  duration_ = motion.times.back();
  if (motion.uniform)
    per_step_ = static_cast<double>(motion.times.size() - 1) / (motion.times.back() - motion.times.front());
  if (source_.empty()) source_ = fmt::format("{} samples", motion.times.size());
  auto record = std::make_shared<const Record>(std::move(motion));
  for (const double v : record->velocities) peak_velocity_ = std::max(peak_velocity_, std::abs(v));
  for (const double d : record->displacements) peak_displacement_ = std::max(peak_displacement_, std::abs(d));
  motion_ = std::move(record);
}

// The velocity of a closed form is extreme at one of the times after the start. If it does not change sign, the
// displacement is extreme at the end.
template <class Closed>
void GroundMotion::describe(const Closed& motion, std::initializer_list<double> fastest) {
  start_ = motion.start;
  duration_ = end_of(motion);
  for (const double after : fastest)
    peak_velocity_ =
        std::max(peak_velocity_, std::abs(moved_inside(motion, std::min(motion.duration, after)).velocity));
  peak_displacement_ = std::abs(moved_inside(motion, motion.duration).displacement);
}

GroundMotion::Record::Record(Samples samples) : Samples(std::move(samples)) {
  velocities.reserve(times.size());
  displacements.reserve(times.size());
  long double v = 0, d = 0;  // long records accumulate many small increments
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (i > 0) {
      const long double h = static_cast<long double>(times[i]) - times[i - 1], a = accelerations[i - 1],
                        b = accelerations[i];
      d += h * (v + h / 6 * (2 * a + b));
      v += h / 2 * (a + b);
    }
    velocities.push_back(static_cast<double>(v));
    displacements.push_back(static_cast<double>(d));
  }
}

// Index of the sample before t, which must be between the first and the last.
std::size_t GroundMotion::interval(const Samples& samples, double t) const noexcept {
  const std::vector<double>& times = samples.times;
  if (per_step_ == 0)
    return static_cast<std::size_t>(std::upper_bound(times.begin() + 1, times.end() - 1, t) - times.begin()) - 1;
  const std::size_t last = times.size() - 2;
  const std::size_t i = std::min(static_cast<std::size_t>((t - times.front()) * per_step_), last);
  // Round-off may place t in the neighbouring interval.
  if (t < times[i]) return i - 1;
  return i < last && t >= times[i + 1] ? i + 1 : i;
}

double GroundMotion::sampled(const Samples& samples, double t) const noexcept {
  const std::vector<double>& times = samples.times;
  const std::size_t i = interval(samples, t);
  const double part = (t - times[i]) / (times[i + 1] - times[i]);
  const std::vector<double>& a = samples.accelerations;
  // Exact at part = 1, unlike a[i] + part (a[i + 1] - a[i]).
  return a[i] * (1 - part) + a[i + 1] * part;
}

// `lasts` is true for a time between the beginning and the end of the motion.
template <class Lasts>
double GroundMotion::acceleration_if(const Lasts& lasts, double t) const noexcept {
  return std::visit(
      Overloaded{[](const Still&) { return 0.0; },
                 [&](const auto& closed) { return lasts(closed.start, end_of(closed)) ? inside(closed, t) : 0; },
                 [&](const SharedSamples& shared) {
                   return lasts(shared->times.front(), shared->times.back()) ? sampled(*shared, t) : 0;
                 }},
      motion_);
}

double GroundMotion::acceleration(double t) const noexcept {
  return acceleration_if([t](double begin, double end) { return t >= begin && t < end; }, t);
}

double GroundMotion::acceleration_before(double t) const noexcept {
  return acceleration_if([t](double begin, double end) { return t > begin && t <= end; }, t);
}

// Between samples the acceleration is linear, so the integrals are those at the sample plus a quadratic, or a cubic.
double GroundMotion::velocity_from_rest(double t) const noexcept {
  return std::visit(
      Overloaded{[](const Still&) { return 0.0; }, [t](const auto& closed) { return moved(closed, t).velocity; },
                 [this, t](const SharedSamples& shared) {
                   const Record& r = *shared;
                   if (!(t > r.times.front())) return 0.0;
                   if (t >= r.times.back()) return r.velocities.back();
                   const std::size_t i = interval(r, t);
                   const double h = r.times[i + 1] - r.times[i], s = t - r.times[i], a = r.accelerations[i];
                   return r.velocities[i] + s * (a + 0.5 * s / h * (r.accelerations[i + 1] - a));
                 }},
      motion_);
}

double GroundMotion::displacement_from_rest(double t) const noexcept {
  return std::visit(
      Overloaded{[](const Still&) { return 0.0; }, [t](const auto& closed) { return moved(closed, t).displacement; },
                 [this, t](const SharedSamples& shared) {
                   const Record& r = *shared;
                   if (!(t > r.times.front())) return 0.0;
                   if (t >= r.times.back()) return r.displacements.back() + r.velocities.back() * (t - r.times.back());
                   const std::size_t i = interval(r, t);
                   const double h = r.times[i + 1] - r.times[i], s = t - r.times[i], a = r.accelerations[i];
                   return r.displacements[i] +
                          s * (r.velocities[i] + s * (0.5 * a + s / (6 * h) * (r.accelerations[i + 1] - a)));
                 }},
      motion_);
}

GroundMotion GroundMotion::delayed(double delay) const {
  require_finite(delay, "delay");
  if (delay == 0) return *this;
  if (initial_velocity_ != 0)
    throw std::invalid_argument(
        fmt::format("ground motion: cannot be delayed, because its initial velocity is {}, not 0",
                    format_quantity(initial_velocity_, dimension::velocity)));
  const auto later = [&](auto closed) {
    closed.start += delay;
    return GroundMotion(closed);
  };
  GroundMotion out = std::visit(Overloaded{[](const Still&) { return GroundMotion(); }, later,
                                           [&](const SharedSamples& shared) {
                                             Samples samples = *shared;
                                             for (double& time : samples.times) time += delay;
                                             return GroundMotion(std::move(samples));
                                           }},
                                motion_);
  out.initial_displacement_ = initial_displacement_;
  if (!is_still()) out.source_ = fmt::format("{}, {:g} s later", source_, delay);
  return out;
}

GroundMotion GroundMotion::with_initial_motion(double velocity, double displacement) const {
  require_finite(velocity, "initial velocity");
  require_finite(displacement, "initial displacement");
  if (is_still())
    throw std::invalid_argument("ground motion: a ground at rest cannot have an initial velocity or displacement");
  GroundMotion out = *this;
  out.initial_velocity_ = velocity;
  out.initial_displacement_ = displacement;
  if (velocity != 0) out.source_ += fmt::format(", from {}", format_quantity(velocity, dimension::velocity));
  if (displacement != 0) out.source_ += fmt::format(", from {}", format_quantity(displacement, dimension::length));
  return out;
}

double GroundMotion::next_break(double t) const noexcept {
  const auto next_of_two = [t](double begin, double end) { return t < begin ? begin : t < end ? end : infinity; };
  return std::visit(Overloaded{[](const Still&) { return infinity; },
                               [&](const auto& closed) { return next_of_two(closed.start, end_of(closed)); },
                               [&](const Step& step) {
                                 const double full = step.start + step.rise;
                                 return step.rise > 0 ? next_of_two(step.start, full)
                                                      : next_of_two(step.start, step.start);
                               },
                               [this, t](const SharedSamples& shared) {
                                 const std::vector<double>& times = shared->times;
                                 if (t < times.front()) return times.front();
                                 if (!(t < times.back())) return infinity;
                                 if (per_step_ == 0) return *std::upper_bound(times.begin(), times.end(), t);
                                 auto i = static_cast<std::size_t>((t - times.front()) * per_step_);
                                 // Round-off may shift the index by one; if it is too high, it is already the one
                                 // sought.
                                 while (times[i] <= t) ++i;
                                 return times[i];
                               }},
                    motion_);
}

double GroundMotion::shortest_period() const noexcept {
  if (const auto* const harmonic = std::get_if<Harmonic>(&motion_)) return harmonic->period;
  if (const auto* const sum = std::get_if<HarmonicSum>(&motion_)) return sum->shortest_period();
  const auto* const pulse = std::get_if<Pulse>(&motion_);
  if (pulse == nullptr || pulse->shape == Pulse::Shape::rectangle) return infinity;
  return pulse->shape == Pulse::Shape::sine ? pulse->duration : 2 * pulse->duration;
}

double GroundMotion::longest_step(double t) const noexcept {
  if (!(t < duration_)) return infinity;
  if (per_step_ > 0) return sample_step();
  return t < start_ ? infinity : max_part_of_period * shortest_period();
}

const Samples* GroundMotion::samples() const noexcept {
  const auto* const shared = std::get_if<SharedSamples>(&motion_);
  return shared == nullptr ? nullptr : shared->get();
}

}  // namespace pounding
