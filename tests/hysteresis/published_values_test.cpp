/// Closed forms of the hysteretic laws, and loops of independent programs along the same path.

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include <pounding/base/root.hpp>
#include <pounding/hysteresis/all.hpp>
#include "support/messages.hpp"

namespace pounding::hysteresis {
namespace published_values_test {

/// Turning points in yield deformations, and the forces there over the yield force, for a hardening of 0.05.
constexpr std::array path{2.5, -1.2, 0.4, -3.6, -3.1, -3.4, 1.0, 0.2, 4.5, -0.5, 0.7, -6.0, 0.0};
using Forces = std::array<double, path.size()>;

/// Each stretch in `parts`, for a law with k = Fy = 1.
template <Law L>
void expect_loop(const L& law, const Forces& forces, int parts = 3) {
  law.check();
  typename L::State kept;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double begin = kept.deformation;
    EXPECT_NEAR(law.respond(kept, path[i]).force, forces[i], 1e-12) << L::name << " at turn " << i;
    for (int part = 1; part <= parts; ++part) kept = law.advance(kept, begin + part * (path[i] - begin) / parts);
    EXPECT_NEAR(law.respond(kept, path[i]).force, forces[i], 1e-12) << L::name << " in parts, at turn " << i;
  }
}

// Reference: an independent Python program, modes with guards, whose crossings are bisected to the last digit.
TEST(PublishedLoops, BilinearFollowsTheIndependentProgram) {
  expect_loop(Bilinear{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.05},
              {1.075, -1.01, 0.59, -1.13, -0.63, -0.93, 1, 0.2, 1.175, -0.975, 0.225, -1.25, 0.95});
}

TEST(PublishedLoops, MenegottoPintoWithTheMemoryOfSteel02FollowsTheIndependentProgram) {
  expect_loop(
      MenegottoPinto{
          .initial_stiffness = 1, .yield_force = 1, .hardening = 0.05, .memory = MenegottoPinto::Memory::last},
      {1.07499999947773, -0.93273176551411, 0.44619113907322, -1.12999756917766, -0.640755869315557, -0.940754209587081,
       0.89340885120892, 0.127498682996302, 1.17358493603992, -0.829075088243166, 0.229036858308608, -1.24157108510793,
       0.823540208103033});
}

TEST(PublishedLoops, MenegottoPintoWithMemoryFollowsTheIndependentProgram) {
  expect_loop(MenegottoPinto{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.05},
              {1.07499999947773, -0.93273176551411, 0.44619113907322, -1.11313391620431, -0.624146504884993,
               -0.924145884853595, 0.871844925906343, 0.107203456418876, 1.13399707045541, -0.836700652471436,
               0.222780843725099, -1.21429953025512, 0.828121878931848});
}

TEST(PublishedLoops, PeakOrientedFollowsTheIndependentProgram) {
  expect_loop(PeakOriented{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.05},
              {1.075, -1.01, 0.204588362746378, -1.13, -0.866476861652635, -1.02459074466105, 0.667388805349724,
               0.161424379722783, 1.175, -0.505295209607356, 0.0701492282652341, -1.25, 0.464136592131771});
}

// Reference: integration of dz/dd of order eight with tolerances of 1e-13.
TEST(PublishedLoops, BoucWenFollowsItsDifferentialEquation) {
  const auto law = [](double n, double g) {
    return BoucWen{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.05, .exponent = n, .gamma_share = g};
  };
  expect_loop(law(1, 0.5),
              {0.997019251307293, -0.951186172667756, 0.479927816918784, -1.10176403475323, -0.601764034753228,
               -0.747193627642839, 0.9785862289041, 0.178586228904099, 1.16439734113394, -0.957793257874549,
               0.221166659653561, -1.24857748434889, 0.943608528013414});
  expect_loop(law(2, 0.5),
              {1.06228358324387, -1.00168176468078, 0.536088306354532, -1.12811275690688, -0.628112756906883,
               -0.82485495779861, 0.998863841285005, 0.198863841285005, 1.17476624647294, -0.974363148127,
               0.223118515174379, -1.24999572236121, 0.949913744826206});
  expect_loop(law(2, 0.3),
              {1.06228358324387, -1.00324559093904, 0.602174447571269, -1.12795010305666, -0.533331918828087,
               -0.756981142476492, 0.999070243157821, 0.0965192218283347, 1.17470864010797, -0.974487141732601,
               0.319303437991664, -1.24999479875652, 0.949930546095788});
  expect_loop(law(1, 0.2),
              {0.997019251307293, -0.961201867085191, 0.563581221455424, -1.10154391442797, -0.427325372379312,
               -0.617966288164896, 0.982332954017364, -0.0165306666973227, 1.16174787909452, -0.961111516346941,
               0.364429591904146, -1.24839762106428, 0.944851286712025});
  expect_loop(law(3.5, 0.4),
              {1.07403850342482, -1.00958590725513, 0.602341025513651, -1.12995755063124, -0.593207351524573,
               -0.844834212146006, 0.999985506858667, 0.161953140318419, 1.17499899022844, -0.974995608903909,
               0.262707039527781, -1.2499999990804, 0.949999867399233});
}

TEST(ClosedForms, TheSteadyLoopOfTheBilinearLawHasItsArea) {
  for (const double a : {0.0, 0.05, 0.5}) {
    const Bilinear law{.initial_stiffness = 1e7, .yield_force = 1.5e5, .hardening = a};
    const double dy = law.yield_deformation(), top = 4.2 * dy;
    const auto at_top = law.advance(law.advance({}, -top), top);
    const double area = law.work(at_top, -top) + law.work(law.advance(at_top, -top), top);
    EXPECT_NEAR(area, 4 * (1 - a) * law.yield_force * (top - dy), 1e-13 * area);
  }
}

TEST(ClosedForms, TheYieldForcesOfTheTwoDirectionsMayDiffer) {
  const Bilinear law{.initial_stiffness = 1e7, .yield_force = 2e5, .hardening = 0, .negative_yield_force = 1e5};
  EXPECT_EQ(law.yield_deformation(), 0.01);
  EXPECT_NEAR(law.respond({}, 0.05).force, 2e5, 1e-9);
  EXPECT_NEAR(law.respond({}, -0.05).force, -1e5, 1e-9);
  const auto up = law.advance({}, 0.05);
  EXPECT_NEAR(*law.corner(up, -0.05), 0.02, 1e-16);
  const double area = law.work(up, -0.05) + law.work(law.advance(up, -0.05), 0.05);
  EXPECT_NEAR(area, 3e5 * (0.1 - 0.03), 1e-8);
}

TEST(ClosedForms, BoucWenIsATangentOfAHyperbolaOrAnExponentialOnFirstLoading) {
  const BoucWen square{.initial_stiffness = 2e6, .yield_force = 2e4},
      linear{.initial_stiffness = 2e6, .yield_force = 2e4, .exponent = 1};
  for (const double d : {1e-6, 1e-3, 0.01, 0.03, 0.3}) {
    EXPECT_NEAR(square.respond({}, d).force, 2e4 * std::tanh(d / 0.01), 1e-11);
    EXPECT_NEAR(linear.respond({}, d).force, 2e4 * (1 - std::exp(-d / 0.01)), 1e-11);
  }
}

// Force cycles between 0.2 and 0.8 Fy: the integral of 1/(1 - z^n) - 1 over this range, log 4 - 0.6 for n = 1.
// Integrals for exponents other than 1 and 2 are limited by round-off, 1e-12 on paths of up to 10 dy.
TEST(ClosedForms, BoucWenOfAnyExponentFollowsShortAndLongWays) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  for (const double exponent : {1.2, 1.5, 3.0, 5.0})
    for (const double share : {0.5, 0.3}) {
      const BoucWen law{.initial_stiffness = 1, .yield_force = 1, .exponent = exponent, .gamma_share = share};
      BoucWen::State state;
      for (int i = 0; i < 500; ++i) {
        const double way = std::pow(10, -12 + 13 * part(random)) * (part(random) < 0.5 ? -1 : 1);
        const double cut = state.deformation + part(random) * way, end = state.deformation + way;
        const BoucWen::State once = law.advance(state, end), twice = law.advance(law.advance(state, cut), end);
        ASSERT_NEAR(once.elastic, twice.elastic, 1e-12) << exponent << " " << share << " " << way;
        ASSERT_TRUE(std::isfinite(law.work(state, end)));
        state = once;
      }
    }
}

