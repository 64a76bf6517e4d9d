// Meaning of the input of a frame, and the report of each mistake in it.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/input/frame_input.hpp>

namespace pounding {
namespace frame_input_test {

// Line 1 is the material.
const std::string portal =
    "material: {E: 30 GPa}\n"
    "sections: {s: {rectangle: [0.4 m, 40 cm]}}\n"
    "nodes: {a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], d: [6 m, 0]}\n"
    "members:\n"
    "  left: {between: [a, b], section: s}\n"
    "  beam: {between: [b, c], section: s}\n"
    "  right: {between: [d, c], section: s}\n"
    "supports: {a: fixed, d: pinned}\n"
    "masses: {b: 10 t, c: 10 t}\n"
    "floors: [{nodes: [b, c]}]\n";

const std::string grid =
    "material: {E: 30 GPa}\n"
    "grid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4]},\n"
    "       beams: {rectangle: [0.3, 0.5]}, floor_mass: 20 t}\n";

std::string with(std::string yaml, const std::string& from, const std::string& to) {
  const std::size_t at = yaml.find(from);
  if (at == std::string::npos) throw std::logic_error("the test replaces what is not there: " + from);
  return yaml.replace(at, from.size(), to);
}

FrameModel read(const std::string& yaml) { return read_frame(Input::read_text(yaml, "test.yaml")).model; }

Structure structure(const std::string& yaml) { return read_frame_structure(Input::read_text(yaml, "test.yaml")); }

// `message` is the whole text after the name of the file.
void refused(const std::string& yaml, const std::string& message) {
  try {
    structure(yaml);
    ADD_FAILURE() << "this was taken:\n" << yaml << "\nnot refused: " << message;
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), "test.yaml:" + message) << yaml;
  }
}

double stiffness(const Structure& s, const std::string& a, const std::string& b) {
  int i = -1, j = -1;
  for (int k = 0; k < s.size(); ++k) {
    if (s.unknowns[k] == a) i = k;
    if (s.unknowns[k] == b) j = k;
  }
  if (i < 0 || j < 0) throw std::logic_error("no unknown " + a + " or " + b);
  return s.stiffness.coeff(i, j);
}

TEST(FrameInput, ListsMakeAFrame) {
  const FrameModel m = read(portal);
  EXPECT_EQ(m.frame.dimension(), 2);
  EXPECT_EQ(m.frame.nodes(), 4);
  EXPECT_EQ(m.frame.members(), 3);
  EXPECT_EQ(m.frame.node_name(1), "b");
  EXPECT_EQ(m.frame.member_name(2), "right");
  EXPECT_EQ(m.frame.position(2), Eigen::Vector3d(6, 0, 3));
  ASSERT_EQ(m.floors.size(), 1u);
  EXPECT_EQ(m.floors[0].label, "1");
  EXPECT_EQ(m.floors[0].elevation, 3);
  EXPECT_EQ(m.floors[0].master, -1);
  ASSERT_EQ(m.supports.size(), 1u);
  EXPECT_EQ(m.supports[0].nodes, (std::vector<int>{0, 3}));
  EXPECT_EQ(structure(portal).nodes.names.size(), 4u);
  EXPECT_TRUE(m.reported_members.empty());
  EXPECT_FALSE(m.has_gravity() || m.is_loaded());
  EXPECT_EQ(m.geometry, FrameGeometry::linear);
}

TEST(FrameInput, UnitsAreRead) {
  const Structure one = structure(portal);
  std::string in_millimetres = with(portal, "[0.4 m, 40 cm]", "[400 mm, 0.4]");
  in_millimetres = with(with(in_millimetres, "30 GPa", "3e10"), "[6 m, 3 m]", "[6000 mm, 300 cm]");
  in_millimetres = with(in_millimetres, "b: 10 t", "b: 10000 kg");
  const Structure other = structure(in_millimetres);
  EXPECT_LT((one.stiffness - other.stiffness).norm(), 1e-12 * one.stiffness.norm());
  EXPECT_LT((one.mass - other.mass).norm(), 1e-12 * one.mass.norm());
  refused(with(portal, "30 GPa", "30 kN"), "1:15: material.E: takes a stress such as \"30 GPa\"; \"30 kN\" is a force");
}

