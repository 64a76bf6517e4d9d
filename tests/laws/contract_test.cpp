/// The contract of every law: typed tests over the list of laws, with the typical values of their parameter tables.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>

namespace pounding::laws {
namespace contract_test {

template <class L>
struct LawContract : testing::Test {
  static Settings settings() { return typical_settings(find_law(L::name)); }
  L law = std::get<L>(make_law(settings()));
  Impact impact = touch(law, typical_closing_speed);
};

template <class Variant>
struct TypesOf;
template <class... L>
struct TypesOf<std::variant<L...>> {
  using type = testing::Types<L...>;
};

struct LawName {
  template <class L>
  static std::string GetName(int) {
    return std::string(L::name);
  }
};

TYPED_TEST_SUITE(LawContract, TypesOf<AnyLaw>::type, LawName);

struct State {
  double penetration, rate;
};

/// Approach and restitution phases, shallow and deep, slow and fast.
State random_state(std::mt19937& random) {
  std::uniform_real_distribution<double> decades(-4, -2), speed(0.05, 1);
  std::bernoulli_distribution approaches;
  const double d = std::pow(10, decades(random)), v = speed(random);
  return {d, approaches(random) ? v : -v};
}

/// True if the stencil around a state crosses a corner of the law, where the slope is undefined.
template <class L>
bool near_corner(const L& law, const Impact& impact, State s, double hd, double hv) {
  if constexpr (requires { law.corner(s.penetration, s.rate, impact); }) {
    const double here = law.corner(s.penetration, s.rate, impact);
    for (const auto& [d, v] : {State{hd, 0}, State{-hd, 0}, State{0, hv}, State{0, -hv}})
      if (here * law.corner(s.penetration + d, s.rate + v, impact) <= 0) return true;
  }
  return false;
}

/// A slope is right if halving the step divides the error of its central difference by four, or if both errors are
/// negligible.
void expect_derivative(double slope, double coarse, double fine, double size) {
  const double error = std::abs(coarse - slope), half_error = std::abs(fine - slope);
  if (error <= 1e-9 * size) return;
  EXPECT_NEAR(error / half_error, 4, 0.05) << "slope " << slope << ", differences " << coarse << ", " << fine;
}

TYPED_TEST(LawContract, SlopesAreDerivatives) {
  std::mt19937 random(7);
  int used = 0;
  for (int i = 0; i < 400; ++i) {
    const State s = random_state(random);
    const double hd = 1e-2 * s.penetration, hv = 1e-2 * std::abs(s.rate);
    if (near_corner(this->law, this->impact, s, hd, hv)) continue;
    const auto force = [&](double d, double v) { return this->law.contact(d, v, this->impact).force; };
    const auto by_d = [&](double h) {
      return (force(s.penetration + h, s.rate) - force(s.penetration - h, s.rate)) / (2 * h);
    };
    const auto by_v = [&](double h) {
      return (force(s.penetration, s.rate + h) - force(s.penetration, s.rate - h)) / (2 * h);
    };
    const Response r = this->law.contact(s.penetration, s.rate, this->impact);
    EXPECT_EQ(r.force, force(s.penetration, s.rate));
    const double reach = std::abs(force(s.penetration, std::abs(s.rate)));
    expect_derivative(r.by_penetration, by_d(hd), by_d(hd / 2), reach / s.penetration);
    expect_derivative(r.by_rate, by_v(hv), by_v(hv / 2), reach / std::abs(s.rate));
    ++used;
  }
  EXPECT_GT(used, 200);
}

TYPED_TEST(LawContract, OpenGapGivesExactlyNothing) {
  for (const double d : {0.0, -1e-12, -0.01, -1.0})
    for (const double v : {-1.0, 0.0, 1.0}) {
      const Response r = this->law.respond(d, v, this->impact);
      EXPECT_EQ(r.force, 0);
      EXPECT_EQ(r.by_penetration, 0);
      EXPECT_EQ(r.by_rate, 0);
    }
}

TYPED_TEST(LawContract, ContinuesSmoothlyPastTheSeparation) {
  for (const double d : {0.0, -1e-9, -1e-4})
    for (const double v : {-1.0, 1.0}) {
      const Response r = this->law.contact(d, v, this->impact);
      EXPECT_TRUE(std::isfinite(r.force) && std::isfinite(r.by_penetration) && std::isfinite(r.by_rate));
    }
}

TYPED_TEST(LawContract, PullsOnlyWhenItSaysSo) {
  std::mt19937 random(8);
  double minimum = 0;
  for (int i = 0; i < 2000; ++i) {
    State s = random_state(random);
    s.rate *= 5;
    const Response r = this->law.respond(s.penetration, s.rate, this->impact);
    minimum = std::min(minimum, r.force);
    const Response uncut = this->law.contact(s.penetration, s.rate, this->impact);
    const Response expected = may_pull<TypeParam> || uncut.force > 0 ? uncut : Response{};
    EXPECT_EQ(r.force, expected.force);
    EXPECT_EQ(r.by_penetration, expected.by_penetration);
    EXPECT_EQ(r.by_rate, expected.by_rate);
  }
  EXPECT_EQ(minimum < 0, may_pull<TypeParam>);
}

TYPED_TEST(LawContract, ClosedCycleNeverGainsEnergy) {
  constexpr int cycles = 4, steps = 4000;
  const double deep = 5e-3;
  for (const double shallow : {0.0, 1e-3, 4e-3})
    for (const double frequency : {1.0, 30.0}) {
      Impact impact = this->impact;
      double work = 0, last_work = 0, largest = 0, d = shallow;
      for (int i = 0; i < cycles * steps; ++i) {
        const double angle = 2 * std::numbers::pi * (i + 1) / steps, middle = angle - std::numbers::pi / steps;
        const double next = shallow + 0.5 * (deep - shallow) * (1 - std::cos(angle));
        const double rate = 0.5 * (deep - shallow) * frequency * std::sin(middle);
        const double force = this->law.respond(0.5 * (d + next), rate, impact).force;
        work += force * (next - d);
        largest = std::max(largest, std::abs(force));
        d = next;
        keep(this->law, d, rate, impact);
        if ((i + 1) % steps == 0) {
          EXPECT_GE(work - last_work, -1e-6 * largest * deep);
          last_work = work;
        }
      }
    }
}

// A later impact starts where the previous one left the surfaces. Only accepted states change the memory.
TYPED_TEST(LawContract, CrushedSurfacesAreRemembered) {
  if constexpr (crushes<TypeParam>) {
    // Beyond yield; the forces of the other laws scale.
    const double deep = TypeParam::name == "elastic_plastic_gap" ? 3e-2 : 2e-3;
    keep(this->law, deep, 0.1, this->impact);
    const double crushed = this->law.crushed(this->impact), indentation = this->law.indentation(this->impact);
    EXPECT_EQ(crushed, deep);
    EXPECT_GT(indentation, 0);
    EXPECT_NEAR(this->law.respond(indentation, 0, this->impact).force, 0,
                1e-12 * this->law.respond(deep, 0, this->impact).force);
    Impact later = touch(this->law, 0.3, crushed);
    EXPECT_EQ(this->law.crushed(later), crushed);
    EXPECT_EQ(this->law.indentation(later), 0);
    const double core = crushed - indentation;
    for (const double part : {0.1, 0.5, 0.999})
      EXPECT_NEAR(this->law.respond(part * core, 0.1, later).force /
                      this->law.respond(indentation + part * core, 0.1, this->impact).force,
                  1, 1e-12);
    keep(this->law, 0.5 * core, 0.1, later);
    EXPECT_EQ(this->law.indentation(later), 0) << "no deeper than before";
    keep(this->law, 2 * core, 0.1, later);
    EXPECT_EQ(this->law.crushed(later), indentation + 2 * core);
    EXPECT_GT(this->law.indentation(later), 0);
  } else {
    EXPECT_EQ(touch(this->law, 0.3).crushed, 0);
  }
}

TYPED_TEST(LawContract, StoredEnergyIsTheWorkOfSlowUnloading) {
  constexpr int steps = 20000;
  for (const double deep : {1e-4, 2e-3, 2e-2}) {
    Impact impact = this->impact;
    for (int i = 1; i <= steps; ++i) keep(this->law, deep * i / steps, 0.1, impact);
    for (const double left : {1.0, 0.7, 0.1}) {
      keep(this->law, left * deep, -0.1, impact);
      double given = 0;
      Impact unloading = impact;
      for (int i = steps; i-- > 0;) {
        const double d = left * deep * (i + 0.5) / steps;
        given += this->law.respond(d, 0, unloading).force * left * deep / steps;
        keep(this->law, d, -1e-9, unloading);
      }
      // If the force ends before the penetration does, the midpoint rule misses up to an eighth of its slope times the
      // squared spacing.
      const double way = left * deep / steps,
                   corner = this->law.respond(left * deep, 0, impact).by_penetration * way * way / 8;
      EXPECT_NEAR(stored_energy(this->law, left * deep, impact), given, 1e-6 * given + corner) << deep << ' ' << left;
    }
  }
  EXPECT_EQ(stored_energy(this->law, 0, this->impact), 0);
}

TYPED_TEST(LawContract, LargestPenetrationIsKept) {
  Impact impact = this->impact;
  keep(this->law, 2e-3, 0.1, impact);
  keep(this->law, 1e-3, -0.1, impact);
  EXPECT_EQ(impact.largest_penetration, 2e-3);
}

TYPED_TEST(LawContract, RefusesValuesThatMakeNoSense) {
  const Entry& entry = find_law(TypeParam::name);
  const auto refuses = [](const Settings& s) { EXPECT_THROW(make_law(s), std::invalid_argument); };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const ParameterInfo& p : entry.parameters)
    for (const double bad : {-1.0, nan, infinite}) {
      Settings s = this->settings();
      if (p.need == Need::damping || p.need == Need::together) s.restitution.reset();
      s.values[std::string(p.name)] = bad;
      refuses(s);
      // Without hardening a contact is perfectly plastic.
      if (p.need == Need::damping || p.is_flag || p.name == "hardening") continue;
      s.values[std::string(p.name)] = 0;
      refuses(s);
    }
  for (const double bad : {0.0, -0.5, 1.0001, nan}) {
    if (bad == 0 && entry.sticks_at_zero) continue;
    Settings s = this->settings();
    s.restitution = bad;
    refuses(s);
  }
  for (const double bad : {0.0, -0.5, nan, infinite}) {
    Settings s = this->settings();
    s.impact_velocity = bad;
    refuses(s);
    s = this->settings();
    s.reduced_mass = bad;
    // 0 means none, which some laws require.
    if (entry.takes_reduced_mass || bad != 0) refuses(s);
  }
}

TYPED_TEST(LawContract, FixedImpactVelocityReplacesTheClosingSpeed) {
  if constexpr (requires { this->law.impact_velocity; }) {
    TypeParam fixed = this->law;
    fixed.impact_velocity = 0.2;
    EXPECT_EQ(fixed.damping_for(3.0), this->law.damping_for(0.2));
    EXPECT_EQ(touch(fixed, 3.0).closing_speed, 0.2);
  } else {
    EXPECT_EQ(touch(this->law, 3.0).closing_speed, 3.0);
  }
}

TYPED_TEST(LawContract, TouchAtRestHasFiniteDamping) {
  if constexpr (has_damping<TypeParam>) {
    for (const double v : {0.0, -0.1, slowest_closing_speed / 2}) {
      EXPECT_TRUE(std::isfinite(touch(this->law, v).damping));
      EXPECT_EQ(this->law.damping_for(v), this->law.damping_for(slowest_closing_speed));
    }
  }
}

TYPED_TEST(LawContract, SlowLoadingNeedsNoMoreThanSlowTouch) {
  const Impact calibrated = touch(this->law, 0), slow = slow_touch(this->law);
  for (const double d : {1e-6, 1e-4, 1e-3, 1e-2}) {
    const Response expected = pressed(this->law, d, 0, calibrated), found = pressed(this->law, d, 0, slow);
    EXPECT_EQ(found.force, expected.force) << d;
    EXPECT_EQ(found.by_penetration, expected.by_penetration) << d;
  }
}

TYPED_TEST(LawContract, TableIsComplete) {
  const Entry& entry = find_law(TypeParam::name);
  EXPECT_FALSE(entry.summary.empty() || entry.shape.empty() || entry.source.empty());
  EXPECT_FALSE(entry.symbols.empty() || entry.range.empty() || entry.beware.empty());
  for (const ParameterInfo& p : entry.parameters) {
    EXPECT_FALSE(p.meaning.empty());
    EXPECT_GT(p.typical, 0) << p.name;
  }
  for (const Formula& f : entry.formulas)
    EXPECT_FALSE(f.name.empty() || f.equation.empty() || f.source.empty() || f.note.empty());
  EXPECT_EQ(entry.formulas.empty(), !has_damping<TypeParam>);
  if (!entry.formulas.empty()) {
    EXPECT_EQ(entry.formulas.front().name, "exact");
  }
}

TYPED_TEST(LawContract, DirectDampingGivesTheLawOfItsRestitution) {
  if constexpr (has_damping<TypeParam>) {
    const double v = typical_closing_speed;
    for (const ParameterInfo& p : find_law(TypeParam::name).parameters) {
      if (p.need != Need::damping) continue;
      Settings s = this->settings();
      s.restitution.reset();
      const bool is_number = p.name == TypeParam::number.name;
      s.values[std::string(p.name)] = is_number ? this->law.damping_number(v) : this->law.damping_for(v);
      const AnyLaw direct = make_law(s);
      EXPECT_NEAR(free_impact(direct, typical_reduced_mass, v).restitution, typical_restitution, 1e-11) << p.name;
    }
  }
}

}  // namespace contract_test
}  // namespace pounding::laws
