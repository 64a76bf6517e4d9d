// Input of a frame, and its errors.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/input/frames/frame_input.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace frame_input_test {

using test::at, test::mentions;

// Line 1 is the material.
const std::string portal =
    "material: {E: 30 GPa}\nsections: {s: {rectangle: [0.4 m, 40 cm]}}\nnodes: {a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], "
    "d: [6 m, 0]}\nmembers:\n  left: {between: [a, b], section: s}\n  beam: {between: [b, c], section: s}\n  right: "
    "{between: [d, c], section: s}\nsupports: {a: fixed, d: pinned}\nmasses: {b: 10 t, c: 10 t}\nfloors: [{nodes: [b, "
    "c]}]\n";

const std::string grid =
    "material: {E: 30 GPa}\ngrid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {rectangle: [0.4, "
    "0.4]},\n       beams: {rectangle: [0.3, 0.5]}, floor_mass: 20 t}\n";

std::string with(std::string yaml, const std::string& from, const std::string& to) {
  const std::size_t at = yaml.find(from);
  if (at == std::string::npos) throw std::logic_error("the test replaces what is not there: " + from);
  return yaml.replace(at, from.size(), to);
}

FrameModel read(const std::string& yaml) { return read_frame(Input::read_text(yaml, "test.yaml")).model; }

Structure structure(const std::string& yaml) { return read_frame_structure(Input::read_text(yaml, "test.yaml")); }

// `message` is the text after the file name.
void refused(const std::string& yaml, const std::string& location, const test::Facts& facts = {},
             std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal<InputError>([&] { structure(yaml); }), "test.yaml:" + location, facts, line);
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
  refused(with(portal, "30 GPa", "30 kN"), at("1:15", "material.E"), mentions({"30 GPa", "30 kN"}));
}

TEST(FrameInput, DimensionFollowsFromWhatIsGiven) {
  EXPECT_EQ(read(portal + "dimension: 2\n").frame.dimension(), 2);
  EXPECT_EQ(read(with(with(grid, "bays: 1", "bays: [1, 2]"), "bay_width: 6 m", "bay_width: {x: 6 m, y: [5 m, 4 m]}"))
                .frame.dimension(),
            3);
  refused(with(portal, "c: [6 m, 3 m]", "c: [6 m, 0, 3 m]") + "dimension: 2\n", at("3:36", "nodes.c"),
          mentions({"dimension: 3", "2"}));
  refused(with(portal, "c: [6 m, 3 m]", "c: [6 m, 0, 3 m]"), at("3:12", "nodes.a"),
          mentions({"[x, y, z]", "[0, 0, 3 m]"}));
  refused(portal + "dimension: 4\n", at("11:12", "dimension"), mentions({"4", "2", "3"}));
}

TEST(FrameInput, OriginMovesEverything) {
  const FrameModel m = read(portal + "origin: [12 m, 1 m]\n");
  EXPECT_EQ(m.frame.position(2), Eigen::Vector3d(18, 0, 4));
  EXPECT_EQ(m.floors[0].elevation, 4);
  EXPECT_EQ(read(portal + "origin: [12 m]\n").frame.position(0), Eigen::Vector3d(12, 0, 0));
  EXPECT_EQ(read(grid + "origin: [12 m, 1 m]\n").floors[1].elevation, 7);
  const std::string marked = with(portal, "floors: [{nodes: [b, c]}]", "floors: [{nodes: [b, c], elevation: 3.1 m}]");
  EXPECT_EQ(read(marked + "origin: [12 m, 1 m]\n").floors[0].elevation, 4.1);
  refused(portal + "origin: 12 m\n", at("11:9", "origin"), mentions({"origin: [12 m, 0]", "[x]", "[x, z]"}));
}