TEST(FrameInput, DimensionFollowsFromWhatIsGiven) {
  EXPECT_EQ(read(portal + "dimension: 2\n").frame.dimension(), 2);
  EXPECT_EQ(read(with(with(grid, "bays: 1", "bays: [1, 2]"), "bay_width: 6 m", "bay_width: {x: 6 m, y: [5 m, 4 m]}"))
                .frame.dimension(),
            3);
  refused(with(portal, "c: [6 m, 3 m]", "c: [6 m, 0, 3 m]") + "dimension: 2\n",
          "3:36: nodes.c: is for a frame in space, and its dimension is given as 2; type dimension: 3, or leave y out");
  refused(with(portal, "c: [6 m, 3 m]", "c: [6 m, 0, 3 m]"),
          "3:12: nodes.a: takes [x, y, z] in a frame in space; type [0, 0, 3 m]");
  refused(portal + "dimension: 4\n", "11:12: dimension: takes an integer from 2 to 3; \"4\" is outside");
}

TEST(FrameInput, OriginMovesEverything) {
  const FrameModel m = read(portal + "origin: [12 m, 1 m]\n");
  EXPECT_EQ(m.frame.position(2), Eigen::Vector3d(18, 0, 4));
  EXPECT_EQ(m.floors[0].elevation, 4);
  EXPECT_EQ(read(portal + "origin: [12 m]\n").frame.position(0), Eigen::Vector3d(12, 0, 0));
  EXPECT_EQ(read(grid + "origin: [12 m, 1 m]\n").floors[1].elevation, 7);
  const std::string marked = with(portal, "floors: [{nodes: [b, c]}]", "floors: [{nodes: [b, c], elevation: 3.1 m}]");
  EXPECT_EQ(read(marked + "origin: [12 m, 1 m]\n").floors[0].elevation, 4.1);
  refused(portal + "origin: 12 m\n", "11:9: origin: takes [x] or [x, z]; type origin: [12 m, 0]");
}

TEST(FrameInput, MaterialsAreNamedOrGivenInPlace) {
  const std::string base = "materials: {soft: {E: 10 GPa}}\n" + with(portal, "{E: 30 GPa}", "soft");
  EXPECT_NEAR(
      stiffness(structure(base), "node b ry", "node b ry") / stiffness(structure(portal), "node b ry", "node b ry"),
      1.0 / 3, 1e-12);
  const Structure mixed = structure(with(base, "[b, c], section: s", "[b, c], section: s, material: {E: 20 GPa}"));
  EXPECT_GT(stiffness(mixed, "node b ry", "node b ry"), stiffness(structure(base), "node b ry", "node b ry"));
  refused(with(base, "material: soft", "material: sofd"),
          "2:11: material: unknown material \"sofd\". Did you mean \"soft\"?");
  refused(with(portal, "material: {E: 30 GPa}\n", "\n"),
          "5:9: members.left: the material is missing; type material: {E: 30 GPa} in the frame, for all members");
  refused(with(portal, "{E: 30 GPa}", "{E: 30 GPa, G: 12 GPa, poisson: 0.2}"),
          "1:34: material.poisson: G and poisson both set the shear modulus; keep one of them");
  refused(with(portal, "{E: 30 GPa}", "{E: 30 GPa, rho: 2500}"),
          "1:23: material: unknown key \"rho\". Did you mean \"density\"?");
  refused(with(portal, "{E: 30 GPa}", "{density: 2500 kg/m^3}"),
          "1:11: material: key \"E\" is missing; type \"E: 30 GPa\"");
}

