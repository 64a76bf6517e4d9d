/// Columns of fibre members against independent programs, energies, and convergence.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "frames/fibre_column.hpp"
#include "sections/reinforced_column.hpp"
#include "support/book.hpp"

namespace pounding {
namespace fibre_column_test {

using test::FibreColumn;

constexpr double weight = 40e3 * 9.80665, height = 3;

std::shared_ptr<const sections::FibreSection> reinforced(const std::string& steel) {
  return std::make_shared<sections::FibreSection>(test::reinforced_column(steel));
}

/// Tip forces at half and at the end of each way of a cantilever under its weight.
std::vector<double> cyclic_forces(const FibreMemberOptions& options, int parts) {
  FibreColumn column(reinforced("steel01"), options, height, parts, 2);
  column.set_load(Dof::uz, -weight);
  column.apply_load();
  std::vector<double> forces;
  double begin = 0;
  for (const double end : {0.03, -0.03, 0.06, -0.06, 0.09, -0.09, 0.0}) {
    const int steps = static_cast<int>(std::lround(std::abs(end - begin) / 0.000125));
    for (int i = 1; i <= steps; ++i) {
      const double force = column.step({{Dof::ux, begin + (end - begin) * i / steps}})[0];
      if (2 * i == steps || i == steps) forces.push_back(force);
    }
    begin = end;
  }
  return forces;
}

TEST(FibreColumn, PushedToAndFroHasTheForcesOfAnIndependentProgram) {
  test::Book book("Fibre members: a cantilever of reinforced concrete, pushed to and fro",
                  "an independent implementation that agrees with OpenSees 3.7.1 to 5e-9 of the maximum force",
                  "the digits of the reference, relative to the maximum force");
  const FibreMemberOptions p_delta{.geometry = FrameGeometry::p_delta, .axial_force = -weight};
  FibreMemberOptions three = p_delta, hinge = p_delta;
  three.rule = lobatto(3);
  hinge.rule = hinge_radau(0.1, 0.1);
  const struct {
    const char* name;
    FibreMemberOptions options;
    int parts;
    std::vector<double> expected;
  } cases[] = {
      {"5 Lobatto points, corotational: tip force [N]",
       {.geometry = FrameGeometry::corotational},
       1,
       {59898.61017, 85864.57737, -8131.705836, -86827.34558, 46649.59503, 89957.92171, -47567.29772, -89960.21819,
        56211.06903, 89300.95094, -55446.65356, -89300.29248, 29167.06739, 55435.11348}},
      {"5 Lobatto points, P-Delta: tip force [N]",
       p_delta,
       1,
       {59903.73429, 85907.08463, -8135.803132, -86874.6141, 46653.3517, 90036.76342, -47604.15362, -90039.07046,
        56213.91583, 89422.68909, -55461.90646, -89422.04775, 29225.22887, 55450.12604}},
      {"3 Lobatto points, P-Delta: tip force [N]",
       three,
       1,
       {60228.28447, 84680.16692, -10117.82768, -85754.83248, 45726.75001, 92894.53058, -34077.65742, -92873.97381,
        46950.46525, 87604.88036, -49072.42509, -87616.45255, 26624.33512, 49071.9403}},
      {"Radau hinges of 0.3 m, P-Delta: tip force [N]",
       hinge,
       1,
       {59918.29264, 84917.6477, -8403.914056, -85779.20927, 46073.97003, 92341.33902, -38352.7642, -92344.52316,
        49626.53015, 86148.1394, -55972.04276, -86148.35591, 29822.56932, 55973.48771}},
      {"4 members by displacements, corotational: tip force [N]",
       {.rule = lobatto(4), .formulation = MemberFormulation::displacement, .geometry = FrameGeometry::corotational},
       4,
       {59973.37285, 88526.0325, -6085.708934, -87966.61717, 48708.38783, 101641.8374, -35416.34107, -103772.0633,
        43268.1433, 100052.9117, -45712.51052, -100011.4939, 3625.786694, 45815.52022}}};
  for (const auto& [name, options, parts, expected] : cases) {
    const std::vector<double> forces = cyclic_forces(options, parts);
    ASSERT_EQ(forces.size(), expected.size());
    for (std::size_t i = 0; i < forces.size(); ++i) book.near(name, forces[i], expected[i], 1e-9 * 1e5);
  }
}

/// Square section in cells: a core between the bars, strips of cover, eight bars.
std::shared_ptr<const sections::FibreSection> biaxial_section() {
  constexpr int n = 10;
  constexpr double side = 0.4, cover = 0.04, core = side / 2 - cover;
  sections::Fibres fibres;
  const auto at = [](double reach, int i) { return -reach + 2 * reach * (i + 0.5) / n; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) fibres.push_back({at(core, i), at(core, j), 4 * core * core / n / n, 0});
    for (const int sign : {-1, 1}) {
      fibres.push_back({sign * (core + cover / 2), at(side / 2, i), cover * side / n, 1});
      fibres.push_back({at(core, i), sign * (core + cover / 2), cover * 2 * core / n, 1});
    }
  }
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1})
      if (i != 0 || j != 0) fibres.push_back({i * core, j * core, 0.0005, 2});
  return std::make_shared<sections::FibreSection>(test::column_materials("steel01"), fibres);
}

