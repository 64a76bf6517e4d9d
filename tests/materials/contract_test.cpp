/// The contract of every material: typed tests over the list of materials, with the typical values of their parameter
/// tables.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/materials/all.hpp>
#include "support/law_contract.hpp"

namespace pounding::materials {
namespace contract_test {

using test::random_path;

template <class M>
struct MaterialContract : testing::Test {
  using State = typename M::State;
  M law = std::get<M>(make_material(hysteresis::typical_settings(find_material(M::name))));
  /// Scale of strains; elastic laws have none.
  double dy = std::min(law.yield_deformation(), 0.002);
  double fy = law.stiffness() * dy;
  State fresh{};

  State follow(const std::vector<double>& path) const { return test::follow(law, path); }
};

TYPED_TEST_SUITE(MaterialContract, test::TypesOf<NamedMaterial>::type, test::LawName);

TYPED_TEST(MaterialContract, IsAMaterial) { static_assert(Material<TypeParam>); }

TYPED_TEST(MaterialContract, IsElasticAtFirst) {
  const double strain = -1e-9 * this->dy;
  const Answer answer = this->law.respond(this->fresh, strain);
  EXPECT_NEAR(answer.force, this->law.stiffness() * strain, 1e-15 * this->fy);
  EXPECT_NEAR(answer.slope, this->law.stiffness(), 1e-6 * this->law.stiffness());
  EXPECT_EQ(this->law.respond(this->fresh, 0).force, 0);
  EXPECT_EQ(this->law.stored(this->fresh), 0);
}

TYPED_TEST(MaterialContract, AnAcceptedStrainAgainChangesNothing) {
  std::mt19937 random(10);
  for (int i = 0; i < 200; ++i) {
    const auto kept = i == 0 ? typename TypeParam::State{} : this->follow(random_path(random, this->dy));
    const auto still = this->law.advance(kept, kept.deformation);
    EXPECT_EQ(this->law.work(kept, kept.deformation), 0);
    for (const double strain : random_path(random, this->dy))
      EXPECT_NEAR(this->law.respond(still, strain).force, this->law.respond(kept, strain).force, 1e-15 * this->fy);
  }
}

TYPED_TEST(MaterialContract, TheSlopeIsTheDerivative) {
  test::expect_slope_is_the_derivative(this->law, this->dy, 10000);
}

TYPED_TEST(MaterialContract, AMonotonicPathMayBeSubdivided) {
  test::expect_subdivision_is_irrelevant(this->law, this->dy);
}

TYPED_TEST(MaterialContract, WorkIsTheIntegralOfTheStress) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> reach(-6, 6);
  for (int i = 0; i < 200; ++i) {
    const auto kept = this->follow(random_path(random, this->dy));
    const double strain = reach(random) * this->dy, unit = this->fy * this->dy;
    constexpr int n = 4000;
    const double h = (strain - kept.deformation) / n;
    double sum = 0;  // midpoint rule; corners and jumps may lie between its points
    for (int j = 0; j < n; ++j) sum += h * this->law.respond(kept, kept.deformation + (j + 0.5) * h).force;
    EXPECT_NEAR(this->law.work(kept, strain), sum, 1e-3 * unit) << "from " << kept.deformation << " to " << strain;
    const double middle = kept.deformation + 0.37 * (strain - kept.deformation);
    EXPECT_NEAR(this->law.work(kept, middle) + this->law.work(this->law.advance(kept, middle), strain),
                this->law.work(kept, strain), 1e-11 * unit);
  }
}

TYPED_TEST(MaterialContract, EnergyIsOnlyLost) { test::expect_energy_is_only_lost(this->law, this->dy); }

TYPED_TEST(MaterialContract, ACycleThatRepeatsGivesNoEnergy) {
  if (!TypeParam::forgets_small_reversals) GTEST_SKIP() << "repeated cycles drift; EnergyIsOnlyLost bounds the sum";
  test::expect_repeated_cycles_give_no_energy(this->law, this->dy);
}

TYPED_TEST(MaterialContract, UnloadingReturnsTheStoredEnergyDownToZeroStress) {
  if constexpr (requires(const TypeParam& law, const typename TypeParam::State& kept) { law.unloaded(kept); }) {
    std::mt19937 random(21);
    for (int i = 0; i < 1000; ++i) {
      const auto kept = this->follow(random_path(random, this->dy));
      const auto unloaded = this->law.advance(kept, this->law.unloaded(kept));
      ASSERT_NEAR(this->law.respond(unloaded, unloaded.deformation).force, 0, 1e-12 * this->fy);
      ASSERT_NEAR(this->law.stored(unloaded), 0, 1e-15 * this->fy * this->dy);
    }
  } else {
    GTEST_SKIP() << "the law of springs has this test";
  }
}

TYPED_TEST(MaterialContract, SlopesJumpAtCornersOnly) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> reach(-6, 6);
  for (int i = 0; i < 1000; ++i) {
    const auto kept = this->follow(random_path(random, this->dy));
    const double strain = reach(random) * this->dy, h = (strain < kept.deformation ? -1e-7 : 1e-7) * this->dy;
    const auto slope = [&](double x) { return this->law.respond(kept, x).slope / this->law.stiffness(); };
    const std::optional<double> corner = this->law.corner(kept, strain);
    if (corner) {
      ASSERT_TRUE(hysteresis::has_corners<TypeParam>);
      ASSERT_TRUE(hysteresis::is_strictly_between(*corner, kept.deformation, strain));
    }
    const double end = corner ? *corner - h : strain;
    if (!hysteresis::is_strictly_between(end - 2 * h, kept.deformation, strain)) continue;
    // Before it, a change of slope shrinks with the length of the path.
    for (int j = 0; j < 20; ++j) {
      double from = kept.deformation + h + j / 20.0 * (end - h - kept.deformation),
             to = from + (end - h - kept.deformation) / 20;
      for (int half = 0; half < 26; ++half) {
        const double middle = 0.5 * (from + to);
        (std::abs(slope(middle) - slope(from)) > std::abs(slope(to) - slope(middle)) ? to : from) = middle;
      }
      ASSERT_NEAR(slope(to), slope(from), 1e-3) << "path " << i << " at " << to;
    }
  }
}