TEST(FrameInput, MaterialsAreNamedOrGivenInPlace) {
  const std::string base = "materials: {soft: {E: 10 GPa}}\n" + with(portal, "{E: 30 GPa}", "soft");
  EXPECT_NEAR(
      stiffness(structure(base), "node b ry", "node b ry") / stiffness(structure(portal), "node b ry", "node b ry"),
      1.0 / 3, 1e-12);
  const Structure mixed = structure(with(base, "[b, c], section: s", "[b, c], section: s, material: {E: 20 GPa}"));
  EXPECT_GT(stiffness(mixed, "node b ry", "node b ry"), stiffness(structure(base), "node b ry", "node b ry"));
  refused(with(base, "material: soft", "material: sofd"), at("2:11", "material"), mentions({"sofd", "soft"}));
  refused(with(portal, "material: {E: 30 GPa}\n", "\n"), at("5:9", "members.left"),
          mentions({"material: {E: 30 GPa}"}));
  refused(with(portal, "{E: 30 GPa}", "{E: 30 GPa, G: 12 GPa, poisson: 0.2}"), at("1:34", "material.poisson"),
          mentions({"shear"}));
  refused(with(portal, "{E: 30 GPa}", "{E: 30 GPa, rho: 2500}"), at("1:23", "material"), mentions({"rho", "density"}));
  refused(with(portal, "{E: 30 GPa}", "{density: 2500 kg/m^3}"), at("1:11", "material"), mentions({"E: 30 GPa"}));
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

  refused(section("{rectangle: [0.4, 0.4], circle: 1}"), at("2:39", "sections.s.circle"));
  refused(section("{rectangle: [0.4, 0.4], area: 1}"), at("2:39", "sections.s.area"));
  refused(section("{}"), at("2:15", "sections.s"),
          mentions({"rectangle: [0.4 m, 0.6 m]", "area: 0.16 m^2", "inertia_y", "2.1e-3 m^4"}));
  refused(section("{rectangel: [0.4, 0.4]}"), at("2:16", "sections.s"), mentions({"rectangel", "rectangle"}));
  refused(section("{rectangle: 0.4}"), at("2:27", "sections.s.rectangle"),
          mentions({"rectangle: [0.4 m, 0.6 m]", "[width, depth]"}));
  refused(section("{tube: {diameter: 0.5, thickness: 0.3}}"), at("2:22", "sections.s.tube"), mentions({"thickness"}));
  refused(section("{area: 1, inertia_y: 1, shear: true}"), at("2:46", "sections.s.shear"),
          mentions({"shear_area_z: 0.13 m^2"}));
  refused(section("{area: 1}"), at("2:15", "sections.s"), mentions({"inertia_y: 2.1e-3 m^4"}));
  refused(section("{circle: 0.5 m, stiffness: 0}"), at("2:42", "sections.s.stiffness"), mentions({"5 %", "0"}));
  refused(with(portal, "[a, b], section: s", "[a, b], section: t"), at("5:36", "members.left.section"),
          mentions({"t", "s"}));
}

TEST(FrameInput, InSpaceASectionNeedsAllSecondMoments) {
  const std::string space =
      with(with(grid, "bays: 1", "bays: [1, 1]"), "{rectangle: [0.4, 0.4]}", "{area: 0.1, inertia_y: 1e-3}");
  refused(space, at("2:79", "grid.columns"), mentions({"inertia_z: 2.1e-3 m^4"}));
}

TEST(FrameInput, NodesAreNamed) {
  refused(with(portal, "{a: [0, 0]", "{a.1: [0, 0]"), at("3:9", "nodes.a.1"), mentions({".", "/", "b1"}));
  refused(with(portal, "[a, b], section", "[a, e1], section"), at("5:23", "members.left.between[1]"),
          mentions({"e1", "a", "b", "c"}));
  refused(with(portal, "{a: fixed", "{e: fixed"), at("8:12", "supports.e"), mentions({"e", "a", "b", "c"}));
  refused(with(portal, "{b: 10 t", "{bb: 10 t"), at("9:10", "masses.bb"), mentions({"bb", "a", "b", "c"}));
  refused("material: {E: 1}\n", at("1:1"),
          mentions({"grid: {storeys: 5, bays: 3, ...}", "nodes: {a: [0, 0], b: [0, 3 m]}"}));
  refused(portal + "nodez: {}\n", at("11:1"), mentions({"nodez", "nodes"}));
}

