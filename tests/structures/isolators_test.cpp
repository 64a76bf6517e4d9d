// Base-isolated buildings: matrices, damping and periods.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include <pounding/structures/damping.hpp>
#include <pounding/structures/isolators.hpp>
#include <pounding/structures/oscillators.hpp>
#include <pounding/structures/sliding_spring.hpp>
#include <pounding/structures/structure_damping.hpp>
#include "support/loaded.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace isolators_test {

const hysteresis::Settings lead_rubber{
    .law = "lead_rubber", .values = {{"strength", 300e3}, {"post_yield_stiffness", 3e6}, {"yield_displacement", 0.01}}};
const hysteresis::Settings slider{.law = "friction_pendulum", .values = {{"radius", 2}, {"friction", 0.06}}};

Structure building(const hysteresis::Settings& law, std::optional<double> capacity = {}) {
  return make_shear_building({.storeys = 3,
                              .mass = {250e3, 200e3, 150e3},
                              .stiffness = {300e6, 200e6},
                              .isolator = IsolatorOptions{.law = law, .capacity = capacity}});
}

std::string refusal_of(const auto& make) {
  return test::refusal([&] { make(); });
}

TEST(Isolators, AreTheLowestStorey) {
  const Structure s = building(lead_rubber, 0.3);
  Eigen::Matrix3d stiffness;
  const double k = 33e6;  // k2 + Q/u_y
  stiffness << k + 300e6, -300e6, 0, -300e6, 500e6, -200e6, 0, -200e6, 200e6;
  EXPECT_LT((Eigen::MatrixXd(s.stiffness) - stiffness).cwiseAbs().maxCoeff(), 1e-7);
  ASSERT_EQ(s.yielding.size(), 1u);
  EXPECT_EQ(s.yielding[0].name, "isolators");
  EXPECT_EQ(s.yielding[0].deformation.coeff(0), 1);
  EXPECT_EQ(s.yielding[0].deformation.nonZeros(), 1);
  EXPECT_EQ(s.yielding[0].parameter("capacity"), 0.3);
  EXPECT_EQ(building(lead_rubber).yielding[0].parameter("capacity"), std::numeric_limits<double>::infinity());
}

TEST(Isolators, CarryTheWeightOfAllFloors) {
  const double weight = 600e3 * 9.80665;
  EXPECT_NEAR(building(slider).yielding[0].stiffness(), weight / 2 + 0.06 * weight / 0.5e-3, 1e-3);
  hysteresis::Settings light = slider;
  light.values["weight"] = 1e6;
  EXPECT_NEAR(building(light).yielding[0].stiffness(), 0.5e6 + 0.06e6 / 0.5e-3, 1e-6);
}

TEST(Isolators, LetTheStoreysAboveThemYieldToo) {
  Structure s = building(lead_rubber);
  let_storeys_yield(s, {2e6, 1e6}, {0.05, 0.05});
  ASSERT_EQ(s.yielding.size(), 3u);
  EXPECT_EQ(s.yielding[1].name, "storey 2");
  EXPECT_EQ(s.yielding[1].deformation.coeff(0), -1);
  EXPECT_EQ(s.yielding[1].deformation.coeff(1), 1);
  EXPECT_NEAR(s.yielding[2].yield_deformation(), 1e6 / 200e6, 1e-15);
  EXPECT_FALSE(isolates(s.yielding[1]));
  EXPECT_THROW(let_storeys_yield(s, {2e6, 1e6, 1e6}, {0, 0, 0}), std::invalid_argument);
}

// One floor on a slab: an oscillator on a fixed base.
TEST(Isolators, TakeNoPartInTheDamping) {
  Structure s = make_shear_building(
      {.storeys = 2, .mass = {200e3, 300e3}, .stiffness = 75e6, .isolator = IsolatorOptions{.law = slider}});
  set_frequencies(s);
  set_damping(s, 0.02);
  const double c = 2 * 0.02 * std::sqrt(75e6 * 300e3);
  Eigen::Matrix2d expected;
  expected << c, -c, -c, c;
  EXPECT_LT((Eigen::MatrixXd(s.whole_damping()) - expected).cwiseAbs().maxCoeff(), 1e-9 * c);
  EXPECT_TRUE(test::mentions(s.damping_note, {"2 %", "0.397384 s"}));
}

TEST(Isolators, AreNotBrakedByModalDamping) {
  Structure s = building(lead_rubber);
  set_frequencies(s);
  set_damping(s, ModalDamping{0.05});
  const Eigen::MatrixXd damping = s.whole_damping();
  EXPECT_GT(damping(2, 2), 1e5);
  EXPECT_LT((damping * Eigen::Vector3d::Ones()).cwiseAbs().maxCoeff(), 1e-6 * damping(2, 2));
  // 5 % in the first mode that bends the building without isolators.
  const Eigenmodes free = dense_modes(s.mass, s.stiffness - stiffness_of_isolators(s), 3);
  EXPECT_NEAR(free.shapes.col(1).dot(damping * free.shapes.col(1)), 2 * 0.05 * free.frequencies[1],
              1e-9 * free.frequencies[1]);
}