TEST(ClosedForms, BoucWenDriftsUnderASteadyForce) {
  const double integrals[] = {std::log(4.0) - 0.6, std::atanh(0.8) - std::atanh(0.2) - 0.6, 0.0538483311596376};
  const double exponents[] = {1, 2, 5};
  for (int i = 0; i < 3; ++i) {
    const BoucWen law{.initial_stiffness = 1, .yield_force = 1, .exponent = exponents[i]};
    const auto to_force = [&law](const BoucWen::State& kept, double force, double reach) {
      const auto miss = [&](double d) { return law.respond(kept, d).force - force; };
      const double end = kept.deformation + reach;
      return law.advance(kept, find_root(miss, kept.deformation, miss(kept.deformation), end, miss(end)));
    };
    BoucWen::State kept = to_force({}, 0.8, 10);
    for (int cycle = 0; cycle < 3; ++cycle) {
      const double before = kept.deformation;
      kept = to_force(to_force(kept, 0.2, -10), 0.8, 10);
      EXPECT_NEAR(kept.deformation - before, integrals[i], 2e-12) << "n = " << exponents[i];
    }
  }
}

// Stress over that of the same path without the small reversal. Reference: another program with steps of 0.001 dy and
// linear interpolation between them.
TEST(PublishedLoops, ASmallTurnLiftsTheForceOfSteel02AndNotThatOfNestedMemory) {
  const double at[] = {-1, 0, 2}, without[] = {0.6469689626087252, 0.7780149802262432, 0.9048491046378144};
  const double lifted[3][3] = {{0.22285351233738027, 0.1939113763178223, 0.10170073798729562},
                               {0.20027835592100107, 0.18579371443314785, 0.09979013830641548},
                               {0.08733676589465078, 0.12802708459952983, 0.08229655721860774}};
  const double back[] = {0.02, 0.1, 0.5};
  MenegottoPinto law{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.01};
  for (const MenegottoPinto::Memory memory : {MenegottoPinto::Memory::nested, MenegottoPinto::Memory::last}) {
    law.memory = memory;
    MenegottoPinto::State kept;
    for (const double d : {4.0, -4.0, -1.5}) kept = law.advance(kept, d);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(law.respond(kept, at[j]).force, without[j], 1e-12);
    for (int i = 0; i < 3; ++i) {
      const MenegottoPinto::State turned = law.advance(kept, -1.5 - back[i]);
      for (int j = 0; j < 3; ++j) {
        const double force = law.respond(turned, at[j]).force;
        if (memory == MenegottoPinto::Memory::last)
          EXPECT_NEAR(force - without[j], lifted[i][j], 1e-9) << back[i] << " back, at " << at[j];
        else
          EXPECT_NEAR(force, without[j], 2e-13) << back[i] << " back, at " << at[j];
      }
    }
  }
}