TEST(FrameInput, MembersJoinTwoNodes) {
  const auto beam = [](const std::string& text) { return with(portal, "{between: [b, c], section: s}", text); };
  refused(beam("{between: [b], section: s}"), at("6:19", "members.beam.between"), mentions({"between: [a, b]"}));
  refused(beam("{section: s}"), at("6:9", "members.beam"), mentions({"between: [a, b]"}));
  refused(beam("{between: [b, c]}"), at("6:9", "members.beam"),
          mentions({"section: {rectangle: [0.4 m, 0.6 m]}", "truss: 20 cm^2"}));
  refused(beam("{between: [b, c], truss: 20 cm^2, section: s}"), at("6:43", "members.beam.section"),
          mentions({"truss"}));
  refused(beam("{between: [b, c], section: s, releases: {start: [rx]}}"), at("6:58", "members.beam.releases.start[0]"),
          mentions({"rx", "ux"}));
  refused(beam("{between: [b, c], section: s, reference: [0, 1]}"), at("6:39", "members.beam.reference"));
  refused(beam("{between: [b, c], section: s, offsets: {start: 0.3 m}}"), at("6:56", "members.beam.offsets.start"),
          mentions({"[x, z]", "[0, 0.3 m]"}));
  refused(beam("{between: [b, b], section: s}"), at("6:9", "members.beam"), mentions({"1"}));
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
  // The release at the start leaves only the column stiffness at b; c keeps the full stiffness.
  const Structure free_start = beam("releases: {start: [ry]}");
  const double whole = stiffness(structure(portal), "node b ry", "node b ry");
  EXPECT_LT(stiffness(free_start, "node b ry", "node b ry"), 0.7 * whole);
  EXPECT_GT(stiffness(free_start, "node c ry", "node c ry"), 0.9 * whole);
}

TEST(FrameInput, SupportsRestrainTheirDofs) {
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
  refused(support("pined"), at("8:25", "supports.d"), mentions({"pined", "pinned"}));
  refused(support("{}"), at("8:25", "supports.d"), mentions({"fix: [ux, uz]", "springs: {ux: 20 MN/m}"}));
  refused(support("{fix: [ux], springs: {ux: 1 MN/m}}"), at("8:47", "supports.d.springs.ux"), mentions({"ux"}));
  refused(support("{springs: {ry: 100 MN}}"), at("8:40", "supports.d.springs.ry"), mentions({"12 kN m", "100 MN"}));
  refused(support("{fix: [uy]}"), at("8:32", "supports.d.fix[0]"), mentions({"uy", "ux"}));
  refused(support("{fix: pinned, delay: -1 s}"), at("8:46", "supports.d.delay"), mentions({"0.5 s", "-1 s"}));
  refused(support("{fix: pinned, delai: 1 s}"), at("8:39", "supports.d"), mentions({"delai", "delay"}));
  refused(
      support("{fix: pinned, ground_motion: {components: {y: {harmonic: {amplitude: 1, period: 1, duration: 1}}}}}"),
      at("8:68", "supports.d.ground_motion.components"), mentions({"y", "x", "z"}));
  refused(with(portal, "supports: {a: fixed, d: pinned}", ""), at("1:1"),
          mentions({"supports: {a: fixed}", "supports: none"}));
}

