/// Loops of the deteriorating laws along the paths of other programs, and their failure.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/hysteresis/all.hpp>
#include "support/law_contract.hpp"
#include "support/messages.hpp"

namespace pounding::hysteresis {
namespace deterioration_test {

/// Rotations of growing cycles, and of a path with inner reversals that reaches the residual moment.
const std::vector<double> cycles{0.01,  -0.01, 0.02,  -0.02, 0.02,  -0.02, 0.04,
                                 -0.04, 0.04,  -0.04, 0.06,  -0.06, 0.08,  -0.08},
    inner{0.02, 0.012, 0.025, -0.015, -0.011, -0.03, 0.005, -0.006, 0.03, 0.01, 0.024,
          0.02, 0.05,  -0.04, 0.01,   -0.02,  -0.01, -0.05, 0.15,   0.1,  0.16, -0.1};

template <class L>
L made() {
  L law;
  law.initial_stiffness = 50e6;
  law.yield_force = 250e3;
  law.FmaxFy = 1.08;
  law.dp = 0.025;
  law.dpc = 0.15;
  law.du = 1;
  law.FresFy = 0.2;
  law.Lambda_S = law.Lambda_C = 0.8;
  law.Lambda_K = 1;
  if constexpr (requires { law.Lambda_A; }) law.Lambda_A = 0.8;
  if constexpr (requires { law.kappaF; }) {
    law.kappaF = 0.4;
    law.kappaD = 0.6;
  }
  if constexpr (requires { law.FprPos; }) {
    law.FprPos = 0.4;
    law.A_pinch = 0.6;
  }
  return law;
}
template <class L>
L made_with_two_sides() {
  L law = made<L>();
  law.negative_yield_force = 300e3;
  law.FmaxFy_neg = 1.05;
  law.dp_neg = 0.04;
  law.dpc_neg = 0.1;
  law.FresFy_neg = 0.3;
  law.D_neg = 0.5;
  law.Lambda_C = 1.2;
  law.c_S = 2;
  if constexpr (requires { law.Lambda_A; }) law.Lambda_A = 0.6;
  if constexpr (requires { law.FprNeg; }) {
    law.FprNeg = 0.3;
    law.A_pinch = 0.2;
    law.Lambda_K.reset();  // a ripple would end it
  }
  return law;
}
template <class L>
L made_with_exponents() {
  L law = made<L>();
  law.Lambda_C = 1.2;
  law.c_S = 1.2;
  law.c_C = 1.5;
  law.c_K = 1.1;
  if constexpr (requires { law.Lambda_A; }) {
    law.Lambda_A = 0.6;
    law.c_A = 0.8;
  }
  if constexpr (requires { law.kappaF; }) {
    law.kappaF = 0.3;
    law.kappaD = 0.2;
  }
  return law;
}

/// `allowed` is a fraction of the maximum moment.
template <Law L>
void expect_loop(const L& law, const std::vector<double>& path, const std::vector<double>& forces, double allowed) {
  test::expect_loop(law, path, forces, allowed * 270e3);
}

// Reference: an independent Python program with every deterioration at its exact point.
TEST(DeterioratingLoops, ImkBilinearFollowsTheIndependentProgram) {
  expect_loop(made<ImkBilinear>(), cycles,
              {254000.0, -252444.46775058607, 258801.17773323198, -253815.2399388184, 248982.99706536997,
               -244037.19697005456, 231390.63765671948, -220053.6900550925, 209475.97606226118, -198350.0818314755,
               164308.9579745774, -149640.07528682362, 119193.80466909727, -104013.13021016789},
              1e-12);
}

// Reference: OpenSees 3.7.1 with 40,000 steps per stretch, extrapolated from 4,000; they differ by up to 3.8e-7.
TEST(DeterioratingLoops, AgreeWithOpenSeesAsItsStepsShrink) {
  expect_loop(made<ImkPeakOriented>(), cycles,
              {254000, -252444.468, 259598.87, -255448.163, 249673.015, -247930.38, 234425.31, -222231.336, 202806.29,
               -200630.532, 164945.945, -152349.513, 104826.654, -95231.1552},
              1e-7);
  expect_loop(made<ImkPinching>(), cycles,
              {254000, -252444.468, 260080.735, -256144.123, 250287.133, -250377.654, 239825.25, -228476.608,
               211255.319, -212595.446, 181697.09, -169071.077, 129174.995, -117333.958},
              1e-7);
  expect_loop(made<ImkBilinear>(), inner,
              {262000,     -131861.526, 266000,     -251465.684, -61391.3756, -263157.101, 235558.366, -237153.189,
               254280.641, -217264.187, 246980.902, 77010.7682,  219263.278,  -222030,     209675.35,  -216621.824,
               136251.565, -196901.339, 57245.9713, -97919.24,   50000,       -100171.423},
              1e-7);
  expect_loop(made<ImkPeakOriented>(), inner,
              {262000,     -33231.4537, 265955.551, -251128.886, -59396.9177, -261239.002, 148058.329, -62312.273,
               254706.3,   -63561.4341, 171238.645, -946.951937, 217997.504,  -219377.031, 98189.2375, -123106.415,
               25357.1188, -197440.325, 50000,      -34868.0101, 50000,       -66084.2325},
              1e-7);
  expect_loop(made<ImkPinching>(), inner,
              {262000,     -13292.5815, 265978.627, -251060.294, -58171.2304, -261151.582, 59976.2413, -29783.9436,
               257418.246, -26436.1415, 177376.46,  -236.08202,  221107.447,  -224409.252, 42517.5125, -82868.5792,
               9370.63628, -204709.493, 50000,      -15497.5632, 50000,       -79263.0272},
              1e-7);
}

TEST(DeterioratingLoops, AgreeWithOpenSeesForOtherExponents) {
  expect_loop(made_with_exponents<ImkBilinear>(), inner,
              {262000,     -133957.403, 266000,     -255170.243, -62001.9943, -267036.577, 241644.25,  -244228.344,
               260934.1,   -227493.8,   255045.731, 76804.046,   235695.74,   -254026.247, 224501.612, -236255.226,
               147513.634, -239064.417, 96441.8811, -100407.677, 88505.9808,  -186308.996},
              1e-7);
  expect_loop(made_with_exponents<ImkPeakOriented>(), inner,
              {262000,     -33612.5305, 265991.947, -255015.115, -60508.4712, -266874.123, 147320.984, -63815.1353,
               263200.481, -65090.3572, 178270.041, -910.981531, 232265.045,  -249278.726, 104182.724, -137491.529,
               26472.8377, -231028.064, 50000,      -42868.63,   50000,       -131701.885},
              1e-7);
  expect_loop(made_with_exponents<ImkPinching>(), inner,
              {262000,     -10083.7591, 265997.555, -254977.982, -59448.8109, -266835.236, 44853.1992, -23368.9479,
               264866.168, -20608.1863, 132990.549, -1803.73451, 232777.442,  -250148.569, 34092.112,  -43749.0586,
               8252.07842, -232101.915, 51422.4489, -14251.3865, 50000,       -136404.304},
              1e-7);
}

// Reference: OpenSees 3.7.1, extrapolated in the same way; change with the step up to 1.2e-6.
TEST(DeterioratingLoops, SupersededLawsAgreeWithOpenSeesAsItsStepsShrink) {
  expect_loop(made<Bilin>(), cycles,
              {254000, -252442.412, 258788.548, -253776.96, 248891.062, -243862.165, 225518.169, -211357.853, 198245.76,
               -184703.97, 148751.869, -131879.836, 99935.4616, -84711.6269},
              1e-7);
  expect_loop(made<ModImkPeakOriented>(), cycles,
              {254000, -252442.412, 259591.437, -255427.452, 249625.804, -247845.092, 234285.602, -222020.095,
               202438.732, -200161.021, 164412.215, -151744.829, 104070.265, -94512.5504},
              1e-7);
  expect_loop(made<ModImkPinching>(), cycles,
              {254000, -252442.412, 260076.687, -256231.481, 249356.207, -250432.526, 240268.218, -229371.726,
               208985.809, -213278.551, 183220.104, -171954.931, 131367.548, -121182.212},
              1e-7);
}

TEST(DeterioratingLoops, SupersededLawsWithTwoSidesAgreeWithOpenSees) {
  expect_loop(made_with_two_sides<Bilin>(), {inner.begin(), inner.end() - 2},
              {262000,      -134954.134, 266000,      -303312.665, -108811.356, -308936.5,  248743.298,
               -265603.509, 255117.192,  -293589.445, 263132.718,  79770.2662,  216643.097, -312021.868,
               245577.915,  -303878.872, 110042.617,  -274634.66,  50000,       -244385.749},
              5e-7);
  expect_loop(made_with_two_sides<ModImkPeakOriented>(), inner,
              {262000,     -39379.6356, 265999.99,  -303309.796, -107733.615, -308933.578, 149331.179, -76011.9943,
               258193.046, -79661.2807, 171824.794, -2338.39968, 221619.641,  -312337.959, 93879.728,  -181883.342,
               21334.7909, -285172.549, 50000,      -53915.8392, 50000,       -108948.417},
              1e-7);
  expect_loop(made_with_two_sides<ModImkPinching>(), inner,
              {262000,     -11876.7321, 265999.998, -303308.617, -103308.617, -308932.377, 66655.1178, -36687.2039,
               260690.898, -24574.044,  179958.268, -720.178625, 224494.48,   -312448.591, 42471.7953, -141402.898,
               8344.87637, -288406.639, 50000,      -17207.9161, 50000,       -113797.547},
              1e-7);
}

// The stiffness and the hardening of OpenSees are those of the member: K0 = 50/11 MN m/rad.
TEST(DeterioratingLoops, BilinReducesRatiosOfTheMemberWithItsFactorN) {
  Bilin law = made<Bilin>();
  law.nFactor = 10;
  expect_loop(law, inner,
              {262000,      -106866.208, 266000,     -251519.564, -94224.5871, -262155.616, 236182.994, -100867.774,
               252699.259,  -218969.914, 170271.51,  59059.6748,  226565.667,  -223530.332, 214652.341, -223309.344,
               -30749.2509, -201867.642, 80604.2752, -107025.914, 67123.2937,  -97175.9052},
              1e-7);
}

// The line of reloading from the zero force at 0.02 - 262000/50e6 to the peak at 0.02 is the unloading line: softer
// unloading after the ripple never reaches it.
TEST(DeterioratingLoops, ARippleEndsModImkPinchingAsInOpenSees) {
  const ModImkPinching law = made<ModImkPinching>();
  const auto ripple = law.advance(law.advance({}, 0.02), 0.018);
  EXPECT_GT(law.respond(ripple, 0.018).force, 1e5);
  EXPECT_EQ(law.respond(ripple, 0.019).force, 0);
  ModImkPinching lasting = law;
  lasting.Lambda_K.reset();
  EXPECT_NEAR(lasting.respond(lasting.advance(lasting.advance({}, 0.02), 0.018), 0.02).force, 262e3, 1e-6);
}

template <class L>
struct DeterioratingBackbone : testing::Test {};
using AllImkLaws = testing::Types<ImkBilinear, ImkPeakOriented, ImkPinching, Bilin, ModImkPeakOriented, ModImkPinching>;
TYPED_TEST_SUITE(DeterioratingBackbone, AllImkLaws);

template <class L>
struct Deterioration : testing::Test {};
using ImkLaws = testing::Types<ImkBilinear, ImkPeakOriented, ImkPinching>;
TYPED_TEST_SUITE(Deterioration, ImkLaws);

// Yield at 5 mrad, cap at 30 mrad, residual at 30 + 150 (1 - 0.2/1.08) mrad.
TYPED_TEST(DeterioratingBackbone, IsThatOfItsParameters) {
  const TypeParam law = made<TypeParam>();
  const double residual = 0.03 + 0.15 * (1 - 0.2 / 1.08);
  for (const double side : {1.0, -1.0}) {
    EXPECT_NEAR(law.respond({}, side * 0.03).force, side * 270e3, 1e-6);
    EXPECT_NEAR(law.respond({}, side * 0.05).slope, -270e3 / 0.15, 1e-6) << "softening";
    EXPECT_NEAR(law.respond({}, side * 0.5).force, side * 50e3, 1e-6);
    double at = 0;
    for (const double corner : {0.005, 0.03, residual, 1.0}) {
      EXPECT_NEAR(std::abs(*law.corner(law.advance({}, side * at), side * 2)), corner, 1e-12);
      at = corner + 1e-6;
    }
  }
}

TYPED_TEST(DeterioratingBackbone, LosesItsForceAtTheUltimateDeformation) {
  TypeParam law = made<TypeParam>();
  law.du = 0.06;
  const auto kept = law.advance({}, 0.05);
  EXPECT_EQ(law.corner(kept, 0.1), 0.06);
  EXPECT_GT(law.respond(kept, 0.06).force, 2e5) << "the force before the corner";
  EXPECT_EQ(law.respond(kept, 0.0600001).force, 0);
  EXPECT_EQ(law.respond(kept, 0.0600001).slope, 0);
  const double force = law.respond(kept, 0.06).force;
  EXPECT_NEAR(law.work(kept, 0.2), 0.5 * 0.01 * (law.respond(kept, 0.05).force + force), 1e-6);
  const auto broken = law.advance(kept, 0.2);
  EXPECT_EQ(law.stored(broken), 0);
  EXPECT_EQ(law.respond(broken, 0.1).force, TypeParam::keeps_other_side ? -50e3 : 0);
  EXPECT_EQ(law.respond(law.advance(broken, -0.5), 0.2).force, 0) << "both sides";
}

// Yield at 6 mrad, cap at 46 mrad, residual at 46 + 100 (1 - 0.3/1.05) mrad.
TYPED_TEST(DeterioratingBackbone, HasParametersOfItsOwnInTheNegativeDirection) {
  const TypeParam law = made_with_two_sides<TypeParam>();
  EXPECT_NEAR(law.respond({}, 0.03).force, 270e3, 1e-6);
  EXPECT_NEAR(law.respond({}, -0.046).force, -315e3, 1e-6);
  EXPECT_NEAR(law.respond({}, -0.1).slope, -315e3 / 0.1, 1e-6) << "softening";
  EXPECT_NEAR(law.respond({}, -0.5).force, -90e3, 1e-6);
  EXPECT_EQ(law.yield_deformation(), 0.005);
  EXPECT_EQ(law.yield_deformation(-1), 0.006);
}

TYPED_TEST(DeterioratingBackbone, IsMirroredWithItsSides) {
  const TypeParam law = made_with_two_sides<TypeParam>();
  TypeParam mirrored = law;
  mirrored.is_mirrored = true;
  typename TypeParam::State kept, other;
  for (const double d : inner) {
    EXPECT_EQ(mirrored.respond(other, -d).force, -law.respond(kept, d).force);
    kept = law.advance(kept, d);
    other = mirrored.advance(other, -d);
  }
}

TYPED_TEST(Deterioration, AnExhaustedEnergyCapacityIsFinal) {
  TypeParam law = made<TypeParam>();
  law.Lambda_S = 0.2;
  typename TypeParam::State kept;
  double work = 0;
  for (int i = 0; i < 40; ++i)
    for (const double d : {0.02, -0.02}) {
      work += law.work(kept, d);
      kept = law.advance(kept, d);
    }
  EXPECT_EQ(law.respond(kept, 0.02).force, 0);
  EXPECT_EQ(law.work(kept, 0.3), 0);
  EXPECT_LT(work, 0.2 * 250e3) << "energy capacity";
  EXPECT_GT(work, 0.5 * 0.2 * 250e3);
}

TYPED_TEST(Deterioration, ASofteningLineThatReachesZeroFails) {
  TypeParam law = made<TypeParam>();
  law.FresFy = 0;
  EXPECT_NEAR(*law.corner(law.advance({}, 0.05), 0.3), 0.18, 1e-12);
  EXPECT_EQ(law.respond(law.advance({}, 0.19), 0).force, 0);
}

TEST(DeteriorationKeys, AreRefusedWithWhatToType) {
  const auto refused = [](const char* name, double value, const test::Facts& facts) {
    Settings s = typical_settings(find_law("imk_bilinear"));
    s.values.insert_or_assign(name, value);
    const std::string text = test::refusal([&] { make_law(s); });
    EXPECT_TRUE(test::mentions(text, facts)) << text;
  };
  refused("FmaxFy", 1.1, {"FmaxFy", "hardening", "not both"});
  refused("Lambda_S", 0, {"Lambda_S", "0", "remove"});
  refused("du", 0.01, {"du", "0.01", "0.015"});
  refused("FresFy", 1, {"FresFy", "[0, 1)"});
  refused("FmaxFy_neg", 6, {"FmaxFy_neg", "6", "below 5"});
  refused("D_neg", 1.5, {"D_neg", "1.5", "[0, 1]"});
}

}  // namespace deterioration_test
}  // namespace pounding::hysteresis