TEST(Isolators, RefuseDampingThatWouldBrakeThem) {
  Structure s = building(lead_rubber);
  set_frequencies(s);
  EXPECT_TRUE(test::mentions(refusal_of([&] { set_damping(s, RayleighDamping{.ratio = 0.05}); }),
                             {"damping: {modal: {ratio: 2 %}}", "damping: 2 %"}));
  Structure block = make_shear_building({.storeys = 1, .mass = 200e3, .isolator = IsolatorOptions{.law = slider}});
  set_frequencies(block);
  EXPECT_TRUE(test::mentions(refusal_of([&] { set_damping(block, 0.02); }), {"damping: 0"}));
  set_damping(block, 0);
  EXPECT_EQ(block.damping_note, "none");
}

TEST(Isolators, HaveThePeriodOfTheBuildingAsOneBody) {
  EXPECT_NEAR(isolated_period(building(lead_rubber)), 2 * M_PI * std::sqrt(600e3 / 3e6), 1e-12);
  EXPECT_NEAR(isolated_period(building(slider)), 2 * M_PI * std::sqrt(2 / 9.80665), 1e-9)
      << "a pendulum of the radius of the dish";
  const hysteresis::Settings flat{.law = "bilinear",
                                  .values = {{"stiffness", 30e6}, {"yield_force", 300e3}, {"hardening", 0}}};
  EXPECT_EQ(isolated_period(building(flat)), std::numeric_limits<double>::infinity());
}

// Fixed isolators leave the motions of the floors above. A slab whose isolators share its unknowns is fixed only once.
TEST(Isolators, LeaveTheMotionsOnAFixedBase) {
  Structure s = building(lead_rubber);
  const Eigen::MatrixXd motions = motions_on_fixed_base(s);
  Eigen::MatrixXd expected(3, 2);
  expected << 0, 0, 1, 0, 0, 1;
  EXPECT_EQ(motions, expected);
  Row other(3), same(3);
  other.insert(0) = 2;
  other.insert(2) = -1;
  same.insert(0) = 1;
  s.yielding.push_back(make_isolator("isolator b", {std::move(other)}, {.law = lead_rubber}, 0).front());
  s.yielding.push_back(make_isolator("isolator c", {std::move(same)}, {.law = lead_rubber}, 0).front());
  const Eigen::MatrixXd fewer = motions_on_fixed_base(s);
  ASSERT_EQ(fewer.cols(), 1);
  for (const YieldingPart& part : s.yielding)
    EXPECT_LT((Eigen::VectorXd(part.deformation).transpose() * fewer).cwiseAbs().maxCoeff(), 1e-15) << part.name;
  EXPECT_EQ(fewer(1, 0), 1);
}

TEST(Isolators, RefuseWhatCannotBe) {
  EXPECT_TRUE(test::mentions(refusal_of([] { building(lead_rubber, -0.1); }), {"capacity"}));
  hysteresis::Settings rough = slider;
  rough.values["friction"] = -0.06;
  EXPECT_TRUE(test::mentions(refusal_of([&] { building(rough); }), {"-0.06", "friction"}));
}

// Pulled at a constant velocity it sticks over u_y mu(v)/mu_fast and then slides at mu(v) W. The energy lost is this
// force times the slip.
TEST(SlidingSpring, SlidesAtTheFrictionOfItsVelocity) {
  const SlidingFriction law{.weight = 5e6, .radius = 2, .slow = 0.04, .fast = 0.08, .rate = 60};
  const double k0 = 0.08 * 5e6 / 0.5e-3, v = 0.02, mu = 0.08 - 0.04 * std::exp(-60 * v), until = mu * 5e6 / k0;
  test::Loaded<SlidingSpring, SlidingFriction> spring(law);
  EXPECT_EQ(spring.stiffness(), 5e6 / 2 + k0);
  const auto force = [&](double d) { return spring.stiffness() * d + spring.evaluate({d, v}).force; };
  EXPECT_NEAR(force(0.9 * until), (2.5e6 + k0) * 0.9 * until, 1e-3);
  EXPECT_NEAR(force(0.01), 2.5e6 * 0.01 + mu * 5e6, 1e-3);
  EXPECT_EQ(spring.evaluate({0.01, v}).by_penetration, -k0);
  const double h = 1e-5;
  EXPECT_NEAR(spring.evaluate({0.01, v}).by_rate,
              (spring.evaluate({0.01, v + h}).force - spring.evaluate({0.01, v - h}).force) / (2 * h), 1);
  EXPECT_NEAR(spring.evaluate({-0.01, -v}).by_rate, spring.evaluate({0.01, v}).by_rate, 1e-9)
      << "the force is odd in the motion";
  spring.accept(
      {.begin = 0, .end = 0.01 / v, .motion_begin = {0, v}, .motion_middle = {0.005, v}, .motion_end = {0.01, v}});
  EXPECT_NEAR(spring.lost(), mu * 5e6 * (0.01 - until), 1e-9 * mu * 5e6);
  EXPECT_NEAR(spring.stored_correction() + 0.5 * spring.stiffness() * 1e-4,
              0.5 * 2.5e6 * 1e-4 + 0.5 * k0 * until * until, 1e-6);
}

