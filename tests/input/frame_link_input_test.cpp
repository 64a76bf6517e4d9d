// Errors in models with frames, their links and ground motions: location, text that was read, text to type.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include "support/models.hpp"

namespace pounding {
namespace frame_link_input_test {

using test::at, test::mentions, test::refused;

std::string with(std::string yaml, const std::string& from, const std::string& to) {
  const std::size_t at = yaml.find(from);
  if (at == std::string::npos) throw std::logic_error("the test replaces what is not there: " + from);
  return yaml.replace(at, from.size(), to);
}

// One storey with nodes a, b, c, d from the left foot to the right foot. Lines 3 to 11 are the frame.
const std::string lone =
    "structures:\n  a:\n    frame:\n      material: {E: 30 GPa}\n      nodes: {a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], "
    "d: [6 m, 0]}\n      members:\n        left: {between: [a, b], section: {circle: 0.4 m}}\n        beam: {between: "
    "[b, c], section: {circle: 0.4 m}}\n        right: {between: [d, c], section: {circle: 0.4 m}}\n      supports: "
    "{a: fixed, d: fixed}\n      masses: {b: 10 t, c: 10 t}\n      floors: [{nodes: [b, c]}]\n    damping: 5 "
    "%\nanalysis: {duration: 1}\n";

// Two adjacent grids of two storeys; the link is on line 9.
const std::string grids =
    "structures:\n  a:\n    frame: {origin: [0], material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 3 "
    "m, bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}\n    damping: 5 %\n  b:\n    "
    "frame: {origin: [6.02], material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 2.5 m, bay_width: 6 m, "
    "columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}\n    damping: 5 %\nlinks:\n  - {gap: 20 mm, law: "
    "hertz, stiffness: 2.75e9, between: [a.1, b.1]}\nanalysis: {duration: 1}\n";

std::string in_space(std::string yaml) {
  for (const char* name : {"origin: [0]", "origin: [6.02]"})
    yaml = with(yaml, name, name == std::string("origin: [0]") ? "origin: [0, 0]" : "origin: [6.02, 0]");
  for (int i = 0; i < 2; ++i) yaml = with(yaml, "bays: 1,", "bays: [1, 1],");
  return yaml;
}

std::string linked(const std::string& ends, const std::string& yaml = grids) {
  return with(yaml, "between: [a.1, b.1]", ends);
}

TEST(FrameModel, TheSamplesAreTaken) {
  EXPECT_NO_THROW(test::model_of(lone));
  EXPECT_NO_THROW(test::model_of(grids));
  EXPECT_NO_THROW(test::model_of(in_space(grids)));
}

TEST(FrameModel, AMechanismIsNamedByANodeAndItsDisplacement) {
  refused(with(lone, "supports: {a: fixed, d: fixed}", "supports: {a: roller, d: roller}"),
          at("5:18", "structures.a.frame.nodes.a"), mentions({"ux", "a"}));
  // Hinges at both feet, and a truss without moments.
  refused(with(with(with(lone, "[b, c], section: {circle: 0.4 m}", "[b, c], truss: 20 cm^2"), "a: fixed", "a: pinned"),
               "d: fixed", "d: pinned"),
          at("5:29", "structures.a.frame.nodes.b"), mentions({"ux", "b"}));
}

TEST(FrameModel, ANodeThatNothingMeetsIsNamed) {
  refused(with(lone, "d: [6 m, 0]}", "d: [6 m, 0], e: [9 m, 0]}"), at("5:70", "structures.a.frame.nodes.e"),
          mentions({"e"}));
}

TEST(FrameModel, NamesStandOnce) {
  refused(with(lone, "d: [6 m, 0]}", "d: [6 m, 0], b: [9 m, 0]}"), at("5:67", "structures.a.frame.nodes"),
          mentions({"b"}));
  refused(with(lone, "right: {", "left: {"), at("9:9", "structures.a.frame.members"), mentions({"left"}));
  refused(with(grids, "  b:\n", "  a:\n"), at("5:3", "structures"), mentions({"a"}));
  refused(with(grids, "floor_mass: 20 t}}", "floor_mass: 20 t}, nodes: {1.1: [0, 9 m]}}"),
          at("3:186", "structures.a.frame.nodes.1.1"), mentions({".", "/", "b1"}));
}

TEST(FrameModel, AMemberHasALength) {
  refused(with(lone, "c: [6 m, 3 m]", "c: [0 m, 3 m]"), at("8:15", "structures.a.frame.members.beam"), mentions({"1"}));
}

TEST(FrameModel, AMissingSectionIsNamed) {
  refused(with(lone, ", section: {circle: 0.4 m}}\n        beam", ", section: c40}\n        beam"),
          at("7:42", "structures.a.frame.members.left.section"), mentions({"c40"}));
  refused(with(lone, ", section: {circle: 0.4 m}}\n        beam", "}\n        beam"),
          at("7:15", "structures.a.frame.members.left"),
          mentions({"section: {rectangle: [0.4 m, 0.6 m]}", "truss: 20 cm^2"}));
}

TEST(FrameModel, SomethingHasMassAndMoves) {
  refused(with(lone, "      masses: {b: 10 t, c: 10 t}\n", ""), at("4:7", "structures.a.frame"),
          mentions({"masses: {NODE: 10 t}", "density: 2500 kg/m^3", "floor_mass", "60 t"}));
  refused(with(lone, "supports: {a: fixed, d: fixed}", "supports: {a: fixed, b: fixed, c: fixed, d: fixed}"),
          at("4:7", "structures.a.frame"), mentions({"wall: {}"}));
}

TEST(FrameLink, FloorsThatDoNotFaceAreNotPaired) {
  refused(linked("between: [a, b], floors: all"), at("9:58", "links[0].between"),
          mentions({"floors: any", "floors: level", "3 m", "1"}));
  refused(linked("between: [a, b], floors: level"), at("9:58", "links[0].between"), mentions({"floors: any"}));
  refused(linked("between: [a, b], floors: any"), at("9:59", "links[0].between[0]"),
          mentions({"masses: {1.1: {ry: 100 kg m^2}}", "mass: consistent"}));
}

TEST(FrameLink, FramesInSpaceDoNotOverlap) {
  const std::string space = in_space(grids);
  refused(with(space, "origin: [6.02, 0]", "origin: [0, 0]"), at("9:58", "links[0].between"),
          mentions({"origin: [6.1 m, 0 m]", "6 m"}));
  refused(with(space, "origin: [6.02, 0]", "origin: [6.02, 6.02]"), at("9:58", "links[0].between"),
          mentions({"origin"}));
}

// Masts have no width: they are in one line, and a plane frame is in line with an edge.
TEST(FrameLink, FramesWithoutWidthFaceEachOther) {
  const auto mast = [](const std::string& name, const std::string& origin) {
    return "  " + name + ": {frame: {dimension: 3, origin: " + origin +
           ", material: {E: 30 GPa}, nodes: {foot: [0, 0, 0], top: [0, 0, 3]},\n    members: {c: {between: [foot, "
           "top], section: {circle: 0.4}}}, supports: {foot: fixed}, masses: {top: 1 t}, floors: [{nodes: [top], "
           "rigid: false}]}, damping: 5 %}\n";
  };
  const auto direction = [&](const std::string& structures) {
    return test::model_of("structures:\n" + structures +
                          "links: [{between: [a, b], law: hertz, stiffness: 1e9}]\nanalysis: {duration: 1}\n")
        .links[0]
        .direction;
  };
  EXPECT_EQ(direction(mast("a", "[0, 0]") + mast("b", "[2, 0]")), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(direction(mast("a", "[0, 0]") + mast("b", "[0, -2]")), Eigen::Vector3d(0, -1, 0));
  const std::string plane =
      "  b: {frame: {origin: [0.1], material: {E: 30 GPa}, grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: "
      "6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}, damping: 5 %}\n";
  EXPECT_EQ(direction(mast("a", "[0, 0]") + plane), Eigen::Vector3d(1, 0, 0));
  EXPECT_THROW(direction(mast("a", "[0, 0]") + mast("b", "[0, 0]")), InputError);
}

TEST(FrameLink, EdgesFaceEachOther) {
  const std::string space = in_space(grids);
  refused(with(linked("between: [a.1, b.1], points: 2", space), "origin: [6.02, 0]", "origin: [6.02, 6]"),
          at("9:70", "links[0].points"));
  refused(with(linked("between: [a.1, b.1], points: 0", space), "origin: [6.02, 0]", "origin: [6.02, 5]"),
          at("9:78", "links[0].points"), mentions({"0", "100"}));
  // The plans overlap because of a mast next to the floor; the floors do not.
  const std::string ell =
      "structures:\n  a: {frame: {origin: [0, 0], material: {E: 30 GPa}, grid: {storeys: 1, bays: [1, 1], "
      "storey_height: 3 m, bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t},\n      "
      "nodes: {f: [0, 8, 0], g: [0, 8, 3]}, members: {m: {between: [f, g], section: {circle: 0.4}}}, supports: {f: "
      "fixed}, masses: {g: 1 t}}, damping: 5 %}\n  b: {frame: {origin: [6.02, 7], material: {E: 30 GPa}, grid: "
      "{storeys: 1, bays: [1, 1], storey_height: 3 m, bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, "
      "floor_mass: 20 t}}, damping: 5 %}\nlinks: [{between: [a, b], gap: 20 mm, law: hertz, stiffness: "
      "1e9}]\nanalysis: {duration: 1}\n";
  refused(ell, at("5:9", "links[0]"), mentions({"0 m", "6 m", "7 m", "13 m"}));
}

TEST(FrameLink, SeveralPointsNeedAnEdge) {
  refused(linked("between: [a.1, b.1], points: 2"), at("9:70", "links[0].points"));
  refused(linked("between: [a.1, {structure: b, node: 1.0.0}], points: 2", in_space(grids)),
          at("9:94", "links[0].points"));
}

TEST(FrameLink, FrictionNeedsAFrameAForceAndItsVelocity) {
  refused(linked("between: [a.1, b.1], sliding_velocity: 5 mm/s"), at("9:70", "links[0].sliding_velocity"),
          mentions({"friction: 0.3"}));
  refused(linked("between: [a.1, b.1], friction: -0.3"), at("9:80", "links[0].friction"), mentions({"5 %", "-0.3"}));
  refused(linked("between: [a.1, b.1], friction: 0.3, sliding_velocity: 0"), at("9:103", "links[0].sliding_velocity"),
          mentions({"0.3 m/s"}));
  refused(with(linked("between: [a.1, b.1], friction: 0.3"), "law: hertz, stiffness: 2.75e9",
               "law: stereomechanical, restitution: 0.5"),
          at("9:80", "links[0].friction"), mentions({"stereomechanical"}));
  refused(
      "structures:\n  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n  right: {oscillator: {mass: 150 "
      "t, period: 0.4, damping: 5 %}}\nlinks: [{between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9, "
      "friction: 0.3}]\nanalysis: {duration: 1}\n",
      at("4:77", "links[0].friction"));
}

TEST(FrameLink, FrictionMayStickUntilItSlips) {
  const auto friction_of = [](const std::string& value) {
    Model model = test::model_of(linked("between: [a.1, b.1], friction: " + value));
    return std::move(model.links[0]);
  };
  EXPECT_EQ(friction_of("{coefficient: 0.3}").friction, 0.3);
  EXPECT_EQ(friction_of("{coefficient: 0.3}").sliding_velocity, 5e-3);
  EXPECT_EQ(friction_of("{coefficient: 30 %, tangential_stiffness: 50 MN/m}").tangential_stiffness, 5e7);
  EXPECT_DOUBLE_EQ(friction_of("{coefficient: 0.3, poisson: 0.2}").tangential_ratio, 1.6 / 1.8);
  const Link sticks = friction_of("{coefficient: 0.3, static: 0.4, stribeck_velocity: 10 mm/s, tangential_ratio: 0.8}");
  EXPECT_EQ(sticks.static_friction, 0.4);
  EXPECT_EQ(sticks.stribeck_velocity, 0.01);
  EXPECT_EQ(sticks.tangential_ratio, 0.8);
}

TEST(FrameLink, FrictionThatSticksNeedsConsistentKeys) {
  const auto rejects = [](const std::string& value, const std::string& place, const std::string& key, auto facts) {
    refused(linked("between: [a.1, b.1], friction: " + value), at(place, key), facts);
  };
  rejects("{static: 0.4}", "9:80", "links[0].friction", mentions({"coefficient"}));
  rejects("{coefficient: 0.3, static: 0.4}", "9:80", "links[0].friction", mentions({"tangential_stiffness"}));
  rejects("{coefficient: 0.3, static: 0.4, tangential_ratio: 1}", "9:80", "links[0].friction",
          mentions({"stribeck_velocity"}));
  rejects("{coefficient: 0.3, stribeck_velocity: 0.1, tangential_ratio: 1}", "9:80", "links[0].friction",
          mentions({"static"}));
  rejects("{coefficient: 0.3, static: 0.2, stribeck_velocity: 0.1, tangential_ratio: 1}", "9:80", "links[0].friction",
          mentions({"0.2", "0.3"}));
  rejects("{coefficient: 0.3, poisson: 0.2, tangential_ratio: 1}", "9:80", "links[0].friction",
          mentions({"poisson", "tangential_ratio"}));
  rejects("{coefficient: 0.3, tangential_stifness: 1}", "9:99", "links[0].friction",
          mentions({"tangential_stiffness"}));
  refused(linked("between: [a.1, b.1], friction: {coefficient: 0.3, poisson: 0.2}, sliding_velocity: 5 mm/s"),
          at("9:114", "links[0].sliding_velocity"), mentions({"tangential stiffness"}));
}

TEST(FrameLink, ItsEndsExist) {
  refused(linked("between: [a.1, {structure: b, node: 1.7}]"), at("9:64", "links[0].between[1]"),
          mentions({"1.7", "1.0"}));
  refused(linked("between: [a.1, {structure: b, elevation: 9 m}]"), at("9:64", "links[0].between[1]"),
          mentions({"9 m", "0 mm", "5 m"}));
  refused(linked("between: [a.1, {structure: b, elevation: 3 m}]"), at("9:64", "links[0].between[1]"),
          mentions({"masses: {1.0: {ry: 100 kg m^2}}", "mass: consistent"}));
  refused(linked("between: [a.1, {structure: b, elevation: 3 kN}]"), at("9:90", "links[0].between[1].elevation"),
          mentions({"20 mm", "3 kN"}));
  refused(linked("between: [a.1, {structure: b, floor: 3}]"), at("9:86", "links[0].between[1].floor"),
          mentions({"3", "b.2", "1"}));
  refused(linked("between: [a.1, {structure: b, floor: 1, node: 1.0}]"), at("9:64", "links[0].between[1]"),
          mentions({"floor", "node", "elevation"}));
  refused(linked("between: [a.1, {node: 1.0}]"), at("9:64", "links[0].between[1]"), mentions({"structure: left"}));
  refused(linked("between: [a.1, {structure: b, storey: 1}]"), at("9:79", "links[0].between[1]"),
          mentions({"storey", "structure", "floor", "node"}));
  refused(linked("between: [a.3, b.1]"), at("9:59", "links[0].between[0]"), mentions({"a.3", "a.2", "1"}));
  refused(linked("between: [a, b.1]"), at("9:59", "links[0].between[0]"), mentions({"floors: all", "a.2"}));
}

TEST(FrameLink, ARestrainedNodeCannotBeHit) {
  refused(linked("between: [a.1, {structure: b, node: 0.0}]"), at("9:64", "links[0].between[1]"), mentions({"0.0"}));
}

TEST(FrameLink, ANodeWithoutMassCannotBeHit) {
  refused(with(linked("between: [a.1, {structure: b, node: t}]"),
               "columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}\n    damping: 5 %\nlinks",
               "columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}, nodes: {t: [0, 7]}, members: {m: "
               "{between: [2.0, t], section: {circle: 0.4}}}}\n    damping: 5 %\nlinks"),
          at("9:64", "links[0].between[1]"), mentions({"mass"}));
}

TEST(FrameLink, AFrameWithoutFloorsIsHitAtItsNodes) {
  const std::string links = "links: [{between: [a, w], gap: 20 mm, law: hertz, stiffness: 2.75e9}]\n";
  const std::string yaml =
      with(with(lone, "      floors: [{nodes: [b, c]}]\n", ""), "analysis", "  w: {wall: {}}\n" + links + "analysis");
  refused(yaml, at("14:20", "links[0].between[0]"), mentions({"{structure: a, node: NAME}"}));
  refused(with(yaml, "[a, w]", "[a.1, w]"), at("14:20", "links[0].between[0]"),
          mentions({"{structure: a, node: NAME}"}));
  refused(with(yaml, "[a, w]", "[a, w], floors: all"), at("14:19", "links[0].between"),
          mentions({"floors", "{structure: a, node: NAME}"}));
  EXPECT_NO_THROW(test::model_of(with(yaml, "[a, w]", "[{structure: a, node: c}, w]")));
}

TEST(FrameLink, ATiltedStartMustLeaveAGap) {
  const std::string leaning = with(grids, "floor_mass: 20 t}}", "floor_mass: 20 t}, loads: {1.1: {ux: 900 kN}}}");
  refused(leaning, at("9:11", "links[0].gap"), mentions({"25.34 mm"}));
}

const std::string harmonic = "{harmonic: {amplitude: 1, period: 1, duration: 1}}";

std::string moved(const std::string& section, const std::string& yaml = grids) {
  return "ground_motion: " + section + "\n" + yaml;
}

TEST(FrameGround, ComponentsNeedMatchingDofs) {
  refused(moved("{components: {y: " + harmonic + "}}"), at("1:30", "ground_motion.components.y"));
  refused(moved("{components: {w: " + harmonic + "}}"), at("1:30", "ground_motion.components"),
          mentions({"w", "x", "y", "z"}));
  refused(moved("{components: {}}"), at("1:29", "ground_motion.components"),
          mentions({"components: {x: {record: FILE}, y: {record: FILE}}"}));
  refused(moved("{components: {x: " + harmonic + "}, harmonic: {amplitude: 1, period: 1, duration: 1}}"),
          at("1:86", "ground_motion"), mentions({"harmonic", "components", "wave"}));
  EXPECT_NO_THROW(test::model_of(moved("{components: {z: " + harmonic + "}}")));
  EXPECT_NO_THROW(test::model_of(moved("{components: {y: " + harmonic + "}}", in_space(grids))));
  const std::string own = with(grids, "    damping: 5 %\n  b",
                               "    damping: 5 %\n    ground_motion: {components: {y: " + harmonic + "}}\n  b");
  refused(own, at("5:34", "structures.a.ground_motion.components.y"));
  const std::string oscillator =
      "structures:\n  a: {oscillator: {mass: 1 t, period: 1, damping: 5 %}, ground_motion: {components: {z: " +
      harmonic + "}}}\nanalysis: {duration: 1}\n";
  refused(oscillator, at("2:86", "structures.a.ground_motion.components.z"));
}

TEST(FrameGround, AWaveHasADirection) {
  const std::string motion = "harmonic: {amplitude: 1, period: 1, duration: 1}, wave: ";
  refused(moved("{" + motion + "{velocity: 0}}"), at("1:84", "ground_motion.wave.velocity"), mentions({"0.3 m/s"}));
  refused(moved("{" + motion + "{direction: x}}"), at("1:73", "ground_motion.wave"), mentions({"velocity: 500 m/s"}));
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: z}}"), at("1:104", "ground_motion.wave.direction"),
          mentions({"z", "x", "y"}));
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: [1]}}"), at("1:104", "ground_motion.wave.direction"),
          mentions({"direction: [0.6, 0.8]"}));
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: [0, 0]}}"), at("1:104", "ground_motion.wave.direction"),
          mentions({"direction: [0.6, 0.8]"}));
  refused(moved("{wave: {velocity: 500 m/s}}"), at("1:16", "ground_motion"),
          mentions({"ground_motion", "record", "harmonic", "sum", "pulse", "synthetic", "displacement"}));
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: y}}"), at("1:67", "ground_motion.wave"),
          mentions({"origin"}));
  EXPECT_NO_THROW(test::model_of(moved("{" + motion + "{velocity: 500 m/s}}")));
  refused(moved("{displacement: {harmonic: {amplitude: 1 mm, period: 1, duration: 1}}, wave: {velocity: 500 m/s}}"),
          at("1:92", "ground_motion.wave"), mentions({"wave", "ground"}));
  EXPECT_NO_THROW(
      test::model_of(moved("{displacement: {harmonic: {amplitude: 1 mm, period: 1, duration: 1, phase: 90 deg}}, wave: "
                           "{velocity: 500 m/s}}")));
  refused(with(grids, "    damping: 5 %\n  b",
               "    damping: 5 %\n    ground_motion: {" + motion + "{velocity: 500 m/s}}\n  b"),
          at("5:20", "structures.a.ground_motion"), mentions({"ground_motion"}));
}

TEST(FrameGround, ADelayNeedsAMotion) {
  const std::string late = with(grids, "    damping: 5 %\n  b", "    damping: 5 %\n    delay: 0.2 s\n  b");
  refused(late, at("5:5", "structures.a.delay"), mentions({"ground_motion"}));
  refused(with(late, "0.2 s", "-0.2 s"), at("5:12", "structures.a.delay"), mentions({"0.5 s", "-0.2 s"}));
  refused(with(late, "0.2 s", "0.2 m"), at("5:12", "structures.a.delay"), mentions({"0.5 s", "0.2 m"}));
  EXPECT_NO_THROW(test::model_of(moved(harmonic, late)));
  refused(moved("{harmonic: {amplitude: 1, period: 1, duration: 1, initial_velocity: 1}}", late),
          at("6:12", "structures.a.delay"), mentions({"delay", "ground"}));
  refused(with(lone, "d: fixed}", "d: {fix: fixed, delay: 0.2 s}}"), at("2:3", "structures.a"),
          mentions({"ground_motion"}));
}

}  // namespace frame_link_input_test
}  // namespace pounding