// The force jumps at an infinitesimal reversal, so the later response is not a continuous function of the path.
TEST(PublishedLoops, ATurnOfNoSizeLiftsTheForceOfSteel02) {
  MenegottoPinto law{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.05};
  for (const MenegottoPinto::Memory memory : {MenegottoPinto::Memory::nested, MenegottoPinto::Memory::last}) {
    law.memory = memory;
    MenegottoPinto::State kept;
    for (const double d : {4.0, -4.0, -2.25}) kept = law.advance(kept, d);
    for (const double size : {1e-3, 1e-6, 1e-9}) {
      const double lift = law.respond(law.advance(kept, -2.25 - size), -1.35).force - law.respond(kept, -1.35).force;
      EXPECT_NEAR(lift, memory == MenegottoPinto::Memory::last ? 0.2535 : 0.0, size < 1e-5 ? 1e-4 : 1e-3) << size;
    }
  }
}

// A hundred small nested loops, entered and left again: more than the law remembers.
TEST(PublishedLoops, MoreTurnsThanAreRememberedForgetTheSmallestOnes) {
  const MenegottoPinto law{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.01};
  MenegottoPinto::State kept = law.advance(law.advance(law.advance({}, 4), -4), -1.5);
  const MenegottoPinto::State before = kept;
  for (int i = 0; i < 100; ++i) {
    kept = law.advance(kept, -1.5 - 0.3 * std::pow(0.97, i));
    kept = law.advance(kept, -1.5 - 0.01 * std::pow(0.97, i));
    ASSERT_LE(kept.up.count, MenegottoPinto::max_branches);
    ASSERT_LE(kept.down.count, MenegottoPinto::max_branches);
  }
  for (const double d : {-1.0, 0.0, 2.0, 3.9})
    EXPECT_NEAR(law.respond(kept, d).force, law.respond(before, d).force, 2e-13);
}

