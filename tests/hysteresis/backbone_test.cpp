/// Laws whose backbone is given by points: loops of OpenSees along the same paths, closed forms, and messages.

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/hysteresis/all.hpp>
#include "support/law_contract.hpp"
#include "support/messages.hpp"

namespace pounding::hysteresis {
namespace backbone_test {

/// Growing cycles, and a path with inner reversals that passes the last point.
const std::vector<double> cycles{0.004,  -0.004, 0.008,  -0.008, 0.008,  0.002, 0.006,
                                 -0.016, 0.016,  -0.016, 0.024,  -0.024, 0.030, 0.0},
    inner{0.002, -0.001, 0.010, 0.009,  0.012, 0.006,  0.011, -0.002, 0.001, -0.010, -0.004,
          0.002, -0.003, 0.02,  -0.018, -0.01, -0.017, 0.035, 0.0,    0.02,  -0.045, 0.05};

Hysteretic three_points() {
  Hysteretic law;
  law.initial_stiffness = 37.5e6;
  law.yield_force = 150e3;
  law.s2p = 200e3, law.e2p = 0.012, law.s3p = 60e3, law.e3p = 0.04;
  law.pinchX = 0.7, law.pinchY = 0.3, law.beta = 0.4;
  return law;
}
Hysteretic damaged(Hysteretic law, double damage1, double damage2) {
  law.damage1 = damage1, law.damage2 = damage2;
  return law;
}
/// The negative side is weaker, and its first line is softer.
Hysteretic two_sides() {
  Hysteretic law = three_points();
  law.s1n = -100e3, law.e1n = -0.003, law.s2n = -160e3, law.e2n = -0.009, law.s3n = -120e3, law.e3n = -0.03;
  return law;
}

Pinching4 four_points() {
  Pinching4 law;
  law.initial_stiffness = 37.5e6;
  law.yield_force = 150e3;
  law.s2p = 200e3, law.e2p = 0.01, law.s3p = 210e3, law.e3p = 0.02, law.s4p = 60e3, law.e4p = 0.04;
  law.rDispP = 0.5, law.rForceP = 0.25, law.uForceP = 0.05;
  return law;
}
Pinching4 damaged(Pinching4 law, double gE = 10) {
  law.gK1 = 0.3, law.gK2 = 0.2, law.gK3 = 0.3, law.gK4 = 0.2, law.gKLim = 0.9;
  law.gD1 = 0.2, law.gD2 = 0.2, law.gD3 = 0.3, law.gD4 = 0.3, law.gDLim = 0.5;
  law.gF1 = 0.1, law.gF2 = 0.1, law.gF3 = 0.3, law.gF4 = 0.3, law.gFLim = 0.5;
  law.gE = gE;
  return law;
}
Pinching4 by_cycles() {
  Pinching4 law = damaged(four_points());
  law.by_cycles = true;
  return law;
}
/// The negative side is weaker, and its ratios differ.
Pinching4 two_sides_of_four() {
  Pinching4 law = damaged(four_points(), 3);
  law.s1n = -100e3, law.s2n = -160e3, law.e2n = -0.009, law.s3n = -150e3, law.e3n = -0.02, law.s4n = -60e3,
  law.e4n = -0.035;
  law.rDispP = 0.4, law.rForceP = 0.3, law.uForceP = -0.1;
  law.rDispN = 0.6, law.rForceN = 0.1, law.uForceN = 0.2;
  return law;
}

// Reference: OpenSees 3.7.1 with 8,000 steps per stretch. With a tenth of them, its forces change by 1e-8 of 200 kN.
TEST(Hysteretic, AgreesWithOpenSeesAsItsStepsShrink) {
  test::expect_loop(three_points(), cycles,
                    {150000, -150000, 175000, -175000, 175000, 4481.88627, 118160.629, -180000, 180000, -180000, 140000,
                     -140000, 110000, -33410.5028},
                    1e-3);
  test::expect_loop(damaged(three_points(), 0.02, 0.02), cycles,
                    {150000, -150000, 175000, -175000, 172554.106, 3496.33532, 116201.516, -180000, 180000, -162902.41,
                     140000, -140000, 110000, -26497.1186},
                    1e-3);
  test::expect_loop(damaged(three_points(), 0.02, 0.02), inner,
                    {75000,       -37500,  187500,      161507.068, 200000,      55011.3466, 175835.224, -94719.6059,
                     5461.91685,  -187500, -31542.4103, 43055.748,  -47966.2698, 160000,     -170000,    -5624.81705,
                     -149453.102, 85000,   -43514.2788, 15335.3899, -60000,      60000},
                    1e-3);
}

// With 80,000 steps, which change its forces by 2e-6 of 200 kN: it finds the change of slope at zero one step late.
TEST(Hysteretic, SidesDifferAsInOpenSees) {
  Hysteretic law = damaged(two_sides(), 0.01, 0.03);
  law.pinchX = 0.5, law.pinchY = 0.2, law.beta = 0.5;
  test::expect_loop(
      law, inner, {75000,       -33333.2813, 187500,      163782.918, 200000,      70096.1894, 178349.365,  -79007.9947,
                   10575.722,   -158095.238, -48550.7266, 42648.2572, -51564.2461, 160000,     -142857.143, -33990.9321,
                   -129248.867, 85000,       -61338.294,  17024.1437, -120000,     60000},
      0.1);
  law = two_sides();
  law.pinchX = law.pinchY = 1, law.beta = 0;
  test::expect_loop(law, inner, {75000,       -33333.2813, 187500,      150000,      200000,      -6896.55172,
                                 165476.19,   -89569.5364, 5531.97717,  -158095.238, 14569.5364,  84105.9603,
                                 -44674.4236, 160000,      -142857.143, 17627.1186,  -123885.268, 85000,
                                 -92171.9542, 45446.5248,  -120000,     60000},
                    0.1);
}

TEST(Hysteretic, ABackboneThatFallsToZeroHasNoForceBeyond) {
  Hysteretic law = damaged(three_points(), 0.01, 0.01);
  law.s3p = 0, law.e3p = 0.02, law.pinchX = 0.6, law.pinchY = 0.4, law.beta = 0.2;
  test::expect_loop(law, inner,
                    {75000,       -37500,  187500,      156279.255, 200000,      19383.1486, 169897.191, -113089.158,
                     -1931.68296, -187500, -175.528334, 62306.9212, -56460.1827, 0,          -50000,     0,
                     -16426.2131, 0,       0,           0,          0,           0},
                    1e-3);
}

// Load to D, unload to u = D - f/k', and reload on the other side to the pinching point and (e1, s1).
TEST(Hysteretic, ReloadsThroughThePinchingPoint) {
  const Hysteretic law = three_points();
  const double peak = 0.012, k = 37.5e6 * std::pow(peak / 0.004, -0.4), u = peak - 200e3 / k;
  const auto kept = law.advance({}, peak);
  const double released = -0.3 * 0.004, knee = u + 0.7 * (released - u);
  EXPECT_NEAR(law.respond(kept, 0.002).force, -0.3 * 150e3 * (u - 0.002) / (u - knee), 1e-6);
  EXPECT_NEAR(law.respond(kept, -0.001).force, -150e3 * (0.3 + 0.7 * (knee + 0.001) / (knee + 0.004)), 1e-6);
  EXPECT_NEAR(*law.corner(kept, -0.001), u, 1e-15);
  EXPECT_NEAR(*law.corner(law.advance(kept, 0.003), -0.001), knee, 1e-15);
}

// Reference: OpenSees 3.7.1 with 8,000 steps per stretch. With a tenth of them, its forces change by 1e-6 of 200 kN.
TEST(Pinching4, AgreesWithOpenSeesAsItsStepsShrink) {
  test::expect_loop(four_points(), cycles,
                    {150000, -150000, 183333.333, -183333.333, 183333.333, -14798.8506, 117289.272, -206000, 206000,
                     -206000, 180000, -180000, 135000, -31847.5992},
                    0.002);
  test::expect_loop(damaged(four_points()), cycles,
                    {150000, -130620.364, 172461.166, -169788.421, 137084.561, -12476.7126, 89441.3381, -187159.833,
                     185519.842, -131346.244, 158134.461, -157206.951, 106926.948, -18035.1651},
                    0.002);
  test::expect_loop(
      damaged(four_points()), inner,
      {75000,       -25857.7026, 188457.392,  153121.631, 183399.78,   -10580.4728, 105581.058,  -46488.5189,
       15923.3961,  -179730.127, 10602.0402,  29314.2108, -28479.4783, 187664.993,  -184639.048, 5719.91698,
       -89340.1697, 84925.4553,  -32187.5335, 4248.55374, -50935.8269, 50564.2971},
      0.1);
}

TEST(Pinching4, CyclesDamageAsInOpenSees) {
  test::expect_loop(by_cycles(), inner, {75000,       -20333.1189, 175737.484,  142786.706,  162255.769,  -10372.0571,
                                         111220.221,  -32988.5795, 15980.6794,  -163670.371, 9668.46803,  27180.6183,
                                         -23457.7203, 169097.566,  -165650.585, -15277.3592, -63567.2065, 75307.3935,
                                         -23960.9131, 2248.21034,  -44748.7694, 41314.1122},
                    0.1);
}

TEST(Pinching4, SidesDifferAsInOpenSees) {
  test::expect_loop(
      two_sides_of_four(), inner,
      {75000,       -35335.0561, 188420.335,  153091.523,  180636.279,  -21151.6165, 142329.267,  -55193.5828,
       5214.0651,   -141386.236, -3708.80925, 34731.0893,  -36206.7723, 185128.761,  -132304.324, -10374.0683,
       -62386.5379, 82774.4315,  -42326.1251, -3634.08269, -49440.6482, 48994.4534},
      0.01);
}

TEST(Pinching4, DamagesReachTheirLimitsWithTheEnergyCapacity) {
  const Pinching4 law = damaged(four_points(), 0.5);
  Pinching4::State kept;
  for (int i = 0; i < 20; ++i)
    for (const double d : {0.03, -0.03}) kept = law.advance(kept, d);
  EXPECT_EQ(kept.used[1], law.gFLim);
  EXPECT_NEAR(law.respond(kept, 0.1).force, 0.5 * 60e3, 1e-9);
}

// The steepest line of a backbone bounds the unloading stiffness; the last line continues only if it rises.
TEST(Backbones, AreThoseOfTheirPoints) {
  Hysteretic rising = three_points();
  rising.s3p = 228e3;
  for (const double side : {1.0, -1.0}) {
    const auto at = [side](const auto& law, double d) { return side * law.respond({}, side * d).force; };
    EXPECT_NEAR(at(three_points(), 0.008), 175e3, 1e-6);
    EXPECT_NEAR(at(three_points(), 0.026), 130e3, 1e-6);
    EXPECT_NEAR(at(three_points(), 0.5), 60e3, 1e-6);
    EXPECT_NEAR(at(rising, 0.052), 240e3, 1e-6);
    EXPECT_NEAR(at(four_points(), 0.03), 135e3, 1e-6);
    EXPECT_NEAR(at(four_points(), 0.05), 60e3, 1e-6);
    double before = 0;
    for (const double corner : {0.004, 0.01, 0.02, 0.04}) {
      EXPECT_NEAR(std::abs(*four_points().corner(four_points().advance({}, side * before), side * 2)), corner, 1e-15);
      before = corner + 1e-6;
    }
  }
}

template <Law L>
void expect_mirror(const L& law) {
  const L mirrored = law.mirrored();
  mirrored.check();
  EXPECT_NEAR(mirrored.stiffness(), law.respond({}, -1e-9).slope, 1e-3);
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    typename L::State kept, other;
    for (const double d : test::random_path(random, 0.004)) {
      kept = law.advance(kept, d), other = mirrored.advance(other, -d);
      ASSERT_NEAR(law.respond(kept, d).force, -mirrored.respond(other, -d).force, 1e-6) << L::name << " path " << i;
    }
  }
}
TEST(Backbones, CanBeMirrored) {
  expect_mirror(damaged(two_sides(), 0.01, 0.01));
  expect_mirror(two_sides_of_four());
}

TEST(BackboneKeys, AreRefusedWithWhatToType) {
  const auto refused = [](const char* law, const char* name, double value, const test::Facts& facts) {
    Settings s = typical_settings(find_law(law));
    s.values.insert_or_assign(name, value);
    const std::string text = test::refusal([&] { make_law(s); });
    EXPECT_TRUE(test::mentions(text, facts)) << text;
  };
  refused("hysteretic", "e2p", 0.01, {"e2p is 0.01", "0.015"});
  refused("hysteretic", "s2p", 6e5, {"s2p is 6e+05", "450000", "steepest"});
  refused("hysteretic", "s2n", 1e5, {"s2n is 1e+05", "not positive"});
  refused("hysteretic", "e3n", -0.01, {"e3n is -0.01", "-0.045"});
  refused("hysteretic", "pinchX", 1.2, {"pinchX", "[0, 1]"});
  refused("pinching4", "ePd4", 0.01, {"ePd4 is 0.01", "0.08"});
  refused("pinching4", "rDispP", 2, {"rDispP", "(-1, 1]"});
  refused("pinching4", "rForceN", -0.5, {"rForceN", "[0, 1]"});
  refused("pinching4", "gFLim", 1, {"gFLim is 1", "[0, 1)"});
}

}  // namespace backbone_test
}  // namespace pounding::hysteresis