TEST(FrameInput, SupportsWithSeparateMotionsAreSeparate) {
  const FrameModel m = read(with(portal, "d: pinned", "d: {fix: pinned, delay: 0.2 s}"));
  ASSERT_EQ(m.supports.size(), 2u);
  EXPECT_EQ(m.supports[0].name, "");
  EXPECT_EQ(m.supports[0].nodes, std::vector<int>{0});
  EXPECT_EQ(m.supports[1].name, "d");
  EXPECT_EQ(m.supports[1].delay, 0.2);
  const FrameModel shaken =
      read(with(portal, "d: pinned",
                "d: {fix: pinned, ground_motion: {components: {x: {harmonic: {amplitude: 1, period: 1, duration: 1}}, "
                "z: {harmonic: {amplitude: 2, period: 1, duration: 1}}}}}"));
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
  EXPECT_EQ(m.floors[1].master, -1) << "flexible in the plane by default";
  const FrameModel space = read(with(grid, "bays: 1", "bays: [1, 1]"));
  EXPECT_EQ(space.frame.node_name(7), "1.1.1");
  EXPECT_EQ(space.floors[0].master, 12) << "rigid in space by default";
  EXPECT_EQ(space.frame.node_name(12), "floor 1");
  EXPECT_EQ(space.given_nodes(), 12);
  EXPECT_EQ(structure(grid).size(), 12);
  EXPECT_EQ(structure(grid + "supports: {feet: pinned}\n").size(), 14);
}

TEST(FrameInput, WrongGridsAreRefused) {
  refused(with(grid, "storeys: 2, ", ""), at("2:7", "grid"), mentions({"storeys: 5"}));
  refused(with(grid, "storeys: 2", "storeys: 0"), at("2:17", "grid.storeys"), mentions({"0", "1000"}));
  refused(with(grid, "storey_height: 3 m", "storey_height: [3 m]"), at("2:44", "grid.storey_height"),
          mentions({"20 mm", "2"}));
  refused(with(grid, "bay_width: 6 m", "bay_width: [6 m, 5 m]"), at("2:60", "grid.bay_width"), mentions({"2"}));
  refused(with(with(grid, "bays: 1", "bays: [1, 1]"), "bay_width: 6 m", "bay_width: [6 m, 5 m]"),
          at("2:65", "grid.bay_width"), mentions({"bay_width: {x: 6 m, y: 5 m}"}));
  refused(with(grid, "bays: 1", "bays: [1, 1, 1]"), at("2:26", "grid.bays"), mentions({"bays: [3, 2]"}));
  refused(with(grid, "floor_mass", "floor_masses"), at("3:40", "grid"), mentions({"floor_masses", "floor_mass"}));
  refused(grid + "nodes: {feet: [0, 9 m]}\n", at("4:9", "nodes.feet"), mentions({"feet"}));
  refused(with(grid, "material: {E: 30 GPa}", ""), at("2:7", "grid"), mentions({"material: {E: 30 GPa}"}));
}

TEST(FrameInput, NodesAndMembersAddToAGrid) {
  const std::string mast = grid +
                           "nodes: {top: [0, 9 m]}\nmembers: {mast: {between: [2.0, top], section: {circle: "
                           "0.3}}}\nmasses: {top: 1 t}\nfloors: [{nodes: [top], label: mast}]\n";
  const FrameModel m = read(mast);
  EXPECT_EQ(m.frame.member_name(6), "mast");
  ASSERT_EQ(m.floors.size(), 3u);
  EXPECT_EQ(m.floors[2].label, "mast");
  EXPECT_EQ(structure(mast).size(), 15);
}

