#include <pounding/ground/synthetic.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/limits.hpp>
#include <pounding/core/units.hpp>
#include <pounding/ground/spectrum.hpp>

namespace pounding {
namespace {

class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : bits_(seed) {}

  double operator()() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }

 private:
  /// A number in (0, 1] from the upper 53 bits; zero is excluded because of the logarithm.
  double uniform() { return (static_cast<double>(bits_() >> 11) + 1) * 0x1p-53; }

  std::mt19937_64 bits_;
};

void require(bool holds, const char* what, double value, const char* range) {
  if (!holds)
    throw std::invalid_argument(fmt::format("synthetic motion: {} is {:g}; it must be {}", what, value, range));
}

void check(const SyntheticOptions& options) {
  const auto positive = [](const char* what, double value) {
    require(std::isfinite(value) && value > 0, what, value, "finite and > 0");
  };
  const auto ratio = [](const char* what, double value) { require(value > 0 && value <= 1, what, value, "in (0, 1]"); };
  positive("duration", options.duration);
  positive("pga", options.pga);
  positive("step", options.step);
  positive("omega_g", options.filter.omega_g);
  positive("omega_f", options.filter.omega_f);
  ratio("zeta_g", options.filter.zeta_g);
  ratio("zeta_f", options.filter.zeta_f);
  require(options.rise > 0 && options.rise < 1, "rise", options.rise, "in (0, 1)");
  require(options.strong_until >= options.rise && options.strong_until < 1, "strong_until", options.strong_until,
          "at least rise and below 1");
  require(options.duration >= 10 * options.step, "step", options.step, "at most a tenth of the duration");
  const double fastest = std::max(options.filter.omega_g, options.filter.omega_f);
  require(fastest * options.step <= 0.5, "step", options.step, "at most 1/2 divided by the filter's larger omega");
  if (const double count = options.duration / options.step; count > limits::samples)
    throw std::invalid_argument(
        fmt::format("synthetic motion: {:g} s in steps of {:g} s are {:.3g} samples, but the maximum is {:g}; type a "
                    "duration up to {:g} s, or a step of at least {:.3g} s",
                    options.duration, options.step, count, limits::samples, limits::samples * options.step,
                    options.duration / limits::samples));
}

/// `part` is the time as a fraction of the duration.
double envelope(const SyntheticOptions& options, double part) {
  if (part < options.rise) return (part / options.rise) * (part / options.rise);
  if (part <= options.strong_until) return 1;
  const double level_at_end = 0.02;
  return std::exp(std::log(level_at_end) * (part - options.strong_until) / (1 - options.strong_until));
}

}  // namespace

GroundMotion synthetic_motion(const SyntheticOptions& options) {
  check(options);
  const auto& [omega_g, zeta_g, omega_f, zeta_f] = options.filter;
  const OscillatorStep soil_step(omega_g, zeta_g, options.step);
  const OscillatorStep cut_step(omega_f, zeta_f, options.step);

  // For a duration of 3 s and a step of 0.1 s there are 30 steps, regardless of the round-off of 3/0.1.
  const auto steps = static_cast<std::size_t>(options.duration / options.step * (1 + 1e-12));
  NormalNumbers normal(options.seed);
  Samples samples;
  OscillatorState soil, cut;
  double noise = 0, surface = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double time = static_cast<double>(i) * options.step;
    const double next_noise = normal() * envelope(options, time / options.duration);
    if (i > 0) soil = soil_step.advance(soil, noise, next_noise);
    const double next_surface = -(2 * zeta_g * omega_g * soil.velocity + omega_g * omega_g * soil.displacement);
    if (i > 0) cut = cut_step.advance(cut, surface, next_surface);
    // The ground acceleration is the absolute acceleration of the second filter: the sum of its three terms.
    const double ground = -(next_surface + 2 * zeta_f * omega_f * cut.velocity + omega_f * omega_f * cut.displacement);
    samples.times.push_back(time);
    samples.accelerations.push_back(ground);
    noise = next_noise;
    surface = next_surface;
  }
  double peak = 0;
  for (const double a : samples.accelerations) peak = std::max(peak, std::abs(a));
  for (double& a : samples.accelerations) a = a / peak * options.pga;
  samples.uniform = true;
  std::string source =
      fmt::format("synthetic, seed {}, soil filter {:g} rad/s, {:g} s, {}", options.seed, options.filter.omega_g,
                  options.duration, format_quantity(options.pga, dimension::acceleration));
  return GroundMotion(std::move(samples), std::move(source));
}

}  // namespace pounding
