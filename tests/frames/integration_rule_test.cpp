/// Integration rules: degree of exactness, published points, hinges.

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include <pounding/frames/integration_rule.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace integration_rule_test {

/// Integral of x^degree over [0, 1] by a rule, minus the exact one.
double error(const IntegrationRule& rule, int degree) {
  double sum = -1.0 / (degree + 1);
  for (const auto* points : {&rule.points, &rule.elastic})
    for (const auto& [at, weight] : *points) sum += weight * std::pow(at, degree);
  return std::abs(sum);
}

/// Largest degree up to which all powers are integrated exactly.
int exactness(const IntegrationRule& rule) {
  for (int degree = 0;; ++degree)
    if (error(rule, degree) > 1e-13) return degree - 1;
}

TEST(IntegrationRule, IntegratesPolynomialsOfItsDegreeExactly) {
  for (int n = 2; n <= 10; ++n) {
    EXPECT_EQ(exactness(lobatto(n)), 2 * n - 3) << n;
    EXPECT_EQ(exactness(radau(n)), 2 * n - 2) << n;
    EXPECT_EQ(exactness(legendre(n)), 2 * n - 1) << n;
    // By symmetry, an odd number of points is exact for one degree more.
    EXPECT_EQ(exactness(newton_cotes(n)), n - 1 + n % 2) << n;
    EXPECT_EQ(lobatto(n).points.size(), static_cast<std::size_t>(n));
    EXPECT_NO_THROW(lobatto(n).check());
  }
}

TEST(IntegrationRule, HasThePublishedPoints) {
  // Abramowitz & Stegun, tables 25.4 and 25.6, on [-1, 1].
  const IntegrationRule l = lobatto(5), g = legendre(4);
  const double lobatto_at[] = {0, 0.5 * (1 - std::sqrt(3.0 / 7)), 0.5, 0.5 * (1 + std::sqrt(3.0 / 7)), 1};
  const double lobatto_weights[] = {0.05, 49.0 / 180, 16.0 / 45, 49.0 / 180, 0.05};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(l.points[i].at, lobatto_at[i], 1e-15);
    EXPECT_NEAR(l.points[i].weight, lobatto_weights[i], 1e-15);
  }
  EXPECT_NEAR(2 * g.points[3].at - 1, 0.861136311594053, 1e-15);
  EXPECT_NEAR(2 * g.points[3].weight, 0.347854845137454, 2e-15);
  EXPECT_EQ(radau(3).points.front().at, 0);
}

TEST(IntegrationRule, FixedLocationsHaveTheWeightsOfTheirPolynomial) {
  const IntegrationRule simpson = fixed_locations({1, 0, 0.5});
  EXPECT_EQ(simpson.points[0].at, 0);
  EXPECT_NEAR(simpson.points[0].weight, 1.0 / 6, 1e-15);
  EXPECT_NEAR(simpson.points[1].weight, 4.0 / 6, 1e-15);
  EXPECT_EQ(exactness(fixed_locations({0.5})), 1);
  EXPECT_EQ(exactness(fixed_locations({0.1, 0.7})), 1);
}

TEST(IntegrationRule, HingesHaveTheirLengthsAndDegrees) {
  const IntegrationRule radau_hinges = hinge_radau(0.1, 0.05);
  ASSERT_EQ(radau_hinges.points.size(), 6u);
  EXPECT_EQ(radau_hinges.points[0].weight, 0.1);
  EXPECT_NEAR(radau_hinges.points[1].at, 0.8 / 3, 1e-15);
  EXPECT_NEAR(radau_hinges.points[1].weight, 0.3, 1e-15);
  EXPECT_NEAR(radau_hinges.points[4].at, 1 - 0.4 / 3, 1e-15);
  EXPECT_EQ(radau_hinges.points[5].at, 1);
  EXPECT_EQ(exactness(radau_hinges), 2);
  EXPECT_EQ(exactness(hinge_radau_two(0.1, 0.2)), 2);
  EXPECT_EQ(exactness(hinge_midpoint(0.1, 0.2)), 1);
  EXPECT_EQ(exactness(hinge_endpoint(0.1, 0.2)), 0);
}

TEST(IntegrationRule, AnElasticInteriorLeavesFibresInTheHingesOnly) {
  const auto counts = [](const IntegrationRule& rule) {
    EXPECT_NO_THROW(rule.check());
    return std::pair(rule.points.size(), rule.elastic.size());
  };
  EXPECT_EQ(counts(hinge_radau(0.1, 0.1, HingeInterior::elastic)), std::pair(2ul, 4ul));
  EXPECT_EQ(counts(hinge_radau_two(0.1, 0.1, HingeInterior::elastic)), std::pair(4ul, 2ul));
  EXPECT_EQ(counts(hinge_midpoint(0.1, 0.1, HingeInterior::elastic)), std::pair(2ul, 2ul));
  EXPECT_EQ(counts(hinge_radau(0.1, 0, HingeInterior::elastic)), std::pair(1ul, 3ul));
  EXPECT_EQ(counts(hinge_radau(0.125, 0.125)), std::pair(4ul, 0ul));
}

TEST(IntegrationRule, InvalidRulesAreRejected) {
  const auto rejection = [](auto&& call) { return test::refusal(call); };
  EXPECT_TRUE(test::mentions(rejection([] { lobatto(11); }), {"11", "10"}));
  EXPECT_TRUE(test::mentions(rejection([] { legendre(1); }), {"1", "2"}));
  EXPECT_TRUE(test::mentions(rejection([] { hinge_radau(0.2, 0.1); }), {"0.2", "0.1", "0.25"}));
  EXPECT_TRUE(test::mentions(rejection([] { hinge_midpoint(-0.1, 0); }), {"hinge length", "-0.1"}));
  EXPECT_TRUE(test::mentions(rejection([] { fixed_locations({0.5, 0.5}); }), {"0.5"}));
  EXPECT_TRUE(test::mentions(rejection([] { IntegrationRule{}.check(); }), {"point"}));
  EXPECT_TRUE(test::mentions(rejection([] { IntegrationRule{{{1.5, 1}}}.check(); }), {"location", "1.5"}));
  EXPECT_TRUE(test::mentions(rejection([] { IntegrationRule{{{0.5, 0.9}}}.check(); }), {"sum", "0.9"}));
  EXPECT_TRUE(test::mentions(rejection([] { IntegrationRule{{{0.5, 0}}}.check(); }), {"weight"}));
}

}  // namespace integration_rule_test
}  // namespace pounding