TEST(ClosedForms, WorkOfMenegottoPintoIsTheIntegralOfItsForce) {
  for (const double R0 : {20.0, 10.0, 4.0, 1.05})
    for (const double c1 : {0.0, 0.925, 0.5}) {
      MenegottoPinto law{.initial_stiffness = 1, .yield_force = 1, .hardening = 0.02, .sharpness = R0, .rounding = c1};
      if (R0 * (1 - c1) < 1) continue;
      MenegottoPinto::State kept;
      for (const double d : {0.9, 0.2, 3.0, -2.5, 1.4, -8.0}) {
        const auto force = [&](double x) { return law.respond(kept, x).force; };
        // Between corners the force is smooth, with a sharp knee.
        double sum = 0, begin = kept.deformation;
        for (int part = 1; part <= 64; ++part) {
          const double end = kept.deformation + part * (d - kept.deformation) / 64;
          sum += integral(force, begin, end, 1e-15);
          begin = end;
        }
        EXPECT_NEAR(law.work(kept, d), sum, 2e-12) << "R0 " << R0 << ", c1 " << c1 << ", to " << d;
        kept = law.advance(kept, d);
      }
    }
}

TEST(ClosedForms, TheHyperbolaHasItsSecantsAndKeepsWhatIsPressedIn) {
  const Backfill law{.initial_stiffness = 2.5e8, .unloading = 5e8, .failure_ratio = 0.75, .strength = 6e6, .gap = 0.1};
  law.check();
  EXPECT_EQ(law.respond({}, 0.0999).force, 0);
  // The secant is (1 - Rf) K at the ultimate force and (1 - Rf/2) K at half of it.
  const double ultimate = 6e6 / (0.25 * 2.5e8), half = 3e6 / (0.625 * 2.5e8);
  EXPECT_NEAR(law.respond({}, 0.1 + ultimate).force, 6e6, 1e-6);
  EXPECT_NEAR(law.respond({}, 0.1 + half).force, 3e6, 1e-6);
  EXPECT_NEAR(law.respond({}, 1e9).force, 8e6, 1) << "the asymptote";
  const auto pressed = law.advance({}, 0.1 + ultimate);
  EXPECT_NEAR(law.pressed_in(pressed), ultimate - 6e6 / 5e8, 1e-15);
  EXPECT_NEAR(law.respond(pressed, 0.1 + ultimate - 0.004).force, 6e6 - 0.004 * 5e8, 1e-6);
  EXPECT_EQ(law.respond(pressed, 0.1 + ultimate - 0.0121).force, 0) << "no tension";
  EXPECT_NEAR(*law.corner(pressed, 0), 0.1 + law.pressed_in(pressed), 1e-15);
  // Energy of the hyperbola: K/c [x - log(1 + c x)/c], c = K Rf/Fu.
  const double c = 2.5e8 * 0.75 / 6e6;
  EXPECT_NEAR(law.work({}, 0.1 + ultimate), 2.5e8 / c * (ultimate - std::log1p(c * ultimate) / c),
              1e-9 * 6e6 * ultimate);
}

