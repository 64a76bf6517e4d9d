// Grids with members that differ.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace grid_frame_test {

using test::refusal;

const Material concrete = isotropic(30e9, 2500);

GridFrame plane() {
  return {.storeys = 3,
          .bays_x = 2,
          .storey_height = {4, 3, 3},
          .bay_width_x = {6, 5},
          .column = rectangle_section(0.5, 0.5),
          .beam = rectangle_section(0.3, 0.6),
          .material = concrete,
          .floor_mass = {60e3}};
}

const Section& section_of(const Frame& frame, const std::string& name) {
  for (int member = 0; member < frame.members(); ++member)
    if (frame.member_name(member) == name) return frame.beam(member).section();
  throw std::invalid_argument("no member " + name);
}

double depth(const Section& section) { return std::sqrt(12 * section.inertia_y / section.area); }

TEST(GridFrame, HasColumnsByStoreyAndBeamsByLine) {
  GridFrame grid = plane();
  const Section c60 = rectangle_section(0.6, 0.6), c50 = rectangle_section(0.5, 0.5), c40 = rectangle_section(0.4, 0.4);
  const Section b60 = rectangle_section(0.3, 0.6), b50 = rectangle_section(0.3, 0.5);
  grid.column = std::vector<Section>{c60, c50, c40};
  grid.beam = std::vector<std::vector<Section>>{{b60, b50}};
  const Frame frame = make_frame(grid);
  EXPECT_NEAR(depth(section_of(frame, "column 1.0")), 0.6, 1e-12);
  EXPECT_NEAR(depth(section_of(frame, "column 2.2")), 0.5, 1e-12);
  EXPECT_NEAR(depth(section_of(frame, "column 3.1")), 0.4, 1e-12);
  EXPECT_NEAR(depth(section_of(frame, "beam x 3.0")), 0.6, 1e-12);
  EXPECT_NEAR(depth(section_of(frame, "beam x 1.1")), 0.5, 1e-12);
}

TEST(GridFrame, RefusesListsThatAreTooLong) {
  GridFrame grid = plane();
  const Section c = rectangle_section(0.5, 0.5);
  grid.column = std::vector<Section>{c, c};
  EXPECT_TRUE(test::mentions(refusal([&] { make_frame(grid); }), {"3"}));
  grid.column = std::vector<std::vector<Section>>{{c, c}};
  EXPECT_TRUE(test::mentions(refusal([&] { make_frame(grid); }), {"3"}));
  grid.column = c;
  grid.members["column 4.0"] = {.section = c};
  EXPECT_TRUE(test::mentions(refusal([&] { make_frame(grid); }), {"column 4.0", "column 1.0"}));
}

// Static condensation: cutting a column changes neither its stiffness nor, with its mass lumped at floors, any period.
TEST(GridFrame, CutMembersAreAsStiffAsWholeOnes) {
  GridFrame whole = plane(), cut = plane();
  whole.material.density = cut.material.density = 0;
  cut.members["column 2.0"] = {.parts = 3};
  cut.members["beam x 1.1"] = {.parts = 2};
  EXPECT_EQ(make_frame(cut).nodes(), make_frame(whole).nodes() + 3);
  EXPECT_EQ(make_frame(cut).members(), make_frame(whole).members() + 3);
  EXPECT_EQ(make_frame(cut).node_name(make_frame(whole).nodes() + 0), "beam x 1.1/1");
  const auto roof = [](const GridFrame& grid) {
    Frame frame = make_frame(grid);
    frame.add_load(grid.node(3, 0), Dof::ux, 1e5);
    const AssembledFrame made = frame.assemble();
    const Eigen::VectorXd q = frame.rest(made);
    return made.motion(grid.node(3, 2), Dof::ux).dot(q);
  };
  EXPECT_NEAR(roof(cut), roof(whole), 1e-9 * roof(whole));
}

// The mass of the parts decreases, yet two floors still collide. A floor loses the mass that the nodes of the cut take.
TEST(GridFrame, CutColumnsAreHitWithTheMassOfTheirFloors) {
  const auto hit = [](int parts, double elevation) {
    GridFrame grid = plane();
    grid.mass = BeamMass::consistent;
    grid.members["column 2.2"] = {.parts = parts};
    return make_structure(grid).surface->column(elevation, Side::plus_x, 0).mass;
  };
  for (const double elevation : {4.1, 5.5, 6.9}) {
    const double whole = hit(1, elevation);
    EXPECT_GT(whole, 60e3);
    for (const int parts : {2, 3, 8})
      EXPECT_NEAR(hit(parts, elevation), whole, 1.2e3) << parts << " parts, " << elevation << " m up";
  }
  EXPECT_NEAR(hit(2, 5.5), 0.5 * (hit(2, 4) + hit(2, 7)), 1e-6) << "at the node between the parts";
}

TEST(GridFrame, AMemberMayHaveItsOwnSectionMaterialAndReleases) {
  GridFrame grid = plane(), hinged = plane();
  grid.members["column 1.1"] = {.section = rectangle_section(0.8, 0.8), .material = isotropic(35e9, 2500)};
  EXPECT_NEAR(depth(section_of(make_frame(grid), "column 1.1")), 0.8, 1e-12);
  EXPECT_NEAR(depth(section_of(make_frame(grid), "column 1.0")), 0.5, 1e-12);
  hinged.members["column 1.1"] = {.options = BeamOptions{.start_releases = {Dof::ry}}, .parts = 2};
  const Frame frame = make_frame(hinged);
  const AssembledFrame made = frame.assemble();
  EXPECT_NO_THROW(frame.rest(made));
}

TEST(GridFrame, MastersOfRigidFloorsComeAfterTheNodesOfCuts) {
  GridFrame grid{.storeys = 2,
                 .bays_x = 1,
                 .bays_y = 1,
                 .storey_height = {3},
                 .bay_width_x = {6},
                 .bay_width_y = {5},
                 .column = rectangle_section(0.5, 0.5),
                 .beam = rectangle_section(0.3, 0.6),
                 .material = concrete,
                 .floor_mass = {60e3},
                 .rigid_floors = true};
  grid.members["column 1.0.0"] = {.parts = 3};
  const FrameModel model = make_frame_model(grid);
  EXPECT_EQ(model.floors[0].master, grid.floor(1));
  EXPECT_EQ(model.floors[1].master, grid.floor(2));
}

}  // namespace grid_frame_test
}  // namespace pounding
