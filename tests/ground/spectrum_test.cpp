#include <pounding/ground/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/ground/record.hpp>
#include <pounding/ground/synthetic.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace spectrum_test {

constexpr double pi = std::numbers::pi;

double sd(const GroundMotion& motion, double period, double damping) {
  return response_spectrum(motion, std::vector{period}, damping).front().sd;
}

/// Peak by the classical fourth-order Runge-Kutta method, independent of the recurrence.
double sd_by_runge_kutta(const Samples& samples, double period, double damping, int substeps) {
  const double w = 2 * pi / period;
  double u = 0, v = 0, peak = 0;
  const auto pass = [&](double duration, double a0, double a1, int count) {
    const double h = duration / count;
    for (int i = 0; i < count; ++i) {
      const auto rate = [&](double part, double uu, double vv) {
        return -2 * damping * w * vv - w * w * uu - (a0 + (a1 - a0) * (i + part) / count);
      };
      const double k1 = rate(0, u, v), v2 = v + h / 2 * k1;
      const double k2 = rate(0.5, u + h / 2 * v, v2), v3 = v + h / 2 * k2;
      const double k3 = rate(0.5, u + h / 2 * v2, v3), v4 = v + h * k3;
      const double k4 = rate(1, u + h * v3, v4);
      u += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      peak = std::max(peak, std::abs(u));
    }
  };
  for (std::size_t i = 0; i + 1 < samples.times.size(); ++i)
    pass(samples.times[i + 1] - samples.times[i], samples.accelerations[i], samples.accelerations[i + 1], substeps);
  pass(period, 0, 0, 4000);
  return peak;
}

TEST(OscillatorStep, FreeVibrationFollowsTheClosedForm) {
  test::Book book("Response spectra", "free vibration of a damped oscillator", "rounding");
  const double w = 7, zeta = 0.1, h = 0.05, wd = w * std::sqrt(1 - zeta * zeta);
  const OscillatorStep step(w, zeta, h);
  OscillatorState s{.displacement = 0.3, .velocity = -2};
  const OscillatorState s0 = s;
  for (int i = 1; i <= 100; ++i) {
    s = step.advance(s, 0, 0);
    const double t = i * h, e = std::exp(-zeta * w * t);
    const double b = (s0.velocity + zeta * w * s0.displacement) / wd;
    book.near("displacement in free vibration [m]", s.displacement,
              e * (s0.displacement * std::cos(wd * t) + b * std::sin(wd * t)), 1e-14);
  }
}

TEST(OscillatorStep, ConstantGroundAccelerationFollowsTheClosedForm) {
  test::Book book("Response spectra", "constant acceleration: -a/w^2 (1 - cos w t)", "rounding");
  const double w = 3, h = 0.1, a = 2;
  const OscillatorStep step(w, 0, h);
  OscillatorState s;
  for (int i = 1; i <= 50; ++i) {
    s = step.advance(s, a, a);
    book.near("displacement under a constant acceleration [m]", s.displacement,
              -a / (w * w) * (1 - std::cos(w * i * h)), 1e-14);
    book.near("velocity under a constant acceleration [m/s]", s.velocity, -a / w * std::sin(w * i * h), 1e-14);
  }
}

TEST(OscillatorStep, RampFollowsTheClosedFormEvenForTinySteps) {
  test::Book book("Response spectra", "ramp: -r t^3/6 and -r t^2/2 for w t -> 0", "the next order of w t");
  // u'' + w^2 u = -r t:  u = -r/w^2 (t - sin(w t)/w), about -r t^3/6 for w t -> 0.
  const double r = 5;
  for (const double w : {2.0, 1e-4}) {
    const double h = 1e-3;
    const OscillatorState s = OscillatorStep(w, 0, h).advance({}, 0, r * h);
    book.near("displacement under a ramp over the limit [-]", s.displacement / (-r * h * h * h / 6), 1, 1e-6);
    book.near("velocity under a ramp over the limit [-]", s.velocity / (-r * h * h / 2), 1, 1e-6);
  }
}