TEST(ClosedForms, ARestrainerIsSlackThenTautThenYieldsAndKeepsTheYieldedElongation) {
  const Restrainer law{.taut_stiffness = 2e7, .slack = 0.02, .strength = 4e5, .hardening = 0.1};
  law.check();
  EXPECT_EQ(law.respond({}, -0.5).force, 0) << "no compression";
  EXPECT_EQ(law.respond({}, 0.0199).force, 0);
  EXPECT_EQ(*law.corner({}, 0.03), 0.02);
  EXPECT_NEAR(law.respond({}, 0.03).force, 2e5, 1e-6);
  EXPECT_NEAR(law.yield_deformation(), 0.04, 1e-15);
  EXPECT_EQ(law.yield_force(), 4e5);
  EXPECT_NEAR(*law.corner(law.advance({}, 0.03), 0.1), 0.04, 1e-15);
  // Beyond yield by 60 mm with a tenth of the stiffness: 4e5 + 2e6 * 0.06 = 5.2e5 N, of which 26 mm are elastic.
  EXPECT_NEAR(law.respond({}, 0.1).force, 5.2e5, 1e-6);
  const auto yielded = law.advance({}, 0.1);
  EXPECT_NEAR(yielded.yielded, 0.1 - 0.02 - 0.026, 1e-15);
  EXPECT_NEAR(law.respond(yielded, 0.09).force, 5.2e5 - 2e5, 1e-6);
  EXPECT_NEAR(*law.corner(yielded, 0), 0.074, 1e-15) << "slack again";
  const auto slack = law.advance(yielded, -1);
  EXPECT_EQ(law.respond(slack, 0.0739).force, 0);
  EXPECT_NEAR(law.respond(slack, 0.1).force, 5.2e5, 1e-6) << "reloads up to the largest force";
  EXPECT_NEAR(law.respond(slack, 0.11).force, 5.2e5 + 2e4, 1e-6);
  // Triangle up to yield and trapezium beyond, of which the unloading triangle is returned.
  const double work = 0.5 * 4e5 * 0.02 + 0.5 * (4e5 + 5.2e5) * 0.06, returned = 0.5 * 5.2e5 * 0.026;
  EXPECT_NEAR(law.work({}, 0.1), work, 1e-9);
  EXPECT_NEAR(law.stored(yielded), returned, 1e-9);
  EXPECT_NEAR(law.lost({}, 0.1), work - returned, 1e-9);
  const Restrainer elastic{.taut_stiffness = 2e7, .slack = 0.02};
  elastic.check();
  EXPECT_NEAR(elastic.respond({}, 5).force, 2e7 * 4.98, 1e-6);
  EXPECT_TRUE(
      test::mentions(test::refusal([] {
                       make_law({.law = "restrainer", .values = {{"stiffness", 1}, {"slack", 0}, {"hardening", 0.1}}});
                     }),
                     {"hardening", "strength"}));
}

TEST(ClosedForms, ASupportLiftsOffWhenItsPreloadIsExhausted) {
  const Uplift law{.initial_stiffness = 2e8, .preload = 8e5};
  law.check();
  EXPECT_NEAR(law.respond({}, -0.01).force, -2e6, 1e-6) << "more compression";
  EXPECT_NEAR(*law.corner({}, 0.01), 0.004, 1e-18);
  EXPECT_EQ(law.respond({}, 0.01).force, 8e5);
  EXPECT_EQ(law.respond({0.02}, 0.01).slope, 0);
  EXPECT_NEAR(law.work({}, 0.01), 0.5 * 8e5 * 0.004 + 8e5 * 0.006, 1e-9);
  EXPECT_NEAR(law.work({0.01}, 0), -law.work({}, 0.01), 1e-9);
  EXPECT_EQ(law.lost({}, 0.01), 0);
}