TEST(FibreColumn, BentInTwoDirectionsHasTheForcesOfAnIndependentProgram) {
  test::Book book("Fibre members: a column of reinforced concrete bent in two directions",
                  "an independent numpy program that agrees with OpenSees 3.7.1 to 3e-10 of the maximum force",
                  "Newton's tolerance of the reference, relative to the maximum force");
  FibreColumn column(biaxial_section(), {.torsion_stiffness = 1e8}, height, 1, 3);
  column.set_load(Dof::ux, -600e3);
  column.apply_load();
  const double corners[][2] = {{0.03, 0}, {0.03, 0.03}, {0, 0.03}, {-0.03, -0.03}, {-0.03, 0.03}, {0.045, 0}, {0, 0}};
  const double expected[][2] = {{72407.83795863405, 0},
                                {109770.48057841092, 0},
                                {97143.41637132074, 53470.501286645405},
                                {76470.53000187929, 84011.0115377964},
                                {22653.820245140603, 84172.24631167008},
                                {-28508.10212944836, 80827.1843371786},
                                {-68353.59485069891, -19091.938764645936},
                                {-75919.11329651733, -83003.80427336605},
                                {-76547.86407173316, 23671.911376552922},
                                {-56075.80331022282, 90929.41635686588},
                                {54186.27552498487, 30128.080381986878},
                                {111468.59206887886, -15339.592414270102},
                                {39955.87514994452, -13495.393212441517},
                                {-40009.31383189483, -10588.288052224323}};
  double from[2] = {0, 0};
  int next = 0;
  for (const auto& to : corners) {
    const double distance = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
    const int steps = static_cast<int>(std::lround(distance / 0.0005));
    for (int i = 1; i <= steps; ++i) {
      const auto at = [&](int j) { return from[j] + (to[j] - from[j]) * i / steps; };
      const auto forces = column.step({{Dof::uy, at(0)}, {Dof::uz, at(1)}});
      if (2 * i != steps && i != steps) continue;
      book.near("tip force along y [N]", forces[0], expected[next][0], 1e-9 * 1.1e5);
      book.near("tip force along z [N]", forces[1], expected[next][1], 1e-9 * 1.1e5);
      ++next;
    }
    std::ranges::copy(to, from);
  }
  EXPECT_EQ(next, 14);
}

/// Work of the tip forces minus stored and dissipated energy, relative to the dissipated energy, on two cycles.
double energy_error(FibreColumn& column, double step) {
  double begin = 0, work = 0, last = 0, sunk = 0;
  column.set_load(Dof::uz, -weight);
  column.apply_load();
  const double at_rest = column.stored() + column.dissipated(), rest = column.displacements()[column.tip(Dof::uz)];
  for (const double end : {0.03, -0.04, 0.06, 0.0}) {
    const int steps = static_cast<int>(std::lround(std::abs(end - begin) / step));
    for (int i = 1; i <= steps; ++i) {
      const double force = column.step({{Dof::ux, begin + (end - begin) * i / steps}})[0];
      work += 0.5 * (force + last) * (end - begin) / steps;
      last = force;
    }
    begin = end;
  }
  sunk = column.displacements()[column.tip(Dof::uz)] - rest;
  EXPECT_GT(column.dissipated(), 2e3);
  EXPECT_GT(column.stored(), 100);
  return std::abs(work - weight * sunk + at_rest - column.stored() - column.dissipated()) / column.dissipated();
}