TEST(OscillatorStep, TwoHalfStepsAreOneStepAtAnyDamping) {
  for (const double zeta : {0.0, 0.05, 1.0, 3.0}) {
    const double w = 5, h = 0.1;
    const OscillatorState s{.displacement = 0.1, .velocity = 1};
    const OscillatorState once = OscillatorStep(w, zeta, h).advance(s, 1, 4);
    const OscillatorStep half(w, zeta, h / 2);
    const OscillatorState twice = half.advance(half.advance(s, 1, 2.5), 2.5, 4);
    EXPECT_NEAR(once.displacement, twice.displacement, 1e-15) << zeta;
    EXPECT_NEAR(once.velocity, twice.velocity, 1e-14) << zeta;
  }
}

TEST(Spectrum, ResonanceOfAnUndampedOscillatorFollowsTheClosedForm) {
  test::Book book("Response spectra", "resonance without damping: peak n pi A/(2 w^2)",
                  "piecewise linear motion, peak of a cubic");
  // u'' + w^2 u = -A sin w t:  u = -A/(2 w^2) (sin w t - w t cos w t), whose peak at w t = n pi is n pi A/(2 w^2).
  const double period = 0.6, w = 2 * pi / period, amplitude = 3;
  const GroundMotion motion(Harmonic{amplitude, period, 10 * period});
  book.near("spectral displacement over closed form, resonance [-]",
            sd(motion, period, 0) / (20 * pi * amplitude / (2 * w * w)), 1, 2e-5);
}

TEST(Spectrum, DampedResonanceApproachesOneOverTwiceTheDamping) {
  test::Book book("Response spectra", "resonance with damping: 1/(2 zeta)", "piecewise linear motion, peak of a cubic");
  const double period = 0.5, w = 2 * pi / period, zeta = 0.05;
  const GroundMotion motion(Harmonic{1, period, 60 * period});
  book.near("amplification times twice the damping [-]", sd(motion, period, zeta) * w * w * 2 * zeta, 1, 2e-5);
}

TEST(Spectrum, RectangleDoublesTheStaticDisplacement) {
  test::Book book("Response spectra", "rectangular pulse: 2, or 2 sin(pi d/T) when it is short",
                  "piecewise linear motion, peak of a cubic");
  // Without damping, a pulse longer than half a period has a peak of twice the static one; a shorter one 2 sin(pi d/T).
  const GroundMotion motion(Pulse{Pulse::Shape::rectangle, 2, 0.3, 0.1});
  for (const double period : {0.05, 0.31, 0.6}) {
    const double w = 2 * pi / period;
    book.near("amplification of a long rectangle [-]", sd(motion, period, 0) * w * w / 2, 2, 1e-5);
  }
  const double w = 2 * pi / 1.5;  // this peak occurs after the end of the motion
  book.near("amplification of a short rectangle [-]", sd(motion, 1.5, 0) * w * w / 2, 2 * std::sin(pi * 0.3 / 1.5),
            1e-5);
}

TEST(Spectrum, HalfSineFollowsTheClosedFormAfterItsEnd) {
  test::Book book("Response spectra",
                  "half sine, Chopra, Dynamics of Structures, 4.8: 2 b cos(pi/(2 b))/(b^2 - 1), b = T/(2 d)",
                  "piecewise linear motion, peak of a cubic");
  // Pulse shorter than half a period: amplification 2 b cos(pi/(2 b))/(b^2 - 1) with b = T/(2 d) (Chopra, Dynamics of
  // Structures, 4.8).
  const double d = 0.2, period = 0.9, b = period / (2 * d), w = 2 * pi / period;
  const GroundMotion motion(Pulse{Pulse::Shape::half_sine, 4, d, 0});
  book.near("amplification of a short half sine [-]", sd(motion, period, 0) * w * w / 4,
            2 * b * std::cos(pi / (2 * b)) / (b * b - 1), 2e-5);
}

TEST(Spectrum, AgreesWithFineRungeKuttaOnIrregularSamples) {
  test::Book book("Response spectra", "classical Runge-Kutta method of fourth order with fine steps",
                  "peak between the steps of the reference");
  Samples samples;
  for (int i = 0; i <= 300; ++i) {
    samples.times.push_back(0.02 * i + 0.006 * std::sin(1.3 * i) + 0.01);
    samples.accelerations.push_back(std::sin(0.9 * i) + std::cos(0.31 * i * i));
  }
  const GroundMotion motion(samples);
  for (const double period : {0.05, 0.2, 0.777, 3.0})
    for (const double damping : {0.0, 0.02, 0.4}) {
      const double expected = sd_by_runge_kutta(samples, period, damping, 400);
      book.near("spectral displacement over reference [-]", sd(motion, period, damping) / expected, 1, 1e-5);
    }
}