TEST(FrameInput, SectionsHaveOneShapeOrNumbers) {
  const auto section = [](const std::string& text) { return with(portal, "{rectangle: [0.4 m, 40 cm]}", text); };
  const double gross = stiffness(structure(section("{rectangle: [0.4, 0.4], shear: false}")), "node b ry", "node c ry");
  const double ei = 30e9 * std::pow(0.4, 4) / 12;
  EXPECT_NEAR(gross, 2 * ei / 6, 1e-9 * gross);
  EXPECT_NEAR(stiffness(structure(section("{area: 0.16 m^2, inertia_y: 2.1e9 mm^4}")), "node b ry", "node c ry"),
              2 * 30e9 * 2.1e-3 / 6, 1);
  EXPECT_NEAR(
      stiffness(structure(section("{rectangle: [0.4, 0.4], shear: false, stiffness: 0.5}")), "node b ry", "node c ry"),
      gross / 2, 1e-9 * gross);
  EXPECT_LT(stiffness(structure(section("{rectangle: [0.4, 0.4]}")), "node b ry", "node c ry"), gross);
  for (const char* shape : {"{circle: 0.5 m}", "{tube: {diameter: 0.5 m, thickness: 10 mm}}",
                            "{i_section: {depth: 300 mm, width: 150 mm, flange: 10.7 mm, web: 7.1 mm}}",
                            "{area: 0.16, inertia_y: 2e-3, shear_area_z: 0.13, shear: true}"})
    EXPECT_NO_THROW(structure(section(shape))) << shape;

  refused(section("{rectangle: [0.4, 0.4], circle: 1}"),
          "2:39: sections.s.circle: a section has one shape, and a rectangle is given too; keep one of the two");
  refused(section("{rectangle: [0.4, 0.4], area: 1}"),
          "2:39: sections.s.area: follows from the rectangle; leave it out, or give numbers only");
  refused(section("{}"),
          "2:15: sections.s: the shape is missing; type rectangle: [0.4 m, 0.6 m], or area: 0.16 m^2 with inertia_y: "
          "2.1e-3 m^4");
  refused(section("{rectangel: [0.4, 0.4]}"),
          "2:16: sections.s: unknown key \"rectangel\". Did you mean \"rectangle\"?");
  refused(section("{rectangle: 0.4}"),
          "2:27: sections.s.rectangle: takes [width, depth]; type rectangle: [0.4 m, 0.6 m]");
  refused(section("{tube: {diameter: 0.5, thickness: 0.3}}"),
          "2:22: sections.s.tube: thickness must be less than half the diameter");
  refused(section("{area: 1, inertia_y: 1, shear: true}"),
          "2:46: sections.s.shear: needs shear_area_z; type shear_area_z: 0.13 m^2");
  refused(section("{area: 1}"), "2:15: sections.s: key \"inertia_y\" is missing; type \"inertia_y: 2.1e-3 m^4\"");
  refused(section("{circle: 0.5 m, stiffness: 0}"),
          "2:42: sections.s.stiffness: takes a number > 0 such as \"5 %\"; \"0\" is outside");
  refused(with(portal, "[a, b], section: s", "[a, b], section: t"),
          "5:36: members.left.section: unknown section \"t\". Allowed: s.");
}

TEST(FrameInput, InSpaceASectionNeedsItsOtherInertias) {
  const std::string space =
      with(with(grid, "bays: 1", "bays: [1, 1]"), "{rectangle: [0.4, 0.4]}", "{area: 0.1, inertia_y: 1e-3}");
  refused(space, "2:79: grid.columns: key \"inertia_z\" is missing; type \"inertia_z: 2.1e-3 m^4\"");
}

TEST(FrameInput, NodesAreNamed) {
  refused(with(portal, "{a: [0, 0]", "{a.1: [0, 0]"),
          "3:9: nodes.a.1: a name must not be empty or contain \".\" or \"/\"; type a name such as b1");
  refused(with(portal, "[a, b], section", "[a, e1], section"),
          "5:23: members.left.between[1]: unknown node \"e1\". Allowed: a, b, c, d.");
  refused(with(portal, "{a: fixed", "{e: fixed"), "8:12: supports.e: unknown node \"e\". Allowed: a, b, c, d.");
  refused(with(portal, "{b: 10 t", "{bb: 10 t"), "9:10: masses.bb: unknown node \"bb\". Allowed: a, b, c, d.");
  refused("material: {E: 1}\n",
          "1:1: a frame needs nodes; type grid: {storeys: 5, bays: 3, ...}, or nodes: {a: [0, 0], b: [0, 3 m]}");
  refused(portal + "nodez: {}\n", "11:1: unknown key \"nodez\". Did you mean \"nodes\"?");
}

