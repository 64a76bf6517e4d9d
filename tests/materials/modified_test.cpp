/// Materials that rupture or begin with a strain: closed forms, the contract of materials, and OpenSees.

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/materials/all.hpp>
#include "support/law_contract.hpp"
#include "support/messages.hpp"

namespace pounding::materials {
namespace modified_test {

using AnyModified = Modified<NamedMaterial>;

Steel01 steel() {
  Steel01 law;
  law.Fy = 460e6, law.E0 = 200e9, law.b = 0.01;
  return law;
}
AnyModified modified(const NamedMaterial& base) {
  AnyModified law;
  law.base = base;
  return law;
}

static_assert(Material<AnyModified>);

template <class M>
struct EveryBase : testing::Test {
  M base = std::get<M>(make_material(hysteresis::typical_settings(find_material(M::name))));
  double dy = std::min(base.yield_deformation(), 0.002);
};
TYPED_TEST_SUITE(EveryBase, test::TypesOf<NamedMaterial>::type, test::LawName);

TYPED_TEST(EveryBase, IsTheMaterialWithoutModifications) {
  const AnyModified law = modified(this->base);
  EXPECT_EQ(law.forgets_small_reversals(), TypeParam::forgets_small_reversals);
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const std::vector<double> path = test::random_path(random, this->dy);
    const auto kept = test::follow(law, path);
    const auto expected = test::follow(this->base, path);
    const double next = this->dy * (i % 7 - 3);
    EXPECT_EQ(law.respond(kept, next).force, this->base.respond(expected, next).force);
    EXPECT_EQ(law.work(kept, next), this->base.work(expected, next));
    EXPECT_EQ(law.stored(kept), this->base.stored(expected));
    EXPECT_EQ(law.corner(kept, next), this->base.corner(expected, next));
  }
}

// Half of the random paths rupture, some by fatigue.
TYPED_TEST(EveryBase, KeepsItsContract) {
  AnyModified law = modified(this->base);
  law.initial_strain = -0.3 * this->dy;
  law.min = -6 * this->dy, law.max = 5 * this->dy;
  law.fatigue = Fatigue{.E0 = 12 * this->dy};
  law.check();
  const auto still = law.advance({}, 0);
  EXPECT_EQ(law.respond(still, this->dy).force, law.respond({}, this->dy).force);
  test::expect_slope_is_the_derivative(law, this->dy, 2000);
  test::expect_subdivision_is_irrelevant(law, this->dy);
  std::mt19937 random(2);
  int ruptured = 0;
  for (int i = 0; i < 1000; ++i) ruptured += test::follow(law, test::random_path(random, this->dy)).is_ruptured;
  EXPECT_GT(ruptured, 300);
  EXPECT_LT(ruptured, 900);
}

TYPED_TEST(EveryBase, LosesTheStoredEnergyAtRupture) {
  AnyModified law = modified(this->base);
  law.min = -0.75 * this->dy;
  const auto kept = law.advance({}, *law.min);
  EXPECT_FALSE(kept.is_ruptured);
  EXPECT_EQ(law.corner({}, -this->dy), law.min);
  EXPECT_EQ(law.respond(kept, -this->dy).force, 0);
  EXPECT_NEAR(hysteresis::lost(law, kept, -this->dy), law.stored(kept), 1e-12 * law.stored(kept));
  const auto broken = law.advance({}, -this->dy);
  EXPECT_TRUE(broken.is_ruptured);
  EXPECT_EQ(law.stored(broken), 0);
  EXPECT_EQ(law.work(broken, this->dy), 0);
  EXPECT_EQ(law.respond(broken, -0.1 * this->dy).force, 0);
}

// Reference: OpenSees 3.7.1, MinMax of InitStrain of Steel01 with 2,000 steps per segment.
TEST(Modified, AgreesWithOpenSees) {
  const std::vector<double> path{0.004, 0.001, 0.0035, -0.006, -0.002, -0.005, 0.012, 0.008, 0.0101, -0.01, 0.02, 0.0};
  const auto expect = [&](const AnyModified& law, const std::vector<double>& stresses) {
    AnyModified::State kept;
    for (std::size_t i = 0; i < path.size(); ++i) {
      EXPECT_NEAR(law.respond(kept, path[i]).force, stresses[i], 1e-4) << "point " << i;
      kept = law.advance(law.advance(kept, 0.4 * kept.deformation + 0.6 * path[i]), path[i]);
    }
  };
  AnyModified law = modified(steel());
  law.initial_strain = 0.001;
  expect(law, {465.4e6, -134.6e6, 365.4e6, -465.4e6, 334.6e6, -265.4e6, 481.4e6, -318.6e6, 101.4e6, -473.4e6, 497.4e6,
               -453.4e6});
  law.min = -0.0065, law.max = 0.011;
  expect(law, {465.4e6, -134.6e6, 365.4e6, -465.4e6, 334.6e6, -265.4e6, 0, 0, 0, 0, 0, 0});
}

// ASTM E1049-85, figure 6: ranges 3, 4, 6, 8, 9 with 0.5, 1.5, 0.5, 1, 0.5 cycles. Damage is the range here.
TEST(Rainflow, CountsTheCyclesOfTheStandard) {
  const Fatigue law{.E0 = 1, .m = -1};
  Rainflow cycles;
  cycles.turns[0] = -2;
  for (const double turn : {1, -3, 5, -1, 3, -4, 4}) cycles.add(law, turn);
  EXPECT_NEAR(cycles.damage_at(law, -2), 0.5 * 3 + 1.5 * 4 + 0.5 * 6 + 8 + 0.5 * 9, 1e-12);
}

TEST(Rainflow, IsBoundedForRangesThatShrink) {
  const Fatigue law{.E0 = 1, .m = -1};
  Rainflow cycles;
  double range = 1, sum = 0;
  for (int i = 0; i < 60; ++i, range *= 0.9) {
    cycles.add(law, i % 2 ? -range : range);
    sum += 0.5 * (i == 0 ? 1 : range + range / 0.9);
  }
  EXPECT_LE(cycles.count, Rainflow::depth);
  EXPECT_NEAR(cycles.damage_at(law, cycles.turns[cycles.count - 1]), sum, 0.3 * sum);
}

// The first range is a, all others 2a, each half a cycle. OpenSees 3.7.1 fails at the same stress reversals.
TEST(Modified, FatigueFollowsCoffinMansonAndMiner) {
  for (const auto& [amplitude, ruptures_at] : {std::pair(0.03, 26), {0.05, 8}, {0.02, 62}}) {
    AnyModified law = modified(steel());
    law.fatigue = Fatigue{};
    const double first = 0.5 * std::pow(amplitude / 0.191, 1 / 0.458),
                 half = 0.5 * std::pow(2 * amplitude / 0.191, 1 / 0.458);
    AnyModified::State kept;
    int turn = 0;
    for (; turn < 100; ++turn) {
      const auto next = law.advance(kept, turn % 2 ? -amplitude : amplitude);
      if (next.is_ruptured) break;
      kept = next;
      EXPECT_NEAR(law.damage(kept), first + turn * half, 1e-12);
    }
    EXPECT_EQ(turn, ruptures_at) << amplitude;
    EXPECT_GT(law.damage(kept) + half, 1);
  }
}

// In tension at the strain at which the open range makes the damage 1; in compression at the next zero of the stress.
TEST(Modified, FatigueRupturesInTension) {
  AnyModified law = modified(steel());
  law.fatigue = Fatigue{.E0 = 0.02, .m = -0.5};
  const double at = 0.02 * std::sqrt(2);
  EXPECT_NEAR(*law.corner(law.advance({}, 0.01), 0.1), at, 1e-12);
  EXPECT_GT(law.respond({}, at - 1e-9).force, 460e6);
  EXPECT_EQ(law.respond({}, at + 1e-9).force, 0);
  const auto pushed = law.advance({}, -0.03);
  EXPECT_FALSE(pushed.is_ruptured);
  const double stress = law.respond({}, -0.03).force;
  EXPECT_NEAR(*law.corner(pushed, 0.1), -0.03 - stress / 200e9, 1e-12);
  EXPECT_EQ(law.respond(pushed, -0.02).force, 0);
}

TEST(Modified, InvalidValuesAreRejected) {
  const auto refused = [](const AnyModified& law, const test::Facts& facts) {
    const std::string text = test::refusal([&] { law.check(); });
    EXPECT_TRUE(test::mentions(text, facts)) << text;
  };
  AnyModified law = modified(steel());
  law.min = 0.01;
  refused(law, {"min is 0.01", "negative"});
  law = modified(steel()), law.max = -0.01;
  refused(law, {"max is -0.01", "positive"});
  law = modified(steel()), law.fatigue = Fatigue{.E0 = -1};
  refused(law, {"E0", "-1"});
  law = modified(steel()), law.fatigue = Fatigue{.m = 0.458};
  refused(law, {"m is 0.458", "negative"});
  law = modified(Steel01{});
  refused(law, {"Fy"});
}

}  // namespace modified_test
}  // namespace pounding::materials
