/// Loops of materials along published paths, closed forms, and confinement.
///
/// References: an independent program written from the published equations and OpenSees 3.7.1 (openseespy), which agree
/// to 2e-13 of the largest stress with 4,000 steps per segment.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/materials/all.hpp>
#include <pounding/materials/mander.hpp>
#include "support/messages.hpp"

namespace pounding::materials {
namespace published_values_test {

template <Material M>
M from_names(const std::map<std::string, double, std::less<>>& values) {
  return std::get<M>(make_material({.law = std::string(M::name), .values = values}));
}
Concrete01 concrete01() {
  return from_names<Concrete01>({{"fpc", -30e6}, {"epsc0", -0.002}, {"fpcu", -6e6}, {"epsU", -0.006}});
}
Concrete02 concrete02() {
  return from_names<Concrete02>({{"fpc", -30e6},
                                 {"epsc0", -0.002},
                                 {"fpcu", -6e6},
                                 {"epsU", -0.006},
                                 {"lambda", 0.1},
                                 {"ft", 2.5e6},
                                 {"Ets", 1.5e9}});
}

/// Stresses at the ends of straight segments, each in one step and in `parts` steps.
template <Material M>
void expect_loop(const M& law, const std::vector<double>& strains, const std::vector<double>& stresses) {
  law.check();
  double largest = 0;
  for (const double stress : stresses) largest = std::max(largest, std::abs(stress));
  for (const int parts : {1, 7}) {
    typename M::State kept;
    for (std::size_t i = 0; i < strains.size(); ++i) {
      const double begin = kept.deformation;
      for (int part = 1; part < parts; ++part) kept = law.advance(kept, begin + part * (strains[i] - begin) / parts);
      kept = law.advance(kept, strains[i]);
      EXPECT_NEAR(law.respond(kept, strains[i]).force, stresses[i], 1e-12 * largest)
          << M::name << " in " << parts << " parts, at point " << i;
    }
  }
}

const std::vector<double> steel_path{0.004, 0.001, 0.0035, -0.006, -0.002, -0.005,
                                     0.012, 0.008, 0.0101, -0.01,  0.02,   0.0};
const std::vector<double> concrete_path{-0.001, -0.0004, -0.0018, -0.0006, 0.0001,  -0.003, -0.0015, -0.0022,
                                        0.0,    0.0004,  -0.005,  -0.002,  -0.0045, -0.009, -0.004};

TEST(PublishedLoops, Steel01) {
  expect_loop(from_names<Steel01>({{"Fy", 460e6}, {"E0", 200e9}, {"b", 0.01}}), steel_path,
              {463400000.0, -136600000.00000003, 363400000.0, -467400000.0, 332600000.0, -267400000.0, 479400000.0,
               -320600000.0, 99399999.99999987, -475400000.0, 495400000.0, -455400000.0});
}

TEST(PublishedLoops, Steel02) {
  const auto law = from_names<Steel02>({{"Fy", 460e6}, {"E", 200e9}, {"b", 0.01}});
  expect_loop(law, steel_path,
              {463399644.6008656, -120133460.96455097, 377559599.4995234, -463898096.5813836, 190040401.69921684,
               -378051911.71891344, 473041787.0092268, -126995082.32765257, 286786292.8902834, -463771977.8969118,
               481243320.37395865, -419213979.13789576});
}

TEST(PublishedLoops, Steel02WithIsotropicHardening) {
  const auto law = from_names<Steel02>(
      {{"Fy", 460e6}, {"E", 200e9}, {"b", 0.01}, {"R0", 18}, {"a1", 0.05}, {"a2", 1}, {"a3", 0.05}, {"a4", 1}});
  expect_loop(law, steel_path,
              {463398805.6519492, -119780674.37846833, 378853673.45048714, -491299252.10586834, 168021609.29141986,
               -404460408.53879344, 509952591.08525646, -96357142.94658458, 319527361.56747967, -518523531.59517163,
               544138041.8567042, -481228766.2252121});
}

TEST(PublishedLoops, Concrete01) {
  expect_loop(concrete01(), concrete_path,
              {-22500000.0, -5572100.313479625, -29700000.0, -2925152.129817444, 0.0, -24000000.0, -5609195.40229885,
               -14191570.881226053, 0.0, 0.0, -12000000.0, 0.0, -9714285.71428571, -6000000.0, -930719.8377830352});
}

TEST(PublishedLoops, Concrete02) {
  const Concrete02 law = concrete02();
  expect_loop(law, concrete_path,
              {-22500000.0, -4500000.0, -29700000.0, -3346039.603960395, 2098547.637490317, -24000000.0,
               -3870967.7419354836, -15329032.258064516, 1446428.5714285714, 846428.5714285711, -12000000.0,
               300570.70386810426, -9673469.3877551, -6000000.0, 0.0});
}

TEST(PublishedLoops, Concrete04WithoutTension) {
  const auto law = from_names<Concrete04>({{"fc", -30e6}, {"epsc", -0.002}, {"epscu", -0.01}, {"Ec", 26e9}});
  expect_loop(law, concrete_path,
              {-22757365.71307805, -7157365.713078051, -29777194.545023873, -2932755.0182951163, 0.0,
               -26784530.130047914, -6259985.969091658, -15838106.577537911, 0.0, 0.0, -17577823.096745845, 0.0,
               -14229666.3164133, -8777162.692650136, 0.0});
}

// OpenSees 3.7.1 alone, with 1 and 400 steps per segment.
TEST(PublishedLoops, Concrete04WithTension) {
  const auto law = from_names<Concrete04>(
      {{"fc", -30e6}, {"epsc", -0.002}, {"epscu", -0.01}, {"Ec", 26e9}, {"ft", 2.5e6}, {"et", 0.001}, {"beta", 0.1}});
  expect_loop(
      law, {5e-5, 2e-4, 1e-4, 3e-4, -0.0015, -5e-4, 1e-4, 5e-4, -0.003, -0.001, 2e-4, 6e-4, 1.2e-3, -1e-3, -6e-3, 1e-4},
      {1300000.0, 1918873.7052003243, 959436.8526001622, 1487332.5886308951, -28435436.030329086, -3533028.9977475125,
       495777.52954363194, 893576.0045552626, -26784530.130047914, 0.0, 357430.40182210517, 692617.0849033983, 0.0, 0.0,
       -14389715.924687196, 0.0});
}

// The nested memory is that of the law of springs, whose loop is verified there.
TEST(PublishedLoops, MenegottoPintoEqualsTheLawOfSprings) {
  const auto law = from_names<MenegottoPinto>({{"Fy", 460e6}, {"E", 200e9}, {"b", 0.01}});
  const hysteresis::MenegottoPinto spring{.initial_stiffness = 200e9, .yield_force = 460e6, .hardening = 0.01};
  MenegottoPinto::State kept;
  for (const double strain : steel_path) {
    EXPECT_EQ(law.respond(kept, strain).force, spring.respond(kept, strain).force);
    kept = law.advance(kept, strain);
  }
}

TEST(ClosedForms, AnElasticMaterialWithoutTensionOpens) {
  const auto law = from_names<ElasticNoTension>({{"E", 25e9}});
  const ElasticNoTension::State closed{-1e-3}, open{2e-3};
  EXPECT_EQ(law.respond(closed, 2e-3).force, 0);
  EXPECT_EQ(law.respond(open, -1e-3).force, -25e6);
  EXPECT_EQ(*law.corner(open, -1e-3), 0);
  EXPECT_DOUBLE_EQ(law.work(closed, 1e-3), -12500);
  EXPECT_DOUBLE_EQ(law.stored(closed), 12500);
}

// Area below the parabola and the line, less the triangle of unloading.
TEST(ClosedForms, CrushedConcreteLosesTheAreaBelowItsEnvelope) {
  const Concrete01 law = concrete01();
  const double area = 2.0 / 3 * 30e6 * 0.002 + 0.5 * (30e6 + 6e6) * 0.004;
  const double end = -0.002 * (0.707 * (3 - 2) + 0.834), triangle = 0.5 * 6e6 * (0.006 + end);
  EXPECT_NEAR(law.work(Concrete01::State{}, -0.006), area, 1e-9);
  EXPECT_NEAR(law.stored(law.advance({}, -0.006)), triangle, 1e-9);
  EXPECT_NEAR(hysteresis::lost(law, {}, -0.006), area - triangle, 1e-9);
}

// Cracking energy: elastic triangle and softening triangle.
TEST(ClosedForms, CrackedConcreteLosesItsFractureEnergy) {
  const Concrete02 law = concrete02();
  const double energy = 0.5 * 2.5e6 * (2.5e6 / 30e9 + 2.5e6 / 1.5e9);
  EXPECT_NEAR(hysteresis::lost(law, {}, 0.01), energy, 1e-12 * energy);
  EXPECT_EQ(*law.corner(Concrete02::State{}, 0.01), 2.5e6 / 30e9);
}

// Equation 29 of Mander, Priestley & Park 1988; its coefficients and those of the surface have six digits.
TEST(Confinement, EqualPressuresFollowTheClosedForm) {
  for (const double x : {0.0, 0.02, 0.05, 0.1, 0.2, 0.3})
    EXPECT_NEAR(confined_strength_ratio(x, x), -1.254 + 2.254 * std::sqrt(1 + 7.94 * x) - 2 * x, 1e-4) << x;
  for (const double x : {0.05, 0.1, 0.2}) {
    EXPECT_EQ(confined_strength_ratio(x, 0.03), confined_strength_ratio(0.03, x));
    EXPECT_GT(confined_strength_ratio(x, 0.03), confined_strength_ratio(0.03, 0.03));
    EXPECT_LT(confined_strength_ratio(x, 0.03), confined_strength_ratio(x, x));
  }
}

// By hand: square core of 360 mm, eight bars of 20 mm held at 150 mm centres, four legs of 10 mm at 100 mm, 30 MPa.
TEST(Confinement, ASquareCoreByHand) {
  const ConfinedCore core{.strength = 30e6,
                          .strain = 0.002,
                          .width = 0.36,
                          .depth = 0.36,
                          .bars = 8 * 314.159e-6,
                          .hoops_across_width = 4 * 78.5398e-6,
                          .hoops_across_depth = 4 * 78.5398e-6,
                          .spacing = 0.1,
                          .clear_spacing = 0.09,
                          .hoop_strength = 420e6,
                          .hoop_strain = 0.1};
  const Confinement result = confine(core, std::vector<double>(8, 0.13));
  // Ineffective area 8 x 0.13^2/6 = 0.022533 m^2: ke = (1 - 0.173868) x 0.875^2/(1 - 0.0193925) = 0.645016.
  EXPECT_NEAR(result.effectiveness, 0.645016, 1e-6);
  // rho_x = 314.159/(100 x 360) = 0.00872664; fl = 0.645016 x 0.00872664 x 420 = 2.36410 MPa.
  EXPECT_NEAR(result.pressure_in_width, 2.36410e6, 20);
  EXPECT_EQ(result.pressure_in_width, result.pressure_in_depth);
  // x = 0.0788034: fcc = 30 (-1.254 + 2.254 sqrt(1.625699) - 0.1576068) = 43.8694 MPa.
  EXPECT_NEAR(result.strength, 43.8694e6, 3e3);
  // ecc = 0.002 (1 + 5 x 0.462313) = 0.00662313; ecu = 0.004 + 1.4 x 0.0174533 x 420 x 0.1/43.8694 = 0.0273934.
  EXPECT_NEAR(result.strain, 0.00662313, 1e-6);
  EXPECT_NEAR(result.ultimate_strain, 0.0273934, 2e-6);
}

TEST(Confinement, InvalidCoresAreRejected) {
  ConfinedCore core{.strength = 30e6, .width = 0.3, .depth = 0.3, .spacing = 0.1, .hoop_strength = 420e6};
  EXPECT_TRUE(test::mentions(test::refusal([&] { confine(core, {}); }), {"hoops_across_width", "0"}));
  core.hoops_across_width = core.hoops_across_depth = 1e-4;
  core.bars = 1;
  EXPECT_TRUE(test::mentions(test::refusal([&] { confine(core, {}); }), {"bars", "1"}));
}

std::string refusal(const Settings& settings) {
  return test::refusal([&] { make_material(settings); });
}

TEST(ByName, EveryMaterialIsThere) {
  std::string names;
  for (const Entry& entry : catalogue()) names += std::string(entry.name) + " ";
  EXPECT_EQ(names, "elastic elastic_no_tension concrete01 concrete02 concrete04 steel01 menegotto_pinto steel02 ");
}

TEST(ByName, MessagesContainTheNearestName) {
  EXPECT_TRUE(test::mentions(refusal({.law = "concrete2"}), {"concrete2", "concrete02", "material"}));
  EXPECT_TRUE(test::mentions(refusal({.law = "steel01", .values = {{"fy", 1}}}), {"steel01", "fy", "Fy"}));
  EXPECT_TRUE(test::mentions(refusal({.law = "steel01", .values = {{"Fy", 1}, {"E0", 1}}}), {"steel01", "b"}));
  EXPECT_TRUE(test::mentions(
      refusal({.law = "concrete01", .values = {{"fpc", 30e6}, {"epsc0", 0.002}, {"fpcu", 6e6}, {"epsU", 0.006}}}),
      {"fpc", "negative"}));
}

}  // namespace published_values_test
}  // namespace pounding::materials