TEST(Spectrum, LimitsAreThoseOfTheGround) {
  const GroundMotion motion = synthetic_motion({.seed = 3, .duration = 12, .pga = 2, .filter = medium_soil});
  const auto points = response_spectrum(motion, std::vector{0.005, 200.0}, 0.05);
  EXPECT_NEAR(points[0].psa, 2, 0.03);
  EXPECT_NEAR(points[1].sd / measure(*motion.samples()).pgd, 1, 0.1);
  EXPECT_DOUBLE_EQ(points[0].psv, points[0].sd * 2 * pi / 0.005);
  EXPECT_DOUBLE_EQ(points[0].psa, points[0].psv * 2 * pi / 0.005);
}

TEST(Spectrum, StillGroundMovesNothing) { EXPECT_EQ(sd(GroundMotion(), 1, 0.05), 0); }

TEST(Spectrum, WrongValuesAreRefused) {
  const auto refused = [](double period, double damping) -> std::string {
    return test::refusal([&] { sd(GroundMotion(), period, damping); });
  };
  EXPECT_TRUE(test::mentions(refused(0, 0.05), {"0 s"}));
  EXPECT_TRUE(test::mentions(refused(1, 1), {"[0, 1)"}));
  EXPECT_TRUE(test::mentions(refused(1, -0.1), {"[0, 1)", "-0.1"}));
  EXPECT_TRUE(test::mentions(refused(1, std::nan("")), {"[0, 1)"}));
}

const SyntheticOptions usual{.seed = 1940, .duration = 20, .pga = 0.3 * 9.80665};

TEST(Synthetic, SameSeedMeansTheSameBits) {
  const GroundMotion one = synthetic_motion(usual), two = synthetic_motion(usual);
  EXPECT_EQ(one.samples()->accelerations, two.samples()->accelerations);
  SyntheticOptions other = usual;
  other.seed = 1941;
  EXPECT_NE(synthetic_motion(other).samples()->accelerations, one.samples()->accelerations);
}

TEST(Synthetic, SeedMeansTheSameEarthquakeOnEveryMachine) {
  // Stored values guard against change; the tolerance covers the rounding of log and cos.
  const GroundMotion motion = synthetic_motion(usual);
  const std::vector<double>& a = motion.samples()->accelerations;
  EXPECT_NEAR(a[1], -2.53795242605e-06, 1e-11);
  EXPECT_NEAR(a[137], 0.0663397925069, 1e-11);
  EXPECT_NEAR(a[500], -0.630251468782, 1e-11);
  EXPECT_NEAR(a[1000], 0.981542817125, 1e-11);
  EXPECT_NEAR(a[1500], -0.0703814338426, 1e-11);
  EXPECT_NEAR(a[2000], 0.0181478667074, 1e-11);
}

TEST(Synthetic, PeakIsTheAskedPgaExactly) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SyntheticOptions options = usual;
    options.seed = seed;
    const GroundMotion motion = synthetic_motion(options);
    EXPECT_EQ(motion.peak(), usual.pga);
    EXPECT_EQ(motion.samples()->times.size(), 2001u);
    EXPECT_EQ(motion.duration(), 20);
    EXPECT_EQ(motion.acceleration(0), 0);
  }
}

TEST(Synthetic, DurationThatIsAWholeNumberOfStepsKeepsItsLastStep) {
  // 2.3/0.01 is 229.99999999999997.
  const GroundMotion motion = synthetic_motion({.seed = 1, .duration = 2.3, .pga = 1});
  EXPECT_EQ(motion.samples()->times.size(), 231u);
}

TEST(Synthetic, GroundComesToRest) {
  for (const GroundFilter& filter : {firm_soil, medium_soil, soft_soil})
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const GroundMotion motion = synthetic_motion({.seed = seed, .duration = 30, .pga = 3, .filter = filter});
      const Samples& samples = *motion.samples();
      double velocity = 0;
      for (std::size_t i = 0; i + 1 < samples.times.size(); ++i)
        velocity += (samples.accelerations[i] + samples.accelerations[i + 1]) / 2 * 0.01;
      // The envelope ends at 2 % of the noise, and the low cut of soft soil takes seconds to decay.
      EXPECT_LT(std::abs(velocity), 0.2 * measure(samples).pgv) << filter.omega_g << " " << seed;
    }
}