TEST(FibreColumn, WorkIsStoredOrDissipated) {
  const FibreMemberOptions cases[] = {
      {.geometry = FrameGeometry::corotational},
      {.geometry = FrameGeometry::p_delta, .axial_force = -weight},
      {.rule = hinge_radau(0.1, 0.1, HingeInterior::elastic),
       .geometry = FrameGeometry::corotational,
       .shear_stiffness_z = 5e8},
      {.rule = lobatto(3), .formulation = MemberFormulation::displacement, .geometry = FrameGeometry::corotational}};
  for (const FibreMemberOptions& options : cases)
    for (const char* steel : {"steel01", "menegotto_pinto"}) {
      FibreColumn coarse(reinforced(steel), options, height, 1, 2), fine = coarse;
      const double error = energy_error(fine, 0.000125);
      EXPECT_LT(error, 2e-5) << steel;
      // Second order, as the rule that integrates the work.
      EXPECT_LT(error, 0.4 * energy_error(coarse, 0.00025)) << steel;
    }
}

TEST(FibreColumn, MirroredLoadsHaveMirroredResults) {
  for (const FrameGeometry geometry : {FrameGeometry::linear, FrameGeometry::corotational}) {
    FibreColumn one(reinforced("menegotto_pinto"), {.geometry = geometry}, height, 1, 2), other = one;
    for (FibreColumn* column : {&one, &other}) {
      column->set_load(Dof::uz, -weight);
      column->apply_load();
    }
    for (int i = 1; i <= 200; ++i) {
      const double to = 0.05 * std::sin(0.05 * i);
      const double a = one.step({{Dof::ux, to}})[0], b = other.step({{Dof::ux, -to}})[0];
      ASSERT_NEAR(a, -b, 1e-8 * 1e5) << i;
    }
    const int along = one.tip(Dof::uz);
    EXPECT_NEAR(one.displacements()[along], other.displacements()[along], 1e-12);
  }
}

// A moderate step into yielding; materials with a continuous slope between corners.
TEST(FibreColumn, ConvergesQuadratically) {
  FibreColumn column(reinforced("menegotto_pinto"), {.geometry = FrameGeometry::corotational}, height, 1, 2);
  column.set_load(Dof::uz, -weight);
  column.apply_load();
  for (int i = 1; i <= 8; ++i) {
    column.step({{Dof::ux, 0.004 * i}});
    const std::vector<double>& changes = column.changes;
    EXPECT_LE(changes.size(), 9u) << i;
    // The last two steps below 1e-3; the constant depends on the curvature of the laws.
    const std::size_t n = changes.size();
    EXPECT_LT(changes[n - 1], std::max(1e-15, 2e3 * changes[n - 2] * changes[n - 2])) << i;
  }
}

// An unconfined column that loses its strength, with five points so fast that its force jumps.
TEST(FibreColumn, SoftensAsInAnIndependentProgram) {
  test::Book book("Fibre members: a softening column", "an independent implementation", "digits of the reference");
  auto materials = test::column_materials("steel01");
  materials[0] = materials[1];
  sections::RcRectangle dimensions = test::column_dimensions();
  dimensions.top = dimensions.bottom = {2, 3e-4};
  dimensions.sides = {2, 2e-4};
  const auto section = std::make_shared<sections::FibreSection>(materials, sections::rc_rectangle(dimensions));
  const struct {
    const char* name;
    IntegrationRule rule;
    std::vector<double> expected;
  } cases[] = {{"3 Lobatto points: tip force at 10, 20, 30, 45, 60 mm [N]",
                lobatto(3),
                {54168.24695, 73453.88832, 78687.6681, 58830.93431, 19803.28297}},
               {"5 Lobatto points: tip force at 10, 20, 30, 45, 60 mm [N]",
                lobatto(5),
                {55518.13948, 76675.94304, 15062.72328, -3575.268255, -12216.13842}},
               {"Radau hinges of 0.2 m: tip force at 10, 20, 30, 45, 60 mm [N]",
                hinge_radau(0.2 / 3, 0.2 / 3),
                {55394.20988, 76510.46513, 38702.2684, 544.8253811, -11107.32418}},
               {"Radau hinges of 0.3 m: tip force at 10, 20, 30, 45, 60 mm [N]",
                hinge_radau(0.1, 0.1),
                {55191.18531, 75837.17863, 75914.07356, 18346.97104, -4560.050767}}};
  for (const auto& [name, rule, expected] : cases) {
    FibreColumn column(section, {.rule = rule, .geometry = FrameGeometry::corotational}, height, 1, 2);
    column.set_load(Dof::uz, -150e3 * 9.80665);
    column.apply_load();
    std::size_t next = 0;
    for (int i = 1; i <= 240; ++i) {
      const double force = column.step({{Dof::ux, 0.00025 * i}}, 200)[0];
      for (const int at : {40, 80, 120, 180, 240})
        if (i == at) book.near(name, force, expected[next++], 1e-9 * 1e5);
    }
  }
}

}  // namespace fibre_column_test
}  // namespace pounding