TEST(FrameInput, MembersJoinTwoNodes) {
  const auto beam = [](const std::string& text) { return with(portal, "{between: [b, c], section: s}", text); };
  refused(beam("{between: [b], section: s}"), "6:19: members.beam.between: takes two nodes; type between: [a, b]");
  refused(beam("{section: s}"), "6:9: members.beam: key \"between\" is missing; type \"between: [a, b]\"");
  refused(beam("{between: [b, c]}"),
          "6:9: members.beam: the section is missing; type section: {rectangle: [0.4 m, 0.6 m]}, or truss: 20 cm^2");
  refused(beam("{between: [b, c], truss: 20 cm^2, section: s}"),
          "6:43: members.beam.section: belongs to a beam; a truss takes its area only");
  refused(
      beam("{between: [b, c], section: s, releases: {start: [rx]}}"),
      "6:58: members.beam.releases.start[0]: unknown displacement \"rx\". Did you mean \"ux\"? The frame is plane.");
  refused(beam("{between: [b, c], section: s, reference: [0, 1]}"),
          "6:39: members.beam.reference: is for frames in space; in the plane local y is y; leave it out");
  refused(beam("{between: [b, c], section: s, offsets: {start: 0.3 m}}"),
          "6:56: members.beam.offsets.start: takes [x, z] in a frame in the plane; type [0, 0.3 m]");
  refused(beam("{between: [b, b], section: s}"),
          "6:9: members.beam: member 1 (nodes b and b): its two ends are at one point");
}

TEST(FrameInput, TrussCarriesAxialForceOnly) {
  const Structure with_beam = structure(portal);
  const Structure with_truss = structure(with(portal, "[b, c], section: s", "[b, c], truss: 20 cm^2"));
  EXPECT_NEAR(stiffness(with_truss, "node b ux", "node c ux"), -30e9 * 20e-4 / 6, 1e-3);
  EXPECT_EQ(stiffness(with_truss, "node b ry", "node c ry"), 0);
  EXPECT_NE(stiffness(with_beam, "node b ry", "node c ry"), 0);
}

TEST(FrameInput, ReleasesAndOffsetsReachTheMember) {
  const auto beam = [](const std::string& text) {
    return structure(with(portal, "[b, c], section: s", "[b, c], section: s, " + text));
  };
  EXPECT_NEAR(stiffness(beam("releases: {start: [ry]}"), "node b ry", "node c ry"), 0, 1e-3);
  EXPECT_GT(stiffness(beam("offsets: {start: [0.2 m, 0], end: [-0.2 m, 0]}"), "node b ry", "node c ry"),
            1.1 * stiffness(structure(portal), "node b ry", "node c ry"));
  const FrameModel m = read(with(portal, "[b, c], section: s", "[b, c], section: s, offsets: {start: [0.2 m, 0.1 m]}"));
  EXPECT_EQ(m.frame.beam(1).options().start_offset, Eigen::Vector3d(0.2, 0, 0.1));
  // A release at the start leaves only the column at b, and all of it at c.
  const Structure free_start = beam("releases: {start: [ry]}");
  const double whole = stiffness(structure(portal), "node b ry", "node b ry");
  EXPECT_LT(stiffness(free_start, "node b ry", "node b ry"), 0.7 * whole);
  EXPECT_GT(stiffness(free_start, "node c ry", "node c ry"), 0.9 * whole);
}