TYPED_TEST(MaterialContract, TheEnvelopeIsNotExceeded) {
  std::mt19937 random(18);
  if (find_material(TypeParam::name).is_symmetric) GTEST_SKIP() << "for concrete";
  for (int i = 0; i < 2000; ++i) {
    const std::vector<double> path = random_path(random, this->dy);
    const auto kept = this->follow(path);
    for (const double strain : path)
      if (strain < 0) {
        ASSERT_GE(this->law.respond(kept, strain).force,
                  this->law.respond(this->fresh, strain).force - 1e-12 * this->fy);
      }
  }
}

TYPED_TEST(MaterialContract, TheMirroredPathHasTheMirroredStress) {
  if (!find_material(TypeParam::name).is_symmetric) GTEST_SKIP() << "not symmetric";
  std::mt19937 random(13);
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> path = random_path(random, this->dy);
    const auto kept = this->follow(path);
    for (double& strain : path) strain = -strain;
    const auto mirrored = this->follow(path);
    EXPECT_EQ(this->law.respond(mirrored, mirrored.deformation).force,
              -this->law.respond(kept, kept.deformation).force);
  }
}

TYPED_TEST(MaterialContract, AStateIsItsBytes) {
  std::mt19937 random(19);
  for (int i = 0; i < 10000; ++i) {
    const auto kept = this->follow(random_path(random, this->dy));
    std::array<std::byte, sizeof(kept)> bytes;
    std::memcpy(bytes.data(), &kept, sizeof kept);
    typename TypeParam::State copy;
    std::memcpy(static_cast<void*>(&copy), bytes.data(), sizeof copy);
    for (const double strain : random_path(random, this->dy, 3)) {
      ASSERT_EQ(this->law.respond(copy, strain).force, this->law.respond(kept, strain).force);
      ASSERT_EQ(this->law.respond(copy, strain).slope, this->law.respond(kept, strain).slope);
    }
  }
}

// One reversal of size e within each segment changes later stresses by O(e); Steel02 as published violates this.
TYPED_TEST(MaterialContract, SmallReversalsAreForgotten) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> fraction(0.1, 0.9);
  const double e = 1e-9 * this->dy;
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    typename TypeParam::State smooth, rippled;
    for (const double strain : random_path(random, this->dy)) {
      const double begin = smooth.deformation, length = strain - begin;
      smooth = this->law.advance(smooth, strain);
      if (std::abs(length) > 1e-3 * this->dy) {
        const double turn = begin + fraction(random) * length;
        rippled = this->law.advance(rippled, turn);
        rippled = this->law.advance(rippled, turn - std::copysign(e, length));
      }
      rippled = this->law.advance(rippled, strain);
      largest = std::max(largest,
                         std::abs(this->law.respond(smooth, strain).force - this->law.respond(rippled, strain).force));
    }
  }
  if (TypeParam::forgets_small_reversals)
    EXPECT_LT(largest, 1e-7 * this->fy);
  else
    EXPECT_GT(largest, 0.05 * this->fy);
}

TYPED_TEST(MaterialContract, InvalidParametersAreRejected) {
  const Entry& entry = find_material(TypeParam::name);
  for (const hysteresis::ParameterInfo& p : entry.parameters)
    for (const double wrong : {p.typical == 0 ? -1.0 : -p.typical, std::nan(""), HUGE_VAL}) {
      Settings s = hysteresis::typical_settings(entry);
      s.values.insert_or_assign(std::string(p.name), wrong);
      EXPECT_THROW(make_material(s), std::invalid_argument) << p.name << " = " << wrong;
    }
  for (const hysteresis::ParameterInfo& p : entry.parameters)
    if (p.need == hysteresis::Need::required) {
      Settings s = hysteresis::typical_settings(entry);
      s.values.erase(std::string(p.name));
      EXPECT_THROW(make_material(s), std::invalid_argument) << "without " << p.name;
    }
}

}  // namespace contract_test
}  // namespace pounding::materials
