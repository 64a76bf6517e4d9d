// The structure made from a frame: floors, shears, supports, state at rest, reports, contact points.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/input/frames/frame_input.hpp>
#include <pounding/structures/elastic_forces.hpp>
#include "support/book.hpp"
#include "support/dense.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace frame_structure_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Structure structure(const std::string& yaml) { return read_frame_structure(Input::read_text(yaml, "test.yaml")); }

int unknown(const Structure& s, const std::string& label) {
  const auto found = std::find(s.unknowns.begin(), s.unknowns.end(), label);
  if (found == s.unknowns.end()) throw std::logic_error("no unknown " + label);
  return static_cast<int>(found - s.unknowns.begin());
}

VectorXd solve(const Structure& s, const VectorXd& load) { return test::dense::solve(s.stiffness, load); }

double relative(const SparseMatrix& a, const SparseMatrix& b) { return (a - b).norm() / b.norm(); }

void refused(const std::function<void()>& act, const test::Facts& facts,
             std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal(act), "", facts, line);
}

const std::string material = "material: {E: 30 GPa}\n";
const std::string column = "{rectangle: [0.4, 0.4], shear: false}";
// Very stiff beams: each column is a storey spring of 12 EI/h^3.
const std::string shear_grid =
    material + "grid: {storeys: 2, bays: 2, storey_height: [4 m, 3 m], bay_width: [5 m, 6 m], columns: " + column +
    ", beams: {area: 1e3, inertia_y: 1e3}, floor_mass: [30 t, 20 t], rigid_floors: true}\n";
const std::string space_grid =
    material +
    "grid: {storeys: 2, bays: [2, 1], storey_height: 3 m, bay_width: {x: [5 m, 6 m], y: 4 m}, columns: " + column +
    ", beams: {rectangle: [0.3, 0.5]}, floor_mass: [30 t, 20 t]}\n";

TEST(FrameStructure, AGridIsTheSameFrameByLists) {
  const std::string by_grid =
      material + "grid: {storeys: 1, bays: 2, storey_height: 3 m, bay_width: [5 m, 6 m], columns: " + column +
      ", beams: " + column + ", floor_mass: 22 t}\n";
  const std::string by_lists = material + "sections: {s: " + column + "}\n" +
                               "nodes: {a: [0, 0], b: [5, 0], c: [11, 0], d: [0, 3], e: [5, 3], f: [11, 3]}\n"
                               "members: {1: {between: [a, d], section: s}, 2: {between: [d, e], section: s}, 3: "
                               "{between: [b, e], section: s},\n"
                               "          4: {between: [e, f], section: s}, 5: {between: [c, f], section: s}}\n"
                               "supports: {a: fixed, b: fixed, c: fixed}\n"
                               "masses: {d: 5 t, e: 11 t, f: 6 t}\n"
                               "floors: [{nodes: [d, e, f]}]\n";
  const Structure grid = structure(by_grid), lists = structure(by_lists);
  EXPECT_LT(relative(grid.stiffness, lists.stiffness), 1e-14);
  EXPECT_LT(relative(grid.mass, lists.mass), 1e-14);
  EXPECT_LT((grid.floors[0].storey_shear[0] - lists.floors[0].storey_shear[0]).norm(),
            1e-14 * lists.floors[0].storey_shear[0].norm());
  EXPECT_DOUBLE_EQ(grid.floors[0].mass, lists.floors[0].mass);
}

TEST(FrameStructure, AGridIsTheGridOfTheLibrary) {
  GridFrame grid;
  grid.storeys = grid.bays_x = 2;
  grid.bays_y = 1;
  grid.storey_height = {3};
  grid.bay_width_x = {5, 6};
  grid.bay_width_y = {4};
  grid.column = without_shear_deformation(rectangle_section(0.4, 0.4));
  grid.beam = rectangle_section(0.3, 0.5);
  grid.material = {.young = 30e9, .shear = 30e9 / 2.4};
  grid.floor_mass = {30e3, 20e3};
  grid.rigid_floors = true;
  const AssembledFrame frame = make_frame(grid).assemble();
  const Structure s = structure(space_grid);
  EXPECT_LT(relative(s.stiffness, frame.stiffness), 1e-13);
  EXPECT_LT(relative(s.mass, frame.mass), 1e-13);
  EXPECT_EQ(s.dimension, 3);
  EXPECT_FALSE(s.is_free);
}