TEST(FrameInput, SupportsHoldWhatTheirWordSays) {
  const auto size = [](const std::string& d) { return structure(with(portal, "d: pinned", "d: " + d)).size(); };
  EXPECT_EQ(size("fixed"), 6);
  EXPECT_EQ(size("pinned"), 7);
  EXPECT_EQ(size("roller"), 8);
  EXPECT_EQ(size("{fix: [ux, uz]}"), 7);
  EXPECT_EQ(size("{fix: pinned, springs: {ry: 100 MN m}}"), 7);
  const std::string heavy_foot = with(portal, "c: 10 t", "c: 10 t, d: 1 t");
  const Structure soft = structure(
      with(heavy_foot, "d: pinned", "d: {fix: [uz], springs: {ux: 2 MN/m, ry: 3 MN m}, dashpots: {ux: 1e5}}"));
  const Structure bare = structure(with(heavy_foot, "d: pinned", "d: roller"));
  EXPECT_NEAR(soft.damping.sum(), 1e5, 1e-9);
  EXPECT_NEAR(stiffness(soft, "node d ux", "node d ux") - stiffness(bare, "node d ux", "node d ux"), 2e6, 1);
  EXPECT_NEAR(stiffness(soft, "node d ry", "node d ry") - stiffness(bare, "node d ry", "node d ry"), 3e6, 1);
}

TEST(FrameInput, WrongSupportsAreRefused) {
  const auto support = [](const std::string& text) { return with(portal, "d: pinned", "d: " + text); };
  refused(support("pined"), "8:25: supports.d: unknown support \"pined\". Did you mean \"pinned\"?");
  refused(support("{}"), "8:25: supports.d: holds nothing; type fix: [ux, uz], or springs: {ux: 20 MN/m}");
  refused(support("{fix: [ux], springs: {ux: 1 MN/m}}"),
          "8:47: supports.d.springs.ux: ux is fixed here too; keep one of the two");
  refused(support("{springs: {ry: 100 MN}}"),
          "8:40: supports.d.springs.ry: takes an energy or moment such as \"12 kN m\"; \"100 MN\" is a force");
  refused(support("{fix: [uy]}"),
          "8:32: supports.d.fix[0]: unknown displacement \"uy\". Did you mean \"ux\"? The frame is plane.");
  refused(support("{fix: pinned, delay: -1 s}"),
          "8:46: supports.d.delay: takes a time >= 0 such as \"0.5 s\"; \"-1 s\" is outside");
  refused(support("{fix: pinned, delai: 1 s}"), "8:39: supports.d: unknown key \"delai\". Did you mean \"delay\"?");
  refused(
      support("{fix: pinned, ground_motion: {components: {y: {harmonic: {amplitude: 1, period: 1, duration: 1}}}}}"),
      "8:68: supports.d.ground_motion.components: unknown key \"y\". Allowed: x, z.");
  refused(with(portal, "supports: {a: fixed, d: pinned}", ""),
          "1:1: nothing holds the frame to the ground; type supports: {a: fixed}, or supports: none for a frame free "
          "in space");
}

TEST(FrameInput, SupportsWithAMotionOfTheirOwnStandApart) {
  const FrameModel m = read(with(portal, "d: pinned", "d: {fix: pinned, delay: 0.2 s}"));
  ASSERT_EQ(m.supports.size(), 2u);
  EXPECT_EQ(m.supports[0].name, "");
  EXPECT_EQ(m.supports[0].nodes, std::vector<int>{0});
  EXPECT_EQ(m.supports[1].name, "d");
  EXPECT_EQ(m.supports[1].delay, 0.2);
  const FrameModel shaken =
      read(with(portal, "d: pinned",
                "d: {fix: pinned, ground_motion: {components: {x: {harmonic: {amplitude: 1, period: 1, duration: 1}},"
                " z: {harmonic: {amplitude: 2, period: 1, duration: 1}}}}}"));
  ASSERT_TRUE(shaken.supports[1].motion.has_value());
  EXPECT_NEAR((*shaken.supports[1].motion)[0].peak(), 1, 1e-9);
  EXPECT_TRUE((*shaken.supports[1].motion)[1].is_still());
  EXPECT_NEAR((*shaken.supports[1].motion)[2].peak(), 2, 1e-9);
  const FrameModel feet = read(grid + "supports: {feet: pinned, 0.1: {fix: fixed, delay: 1 s}}\n");
  ASSERT_EQ(feet.supports.size(), 2u);
  EXPECT_EQ(feet.supports[0].nodes, std::vector<int>{0});
  EXPECT_EQ(feet.supports[1].name, "0.1");
}

