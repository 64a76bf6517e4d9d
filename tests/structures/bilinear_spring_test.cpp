// A bilinear spring in isolation, with the test as integrator, and the yielding storeys of an input.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include <pounding/input/resolved.hpp>
#include <pounding/model/system.hpp>
#include <pounding/structures/oscillators.hpp>
#include "support/bilinear_spring.hpp"
#include "support/models.hpp"

namespace pounding {
namespace bilinear_spring_test {

using BilinearSpring = test::LoadedBilinear;
using Parameters = pounding::BilinearSpring::Parameters;

// Yields at 10 mm.
constexpr double k = 2e6, yield_force = 2e4, yield = yield_force / k, hardening = 0.1;

BilinearSpring make(double ratio = hardening) {
  return BilinearSpring(Parameters{.stiffness = k, .yield_force = yield_force, .hardening = ratio});
}

double force(const BilinearSpring& spring, double u) { return k * u + spring.evaluate({u, 0}).force; }
double stored(const BilinearSpring& spring, double u) { return 0.5 * k * u * u + spring.stored_correction(); }

LinkStep to(double u) { return {.begin = 0, .end = 1, .motion_begin = {}, .motion_middle = {}, .motion_end = {u, 0}}; }

// Deforms the spring evenly from `from` to `to_u` and accepts every state. Returns the work done on it by the
// trapezoidal rule.
double drive(BilinearSpring& spring, double from, double to_u, int steps) {
  double work = 0;
  for (int i = 1; i <= steps; ++i) {
    const double u0 = from + (to_u - from) * (i - 1) / steps, u1 = from + (to_u - from) * i / steps;
    const double before = force(spring, u0), at_end = force(spring, u1);
    spring.accept(to(u1));
    EXPECT_NEAR(force(spring, u1), at_end, 1e-12 * yield_force) << "accepting a state does not change its force";
    work += 0.5 * (before + at_end) * (u1 - u0);
  }
  return work;
}

TEST(BilinearSpring, LoadsAlongTheStiffnessAndThenAlongTheHardening) {
  for (const double sign : {1.0, -1.0}) {
    BilinearSpring driven = make();
    const BilinearSpring jumped = make();
    double last = 0;
    for (const double u : {0.004, 0.01, 0.0101, 0.02, 0.035}) {
      const double expected = u <= yield ? k * u : yield_force + hardening * k * (u - yield);
      EXPECT_NEAR(force(jumped, sign * u), sign * expected, 1e-12 * expected);
      drive(driven, sign * last, sign * u, 7);
      EXPECT_NEAR(force(driven, sign * u), sign * expected, 1e-12 * expected) << "for any number of steps";
      last = u;
    }
  }
}

TEST(BilinearSpring, AddsExactlyNothingBeforeItYields) {
  const BilinearSpring spring = make();
  for (const double u : {0.0, 1e-300, 0.003, -0.00999}) {
    EXPECT_EQ(spring.evaluate({u, 2.0}).force, 0);
    EXPECT_EQ(spring.evaluate({u, 2.0}).by_penetration, 0);
  }
  EXPECT_EQ(spring.stored_correction(), 0);
  EXPECT_EQ(spring.lost(), 0);
}

TEST(BilinearSpring, UnloadsAlongItsStiffnessOverTwiceTheYieldForce) {
  BilinearSpring spring = make();
  spring.accept(to(0.05));
  const double top = yield_force + hardening * k * 0.04;
  EXPECT_NEAR(force(spring, 0.05), top, 1e-12 * top);
  EXPECT_NEAR(force(spring, 0.05 - 1.99 * yield), top - 1.99 * yield_force, 1e-11 * top);
  EXPECT_NEAR(force(spring, 0.05 - 3 * yield), top - 2 * yield_force - hardening * yield_force, 1e-11 * top);
}

TEST(BilinearSpring, LosesTheAreaOfItsLoopInAClosedCycle) {
  for (const double ratio : {0.0, 0.1, 0.5}) {
    BilinearSpring spring = make(ratio);
    const double amplitude = 0.05, area = 4 * (1 - ratio) * yield_force * (amplitude - yield);
    drive(spring, 0, amplitude, 50);
    const double before = spring.lost();
    const double work = drive(spring, amplitude, -amplitude, 100) + drive(spring, -amplitude, amplitude, 100);
    EXPECT_NEAR(spring.lost() - before, area, 1e-12 * area);
    EXPECT_NEAR(work, area, 1e-10 * area) << "the yield points fall on the ends of steps";
  }
}

TEST(BilinearSpring, StoresAndLosesTheWorkDoneOnIt) {
  BilinearSpring spring = make();
  double work = 0, u = 0, lost = 0;
  for (const double next : {0.007, -0.004, 0.03, 0.024, 0.041, 0.005, -0.06, -0.0591, 0.002, 0.0}) {
    work += drive(spring, u, next, 4000);
    u = next;
    EXPECT_NEAR(stored(spring, u) + spring.lost(), work, 1e-6 * yield_force * yield) << "at " << u;
    EXPECT_GE(spring.lost(), lost) << "lost energy does not return";
    EXPECT_GE(stored(spring, u), 0);
    lost = spring.lost();
  }
  EXPECT_GT(lost, 10 * yield_force * yield);
}

TEST(BilinearSpring, AnswersWithTheSlopeOfItsForce) {
  for (const double ratio : {0.0, 0.1}) {
    BilinearSpring spring = make(ratio);
    spring.accept(to(0.033));
    int yielded = 0;
    for (double u = -0.0403; u < 0.06; u += 1.7e-3) {
      const double d = 1e-7;
      const laws::Response here = spring.evaluate({u, 0.3});
      const double slope = (spring.evaluate({u + d, 0.3}).force - spring.evaluate({u - d, 0.3}).force) / (2 * d);
      EXPECT_NEAR(here.by_penetration, slope, 1e-6 * k) << "at " << u;
      EXPECT_LE(here.by_penetration, 0);
      EXPECT_GE(here.by_penetration, -k);
      EXPECT_EQ(here.by_rate, 0);
      EXPECT_EQ(spring.evaluate({u, -7.0}).force, here.force) << "the rate has no effect";
      yielded += here.by_penetration < 0;
    }
    EXPECT_GT(yielded, 20);
  }
}

TEST(BilinearSpring, IsNotMovedByBeingAsked) {
  BilinearSpring spring = make();
  spring.accept(to(0.02));
  const double slip = spring.slip(), lost = spring.lost(), correction = spring.stored_correction();
  const double before = spring.evaluate({0.013, 1}).force;
  for (const double u : {0.3, -0.3, 0.02, -0.1}) static_cast<void>(spring.evaluate({u, 1}));
  EXPECT_EQ(spring.evaluate({0.013, 1}).force, before);
  EXPECT_EQ(spring.slip(), slip);
  EXPECT_EQ(spring.lost(), lost);
  EXPECT_EQ(spring.stored_correction(), correction);
}

// A parabola with its maximum at t = 0.6, in one step and in two that meet there.
TEST(BilinearSpring, YieldsUpToTheTurningPointInsideAStep) {
  for (const double sign : {1.0, -1.0})
    for (const double end : {1.0, 0.7, 0.6001}) {
      const double top = 0.045;
      const auto motion = [&](double t) {
        return LinkMotion{sign * (top - (t - 0.6) * (t - 0.6) * 0.1), -sign * 0.2 * (t - 0.6)};
      };
      BilinearSpring whole = make(), halves = make();
      whole.accept({.begin = 0, .end = end, .motion_begin = motion(0), .motion_middle = {}, .motion_end = motion(end)});
      halves.accept(to(sign * top));
      halves.accept(to(motion(end).penetration));
      EXPECT_NEAR(whole.slip(), sign * (top - yield), 1e-15);
      EXPECT_NEAR(whole.slip(), halves.slip(), 1e-15);
      EXPECT_NEAR(whole.lost(), halves.lost(), 1e-12 * halves.lost());
      EXPECT_NEAR(whole.stored_correction(), halves.stored_correction(), 1e-12 * std::abs(halves.stored_correction()));
    }
}

TEST(BilinearSpring, GoesOnFromItsArchiveWithTheSameBits) {
  BilinearSpring spring = make();
  drive(spring, 0, 0.037, 11);
  drive(spring, 0.037, -0.013, 7);
  Archive archive;
  spring.archive(archive);
  BilinearSpring copy = make();
  Archive read(archive.bytes());
  copy.archive(read);
  read.expect_end();
  drive(spring, -0.013, 0.021, 13);
  drive(copy, -0.013, 0.021, 13);
  const auto bits = [](const BilinearSpring& s) {
    return std::vector<double>{s.slip(), s.lost(), s.stored_correction(), s.evaluate({0.03, 0}).force,
                               s.evaluate({-0.02, 0}).force};
  };
  EXPECT_EQ(std::memcmp(bits(spring).data(), bits(copy).data(), 5 * sizeof(double)), 0);
}

TEST(BilinearSpring, RefusesWhatCannotBe) {
  const double infinite = std::numeric_limits<double>::infinity(), none = std::numeric_limits<double>::quiet_NaN();
  const auto refusal = [](const Parameters& parameters) -> std::string {
    return test::refusal([&] { BilinearSpring spring(parameters); });
  };
  for (const double wrong : {0.0, -1.0, infinite, none}) {
    EXPECT_TRUE(
        test::mentions(refusal({.stiffness = wrong, .yield_force = 1}), {"stiffness", laws::number_text(wrong)}));
    EXPECT_TRUE(
        test::mentions(refusal({.stiffness = 1, .yield_force = wrong}), {"yield_force", laws::number_text(wrong)}));
  }
  for (const double wrong : {-0.1, 1.0, none})
    EXPECT_TRUE(test::mentions(refusal({.stiffness = 1, .yield_force = 1, .hardening = wrong}),
                               {"hardening", laws::number_text(wrong), "[0, 1)"}));
}

LoadedSpring spring_of(const System& system, std::size_t i) {
  return LoadedSpring(static_cast<const Spring&>(*system.elements[i]));
}

std::string structure(const std::string& text) { return "structures:\n  a: " + text + "\nanalysis: {duration: 1}\n"; }

TEST(YieldingStoreys, HaveOneForceOrOneAStorey) {
  const Model model = test::model_of(
      "structures:\n"
      "  a: {oscillator: {mass: 100 t, stiffness: 4 MN/m, yield_force: 50 kN}, damping: 0}\n"
      "  b: {shear_building: {storeys: 2, mass: 1 t, stiffness: 1 MN/m, yield_force: [20 kN, 10 kN], hardening: 4 %}, "
      "damping: 0}\n"
      "  c: {shear_building: {storeys: 2, mass: 1 t, stiffness: 1 MN/m, yield_force: 7, hardening: [0, 0.5]}, damping: "
      "0}\n"
      "  d: {oscillator: {mass: 100 t, stiffness: 4 MN/m}, damping: 0}\n"
      "analysis: {duration: 1}\n");
  const YAML::Node resolved = YAML::Load(resolved_yaml(model))["structures"];
  using Values = std::vector<double>;
  EXPECT_EQ(resolved["a"]["yield_force"].as<Values>(), (Values{5e4}));
  EXPECT_EQ(resolved["a"]["hardening"].as<Values>(), (Values{0}));
  EXPECT_EQ(resolved["b"]["yield_force"].as<Values>(), (Values{2e4, 1e4}));
  EXPECT_EQ(resolved["b"]["hardening"].as<Values>(), (Values{0.04, 0.04}));
  EXPECT_EQ(resolved["c"]["yield_force"].as<Values>(), (Values{7, 7}));
  EXPECT_EQ(resolved["c"]["hardening"].as<Values>(), (Values{0, 0.5}));
  EXPECT_FALSE(resolved["d"]["yield_force"]) << "an elastic storey has none";
}

TEST(YieldingStoreys, ActBetweenTheirFloorsAfterTheContacts) {
  const Model model = test::model_of(
      "structures:\n"
      "  a: {oscillator: {mass: 1, stiffness: 1}, damping: 0}\n"
      "  b: {shear_building: {storeys: 2, mass: 1, stiffness: 100, yield_force: [20, 10], hardening: 0.1}, damping: "
      "0}\n"
      "links: [{between: [a, b.2], gap: 1, law: hertz, stiffness: 1}]\n"
      "analysis: {duration: 1}\n");
  const System system = assemble(model);
  Eigen::Matrix3d closing;
  closing << 1, 0, 0, 0, 1, -1, -1, 0, 1;
  EXPECT_EQ(Eigen::MatrixXd(system.gap_jacobian), closing);
  ASSERT_EQ(system.elements.size(), 2u);
  EXPECT_EQ(spring_of(system, 0).evaluate({0.2, 0}).force, 0) << "yields at 20 N";
  EXPECT_NEAR(spring_of(system, 1).evaluate({0.2, 0}).force, 10 + 0.1 * 10 - 20, 1e-12) << "yields at 10 N";
  const System without = assemble(model, false);
  EXPECT_EQ(without.links(), 2);
  EXPECT_EQ(Eigen::MatrixXd(without.gap_jacobian), closing.rightCols(2));
}

TEST(YieldingStoreys, AreRefusedWithAReason) {
  test::refused(structure("{oscillator: {mass: 1, stiffness: 1, hardening: 0.1}, damping: 0}"),
                test::at("2:43", "structures.a.oscillator.hardening"), test::mentions({"yield_force: 2 MN"}));
  test::refused(structure("{oscillator: {mass: 1, stiffness: 1, yield_force: 0}, damping: 0}"),
                test::at("2:56", "structures.a.oscillator.yield_force"), test::mentions({"200 kN", "0"}));
  test::refused(structure("{oscillator: {mass: 1, stiffness: 1, yield_force: 1, hardening: 100 %}, damping: 0}"),
                test::at("2:70", "structures.a.oscillator.hardening"), test::mentions({"5 %", "100 %", "[0, 1)"}));
  test::refused(structure("{shear_building: {storeys: 3, mass: 1, stiffness: 1, yield_force: [1 N, 2 N]}, damping: 0}"),
                test::at("2:72", "structures.a.shear_building.yield_force"), test::mentions({"200 kN", "3", "2"}));
  test::refused(structure("{shear_building: {storeys: 2, mass: 1, stiffness: 1 N/m, yield_force: 5 mm}, damping: 0}"),
                test::at("2:76", "structures.a.shear_building.yield_force"), test::mentions({"200 kN", "5 mm"}));
  test::refused(structure("{body: {mass: 1, yield_force: 1}}"), test::at("2:23", "structures.a.body"),
                test::mentions({"yield_force", "mass", "gravity", "initial_velocity"}));
}

// The storeys are loaded slowly to the initial displacement before the run.
TEST(YieldingStoreys, MayYieldBeforeTheStart) {
  const std::string building =
      "{shear_building: {storeys: 2, mass: 1, stiffness: 1 MN/m, yield_force: 20 kN}, damping: 0, ";
  EXPECT_NO_THROW(test::model_of(structure(building + "initial_displacement: [20 mm, 40 mm]}")));
  const Model model = test::model_of(structure(building + "initial_displacement: [10 mm, -11 mm]}"));
  const System system = assemble(model);
  ASSERT_EQ(system.loaded_from.size(), 2);
  EXPECT_TRUE(system.loaded_from.isZero(0));
  LoadedSpring spring = spring_of(system, 1);
  for (const double d : {0.03, -0.03}) {
    spring.load(d);
    EXPECT_NEAR(spring.energy().lost, 20e3 * (d > 0 ? 0.01 : 0.01 + 0.02), 1e-9) << "Fy times the slip";
  }
}

TEST(YieldingStoreys, AreCountedFromNumbersToo) {
  Structure s = make_shear_building({.storeys = 2, .mass = 1, .stiffness = 10});
  EXPECT_THROW(let_storeys_yield(s, {1}, {0, 0}), std::invalid_argument);
  EXPECT_THROW(let_storeys_yield(s, {1, 1}, {0}), std::invalid_argument);
  EXPECT_THROW(let_storeys_yield(s, {1, -1}, {0, 0}), std::invalid_argument);
  let_storeys_yield(s, {1, 2}, {0, 0.2});
  ASSERT_EQ(s.yielding.size(), 2u);
  EXPECT_EQ(s.yielding[1].parameters.front().value, 2);
  EXPECT_EQ(s.yielding[1].name, "storey 2");
}

}  // namespace bilinear_spring_test
}  // namespace pounding
