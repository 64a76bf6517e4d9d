#pragma once
/// Random paths, typed tests and shared checks of hysteretic laws and materials.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>

namespace pounding::test {

/// The types of a variant as a list of typed tests.
template <class Variant>
struct TypesOf;
template <class... L>
struct TypesOf<std::variant<L...>> {
  using type = testing::Types<L...>;
};

/// Names typed tests after their laws.
struct LawName {
  template <class L>
  static std::string GetName(int) {
    return std::string(L::name);
  }
};

/// Turning points: the majority within a few yield deformations, some far out, some close to the previous one.
inline std::vector<double> random_path(std::mt19937& random, double dy, int max_turns = 12) {
  std::uniform_real_distribution<double> near(-2, 2), far(-10, 10), decades(-6, 0);
  std::uniform_int_distribution<int> turns(1, max_turns), kind(0, 9);
  std::vector<double> path(static_cast<std::size_t>(turns(random)));
  double last = 0;
  for (double& d : path) {
    const int k = kind(random);
    d = k < 5   ? dy * near(random)
        : k < 8 ? dy * far(random)
                : last + dy * std::copysign(std::pow(10, decades(random)), near(random));
    last = d;
  }
  return path;
}

/// State at the end of a path.
template <class L>
typename L::State follow(const L& law, const std::vector<double>& path) {
  typename L::State kept;
  for (const double d : path) kept = law.advance(kept, d);
  return kept;
}

/// Forces at the turning points of a path, each stretch in one part and in three [N]; the loss is work minus stored.
template <class L>
void expect_loop(const L& law, const std::vector<double>& path, const std::vector<double>& forces, double allowed) {
  law.check();
  ASSERT_EQ(path.size(), forces.size());
  typename L::State kept;
  double work = 0, all = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double begin = kept.deformation;
    EXPECT_NEAR(law.respond(kept, path[i]).force, forces[i], allowed) << L::name << " at turn " << i;
    for (const double d : {begin + (path[i] - begin) / 3, begin + 2 * (path[i] - begin) / 3, path[i]}) {
      work += law.work(kept, d);
      all += hysteresis::lost(law, kept, d);
      kept = law.advance(kept, d);
    }
    EXPECT_NEAR(law.respond(kept, path[i]).force, forces[i], allowed) << L::name << " in parts, turn " << i;
    EXPECT_NEAR(all, work - law.stored(kept), 1e-9 * std::abs(work) + 1e-9);
    EXPECT_GE(all, -hysteresis::gives_back<L> * law.stiffness() * std::pow(law.yield_deformation(), 2) - 1e-9 * work);
  }
}

/// The slope is the derivative along the path, by finite differences.
template <class L>
void expect_slope_is_the_derivative(const L& law, double dy, int samples) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> reach(-6, 6);
  const double h = 1e-4 * dy;
  int used = 0;
  for (int i = 0; i < samples; ++i) {
    const auto kept = follow(law, random_path(random, dy));
    const double d = reach(random) * dy, way = d < kept.deformation ? -1 : 1;
    if (std::abs(d - kept.deformation) < 3 * h) continue;
    // The slope is undefined at a corner between the points of the difference.
    const auto before = law.advance(kept, d - 2 * way * h);
    if (law.corner(before, d + 2 * way * h)) continue;
    const auto difference = [&](double step) {
      return (law.respond(kept, d + step).force - law.respond(kept, d - step).force) / (2 * step);
    };
    // The difference is of fourth order; the remaining error is round-off, 1e-16 fy over the step.
    const double slope = (4 * difference(h / 2) - difference(h)) / 3;
    EXPECT_NEAR(law.respond(kept, d).slope, slope, 2e-8 * law.stiffness())
        << "from " << kept.deformation << " to " << d;
    ++used;
  }
  EXPECT_GT(used, samples * 3 / 4);
}

