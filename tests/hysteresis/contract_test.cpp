/// The contract of every hysteretic law: typed tests over the list of laws, with the typical values of their parameter
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

#include <pounding/hysteresis/all.hpp>
#include "support/law_contract.hpp"

namespace pounding::hysteresis {
namespace contract_test {

using test::random_path;

template <class L>
struct HysteresisContract : testing::Test {
  using State = typename L::State;
  L law = std::get<L>(make_law(typical_settings(find_law(L::name))));
  double dy = law.yield_deformation();
  double fy = law.stiffness() * law.yield_deformation();

  State follow(const std::vector<double>& path) const { return test::follow(law, path); }
  double force(const State& kept) const { return law.respond(kept, kept.deformation).force; }
};

TYPED_TEST_SUITE(HysteresisContract, test::TypesOf<AnyLaw>::type, test::LawName);

TYPED_TEST(HysteresisContract, IsElasticAtFirst) {
  const double d = 1e-9 * this->dy;
  const Answer a = this->law.respond({}, d);
  EXPECT_NEAR(a.force, this->law.stiffness() * d, 1e-6 * this->law.stiffness() * d);
  EXPECT_NEAR(a.slope, this->law.stiffness(), 1e-6 * this->law.stiffness());
  EXPECT_EQ(this->law.respond({}, 0).force, 0);
  EXPECT_EQ(this->law.stored({}), 0);
}

TYPED_TEST(HysteresisContract, StandingStillChangesNothing) {
  std::mt19937 random(10);
  for (int i = 0; i < 200; ++i) {
    const auto kept = i == 0 ? typename TypeParam::State{} : this->follow(random_path(random, this->dy));
    const auto still = this->law.advance(kept, kept.deformation);
    EXPECT_EQ(this->law.work(kept, kept.deformation), 0);
    EXPECT_EQ(lost(this->law, kept, kept.deformation), 0);
    EXPECT_FALSE(this->law.corner(kept, kept.deformation));
    for (const double d : random_path(random, this->dy))
      EXPECT_EQ(this->law.respond(still, d).force, this->law.respond(kept, d).force);
  }
}

TYPED_TEST(HysteresisContract, SlopeIsTheDerivativeAlongTheWay) {
  test::expect_slope_is_the_derivative(this->law, this->dy, 2000);
}

TYPED_TEST(HysteresisContract, ItDoesNotMatterWhereAWayIsCut) {
  test::expect_subdivision_is_irrelevant(this->law, this->dy);
}

TYPED_TEST(HysteresisContract, NothingButTheDeformationChangesInTheElasticRange) {
  if constexpr (requires(const TypeParam& law, const typename TypeParam::State& kept) { law.elastic(kept); }) {
    std::mt19937 random(22);
    std::uniform_real_distribution<double> part(0, 1);
    for (int i = 0; i < 2000; ++i) {
      const auto kept = this->follow(random_path(random, this->dy));
      const Range range = this->law.elastic(kept);
      ASSERT_GT(range.high - range.low, this->dy) << "path " << i;
      const double force = excess(this->law, kept, 0.5 * (range.low + range.high)).force;
      auto moved = kept;
      for (int j = 0; j < 8; ++j) {
        const double d = j == 0   ? std::nextafter(range.low, range.high)
                         : j == 1 ? std::nextafter(range.high, range.low)
                                  : range.low + part(random) * (range.high - range.low);
        const Answer answer = excess(this->law, moved, d);
        ASSERT_EQ(answer.force, force) << "path " << i << ", at " << d;
        ASSERT_EQ(answer.slope, 0);
        ASSERT_EQ(lost(this->law, moved, d), 0);
        if (kept.deformation > range.low && kept.deformation < range.high) {
          ASSERT_FALSE(this->law.corner(moved, d));
        }
        auto expected = moved;
        expected.deformation = d;
        moved = this->law.advance(moved, d);
        for (const StateValue<TypeParam>& value : TypeParam::state)
          ASSERT_EQ(value.get(moved), value.get(expected)) << value.info.name;
        ASSERT_EQ(moved.deformation, d);
      }
      if constexpr (requires { this->law.hardening; }) {
        ASSERT_NEAR(excess(this->law, kept, range.high + 1e-3 * this->dy).slope,
                    -(1 - this->law.hardening) * this->law.stiffness(), 1e-9 * this->law.stiffness());
      }
    }
  } else {
    GTEST_SKIP() << "no such range";
  }
}

TYPED_TEST(HysteresisContract, TheMirroredPathHasTheMirroredForce) {
  if (!find_law(TypeParam::name).is_symmetric) GTEST_SKIP() << "not symmetric";
  std::mt19937 random(13);
  for (int i = 0; i < 1000; ++i) {
    std::vector<double> path = random_path(random, this->dy);
    const auto kept = this->follow(path);
    for (double& d : path) d = -d;
    const auto mirrored = this->follow(path);
    EXPECT_EQ(this->force(mirrored), -this->force(kept));
    EXPECT_EQ(this->law.stored(mirrored), this->law.stored(kept));
  }
}

TYPED_TEST(HysteresisContract, WorkIsTheIntegralOfTheForce) {
  std::mt19937 random(14);
  std::uniform_real_distribution<double> reach(-6, 6);
  for (int i = 0; i < 100; ++i) {
    const auto kept = this->follow(random_path(random, this->dy));
    const double d = reach(random) * this->dy;
    constexpr int n = 4000;
    const double h = (d - kept.deformation) / n;
    double sum = 0;  // by Simpson's rule; corners may lie between its points
    for (int j = 0; j < n; ++j) {
      // The force may jump at a reversal that ends the spring.
      const double x = kept.deformation + (j == 0 ? 1e-9 : j) * h;
      sum += h / 6 *
             (this->law.respond(kept, x).force + 4 * this->law.respond(kept, x + h / 2).force +
              this->law.respond(kept, x + h).force);
    }
    EXPECT_NEAR(this->law.work(kept, d), sum, 1e-6 * this->fy * this->dy) << "from " << kept.deformation << " to " << d;
    // The work is additive over parts of the path.
    const double middle = kept.deformation + 0.37 * (d - kept.deformation);
    EXPECT_NEAR(this->law.work(kept, middle) + this->law.work(this->law.advance(kept, middle), d),
                this->law.work(kept, d), 1e-11 * this->fy * this->dy);
  }
}

TYPED_TEST(HysteresisContract, EnergyIsOnlyLost) { test::expect_energy_is_only_lost(this->law, this->dy); }

TYPED_TEST(HysteresisContract, TheLossIsTheWorkLessWhatIsStored) {
  std::mt19937 random(22);
  for (int i = 0; i < 500; ++i) {
    typename TypeParam::State kept;
    double work = 0, all = 0;
    for (const double d : random_path(random, this->dy)) {
      all += lost(this->law, kept, d);
      work += this->law.work(kept, d);
      kept = this->law.advance(kept, d);
      ASSERT_NEAR(all, work - this->law.stored(kept), 1e-11 * (this->fy * this->dy + work));
    }
  }
}

TYPED_TEST(HysteresisContract, ACycleThatRepeatsGivesNoEnergy) {
  test::expect_repeated_cycles_give_no_energy(this->law, this->dy);
}

TYPED_TEST(HysteresisContract, SlopesJumpAtCornersAndNowhereElse) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> reach(-6, 6);
  int corners = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto kept = this->follow(random_path(random, this->dy));
    const double d = reach(random) * this->dy, h = (d < kept.deformation ? -1e-7 : 1e-7) * this->dy;
    const auto slope = [&](double x) { return this->law.respond(kept, x).slope / this->law.stiffness(); };
    const std::optional<double> corner = this->law.corner(kept, d);
    if (corner) {
      ASSERT_TRUE(has_corners<TypeParam>);
      ASSERT_TRUE(is_strictly_between(*corner, kept.deformation, d));
      if (is_strictly_between(*corner - 4 * h, kept.deformation, d)) {
        EXPECT_GT(std::abs(slope(*corner + h) - slope(*corner - h)), 1e-9) << "path " << i << " at " << *corner;
        ++corners;
      }
    }
    // Before it, a change of slope shrinks with the length of the path.
    const double end = corner ? *corner - h : d;
    if (!is_strictly_between(end - 2 * h, kept.deformation, d)) continue;
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
  if (has_corners<TypeParam>) {
    EXPECT_GT(corners, 30);
  }
}

TYPED_TEST(HysteresisContract, ExcessIsTheAnswerLessThatOfASpring) {
  std::mt19937 random(18);
  std::uniform_real_distribution<double> reach(-6, 6);
  for (int i = 0; i < 1000; ++i) {
    const auto kept = this->follow(random_path(random, this->dy));
    const double d = reach(random) * this->dy, k = this->law.stiffness();
    const Answer all = this->law.respond(kept, d), rest = excess(this->law, kept, d);
    EXPECT_NEAR(rest.force, all.force - k * d, 1e-13 * (this->fy + std::abs(k * d)));
    EXPECT_NEAR(rest.slope, all.slope - k, 1e-13 * k);
    EXPECT_NEAR(stored_excess(this->law, kept), this->law.stored(kept) - 0.5 * k * kept.deformation * kept.deformation,
                1e-12 * this->fy * (this->dy + std::abs(kept.deformation * kept.deformation / this->dy)));
  }
}

TYPED_TEST(HysteresisContract, AStateIsItsBytes) {
  std::mt19937 random(19);
  for (int i = 0; i < 200; ++i) {
    const auto kept = this->follow(random_path(random, this->dy));
    std::array<std::byte, sizeof(kept)> bytes;
    std::memcpy(bytes.data(), &kept, sizeof kept);
    typename TypeParam::State copy;
    std::memcpy(static_cast<void*>(&copy), bytes.data(), sizeof copy);
    for (const double d : random_path(random, this->dy))
      EXPECT_EQ(this->law.respond(copy, d).force, this->law.respond(kept, d).force);
  }
}

TYPED_TEST(HysteresisContract, WrongParametersAreRefused) {
  const Entry& entry = find_law(TypeParam::name);
  for (const ParameterInfo& p : entry.parameters)
    for (const double wrong : {p.typical < 0 ? 1.0 : -1.0, std::nan(""), HUGE_VAL}) {
      Settings s = typical_settings(entry);
      s.values.insert_or_assign(std::string(p.name), wrong);
      EXPECT_THROW(make_law(s), std::invalid_argument) << p.name << " = " << wrong;
    }
  for (const ParameterInfo& p : entry.parameters)
    if (p.need == Need::required) {
      Settings s = typical_settings(entry);
      std::erase_if(s.values, [&](const auto& value) { return laws::parameter_name(value.first) == p.name; });
      EXPECT_THROW(make_law(s), std::invalid_argument) << "without " << p.name;
    }
}

}  // namespace contract_test
}  // namespace pounding::hysteresis