// There and back: at the reversal it slides at mu_slow, then sticks over twice the yield deformation of its spring.
TEST(SlidingSpring, TurnsAtTheFrictionOfRest) {
  const SlidingFriction law{.weight = 5e6, .radius = 2, .slow = 0.04, .fast = 0.08, .rate = 60};
  const double k0 = 0.08 * 5e6 / 0.5e-3;
  test::Loaded<SlidingSpring, SlidingFriction> spring(law);
  // d = 0.1 sin t from t = 0 to pi: a single step with a reversal in its middle would be too coarse, hence a thousand
  // steps.
  const int steps = 1000;
  const auto at = [](double t) { return LinkMotion{0.1 * std::sin(t), 0.1 * std::cos(t)}; };
  for (int i = 0; i < steps; ++i) {
    const double t0 = M_PI * i / steps, t1 = M_PI * (i + 1) / steps;
    spring.accept({.begin = t0,
                   .end = t1,
                   .motion_begin = at(t0),
                   .motion_middle = at(0.5 * (t0 + t1)),
                   .motion_end = at(t1),
                   .acceleration_begin = -0.1 * std::sin(t0),
                   .acceleration_end = -0.1 * std::sin(t1)});
    if (i == steps / 2 - 1) {
      EXPECT_NEAR(spring.evaluate(at(t1)).force + k0 * 0.1, 0.04 * 5e6, 1) << "at the reversal";
    }
  }
  EXPECT_NEAR(spring.evaluate(at(M_PI)).force, -(0.08 - 0.04 * std::exp(-6)) * 5e6, 1e-3);
  // Two slides of 0.1 m less the sticking range, at mu(v): Simpson's rule over the velocity.
  EXPECT_GT(spring.lost(), 0.04 * 5e6 * 0.19);
  EXPECT_LT(spring.lost(), 0.08 * 5e6 * 0.2);
}

// Pushed on from a low but nonzero velocity: friction rises faster than the spring force, and it sticks from the
// maximum slip on. The slip is d - mu(v) W/k0, whose maximum a search over the step finds.
TEST(SlidingSpring, SticksWhereItsSlipStops) {
  const SlidingFriction law{.weight = 5e6, .radius = 2, .slow = 0.04, .fast = 0.08, .rate = 60};
  const double k0 = 0.08 * 5e6 / 0.5e-3, h = 0.005, minimum = 5e-4, bend = 50;
  const auto at = [&](double s) {
    const double t = (s - 0.4) * h;
    return Jet{0.01 + minimum * t + bend * t * t * t / 3, minimum + bend * t * t, 2 * bend * t};
  };
  const auto slip = [&](double s) { return at(s).x - law.coefficient(at(s).v) * law.weight / k0; };
  double largest = slip(0), where = 0;
  for (int i = 1; i <= 1000000; ++i)
    if (const double s = 1e-6 * i; slip(s) > largest) largest = slip(s), where = s;
  ASSERT_GT(where, 0.4);
  ASSERT_LT(where, 0.9);
  test::Loaded<SlidingSpring, SlidingFriction> spring(law);
  const LinkMotion begin{at(0).x, at(0).v}, end{at(1).x, at(1).v};
  spring.accept({.begin = -1, .end = 0, .motion_begin = {0, begin.rate}, .motion_middle = {}, .motion_end = begin});
  const std::optional<double> found = spring.bend({at(0), at(1), h}, 1e-6);
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, where, 2e-6);
  EXPECT_FALSE(spring.bend({at(0), at(0.9 * where), 0.9 * where * h}, 1e-6).has_value()) << "still sliding";
  const double work = spring.lost();
  spring.accept({.begin = 0,
                 .end = h,
                 .motion_begin = begin,
                 .motion_middle = {},
                 .motion_end = end,
                 .acceleration_begin = at(0).a,
                 .acceleration_end = at(1).a});
  ASSERT_LT(slip(1), largest - 1e-7) << "value from the motion at the end alone";
  EXPECT_NEAR(spring.evaluate(end).force, -k0 * largest, 1e-13 * k0);
  EXPECT_GT(spring.lost(), work);
}

TEST(SlidingSpring, RefusesWhatCannotBe) {
  const auto spring = [](SlidingFriction law) { return refusal_of([&] { SlidingSpring{law}; }); };
  EXPECT_TRUE(test::mentions(spring({.weight = 5e6, .radius = 2, .slow = 0.09, .fast = 0.08, .rate = 60}),
                             {"0.09", "0.08", "friction"}));
  EXPECT_TRUE(test::mentions(spring({.weight = 5e6, .radius = 2, .slow = 0.04, .fast = 0.08}), {"0", "rate"}));
}

}  // namespace isolators_test
}  // namespace pounding