TEST(ClosedForms, ATrilinearBackboneGoesThroughItsBreaks) {
  const PeakOriented law{.initial_stiffness = 1e7,
                         .yield_force = 1.5e5,
                         .hardening = 0.02,
                         .unloading = 0.5,
                         .cracking_force = 5e4,
                         .deformation_at_yield = 0.03};
  law.check();
  const double forces[] = {2.5e4, 5e4, 1e5, 1.5e5, 1.5e5 + 2e5 * 0.01}, at[] = {0.0025, 0.005, 0.0175, 0.03, 0.04};
  for (int i = 0; i < 5; ++i)
    for (const int side : {1, -1}) EXPECT_NEAR(law.respond({}, side * at[i]).force, side * forces[i], 1e-8) << at[i];
  EXPECT_EQ(*law.corner({}, 0.04), 0.005);
  EXPECT_EQ(*law.corner(law.advance({}, 0.006), 0.04), 0.03);
  // A cracked section unloads towards the crack of the opposite side, a yielded one with the stiffness of Takeda.
  EXPECT_NEAR(law.respond(law.advance({}, 0.0175), 0.0174).slope, (5e4 + 1e5) / (0.005 + 0.0175), 1e-6);
  EXPECT_NEAR(law.respond(law.advance({}, 0.12), 0.1199).slope, 2e5 / 0.035 * 0.5, 1e-6);
}

std::string refusal(const Settings& settings) {
  return test::refusal([&] { make_law(settings); });
}

TEST(ClosedForms, IsolatorsAreLoopsByTheirOwnWords) {
  FrictionPendulum slider;
  slider.weight = 5e6;
  slider.radius = 2;
  slider.friction = 0.06;
  EXPECT_NEAR(slider.respond({}, 0.2).force, 5e6 * 0.2 / 2 + 0.06 * 5e6, 1e-6);
  EXPECT_NEAR(slider.respond(slider.advance({}, 0.2), 0).force, -0.06 * 5e6, 1e-6);
  const Settings by_modulus{.law = "lead_rubber",
                            .values = {{"strength", 3.75e5},
                                       {"yield_displacement", 0.012},
                                       {"shear_modulus", 4e5},
                                       {"area", 1.75},
                                       {"rubber_thickness", 0.2}}};
  const LeadRubber bearing = std::get<LeadRubber>(make_law(by_modulus));
  EXPECT_NEAR(bearing.respond({}, 0.1).force, 3.75e5 + 3.5e6 * 0.1, 1e-6);
  EXPECT_NEAR(bearing.respond(bearing.advance({}, 0.1), 0).force, -3.75e5, 1e-6);
  const Elastomeric rubber = std::get<Elastomeric>(make_law(typical_settings(find_law("elastomeric"))));
  EXPECT_NEAR(rubber.respond({}, 0.01).force, 3.5e6 * 0.01 + 3.75e5 * std::tanh(0.01 / 0.012), 1e-6);
  EXPECT_TRUE(test::mentions(refusal({.law = "lead_rubber", .values = {{"strength", 1}, {"yield_displacement", 1}}}),
                             {"lead_rubber", "post_yield_stiffness", "shear_modulus", "rubber_thickness"}));
  EXPECT_TRUE(test::mentions(
      refusal({.law = "lead_rubber",
               .values = {{"strength", 1}, {"yield_displacement", 1}, {"post_yield_stiffness", 1}, {"area", 1}}}),
      {"lead_rubber", "post_yield_stiffness", "shear_modulus", "rubber_thickness"}));
}