TEST(FrameInput, GridNamesItsNodesAndMembers) {
  const FrameModel m = read(grid);
  EXPECT_EQ(m.frame.nodes(), 6);
  EXPECT_EQ(m.frame.node_name(5), "2.1");
  EXPECT_EQ(m.frame.member_name(0), "column 1.0");
  EXPECT_EQ(m.frame.member_name(1), "beam x 1.0");
  ASSERT_EQ(m.floors.size(), 2u);
  EXPECT_EQ(m.floors[1].elevation, 6);
  EXPECT_EQ(m.floors[1].master, -1) << "flexible in the plane unless asked for";
  const FrameModel space = read(with(grid, "bays: 1", "bays: [1, 1]"));
  EXPECT_EQ(space.frame.node_name(7), "1.1.1");
  EXPECT_EQ(space.floors[0].master, 12) << "rigid in space unless asked for";
  EXPECT_EQ(space.frame.node_name(12), "floor 1");
  EXPECT_EQ(space.given_nodes(), 12);
  EXPECT_EQ(structure(grid).size(), 12);
  EXPECT_EQ(structure(grid + "supports: {feet: pinned}\n").size(), 14);
}

TEST(FrameInput, WrongGridsAreRefused) {
  refused(with(grid, "storeys: 2, ", ""), "2:7: grid: key \"storeys\" is missing; type \"storeys: 5\"");
  refused(with(grid, "storeys: 2", "storeys: 0"),
          "2:17: grid.storeys: takes an integer from 1 to 1000; \"0\" is outside");
  refused(with(grid, "storey_height: 3 m", "storey_height: [3 m]"),
          "2:44: grid.storey_height: takes a length > 0 such as \"20 mm\" or a list of 2 from the ground up; a list of "
          "1 was read");
  refused(with(grid, "bay_width: 6 m", "bay_width: [6 m, 5 m]"),
          "2:60: grid.bay_width: takes one width, or a list of 1 in the order of the bays; a list of 2 was read");
  refused(
      with(with(grid, "bays: 1", "bays: [1, 1]"), "bay_width: 6 m", "bay_width: [6 m, 5 m]"),
      "2:65: grid.bay_width: takes one width, or one for each direction in space; type bay_width: {x: 6 m, y: 5 m}");
  refused(with(grid, "bays: 1", "bays: [1, 1, 1]"),
          "2:26: grid.bays: takes the bays along x and along y in space; type bays: [3, 2]");
  refused(with(grid, "floor_mass", "floor_masses"),
          "3:40: grid: unknown key \"floor_masses\". Did you mean \"floor_mass\"?");
  refused(grid + "nodes: {feet: [0, 9 m]}\n", "4:9: nodes.feet: \"feet\" are those of the grid; choose another name");
  refused(with(grid, "material: {E: 30 GPa}", ""),
          "2:7: grid: the material is missing; type material: {E: 30 GPa} in the frame, for all members");
}

TEST(FrameInput, NodesAndMembersGoOnTopOfAGrid) {
  const std::string mast = grid +
                           "nodes: {top: [0, 9 m]}\nmembers: {mast: {between: [2.0, top], section: {circle: 0.3}}}\n"
                           "masses: {top: 1 t}\nfloors: [{nodes: [top], label: mast}]\n";
  const FrameModel m = read(mast);
  EXPECT_EQ(m.frame.member_name(6), "mast");
  ASSERT_EQ(m.floors.size(), 3u);
  EXPECT_EQ(m.floors[2].label, "mast");
  EXPECT_EQ(structure(mast).size(), 15);
}