/// Mean squared amplitudes at some frequencies, over many earthquakes with a constant envelope.
std::vector<double> mean_powers(const GroundFilter& filter, const std::vector<double>& omegas) {
  std::vector<double> powers(omegas.size());
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    const GroundMotion motion = synthetic_motion(
        {.seed = seed, .duration = 20, .pga = 1, .filter = filter, .rise = 0.02, .strong_until = 0.98});
    const std::vector<double>&times = motion.samples()->times, &accelerations = motion.samples()->accelerations;
    double square = 0;  // undoes the scaling to the PGA, which varies with the seed
    for (const double a : accelerations) square += a * a;
    for (std::size_t k = 0; k < omegas.size(); ++k) {
      double real = 0, imaginary = 0;
      for (std::size_t i = 0; i < times.size(); ++i) {
        real += accelerations[i] * std::cos(omegas[k] * times[i]);
        imaginary += accelerations[i] * std::sin(omegas[k] * times[i]);
      }
      powers[k] += (real * real + imaginary * imaginary) / square;
    }
  }
  return powers;
}

TEST(Synthetic, PowerFollowsTheSpectrumOfCloughAndPenzien) {
  const GroundFilter filter{.omega_g = 12, .zeta_g = 0.2, .omega_f = 3, .zeta_f = 0.6};
  const auto density = [&](double w) {
    const auto [wg, zg, wf, zf] = filter;
    const double soil = (std::pow(wg, 4) + std::pow(2 * zg * wg * w, 2)) /
                        (std::pow(wg * wg - w * w, 2) + std::pow(2 * zg * wg * w, 2));
    return soil * std::pow(w, 4) / (std::pow(wf * wf - w * w, 2) + std::pow(2 * zf * wf * w, 2));
  };
  const std::vector<double> omegas = {12, 3, 6, 24, 40};
  const std::vector<double> powers = mean_powers(filter, omegas);
  // A mean of 600 squared amplitudes scatters by 1/sqrt(600), 4 %, and so does its divisor.
  for (std::size_t k = 1; k < omegas.size(); ++k)
    EXPECT_NEAR(powers[k] / powers[0] / (density(omegas[k]) / density(omegas[0])), 1, 0.2) << omegas[k];
}

TEST(Synthetic, ResponsePeaksNearThePeriodOfTheSoil) {
  const GroundFilter filter{.omega_g = 10, .zeta_g = 0.1, .omega_f = 1, .zeta_f = 0.6};
  std::vector<double> periods, mean;
  for (double period = 0.1; period < 3; period *= 1.1) periods.push_back(period);
  mean.resize(periods.size());
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const GroundMotion motion = synthetic_motion({.seed = seed, .duration = 20, .pga = 1, .filter = filter});
    const auto points = response_spectrum(motion, periods, 0.05);
    for (std::size_t i = 0; i < points.size(); ++i) mean[i] += points[i].psa;
  }
  const auto peak = std::max_element(mean.begin(), mean.end()) - mean.begin();
  EXPECT_NEAR(periods[static_cast<std::size_t>(peak)], 2 * pi / filter.omega_g, 0.1);
}

TEST(Synthetic, WrongValuesAreRefused) {
  const auto refused = [](auto change) -> std::string {
    SyntheticOptions options = usual;
    change(options);
    try {
      synthetic_motion(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "taken";
  };
  using O = SyntheticOptions;
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.duration = 0; }), {"0", "duration"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.pga = -1; }), {"-1", "pga"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.step = 0; }), {"0", "step"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.step = 3; }), {"3", "step"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.step = 0.04; }), {"0.04", "1/2", "step"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.rise = 0; }), {"0", "rise"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.strong_until = 0.1; }), {"strong_until", "0.1"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.filter.zeta_g = 0; }), {"zeta_g", "0"}));
  EXPECT_TRUE(test::mentions(refused([](O& o) { o.filter.omega_f = -1; }), {"omega_f", "-1"}));
}

}  // namespace spectrum_test
}  // namespace pounding