// Points by hand, on both sides and mirrored.
TEST(MultilinearElastic, FollowsItsPoints) {
  const MultilinearElastic both{.deformation = {-0.03, -0.01, 0, 0.02, 0.05}, .force = {-150, -100, 0, 200, 260}};
  both.check();
  EXPECT_DOUBLE_EQ(both.stiffness(), 1e4);
  EXPECT_EQ(both.yield_deformation(1), 0.02);
  EXPECT_EQ(both.yield_deformation(-1), 0.01);
  for (const auto& [d, f] :
       {std::pair(0.01, 100.0), {0.035, 230.0}, {0.1, 360.0}, {-0.005, -50.0}, {-0.02, -125.0}, {-0.07, -250.0}})
    for (const double from : {-0.06, 0.0, 0.04}) EXPECT_NEAR(both.respond({from}, d).force, f, 1e-12) << d;
  EXPECT_NEAR(both.work({-0.02}, 0.035), 2 + 1.5 * 2.15 - (0.5 + 1.125), 1e-12);
  EXPECT_EQ(both.corner({-0.02}, 0.03), -0.01);
  EXPECT_EQ(both.corner({-0.01}, 0.03), 0.02);
  EXPECT_FALSE(both.corner({0.02}, 0.2)) << "the last slope continues";
  const MultilinearElastic mirrored{.deformation = {0.02, 0.05}, .force = {200, 260}};
  EXPECT_NEAR(mirrored.respond({0.01}, -0.035).force, -230, 1e-12);
  EXPECT_EQ(mirrored.corner({0.03}, -0.03), 0.02);
  const auto refused = [](const MultilinearElastic& law, const test::Facts& facts) {
    EXPECT_TRUE(test::mentions(test::refusal([&] { law.check(); }), facts)) << test::refusal([&] { law.check(); });
  };
  refused({.deformation = {0.01}, .force = {1, 2}}, {"force", "deformation", "2", "1"});
  refused({.deformation = {-0.01, 0.01}, .force = {-1, 2}}, {"100", "200", "origin"});
  refused({.deformation = {0.02, 0.01}, .force = {1, 2}}, {"deformation[2]", "0.01"});
  refused({.deformation = {0.01, 0.02}, .force = {2, 1}}, {"force[2]", "1"});
  refused({.deformation = {-0.01}, .force = {-1}}, {"deformation", "point"});
  refused({.deformation = {0.01}, .force = {1}, .slope_at_0 = 120}, {"stiffness", "120", "100"});
}

TEST(ByName, EveryLawOfTheDesignIsThere) {
  std::string names;
  for (const Entry& entry : catalogue()) names += std::string(entry.name) + " ";
  EXPECT_EQ(
      names,
      "bilinear menegotto_pinto bouc_wen peak_oriented friction_pendulum lead_rubber elastomeric backfill restrainer "
      "uplift multilinear_elastic imk_bilinear imk_peak_oriented imk_pinching bilin mod_imk_peak_oriented "
      "mod_imk_pinching hysteretic pinching4 ");
}

TEST(ByName, WhatIsWrongIsSaidWithWhatToType) {
  EXPECT_TRUE(test::mentions(refusal({.law = "bouc_wenn"}), {"bouc_wenn", "bouc_wen"}));
  EXPECT_TRUE(test::mentions(refusal({.law = "bilinear", .values = {{"stiffness", 1}}}), {"yield_force"}));
  EXPECT_TRUE(test::mentions(refusal({.law = "bilinear", .values = {{"hardenning", 1}}}), {"hardenning", "hardening"}));
  const std::map<std::string, double, std::less<>> steel{{"stiffness", 1}, {"yield_force", 1}};
  EXPECT_EQ(refusal({.law = "menegotto_pinto", .values = steel, .words = {{"memory", "nested"}}}), "taken");
  EXPECT_TRUE(test::mentions(refusal({.law = "menegotto_pinto", .values = steel, .words = {{"memory", "lasst"}}}),
                             {"lasst", "last", "menegotto_pinto"}));
  EXPECT_TRUE(test::mentions(refusal({.law = "bilinear", .values = steel, .words = {{"memory", "last"}}}), {"memory"}));
  EXPECT_TRUE(test::mentions(
      refusal({.law = "bouc_wen", .values = {{"stiffness", 1}, {"yield_force", 1}, {"gamma_share", 0.6}}}),
      {"[0, 0.5]", "gamma_share", "0.6"}));
  EXPECT_TRUE(
      test::mentions(refusal({.law = "menegotto_pinto", .values = {{"stiffness", 1}, {"yield_force", 1}, {"R0", 10}}}),
                     {"R0", "10", "cR1", "13.333333333333341"}));
}

}  // namespace published_values_test
}  // namespace pounding::hysteresis
