// Devices in complete runs, against closed forms and each other.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "support/runs.hpp"

namespace pounding {
namespace devices_test {

constexpr const char* schemes[] = {"generalized_alpha", "esdirk4"};

// A mass on a linear Maxwell element: f'' + (k/c) f' + (k/m) f = 0, f(0) = 0, f'(0) = k v.
TEST(Devices, HoldAMassByALinearDamperBehindASpring) {
  constexpr double m = 1e5, k = 4e6, c = 1e6, v = 0.3;
  const double decay = k / (2 * c), w = std::sqrt(k / m - decay * decay);
  for (const char* scheme : schemes) {
    const Outcome run = test::run_text(
        fmt::format("structures: {{a: {{body: {{mass: 100 t}}, initial_velocity: {} m/s}}, w: {{wall: {{}}}}}}\n"
                    "devices: {{tie: {{between: [w, a], damper: {{coefficient: 1 MN s/m, stiffness: 4 MN/m}}}}}}\n"
                    "analysis: {{duration: 2, tolerance: 1e-7, output_step: 10 ms, integrator: {}}}\n",
                    v, scheme));
    const DeviceHistory& tie = run.results.devices[0];
    const double largest = k * v / std::sqrt(k / m);
    for (std::size_t i = 0; i < tie.force.size(); ++i) {
      const double t = run.results.time[i];
      ASSERT_NEAR(tie.force[i], k * v / w * std::exp(-decay * t) * std::sin(w * t), 1e-6 * largest)
          << scheme << " at " << t;
    }
    EXPECT_LT(run.summary.energy.error, 1e-6) << scheme;
  }
}

// A body too heavy to move, on ground that moves by A T^2/(2 pi) and stops. The force of a Maxwell element at constant
// length decays as f = (f0^(1-q) + (q-1) k t/c^q)^(1/(1-q)) with q = 1/a.
TEST(Devices, RelaxAsAPowerOfTime) {
  constexpr double k = 4e6, c = 2e5;
  for (const char* scheme : schemes)
    for (const double a : {0.35, 0.5, 0.8}) {
      const Outcome run = test::run_text(fmt::format(
          "ground_motion: {{harmonic: {{amplitude: 6, period: 0.2, duration: 0.2}}}}\n"
          "structures: {{a: {{body: {{mass: 1e13 t}}}}, w: {{wall: {{}}}}}}\n"
          "devices: {{tie: {{between: [w, a], damper: {{coefficient: {}, exponent: {}, stiffness: 4 MN/m}}}}}}\n"
          "analysis: {{duration: 3, tolerance: 1e-7, output_step: 10 ms, integrator: {}}}\n",
          c, a, scheme));
      const DeviceHistory& tie = run.results.devices[0];
      const std::size_t from = 20;  // the ground has stopped
      const double f0 = std::abs(tie.force[from]), q = 1 / a;
      ASSERT_GT(f0, 1e3);
      for (std::size_t i = from; i < tie.force.size(); ++i) {
        const double t = run.results.time[i] - run.results.time[from];
        const double f = std::pow(std::pow(f0, 1 - q) + (q - 1) * k * t / std::pow(c, q), 1 / (1 - q));
        ASSERT_NEAR(std::abs(tie.force[i]), f, 3e-6 * f0) << scheme << ", " << a << " at " << t;
      }
    }
}

// Two equal oscillators that start against each other stretch a brace between them by twice their displacement: each
// moves as with a separate brace to the ground of twice the stiffness.
TEST(Devices, BetweenMirroredStructuresAreTwoToTheGround) {
  const char* const analysis = "analysis: {duration: 3, tolerance: 1e-7, output_step: 10 ms}\n";
  for (const char* law : {"bilinear", "bouc_wen", "menegotto_pinto", "peak_oriented"}) {
    const Outcome pair = test::run_text(fmt::format(
        "structures:\n  a: {{oscillator: {{mass: 100 t, period: 0.5, damping: 2 %}}, initial_velocity: -0.4}}\n"
        "  b: {{oscillator: {{mass: 100 t, period: 0.5, damping: 2 %}}, initial_velocity: 0.4}}\n"
        "devices: {{brace: {{between: [a, b], {}: {{stiffness: 10 MN/m, yield_force: 100 kN, hardening: 0.05}}}}}}\n{}",
        law, analysis));
    const Outcome one =
        test::run_text(fmt::format("structures:\n  b: {{oscillator: {{mass: 100 t, period: 0.5, damping: 2 %, devices: "
                                   "{{brace: {{storey: 1, {}: {{stiffness: 20 MN/m, "
                                   "yield_force: 100 kN, hardening: 0.05}}}}}}}}, initial_velocity: 0.4}}\n{}",
                                   law, analysis));
    const std::vector<double>&a = pair.results.structures[0].displacement, &b = pair.results.structures[1].displacement;
    const double peak = one.summary.structures[0].peak_displacement[0];
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_NEAR(a[i], -b[i], 1e-12) << law;
      ASSERT_NEAR(b[i], one.results.structures[0].displacement[i], 1e-6 * peak)
          << law << " at " << pair.results.time[i];
    }
    EXPECT_NEAR(pair.summary.devices[0].energy_lost / (2 * one.summary.structures[0].springs[0].energy_lost), 1, 1e-6)
        << law;
    EXPECT_NEAR(pair.summary.energy.hysteretic / (2 * one.summary.energy.hysteretic), 1, 1e-6) << law;
    EXPECT_GT(one.summary.structures[0].springs[0].ductility, 2) << law;
  }
}

// A device shares the shear of its storey: the only other force on the masses above is damping.
TEST(Devices, AddToTheShearOfTheirStoreys) {
  const Outcome run = test::run_text(
      "ground_motion: {harmonic: {amplitude: 3, period: 0.6, duration: 3}}\n"
      "structures: {a: {shear_building: {storeys: 3, mass: 100 t, stiffness: 90 MN/m, damping: 0, devices: {"
      "brace: {between: [ground, 2], bilinear: {stiffness: 80 MN/m, yield_force: 300 kN, hardening: 0.02}}, "
      "fluid: {storey: 3, damper: {coefficient: 200 kN (s/m)^0.35, exponent: 0.35, stiffness: 40 MN/m}}}}}}\n"
      "analysis: {duration: 4, tolerance: 1e-7, output_step: 10 ms}\n");
  const StructureHistory& s = run.results.structures[0];
  ASSERT_EQ(s.springs.names, (std::vector<std::string>{"brace", "fluid"}));
  double peak = 0;
  for (std::size_t i = 0; i < run.results.time.size(); ++i) {
    double above = 0;
    for (int floor = 2; floor >= 0; --floor) {
      above -= 1e5 * s.acceleration[3 * i + floor];
      ASSERT_NEAR(s.storey_shear[3 * i + floor], above, 2e3) << "storey " << floor + 1 << " at " << run.results.time[i];
    }
    peak = std::max(peak, std::abs(s.storey_shear[3 * i]));
  }
  EXPECT_GT(peak, 1e6);
  EXPECT_NEAR(run.summary.structures[0].envelope.storey_shear.peak(0) / peak, 1, 0.02);
  const EnergySummary& e = run.summary.energy;
  EXPECT_NEAR(s.springs.hysteretic[2 * (run.results.time.size() - 1)], e.hysteretic, 1e-6 * e.hysteretic);
  EXPECT_NEAR(s.springs.hysteretic[2 * (run.results.time.size() - 1) + 1], e.devices, 1e-6 * e.devices);
  EXPECT_LT(e.error, 1e-6);
  EXPECT_TRUE(run.results.has_devices());
}

}  // namespace devices_test
}  // namespace pounding