TEST(FrameInput, FloorsStandInOrder) {
  const auto floors = [](const std::string& text) {
    return with(portal, "floors: [{nodes: [b, c]}]", "floors: " + text);
  };
  EXPECT_EQ(read(floors("[{nodes: [b, c], elevation: 3.1 m, label: roof}]")).floors[0].elevation, 3.1);
  EXPECT_EQ(read(floors("[{nodes: [b, c], rigid: true}]")).floors[0].master, 1);
  refused(floors("[{nodes: [b], elevation: 3 m}, {nodes: [c], elevation: 2 m}]"),
          "10:40: floors[1]: floors stand in the order from the ground up, and this one at 2 m is not above floor 1 at "
          "3 m");
  refused(floors("[{nodes: [b, b]}]"), "10:22: floors[0].nodes[1]: stands twice in this floor; keep it once");
  refused(floors("[{nodes: [b]}, {nodes: [b, c], elevation: 4 m}]"),
          "10:33: floors[1].nodes[0]: belongs to floor 1 already");
  refused(floors("[{nodes: [a, b], rigid: true}]"),
          "10:10: floors[0]: a rigid floor is level, and its nodes lie from 0 mm to 3 m; type rigid: false");
  refused(floors("[{nodes: []}]"),
          "10:18: floors[0].nodes: takes the names of nodes such as [a, b]; the list is empty");
  refused(floors("[{nodes: [b], label: x}, {nodes: [c], elevation: 4 m, label: x}]"),
          "10:70: floors[1].label: two floors have the label x; choose another one");
}

TEST(FrameInput, MassesMayDifferByDirection) {
  const Structure s = structure(with(portal, "b: 10 t", "b: {ux: 5 t, ry: 7}"));
  EXPECT_EQ(s.mass.coeff(0, 0), 5000);
  EXPECT_EQ(s.mass.coeff(1, 1), 0);
  EXPECT_EQ(s.mass.coeff(2, 2), 7);
  refused(with(portal, "b: 10 t", "b: {ux: 5 m}"),
          "9:18: masses.b.ux: takes a mass such as \"100 t\"; \"5 m\" is a length");
  refused(with(portal, "b: 10 t", "b: {uy: 5 t}"),
          "9:14: masses.b.uy: unknown displacement \"uy\". Did you mean \"ux\"? The frame is plane.");
}

TEST(FrameInput, SpringsStandAtOneNodeOrBetweenTwo) {
  const Structure bare = structure(portal);
  const Structure s = structure(portal +
                                "springs: [{node: b, dof: ux, stiffness: 1 MN/m}, {between: [b, c], dof: ux, "
                                "stiffness: 2 MN/m, damping: 1e5}]\n");
  EXPECT_NEAR(stiffness(s, "node b ux", "node b ux") - stiffness(bare, "node b ux", "node b ux"), 3e6, 1e-3);
  EXPECT_NEAR(stiffness(s, "node b ux", "node c ux") - stiffness(bare, "node b ux", "node c ux"), -2e6, 1e-3);
  EXPECT_NEAR(s.damping.coeff(0, 0), 1e5, 1e-9);
  EXPECT_NEAR(s.damping.coeff(0, 3), -1e5, 1e-9);
  refused(portal + "springs: [{dof: ux, stiffness: 1}]\n",
          "11:11: springs[0]: its place is missing; type node: a for a spring to the ground, or between: [a, b]");
  refused(portal + "springs: [{node: b, dof: ux}]\n",
          "11:11: springs[0]: has neither stiffness nor damping; type stiffness: 1 MN/m");
  refused(portal + "springs: [{node: b, between: [b, c], dof: ux, stiffness: 1}]\n",
          "11:21: springs[0].between: a spring stands at one node or between two; keep one of node and between");
  refused(portal + "springs: [{node: b, dof: ux, stiffness: 1 m}]\n",
          "11:41: springs[0].stiffness: takes a stiffness such as \"93500 kN/m\"; \"1 m\" is a length");
}

TEST(FrameInput, TiesHoldWhatTheySay) {
  EXPECT_EQ(structure(portal + "ties: [{master: b, nodes: [c], dofs: [ux]}]\n").size(), 6);
  EXPECT_EQ(structure(portal + "ties: [{master: b, nodes: [c], rigid: true}]\n").size(), 4);
  refused(portal + "ties: [{master: b, nodes: [c]}]\n",
          "11:8: ties[0]: what is tied is missing; type dofs: [ux], or rigid: true");
  refused(portal + "ties: [{master: b, nodes: [c], dofs: [ux], rigid: true}]\n",
          "11:44: ties[0].rigid: a rigid tie holds all displacements; keep one of dofs and rigid");
  refused(portal + "ties: [{master: b, nodes: [b], dofs: [ux]}]\n", "11:8: ties[0]: node b: tied to itself");
}