TEST(FrameStructure, FloorsHaveMassElevationAndMotion) {
  const Structure s = structure(shear_grid);
  ASSERT_EQ(s.floors.size(), 2u);
  EXPECT_EQ(s.floors[0].label, "1");
  EXPECT_NEAR(s.floors[0].mass, 30e3, 1e-8);
  EXPECT_NEAR(s.floors[1].mass, 20e3, 1e-8);
  EXPECT_EQ(s.floors[1].elevation, 7);
  ASSERT_EQ(s.floors[1].motion.size(), 1u);
  EXPECT_EQ(s.floors[1].motion[0].coeff(unknown(s, "node 2.0 ux")), 1);
  EXPECT_EQ(s.floors[1].motion[0].nonZeros(), 1);
}

TEST(FrameStructure, MembersWithDensityWeighOnTheirFloors) {
  test::Book book("Frames as structures: floors, shears, weight",
                  "masses of a beam and of the upper halves of two columns", "rounding");
  const Structure s = structure(
      "material: {E: 30 GPa, density: 2500 kg/m^3}\n"
      "grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {area: 0.1, inertia_y: 1e-3}, beams: "
      "{area: 0.2, inertia_y: 1e-3}}\n");
  book.near("mass of a floor [kg]", s.floors[0].mass, 2500 * (0.2 * 6 + 2 * 0.1 * 1.5), 1e-9);
}

// Stiff beams.
TEST(FrameStructure, StoreyShearIsStiffnessTimesDriftAndTheLoadAbove) {
  test::Book book("Frames as structures: floors, shears, weight", "statics: the load above; three columns of 12 EI/h^3",
                  "round-off for statics; the beams bend by about EI/h of a column over EI/L of a beam, 3e-6");
  const Structure s = structure(shear_grid);
  VectorXd load = VectorXd::Zero(s.size());
  load += 10e3 * s.floors[0].motion[0] + 7e3 * s.floors[1].motion[0];
  const VectorXd q = solve(s, load);
  const double first = s.floors[0].storey_shear[0].dot(q), second = s.floors[1].storey_shear[0].dot(q);
  book.near("shear of the second storey [N]", second, 7e3, 1e-4);
  book.near("shear of the first storey [N]", first, 17e3, 1e-4);
  // Columns are inextensible here; otherwise the stiff floors would tilt.
  const Structure stocky = structure(
      std::string(shear_grid).replace(shear_grid.find(column), column.size(), "{area: 1e3, inertia_y: 2e-3}"));
  const VectorXd p = solve(stocky, load);
  const double sway_1 = stocky.floors[0].motion[0].dot(p), sway_2 = stocky.floors[1].motion[0].dot(p) - sway_1;
  book.near("stiffness times drift of the first storey [N]", 3 * 12 * 60e6 / 64 * sway_1, 17e3, 3e-5 * 17e3);
  book.near("stiffness times drift of the second storey [N]", 3 * 12 * 60e6 / 27 * sway_2, 7e3, 3e-5 * 7e3);
}

TEST(FrameStructure, StoreyShearOfABracedSplayedFrameIsTheLoadAbove) {
  test::Book book("Frames as structures: floors, shears, weight",
                  "statics: the loads above, with inclined legs, a brace, a spring that spans the storey, columns "
                  "drawn downwards",
                  "rounding");
  const Structure s = structure(
      "dimension: 3\n" + material +
      "sections: {s: {rectangle: [0.4, 0.3]}}\n"
      "nodes: {a: [0, 0, 0], b: [8, 0, 0], c: [8, 7, 0.5], d: [0, 7, 0], e: [1, 1, 3], f: [7, 1, 3], g: [7, 6, 3], h: "
      "[1, 6, 3]}\n"
      "members: {1: {between: [e, a], section: s}, 2: {between: [b, f], section: s, offsets: {end: [0, 0, -0.3 m]}},\n"
      "  3: {between: [c, g], section: s}, 4: {between: [h, d], section: s}, 5: {between: [e, f], section: s},\n"
      "  6: {between: [f, g], section: s}, 7: {between: [g, h], section: s}, 8: {between: [h, e], section: s},\n"
      "  9: {between: [a, f], truss: 20 cm^2}, 10: {between: [g, d], truss: 20 cm^2}}\n"
      "springs: [{between: [b, g], dof: uy, stiffness: 5 MN/m}]\n"
      "supports: {a: fixed, b: pinned, c: fixed, d: fixed}\n"
      "masses: {e: 3 t, f: 4 t, g: 5 t, h: 6 t}\n"
      "floors: [{nodes: [e, f, g, h], rigid: false}]\n");
  VectorXd load = VectorXd::Zero(s.size());
  load[unknown(s, "node e ux")] = 10e3;
  load[unknown(s, "node g uy")] = -4e3;
  load[unknown(s, "node h uz")] = -9e3;
  const VectorXd q = solve(s, load);
  ASSERT_EQ(s.floors[0].storey_shear.size(), 2u);
  book.near("shear of a braced storey along x [N]", s.floors[0].storey_shear[0].dot(q), 10e3, 1e-5);
  book.near("shear of a braced storey along y [N]", s.floors[0].storey_shear[1].dot(q), -4e3, 1e-5);
}

