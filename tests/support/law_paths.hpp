#pragma once
/// Random paths and typed tests of hysteretic laws and materials.

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

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

}  // namespace pounding::test