TEST(FrameInput, FloorsAreInAscendingOrder) {
  const auto floors = [](const std::string& text) {
    return with(portal, "floors: [{nodes: [b, c]}]", "floors: " + text);
  };
  EXPECT_EQ(read(floors("[{nodes: [b, c], elevation: 3.1 m, label: roof}]")).floors[0].elevation, 3.1);
  EXPECT_EQ(read(floors("[{nodes: [b, c], rigid: true}]")).floors[0].master, 1);
  refused(floors("[{nodes: [b], elevation: 3 m}, {nodes: [c], elevation: 2 m}]"), at("10:40", "floors[1]"),
          mentions({"2 m", "3 m", "1"}));
  refused(floors("[{nodes: [b, b]}]"), at("10:22", "floors[0].nodes[1]"));
  refused(floors("[{nodes: [b]}, {nodes: [b, c], elevation: 4 m}]"), at("10:33", "floors[1].nodes[0]"),
          mentions({"1"}));
  refused(floors("[{nodes: [a, b], rigid: true}]"), at("10:10", "floors[0]"),
          mentions({"rigid: false", "0 mm", "3 m"}));
  refused(floors("[{nodes: []}]"), at("10:18", "floors[0].nodes"), mentions({"[a, b]"}));
  refused(floors("[{nodes: [b], label: x}, {nodes: [c], elevation: 4 m, label: x}]"), at("10:70", "floors[1].label"));
}

TEST(FrameInput, MassesMayDifferByDirection) {
  const Structure s = structure(with(portal, "b: 10 t", "b: {ux: 5 t, ry: 7}"));
  EXPECT_EQ(s.mass.coeff(0, 0), 5000);
  EXPECT_EQ(s.mass.coeff(1, 1), 0);
  EXPECT_EQ(s.mass.coeff(2, 2), 7);
  refused(with(portal, "b: 10 t", "b: {ux: 5 m}"), at("9:18", "masses.b.ux"), mentions({"100 t", "5 m"}));
  refused(with(portal, "b: 10 t", "b: {uy: 5 t}"), at("9:14", "masses.b.uy"), mentions({"uy", "ux"}));
}

TEST(FrameInput, SpringsAreAtOneNodeOrBetweenTwo) {
  const Structure bare = structure(portal);
  const Structure s = structure(portal +
                                "springs: [{node: b, dof: ux, stiffness: 1 MN/m}, {between: [b, c], dof: ux, "
                                "stiffness: 2 MN/m, damping: 1e5}]\n");
  EXPECT_NEAR(stiffness(s, "node b ux", "node b ux") - stiffness(bare, "node b ux", "node b ux"), 3e6, 1e-3);
  EXPECT_NEAR(stiffness(s, "node b ux", "node c ux") - stiffness(bare, "node b ux", "node c ux"), -2e6, 1e-3);
  EXPECT_NEAR(s.damping.coeff(0, 0), 1e5, 1e-9);
  EXPECT_NEAR(s.damping.coeff(0, 3), -1e5, 1e-9);
  refused(portal + "springs: [{dof: ux, stiffness: 1}]\n", at("11:11", "springs[0]"),
          mentions({"between: [b, c]", "node: b"}));
  refused(portal + "springs: [{node: b, dof: ux}]\n", at("11:11", "springs[0]"), mentions({"stiffness: 1 MN/m"}));
  refused(portal + "springs: [{node: b, between: [b, c], dof: ux, stiffness: 1}]\n", at("11:21", "springs[0].between"),
          mentions({"node", "between"}));
  refused(portal + "springs: [{node: b, dof: ux, stiffness: 1 m}]\n", at("11:41", "springs[0].stiffness"),
          mentions({"93500 kN/m", "1 m"}));
}

TEST(FrameInput, TiesConstrainTheirDofs) {
  EXPECT_EQ(structure(portal + "ties: [{master: b, nodes: [c], dofs: [ux]}]\n").size(), 6);
  EXPECT_EQ(structure(portal + "ties: [{master: b, nodes: [c], rigid: true}]\n").size(), 4);
  refused(portal + "ties: [{master: b, nodes: [c]}]\n", at("11:8", "ties[0]"), mentions({"dofs: [ux]", "rigid: true"}));
  refused(portal + "ties: [{master: b, nodes: [c], dofs: [ux], rigid: true}]\n", at("11:44", "ties[0].rigid"),
          mentions({"dofs", "rigid"}));
  refused(portal + "ties: [{master: b, nodes: [b], dofs: [ux]}]\n", at("11:8", "ties[0]"), mentions({"b"}));
}