// Cut at 2 m: forces above count, forces below do not.
TEST(FrameStructure, AStoreyIsCutAtItsMiddleHeight) {
  const Structure s = structure(material +
                                "nodes: {foot: [0, 0], low: [0, 1], high: [0, 3], top: [0, 4]}\n"
                                "sections: {s: {rectangle: [0.4, 0.4]}}\n"
                                "members: {1: {between: [foot, low], section: s}, 2: {between: [low, high], section: "
                                "s}, 3: {between: [high, top], section: s}}\n"
                                "supports: {foot: fixed}\nmasses: {top: 1 t}\nfloors: [{nodes: [top]}]\n");
  const Row& shear = s.floors[0].storey_shear[0];
  for (const auto& [label, expected] :
       {std::pair("node low ux", 0.0), std::pair("node high ux", 1e3), std::pair("node top ux", 1e3)}) {
    VectorXd load = VectorXd::Zero(s.size());
    load[unknown(s, label)] = 1e3;
    EXPECT_NEAR(shear.dot(solve(s, load)), expected, 1e-7) << label;
  }
}

// A slab on bearings: the storey below the slab has no height.
TEST(FrameStructure, BearingsWithoutHeightAreAStorey) {
  const Structure s = structure(material +
                                "sections: {s: {rectangle: [0.4, 0.4]}}\n"
                                "nodes: {ground: [0, 0], slab: [0, 0], roof: [0, 3]}\n"
                                "members: {c: {between: [slab, roof], section: s}}\n"
                                "springs: [{between: [ground, slab], dof: ux, stiffness: 2 MN/m}, {between: [ground, "
                                "slab], dof: uz, stiffness: 1 GN/m},\n"
                                "          {between: [ground, slab], dof: ry, stiffness: 1 GN m}]\n"
                                "supports: {ground: fixed}\nmasses: {slab: 10 t, roof: 10 t}\n"
                                "floors: [{nodes: [slab]}, {nodes: [roof]}]\n");
  VectorXd load = VectorXd::Zero(s.size());
  load[unknown(s, "node slab ux")] = 3e3;
  load[unknown(s, "node roof ux")] = 1e3;
  const VectorXd q = solve(s, load);
  EXPECT_NEAR(s.floors[0].storey_shear[0].dot(q), 4e3, 1e-6);
  EXPECT_NEAR(s.floors[0].storey_shear[0].dot(q), 2e6 * s.floors[0].motion[0].dot(q), 1e-6);
  EXPECT_NEAR(s.floors[1].storey_shear[0].dot(q), 1e3, 1e-6);
}

TEST(FrameStructure, AFlexibleFloorInSpaceMovesAsItsMassesOnAverage) {
  std::string yaml = space_grid;
  yaml.replace(yaml.find("floor_mass"), 0, "rigid_floors: false, ");
  const Structure s = structure(yaml);
  // The floor moves as a rigid body: a shift and a small rotation about the origin.
  const double angle = 1e-3, shift = 0.02;
  VectorXd q = VectorXd::Zero(s.size());
  for (std::size_t node = 0; node < s.geometry.positions.size(); ++node) {
    if (s.geometry.floor_of_node[node] != 0) continue;
    const Vector3d& at = s.geometry.positions[node];
    q[unknown(s, "node " + s.geometry.node_names[node] + " ux")] = shift - angle * at.y();
    q[unknown(s, "node " + s.geometry.node_names[node] + " uy")] = angle * at.x();
  }
  // Centre of mass by tributary half bays: x = (0 x 2.5 + 5 x 5.5 + 11 x 3)/11 = 5.5, y = 2.
  ASSERT_EQ(s.floors[0].motion.size(), 3u);
  EXPECT_NEAR(s.floors[0].motion[0].dot(q), shift - angle * 2, 1e-12);
  EXPECT_NEAR(s.floors[0].motion[1].dot(q), angle * 5.5, 1e-12);
  EXPECT_NEAR(s.floors[0].motion[2].dot(q), angle, 1e-12);
}

