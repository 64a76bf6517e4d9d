/// Yield, failure and axial strength of sections in bending.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/sections/bending.hpp>
#include "sections/reinforced_column.hpp"

namespace pounding::sections {
namespace bending_test {

std::vector<double> path_to(double curvature) {
  std::vector<double> path;
  for (int i = 1; i <= 120; ++i) path.push_back(curvature * i / 120);
  return path;
}

// The outermost fibres are at 0.16 m (bars) and 0.16 m less half a layer (core).
TEST(Bending, AReinforcedColumnYieldsAndCrushes) {
  const FibreSection column = test::reinforced_column("steel01");
  const Bending found = bend(column, -500e3, path_to(0.5));
  const auto at = [&](double curvature) {
    std::size_t i = 0;
    while (found.curve[i + 1].curvature < curvature) ++i;
    const CurvePoint &a = found.curve[i], &b = found.curve[i + 1];
    return a.axial_strain + (b.axial_strain - a.axial_strain) * (curvature - a.curvature) / (b.curvature - a.curvature);
  };
  // The bars in tension yield before the cover, 0.0067 m thick layers, reaches its strength, or at the same time.
  const double bars = at(found.yield_curvature) + found.yield_curvature * 0.16;
  const double cover = at(found.yield_curvature) - found.yield_curvature * (0.2 - 0.04 / 6);
  EXPECT_NEAR(std::max(bars / 0.0023, cover / -0.002), 1, 1e-9);
  EXPECT_LT(found.cracked_stiffness(), 0.6 * initial_bending_stiffness(column));
  EXPECT_TRUE(found.crushes);
  EXPECT_NEAR(at(found.ultimate_curvature) - found.ultimate_curvature * 0.16 * 23 / 24, -0.03, 1e-9);
  EXPECT_EQ(bend(column, -500e3, path_to(0.02)).ultimate_curvature, 0);
  // The hardening of the bars raises the moment again after the core has crushed.
  double before = 0, after = 0;
  for (const CurvePoint& point : found.curve) {
    double& largest = point.curvature <= found.ultimate_curvature ? before : after;
    largest = std::max(largest, point.moment);
  }
  EXPECT_EQ(found.largest_moment, before);
  EXPECT_GT(after, before);
}

TEST(Bending, ASectionOfElasticSteelNeverYields) {
  const FibreSection elastic{{materials::make_material({.law = "elastic", .values = {{"E", 200e9}}})},
                             rectangle(0.2, 0.4, 0, 100)};
  const Bending found = bend(elastic, -1e6, path_to(0.01));
  EXPECT_EQ(found.yield_curvature, 0);
  EXPECT_EQ(found.cracked_stiffness(), 0);
  EXPECT_NEAR(found.largest_moment, 0.01 * initial_bending_stiffness(elastic), 1e-6 * found.largest_moment);
}

TEST(Bending, AxialStrengthIsThatOfConcreteAndBars) {
  const AxialStrength strength = axial_strength(test::reinforced_column("steel01"));
  const double steel = 8 * 3e-4 + 2 * 4e-4;
  // Bars with a hardening of 1 % at a strain of 0.05.
  EXPECT_NEAR(strength.tension, steel * (460e6 + 2e9 * (0.05 - 0.0023)), 0.02 * strength.tension);
  EXPECT_LT(strength.compression, -(36e6 * 0.32 * 0.32 + steel * 460e6));
  EXPECT_GT(strength.compression, -(36e6 * 0.32 * 0.32 + 28e6 * (0.16 - 0.32 * 0.32) + steel * 480e6));
}

}  // namespace bending_test
}  // namespace pounding::sections