/// Steps of a monotonic path do not matter, on 10,000 random paths.
template <class L>
void expect_subdivision_is_irrelevant(const L& law, double dy) {
  const double fy = law.stiffness() * dy;
  std::mt19937 random(12);
  std::uniform_real_distribution<double> part(0, 1), probe(-3, 3);
  for (int i = 0; i < 10000; ++i) {
    const std::vector<double> path = random_path(random, dy);
    typename L::State whole, cut;
    for (const double d : path) {
      const double begin = cut.deformation;
      std::vector<double> cuts(static_cast<std::size_t>(1 + i % 4));
      for (double& x : cuts) x = part(random);
      std::sort(cuts.begin(), cuts.end());
      for (const double x : cuts) cut = law.advance(cut, begin + x * (d - begin));
      cut = law.advance(cut, d);
      whole = law.advance(whole, d);
    }
    for (const double d : {whole.deformation, dy * probe(random), dy * probe(random), dy * probe(random)}) {
      const double expected = law.respond(whole, d).force;
      ASSERT_NEAR(law.respond(cut, d).force, expected, 1e-12 * fy) << "path " << i << ", then to " << d;
    }
    ASSERT_NEAR(law.stored(cut), law.stored(whole), 1e-11 * fy * dy) << "path " << i;
    for (const hysteresis::StateValue<L>& value : L::state)
      ASSERT_NEAR(value.get(cut), value.get(whole), 1e-12 * std::max(1.0, std::abs(value.get(whole))))
          << value.info.name << " of path " << i;
  }
}

/// Total lost energy stays near its running maximum, and at it for a law that gives none back; paths end at zero.
template <class L>
void expect_energy_is_only_lost(const L& law, double dy) {
  const double fy = law.stiffness() * dy;
  std::mt19937 random(15);
  const double unit = fy * dy, allowed = (hysteresis::gives_back<L> + 1e-11) * unit;
  for (int i = 0; i < 3000; ++i) {
    typename L::State kept;
    double all = 0, maximum = 0;
    std::vector<double> path = random_path(random, dy);
    path.push_back(0);
    for (const double strain : path) {
      const double begin = kept.deformation;
      for (int quarter = 1; quarter <= 4; ++quarter) {
        const double next = begin + 0.25 * quarter * (strain - begin);
        all += hysteresis::lost(law, kept, next);
        maximum = std::max(maximum, all);
        ASSERT_GE(all, maximum - allowed) << "path " << i << ", from " << kept.deformation << " to " << next;
        kept = law.advance(kept, next);
        ASSERT_GE(law.stored(kept), -1e-18 * unit);
      }
    }
  }
}

/// A cycle that is repeated gives no energy, except for published laws with this defect. Where its ripples may give
/// some, it is less than the path before has lost.
template <class L>
void expect_repeated_cycles_give_no_energy(const L& law, double dy) {
  const double fy = law.stiffness() * dy;
  std::mt19937 random(16);
  std::uniform_real_distribution<double> reach(-2, 2);
  for (int i = 0; i < 300; ++i) {
    typename L::State kept;
    double all = 0;
    for (const double d : random_path(random, dy)) {
      all += hysteresis::lost(law, kept, d);
      kept = law.advance(kept, d);
    }
    const double begin = kept.deformation;
    std::vector<double> cycle(static_cast<std::size_t>(1 + i % 4));
    for (double& d : cycle) d = begin + reach(random) * dy;
    cycle.push_back(begin);
    double work = 0;
    for (int j = 0; j < 100; ++j) {
      work = 0;
      const double stored = law.stored(kept);
      for (const double d : cycle) {
        work += law.work(kept, d);
        kept = law.advance(kept, d);
      }
      work -= law.stored(kept) - stored;
      all += work;
    }
    ASSERT_GE(hysteresis::ripples_give_back<L> ? all : work, -(hysteresis::cycle_gives_back<L> + 1e-11) * fy * dy)
        << "cycle " << i;
  }
}

}  // namespace pounding::test