TEST(FrameStructure, OneSupportMovesTheWholeFrame) {
  const Structure s = structure(shear_grid);
  ASSERT_EQ(s.supports.size(), 1u);
  EXPECT_EQ(s.supports[0].name, "");
  EXPECT_NEAR((s.supports[0].position - Vector3d(16.0 / 3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(s.supports[0].load.col(0).sum(), 50e3, 1e-8);
  EXPECT_EQ(s.supports[0].influence(unknown(s, "node 1.0 ux"), 0), 1);
}

TEST(FrameStructure, SupportsThatDifferAddUpToTheWhole) {
  const Structure whole = structure(shear_grid + "springs: [{node: 2.0, dof: ux, stiffness: 3 MN/m}]\n");
  const Structure parts = structure(shear_grid +
                                    "springs: [{node: 2.0, dof: ux, stiffness: 3 MN/m}]\n"
                                    "supports: {0.2: {fix: fixed, delay: 0.1 s}}\n");
  ASSERT_EQ(parts.supports.size(), 2u);
  EXPECT_EQ(parts.supports[1].name, "0.2");
  EXPECT_EQ(parts.supports[1].delay, 0.1);
  EXPECT_EQ(parts.supports[1].position, Vector3d(11, 0, 0));
  const MatrixXd influence = parts.supports[0].influence + parts.supports[1].influence;
  const MatrixXd load = parts.supports[0].load + parts.supports[1].load;
  EXPECT_LT((influence - MatrixXd(whole.supports[0].influence)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((load - MatrixXd(whole.supports[0].load)).cwiseAbs().maxCoeff(), 1e-6 * 50e3);
  // The influence of one of three equal columns is less than that of the others together.
  EXPECT_LT(parts.supports[1].influence(unknown(parts, "node 1.0 ux"), 0), 0.5);
}

const std::string cantilever =
    "material: {E: 30 GPa}\nnodes: {foot: [0, 0], top: [0, 4 m]}\n"
    "members: {c: {between: [foot, top], section: {area: 0.1, inertia_y: 1e-3}}}\n"
    "supports: {foot: fixed}\nmasses: {top: 20 t}\nfloors: [{nodes: [top]}]\n";

TEST(FrameStructure, RestsWhereItsWeightTakesIt) {
  test::Book book("Frames as structures: floors, shears, weight", "a column: P L/(EA), H L^3/(3 EI)", "rounding");
  EXPECT_EQ(structure(cantilever).at_rest.size(), 0);
  const Structure s = structure(cantilever + "gravity: true\nloads: {top: {ux: 5 kN}}\n");
  const double weight = 20e3 * 9.80665;
  book.near("shortening by its weight [m]", s.at_rest[unknown(s, "node top uz")], -weight * 4 / (30e9 * 0.1), 1e-14);
  book.near("deflection by a force at its top [m]", s.at_rest[unknown(s, "node top ux")], 5e3 * 64 / (3 * 30e9 * 1e-3),
            1e-13);
  const Structure light = structure(cantilever + "gravity: false\nloads: {top: {ux: 5 kN}}\n");
  EXPECT_NEAR(light.at_rest[unknown(light, "node top uz")], 0, 1e-18);
  book.near("deflection without weight [m]", light.at_rest[unknown(light, "node top ux")], 5e3 * 64 / (3 * 30e9 * 1e-3),
            1e-13);
}

TEST(FrameStructure, PDeltaSoftensByTheWeight) {
  test::Book book("Frames as structures: floors, shears, weight",
                  "consistent geometric stiffness of a beam: 12 EI/L^3 - 6/5 P/L", "rounding");
  const Structure s = structure(cantilever + "geometry: p_delta\n");
  const int ux = unknown(s, "node top ux");
  const double weight = 20e3 * 9.80665;
  book.near("transverse stiffness under its weight [N/m]", s.stiffness.coeff(ux, ux), 12 * 30e6 / 64 - 1.2 * weight / 4,
            1e-5);
  EXPECT_THROW(structure("material: {E: 30 GPa}\nnodes: {foot: [0, 0], top: [0, 4 m]}\n"
                         "members: {c: {between: [foot, top], section: {area: 0.1, inertia_y: 1e-3}}}\n"
                         "supports: {foot: fixed}\nmasses: {top: 500 t}\ngeometry: p_delta\n"),
               InputError)
      << "the Euler load is 4.63 MN";
}

TEST(FrameStructure, ReportsNodesAndMembers) {
  const Structure s = structure(cantilever + "report: {nodes: [top], members: [c]}\n");
  EXPECT_EQ(s.nodes.names, std::vector<std::string>{"top"});
  EXPECT_EQ(s.nodes.directions, (std::vector<std::string>{"x", "z", "ry"}));
  EXPECT_EQ(s.reported_members, std::vector<int>{0});
  EXPECT_EQ(s.forces.components,
            (std::vector<std::string>{"start N", "start Vz", "start My", "end N", "end Vz", "end My"}));
  EXPECT_EQ(s.forces.places, (std::vector<int>{0, 2, 4, 6, 8, 10}));
  VectorXd load = VectorXd::Zero(s.size());
  load[unknown(s, "node top ux")] = 1e3;
  load[unknown(s, "node top uz")] = -2e3;
  const VectorXd q = solve(s, load);
  EXPECT_NEAR(s.nodes.motion[0][0].dot(q), 1e3 * 64 / (3 * 30e6), 1e-14);
  const VectorXd forces = s.forces.rows * q;
  const auto force = [&](int i) { return forces[i]; };
  // Local x up, local z along -x.
  EXPECT_NEAR(force(0), 2e3, 1e-8);
  EXPECT_NEAR(force(1), 1e3, 1e-8);
  EXPECT_NEAR(std::abs(force(2)), 4e3, 1e-8);
  EXPECT_NEAR(force(3), -2e3, 1e-8);
  EXPECT_NEAR(force(4), -1e3, 1e-8);
  EXPECT_NEAR(force(5), 0, 1e-8);
  // Moment equilibrium about y, with local z along -x and local y along y: the moment at the foot opposes the push.
  EXPECT_NEAR(force(2), -4e3, 1e-8);
  // The support opposes the push, carries the load and restrains the rotation of the foot.
  EXPECT_EQ(s.forces.supports, std::vector<std::string>{"foot"});
  EXPECT_EQ(s.forces.directions, (std::vector<std::string>{"x", "z", "ry"}));
  EXPECT_NEAR(force(6), -1e3, 1e-8);
  EXPECT_NEAR(force(7), 2e3, 1e-8);
  EXPECT_NEAR(force(8), -4e3, 1e-8);
}

TEST(FrameStructure, InSpaceAllTwelveEndForcesAreReported) {
  const Structure s = structure(space_grid + "report: {members: [beam y 1.2.0]}\n");
  EXPECT_EQ(s.forces.components.size(), 12u);
  EXPECT_EQ(s.forces.components[3], "start T");
  EXPECT_EQ(s.forces.components[11], "end Mz");
  EXPECT_EQ(s.nodes.directions.size(), 6u);
  EXPECT_EQ(s.nodes.names.size(), 18u) << "masters are excluded";
}

TEST(FrameStructure, HasAPicture) {
  const Structure s = structure(space_grid);
  EXPECT_EQ(s.geometry.node_names.size(), 18u);
  EXPECT_EQ(s.geometry.floor_of_node[0], -1);
  EXPECT_EQ(s.geometry.floor_of_node[17], 1);
  EXPECT_EQ(s.geometry.member_names[1], "beam x 1.0.0");
  EXPECT_EQ(s.geometry.members[1], (std::array<int, 2>{6, 7}));
  EXPECT_EQ(s.unknowns[unknown(s, "floor 2 rz")], "floor 2 rz");
  EXPECT_EQ(s.initial_velocity.size(), s.size());
}

// Contact points.

double motion(const ContactPoint& point, int direction, const VectorXd& q) { return point.motion[direction].dot(q); }

TEST(FrameSurface, AFloorInThePlaneIsTouchedAtItsOutermostNode) {
  const Structure s = structure(shear_grid + "origin: [10 m]\n");
  EXPECT_EQ(*s.surface->plan(), (std::array<double, 4>{10, 21, 0, 0}));
  const ContactPoint right = s.surface->floor(1, Side::plus_x, 0), left = s.surface->floor(1, Side::minus_x, 0);
  EXPECT_EQ(right.position, Vector3d(21, 0, 7));
  EXPECT_EQ(left.position, Vector3d(10, 0, 7));
  EXPECT_NEAR(right.mass, 20e3, 1e-8);
  EXPECT_EQ(right.motion[0].coeff(unknown(s, "node 2.0 ux")), 1);
  EXPECT_EQ(right.motion[2].coeff(unknown(s, "node 2.2 uz")), 1);
  EXPECT_EQ(right.motion[1].size(), s.size());
  EXPECT_EQ(right.motion[1].nonZeros(), 0);
  EXPECT_EQ(right.member, -1);
  refused([&] { s.surface->floor(1, Side::plus_y, 0); }, {"x"});
  refused([&] { s.surface->floor(2, Side::plus_x, 0); }, {"3", "2"});
}

TEST(FrameSurface, APointOnARigidFloorTurnsWithIt) {
  const Structure s = structure(space_grid);
  EXPECT_EQ(*s.surface->plan(), (std::array<double, 4>{0, 11, 0, 4}));
  EXPECT_EQ(s.surface->edge(0, Side::plus_x), (std::array<double, 2>{0, 4}));
  EXPECT_EQ(s.surface->edge(0, Side::minus_y), (std::array<double, 2>{0, 11}));
  VectorXd q = VectorXd::Zero(s.size());
  q[unknown(s, "floor 2 rz")] = 1e-3;
  const ContactPoint right = s.surface->floor(1, Side::plus_x, 3), back = s.surface->floor(1, Side::plus_y, 8);
  EXPECT_EQ(right.position, Vector3d(11, 3, 6));
  // The master is at (5.5, 2).
  EXPECT_NEAR(motion(right, 0, q), -1e-3 * (3 - 2), 1e-15);
  EXPECT_NEAR(motion(right, 1, q), 1e-3 * (11 - 5.5), 1e-15);
  EXPECT_NEAR(motion(back, 0, q), -1e-3 * (4 - 2), 1e-15);
  EXPECT_NEAR(motion(back, 1, q), 1e-3 * (8 - 5.5), 1e-15);
  // Corners move with their nodes.
  const ContactPoint corner = s.surface->floor(1, Side::plus_x, 4);
  EXPECT_NEAR(motion(corner, 0, q), -2e-3, 1e-15);
  // Vertical motion: linear between the nodes.
  VectorXd lift = VectorXd::Zero(s.size());
  lift[unknown(s, "node 2.2.0 uz")] = 0.02;
  lift[unknown(s, "node 2.2.1 uz")] = 0.04;
  EXPECT_NEAR(motion(right, 2, lift), 0.035, 1e-15);
  refused([&] { s.surface->floor(1, Side::plus_x, 5); }, {"0 mm", "4 m", "5 m", "2"});
}

TEST(FrameSurface, AFlexibleFloorIsTouchedOnItsEdgeBeam) {
  std::string yaml = space_grid;
  yaml.replace(yaml.find("floor_mass"), 0, "rigid_floors: false, ");
  const Structure light = structure(yaml);
  refused([&] { light.surface->floor(0, Side::plus_x, 2); }, {"masses: {1.2.0: {rz: 100 kg m^2}}", "mass: consistent"});
  EXPECT_EQ(light.surface->floor(0, Side::plus_x, 4).member, -1) << "no rotation at the node itself";
  const Structure s = structure(yaml + "masses: {1.2.0: {rz: 100}, 1.2.1: {rz: 100}}\n");
  const ContactPoint point = s.surface->floor(0, Side::plus_x, 1);
  EXPECT_EQ(s.geometry.member_names[point.member], "beam y 1.2.0");
  VectorXd q = VectorXd::Zero(s.size());
  q[unknown(s, "node 1.2.0 ux")] = q[unknown(s, "node 1.2.1 ux")] = 0.1;
  EXPECT_NEAR(motion(point, 0, q), 0.1, 1e-15);
  EXPECT_NEAR(point.mass, 30e3, 1e-8);
  // The end forces sum to minus the applied force.
  const Eigen::Matrix3d axes = beam_axes({0, 1, 0});
  const Vector3d ends = axes.transpose() * (point.fixed_ends.block<3, 1>(0, 0) + point.fixed_ends.block<3, 1>(6, 0));
  EXPECT_NEAR((ends - Vector3d(-1, 0, 0)).norm(), 0, 1e-12);
}

TEST(FrameSurface, AColumnIsTouchedBetweenItsFloors) {
  const std::string turning =
      "masses: {1.0: {ry: 50}, 1.1: {ry: 50}, 1.2: {ry: 50}, 2.0: {ry: 50}, 2.1: {ry: 50}, 2.2: {ry: 50}}\n";
  const Structure s = structure(shear_grid + turning);
  const ContactPoint point = s.surface->column(5.5, Side::plus_x, 0);
  EXPECT_EQ(point.position, Vector3d(11, 0, 5.5));
  EXPECT_EQ(s.geometry.member_names[point.member], "column 2.2");
  EXPECT_NEAR(point.mass, 25e3, 1e-8) << "midway between 30 t and 20 t";
  VectorXd q = VectorXd::Zero(s.size());
  q[unknown(s, "node 2.0 ux")] = 0.1;
  EXPECT_NEAR(motion(point, 0, q), 0.05, 1e-15) << "midway, by symmetry";
  const ContactPoint foot_side = s.surface->column(1, Side::minus_x, 0);
  EXPECT_EQ(s.geometry.member_names[foot_side.member], "column 1.0");
  EXPECT_NEAR(foot_side.mass, 30e3 / 4, 1e-8);
  const ContactPoint at_floor = s.surface->column(4, Side::plus_x, 0);
  EXPECT_EQ(at_floor.member, -1);
  EXPECT_EQ(at_floor.position, Vector3d(11, 0, 4));
  EXPECT_NEAR(at_floor.mass, 30e3, 1e-8);
  refused([&] { s.surface->column(7.5, Side::plus_x, 0); }, {"7.5 m", "0 mm", "7 m"});
  refused([&] { structure(shear_grid).surface->column(5.5, Side::plus_x, 0); },
          {"masses: {1.2: {ry: 100 kg m^2}}", "mass: consistent"});
}

TEST(FrameSurface, InSpaceTheColumnNearestToThePointIsTouched) {
  std::string turning = "masses: {";
  for (int storey : {1, 2})
    for (int i : {0, 1, 2})
      for (int k : {0, 1})
        turning += (turning.back() == '{' ? "" : ", ") + std::to_string(storey) + "." + std::to_string(i) + "." +
                   std::to_string(k) + ": {rx: 50, ry: 50}";
  const Structure s = structure(space_grid + turning + "}\n");
  EXPECT_EQ(s.geometry.member_names[s.surface->column(4, Side::plus_x, 0.5).member], "column 2.2.0");
  EXPECT_EQ(s.geometry.member_names[s.surface->column(4, Side::plus_x, 3.5).member], "column 2.2.1");
  EXPECT_EQ(s.geometry.member_names[s.surface->column(1, Side::plus_y, 6).member], "column 1.1.1");
}

// A rigid end zone of 0.5 m belongs to the column: there the point rotates with the node.
TEST(FrameSurface, ARigidEndOfAColumnMovesWithItsNode) {
  const Structure s = structure(
      "material: {E: 30 GPa}\nnodes: {foot: [0, 0], top: [0, 4 m]}\n"
      "members: {c: {between: [foot, top], section: {area: 0.1, inertia_y: 1e-3}, offsets: {end: [0, -0.5 m]}}}\n"
      "supports: {foot: fixed}\nmasses: {top: {ux: 20 t, uz: 20 t, ry: 100}}\nfloors: [{nodes: [top]}]\n");
  const ContactPoint point = s.surface->column(3.75, Side::plus_x, 0);
  EXPECT_EQ(point.member, -1);
  VectorXd q = VectorXd::Zero(s.size());
  q[unknown(s, "node top ry")] = 0.01;
  EXPECT_NEAR(motion(point, 0, q), -0.0025, 1e-15);
  EXPECT_EQ(s.surface->column(2, Side::plus_x, 0).member, 0);
}

TEST(FrameSurface, NodesAreTouchedByName) {
  const Structure s = structure(shear_grid);
  const ContactPoint point = s.surface->node("2.2");
  EXPECT_EQ(point.position, Vector3d(11, 0, 7));
  EXPECT_NEAR(point.mass, 20e3, 1e-8) << "the rigid floor moves with it";
  refused([&] { s.surface->node("2.3"); }, {"2.3", "2.0"});
}

// A rod on a rotational spring at its foot with a weight on top: unstable if the weight exceeds spring/length.
std::string inverted_pendulum(double weight, const std::string& more = "") {
  return "geometry: corotational\ngravity: true\nmaterial: {E: 1e9}\nsections: {s: {area: 1, inertia_y: 1}}\n"
         "nodes: {a: [0, 0], b: [0, 2]}\nmembers: {rod: {between: [a, b], section: s}}\n"
         "supports: {a: {fix: [ux, uz], springs: {ry: 4000}" +
         more + "}}\nmasses: {b: " + std::to_string(weight / 9.80665) + "}\nfloors: [{nodes: [b]}]\n";
}

TEST(TurningFrame, HasTheStiffnessOfItsStateAtRest) {
  const Structure s = structure(inverted_pendulum(500));
  ASSERT_TRUE(s.elastic);
  const MatrixXd k = s.stiffness;
  EXPECT_LT((MatrixXd(s.elastic->tangent(VectorXd::Zero(s.size()))) - k).norm(), 1e-14 * k.norm());
  EXPECT_EQ(s.elastic->force(VectorXd::Zero(s.size())), VectorXd::Zero(s.size()));
  EXPECT_EQ(s.elastic->energy(VectorXd::Zero(s.size())), 0);
  // Lateral stiffness at the top with all other unknowns free: k/L^2 - P/L.
  VectorXd load = VectorXd::Zero(s.size());
  load[unknown(s, "node b ux")] = 1;
  EXPECT_NEAR(1 / solve(s, load)[unknown(s, "node b ux")], 4000 / 4.0 - 500 / 2.0, 1e-2);
}

TEST(TurningFrame, ThatFallsOverIsRefusedWithWhatItCarries) {
  test::expect_message(test::refusal<InputError>([] { structure(inverted_pendulum(2500)); }),
                       "test.yaml:1:1: ", {"0.800"});
  structure(inverted_pendulum(1990));
}

TEST(TurningFrame, RefusesWhatItWouldShowWrong) {
  const auto portal = [](const std::string& foot) {
    return "geometry: corotational\nmaterial: {E: 30 GPa}\nsections: {s: {rectangle: [0.4, 0.4], shear: false}}\n"
           "nodes: {a: [0, 0], b: [0, 3], c: [5, 3], d: [5, 0]}\n"
           "members: {left: {between: [a, b], section: s}, beam: {between: [b, c], section: s}, right: {between: [d, "
           "c], section: s}}\n"
           "supports: {a: fixed, d: " +
           foot + "}\nmasses: {b: 1000, c: 1000}\nfloors: [{nodes: [b, c]}]\n";
  };
  test::expect_message(test::refusal<InputError>([&] { structure(portal("{fix: [ux, uz, ry], delay: 1 s}")); }),
                       "test.yaml:1:1: ", {"geometry: p_delta"});
  const Structure s = structure(portal("fixed"));
  refused([&] { s.supports_along({1, 0, 0}); }, {"geometry: p_delta"});
  EXPECT_EQ(s.supports_along({0, 0, 1}).size(), 1u);
  refused([&] { s.surface->column(1.5, Side::plus_x, 0); }, {"geometry: corotational"});
  EXPECT_GT(s.surface->column(3, Side::plus_x, 0).mass, 0);
}

// A rigid rotation changes no forces of the rotated members about the state of rest; only their axes rotate.
TEST(TurningFrame, TrussesTurnToo) {
  const Structure s = structure(
      "geometry: corotational\nmaterial: {E: 1e9}\nsections: {s: {area: 0.01, inertia_y: 1e-5}}\n"
      "nodes: {a: [0, 0], b: [3, 4]}\nmembers: {bar: {between: [a, b], truss: 0.01}}\n"
      "supports: {a: pinned, b: {springs: {ux: 1, uz: 1}}}\nmasses: {b: 1000}\nreport: {members: all}\n");
  // From (3, 4) to (-4, 3): a quarter turn without strain; only the springs act.
  VectorXd u = VectorXd::Zero(s.size());
  u[unknown(s, "node b ux")] = -7;
  u[unknown(s, "node b uz")] = -1;
  EXPECT_NEAR(s.elastic->energy(u), 0.5 * (49 + 1), 1e-6);
  EXPECT_LT((s.elastic->force(u) - u).norm(), 1e-6);
  u *= 1.1;  // further: to (-4.7, 2.9)
  const double stretch = std::hypot(4.7, 2.9) - 5, force = 1e7 / 5 * stretch;
  ASSERT_EQ(s.forces.components.size(), 6u);
  VectorXd forces = s.forces.nonlinear(u, {});
  if (s.forces.rows.rows() > 0) forces += s.forces.rows * u + s.forces.at_rest;
  const VectorXd ends = forces.head(6);
  EXPECT_NEAR(ends[0], -force, 1e-6 * std::abs(force));
  EXPECT_NEAR(ends[3], force, 1e-6 * std::abs(force));
  EXPECT_NEAR(ends[4], 0, 1e-6 * std::abs(force));
}

}  // namespace frame_structure_test
}  // namespace pounding