TEST(FrameInput, LoadsBringGravity) {
  const FrameModel m = read(portal + "loads: {b: {uz: -10 kN}}\n");
  EXPECT_TRUE(m.has_gravity() && m.is_loaded());
  EXPECT_TRUE(read(with(portal, "[b, c], section: s", "[b, c], section: s, load: [0, -10 kN/m]")).has_gravity());
  EXPECT_TRUE(read(portal + "geometry: p_delta\n").has_gravity());
  const FrameModel light = read(portal + "loads: {b: {uz: -10 kN}}\ngravity: false\n");
  EXPECT_FALSE(light.has_gravity());
  EXPECT_TRUE(light.is_loaded());
  refused(portal + "loads: {b: -10 kN}\n", at("11:12", "loads.b"), mentions({"{uz: -10 kN}"}));
  refused(portal + "geometry: p_delta\ngravity: false\n", at("11:11", "geometry"),
          mentions({"gravity: true", "p_delta"}));
  refused(portal + "geometry: p-delta\n", at("11:11", "geometry"), mentions({"p-delta", "p_delta"}));
  refused(portal + "mass: lumpd\n", at("11:7", "mass"), mentions({"lumpd", "lumped"}));
}

TEST(FrameInput, ReportsAreChosenByName) {
  const FrameModel m = read(portal + "report: {nodes: [c, b], members: all}\n");
  EXPECT_EQ(m.reported_nodes, (std::vector<int>{2, 1}));
  EXPECT_EQ(m.reported_members, (std::vector<int>{0, 1, 2}));
  refused(portal + "report: {members: [bean]}\n", at("11:20", "report.members[0]"), mentions({"bean", "beam"}));
  refused(portal + "report: {nodes: some}\n", at("11:17", "report.nodes"), mentions({"nodes: [a, b]"}));
  EXPECT_TRUE(structure(with(grid, "storeys: 2, bays: 1", "storeys: 50, bays: 1")).nodes.names.empty())
      << "102 nodes are too many to report by default";
}

TEST(FrameInput, TheMasterOfARigidFloorIsAtItsCentreOfMass) {
  const std::string floor =
      "material: {E: 30 GPa}\nsections: {s: {circle: 0.4}}\nnodes: {a: [0, 0, 0], b: [0, 0, 3], c: [8, 0, 3], d: [0, "
      "4, 3]}\nmembers: {1: {between: [a, b], section: s}, 2: {between: [b, c], section: s}, 3: {between: [b, d], "
      "section: s}}\nsupports: {a: fixed}\nmasses: {b: 1 t, c: 2 t, d: {ux: 1 t, uy: 1 t, uz: 1 t}}\nfloors: [{nodes: "
      "[b, c, d]}]\n";
  const FrameModel m = read(floor);
  EXPECT_EQ(m.frame.node_name(m.floors[0].master), "floor 1");
  EXPECT_NEAR((m.frame.position(m.floors[0].master) - Eigen::Vector3d(4, 1, 3)).norm(), 0, 1e-14);
  EXPECT_EQ(read(with(floor, "[b, c, d]}", "[b, c, d], rigid: false}")).floors[0].master, -1);
}

// Errors found from the matrices are also reported at their node or member.
TEST(FrameInput, ErrorsOfTheFrameHaveALocation) {
  refused(with(portal, "d: [6 m, 0]}", "d: [6 m, 0], e: [9 m, 0]}"), at("3:64", "nodes.e"), mentions({"e"}));
}

TEST(FrameInput, AnUnsupportedFrameIsReportedAtANode) {
  try {
    structure(with(portal, "{a: fixed, d: pinned}", "{a: roller, d: roller}"));
    ADD_FAILURE() << "a frame on rollers was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nodes."), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("ux"), std::string::npos) << error.what();
  }
}

}  // namespace frame_input_test
}  // namespace pounding