TEST(FrameInput, LoadsBringGravity) {
  const FrameModel m = read(portal + "loads: {b: {uz: -10 kN}}\n");
  EXPECT_TRUE(m.has_gravity() && m.is_loaded());
  EXPECT_TRUE(read(with(portal, "[b, c], section: s", "[b, c], section: s, load: [0, -10 kN/m]")).has_gravity());
  EXPECT_TRUE(read(portal + "geometry: p_delta\n").has_gravity());
  const FrameModel light = read(portal + "loads: {b: {uz: -10 kN}}\ngravity: false\n");
  EXPECT_FALSE(light.has_gravity());
  EXPECT_TRUE(light.is_loaded());
  refused(portal + "loads: {b: -10 kN}\n", "11:12: loads.b: takes forces with their directions; type {uz: -10 kN}");
  refused(portal + "geometry: p_delta\ngravity: false\n",
          "11:11: geometry: p_delta needs forces at rest, and nothing acts; type gravity: true, or give loads");
  refused(portal + "geometry: p-delta\n", "11:11: geometry: unknown geometry \"p-delta\". Did you mean \"p_delta\"?");
  refused(portal + "mass: lumpd\n", "11:7: mass: unknown mass of members \"lumpd\". Did you mean \"lumped\"?");
}

TEST(FrameInput, ReportsAreChosenByName) {
  const FrameModel m = read(portal + "report: {nodes: [c, b], members: all}\n");
  EXPECT_EQ(m.reported_nodes, (std::vector<int>{2, 1}));
  EXPECT_EQ(m.reported_members, (std::vector<int>{0, 1, 2}));
  refused(portal + "report: {members: [bean]}\n",
          "11:20: report.members[0]: unknown member \"bean\". Did you mean \"beam\"?");
  refused(portal + "report: {nodes: some}\n", "11:17: report.nodes: takes all, or a list of nodes; type nodes: [a, b]");
  EXPECT_TRUE(structure(with(grid, "storeys: 2, bays: 1", "storeys: 50, bays: 1")).nodes.names.empty())
      << "102 nodes are too many to report unasked";
}

TEST(FrameInput, TheMasterOfARigidFloorStandsAtTheCentreOfItsMasses) {
  const std::string floor =
      "material: {E: 30 GPa}\nsections: {s: {circle: 0.4}}\n"
      "nodes: {a: [0, 0, 0], b: [0, 0, 3], c: [8, 0, 3], d: [0, 4, 3]}\n"
      "members: {1: {between: [a, b], section: s}, 2: {between: [b, c], section: s}, 3: {between: [b, d], section: "
      "s}}\n"
      "supports: {a: fixed}\nmasses: {b: 1 t, c: 2 t, d: {ux: 1 t, uy: 1 t, uz: 1 t}}\nfloors: [{nodes: [b, c, d]}]\n";
  const FrameModel m = read(floor);
  EXPECT_EQ(m.frame.node_name(m.floors[0].master), "floor 1");
  EXPECT_NEAR((m.frame.position(m.floors[0].master) - Eigen::Vector3d(4, 1, 3)).norm(), 0, 1e-14);
  EXPECT_EQ(read(with(floor, "[b, c, d]}", "[b, c, d], rigid: false}")).floors[0].master, -1);
}

// Mistakes that only the matrices show are reported at their node or member, too.
TEST(FrameInput, WhatTheFrameRefusesIsReportedAtItsPlace) {
  refused(with(portal, "d: [6 m, 0]}", "d: [6 m, 0], e: [9 m, 0]}"),
          "3:64: nodes.e: node e: no member, spring or constraint is connected to it");
}

TEST(FrameInput, AFrameThatNothingHoldsIsReportedAtANode) {
  try {
    structure(with(portal, "{a: fixed, d: pinned}", "{a: roller, d: roller}"));
    ADD_FAILURE() << "a frame on rollers was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nodes."), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("ux"), std::string::npos) << error.what();
  }
}

}  // namespace frame_input_test
}  // namespace pounding
