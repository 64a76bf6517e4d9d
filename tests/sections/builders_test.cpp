/// Areas, centroids and inertias of patches and sections against closed forms.

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/sections/builders.hpp>
#include "sections/reinforced_column.hpp"
#include "support/messages.hpp"

namespace pounding::sections {
namespace builders_test {

struct Moments {
  double area = 0, y = 0, z = 0, yy = 0, zz = 0;
};
Moments moments(const Fibres& fibres) {
  Moments m;
  for (const Fibre& f : fibres)
    m.area += f.area, m.y += f.area * f.y, m.z += f.area * f.z, m.yy += f.area * f.y * f.y, m.zz += f.area * f.z * f.z;
  return m;
}

TEST(Patches, ARectangleHasItsAreaAndLayeredInertia) {
  const Moments m = moments(rectangle(0.3, 0.5, 0, 20, 10));
  EXPECT_NEAR(m.area, 0.15, 1e-15);
  EXPECT_NEAR(m.y, 0, 1e-16);
  EXPECT_NEAR(m.z, 0, 1e-16);
  // Midpoint rule: n cells miss a fraction 1/n^2 of the inertia.
  EXPECT_NEAR(m.zz, 0.3 * 0.125 / 12 * (1 - 1.0 / 400), 1e-16);
  EXPECT_NEAR(m.yy, 0.5 * 0.027 / 12 * (1 - 1.0 / 100), 1e-16);
  for (const Fibre& f : rectangle(0.3, 0.5, 0, 20)) EXPECT_NEAR(f.y, 0, 1e-16);
}

TEST(Patches, ATrapezoidHasItsAreaAndCentroidForAnyCells) {
  for (const Cells cells : {Cells{1, 1}, Cells{3, 7}}) {
    Fibres fibres;
    add_quadrilateral(fibres, 0, {Point{0, 0}, Point{4, 0}, Point{3, 2}, Point{1, 2}}, cells);
    const Moments m = moments(fibres);
    EXPECT_EQ(fibres.size(), static_cast<std::size_t>(cells.first * cells.second));
    EXPECT_NEAR(m.area, 6, 1e-14);
    EXPECT_NEAR(m.y / m.area, 2, 1e-14);
    EXPECT_NEAR(m.z / m.area, 2.0 / 3 * (4 + 2 * 2) / (4 + 2), 1e-14);
  }
}

TEST(Patches, ARingHasItsAreaAndInertia) {
  Fibres fibres;
  add_ring(fibres, 0, {0.1, -0.2}, 0.15, 0.25, {4, 16});
  const Moments m = moments(fibres);
  const double ring = M_PI * (0.0625 - 0.0225);
  EXPECT_NEAR(m.area, ring, 1e-15);
  EXPECT_NEAR(m.y / m.area, 0.1, 1e-15);
  EXPECT_NEAR(m.z / m.area, -0.2, 1e-15);
  const Moments solid = moments(pipe(0.5, 0.25, 0, 40, 200));
  EXPECT_NEAR(solid.area, M_PI * 0.0625, 1e-14);
  EXPECT_NEAR(solid.zz, M_PI * std::pow(0.25, 4) / 4, 1e-3 * solid.zz);
  EXPECT_NEAR(solid.yy, solid.zz, 1e-14);
  Fibres quarter;
  add_ring(quarter, 0, {}, 0, 0.3, {1, 1}, 0, M_PI / 2);
  EXPECT_NEAR(quarter[0].y, 4 * 0.3 / (3 * M_PI), 1e-15);
  EXPECT_NEAR(quarter[0].z, quarter[0].y, 1e-15);
}

TEST(Layers, BarsAreEquallySpaced) {
  Fibres bars;
  add_straight_layer(bars, 2, 3, 1e-4, {-0.1, 0.2}, {0.3, 0.2});
  add_straight_layer(bars, 2, 1, 1e-4, {-0.1, 0}, {0.1, 0.4});
  add_circular_layer(bars, 1, 4, 2e-4, {0, 0}, 0.5);
  const std::vector<Point> expected{{-0.1, 0.2}, {0.1, 0.2}, {0.3, 0.2}, {0, 0.2},
                                    {0.5, 0},    {0, 0.5},   {-0.5, 0},  {0, -0.5}};
  ASSERT_EQ(bars.size(), expected.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    EXPECT_NEAR(bars[i].y, expected[i].y, 1e-16);
    EXPECT_NEAR(bars[i].z, expected[i].z, 1e-16);
  }
  EXPECT_NEAR(area(bars), 12e-4, 1e-18);
  EXPECT_NEAR(bar_area(0.02), 314.159e-6, 1e-9);
}

// 24 layers of core, the cover next to them, 3 layers of cover above and below, 3 rows of bars.
TEST(Builders, AReinforcedRectangleInLayers) {
  const Fibres fibres = rc_rectangle(test::column_dimensions());
  ASSERT_EQ(fibres.size(), 24u + 24u + 6u + 3u);
  std::array<double, 3> areas{};
  for (const Fibre& f : fibres) areas[f.material] += f.area;
  EXPECT_NEAR(areas[0], 0.32 * 0.32, 1e-15);
  EXPECT_NEAR(areas[1], 0.16 - 0.32 * 0.32, 1e-15);
  EXPECT_NEAR(areas[2], 3.2e-3, 1e-18);
  EXPECT_NEAR(moments(fibres).z, 0, 1e-17);
}

TEST(Builders, CellsAndLayersHaveTheSameAreas) {
  RcRectangle column = test::column_dimensions();
  const Moments layers = moments(rc_rectangle(column));
  column.across = 8;
  const Fibres fibres = rc_rectangle(column);
  const Moments cells = moments(fibres);
  EXPECT_NEAR(cells.area, layers.area, 1e-15);
  EXPECT_NEAR(cells.zz, layers.zz, 1e-15);
  EXPECT_NEAR(cells.y, 0, 1e-16);
  EXPECT_GT(cells.yy, 0.4 * 0.064 / 12);
  std::size_t bars = 0;
  for (const Fibre& f : fibres) bars += f.material == 2;
  EXPECT_EQ(bars, 10u);
}

TEST(Builders, AnIHasItsAreaAndInertia) {
  const Moments m = moments(i_section(0.3, 0.15, 0.0107, 0.0071, 0, 64, 8));
  EXPECT_NEAR(m.area, 2 * 0.15 * 0.0107 + 0.2786 * 0.0071, 1e-16);
  const double inertia = (0.15 * std::pow(0.3, 3) - (0.15 - 0.0071) * std::pow(0.2786, 3)) / 12;
  EXPECT_NEAR(m.zz, inertia, 1e-4 * inertia);
}

TEST(Builders, InvalidDimensionsAreRejected) {
  RcRectangle column = test::column_dimensions();
  column.cover = 0.2;
  EXPECT_TRUE(test::mentions(test::refusal([&] { rc_rectangle(column); }), {"cover", "0.2"}));
  column = test::column_dimensions();
  column.sides.count = 3;
  EXPECT_TRUE(test::mentions(test::refusal([&] { rc_rectangle(column); }), {"sides", "3", "even"}));
  EXPECT_TRUE(test::mentions(test::refusal([&] { pipe(0.2, 0.11, 0, 2, 8); }), {"thickness", "0.11"}));
  EXPECT_TRUE(test::mentions(test::refusal([&] { i_section(0.3, 0.1, 0.2, 0.01, 0, 8); }), {"flange", "0.2"}));
  EXPECT_TRUE(test::mentions(test::refusal([&] { rectangle(0.3, 0.3, 0, 0); }), {"cells", "0", "1"}));
  Fibres fibres;
  EXPECT_TRUE(test::mentions(
      test::refusal([&] { add_quadrilateral(fibres, 0, {Point{0, 0}, Point{1, 1}, Point{1, 0}, Point{0, 1}}, {}); }),
      {"convex"}));
  EXPECT_TRUE(test::mentions(test::refusal([&] { add_ring(fibres, 0, {}, 0.2, 0.1, {}); }), {"outer", "0.1"}));
}

TEST(Builders, AnAreaThatTheFibresDoNotCoverIsRejected) {
  const Fibres fibres = rectangle(0.2, 0.4, 0, 10);
  check_area(fibres, 0.0805);
  EXPECT_TRUE(test::mentions(test::refusal([&] { check_area(fibres, 0.09); }), {"0.08", "0.09", "m^2"}));
}

}  // namespace builders_test
}  // namespace pounding::sections
