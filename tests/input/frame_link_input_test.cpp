// Mistakes in models with frames, and in what links them and moves them: where, what was read, what to type.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "support/refusals.hpp"

namespace pounding {
namespace frame_link_input_test {

using test::refused;

std::string with(std::string yaml, const std::string& from, const std::string& to) {
  const std::size_t at = yaml.find(from);
  if (at == std::string::npos) throw std::logic_error("the test replaces what is not there: " + from);
  return yaml.replace(at, from.size(), to);
}

// One storey, nodes a b c d from the left foot over the floor to the right foot. Lines 3 to 11 are the frame.
const std::string lone =
    "structures:\n"
    "  a:\n"
    "    frame:\n"
    "      material: {E: 30 GPa}\n"
    "      nodes: {a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], d: [6 m, 0]}\n"
    "      members:\n"
    "        left: {between: [a, b], section: {circle: 0.4 m}}\n"
    "        beam: {between: [b, c], section: {circle: 0.4 m}}\n"
    "        right: {between: [d, c], section: {circle: 0.4 m}}\n"
    "      supports: {a: fixed, d: fixed}\n"
    "      masses: {b: 10 t, c: 10 t}\n"
    "      floors: [{nodes: [b, c]}]\n"
    "    damping: 5 %\n"
    "analysis: {duration: 1}\n";

// Grids of two storeys side by side; the link stands in line 9.
const std::string grids =
    "structures:\n"
    "  a:\n"
    "    frame: {origin: [0], material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, "
    "columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}\n"
    "    damping: 5 %\n"
    "  b:\n"
    "    frame: {origin: [6.02], material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 2.5 m, bay_width: 6 "
    "m, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}\n"
    "    damping: 5 %\n"
    "links:\n"
    "  - {gap: 20 mm, law: hertz, stiffness: 2.75e9, between: [a.1, b.1]}\n"
    "analysis: {duration: 1}\n";

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
          "5:18: structures.a.frame.nodes.a: node a: ux: nothing holds the frame against this displacement; fix it, "
          "brace it or connect it");
  // Hinges at both feet, and a truss that holds no moment.
  refused(with(with(with(lone, "[b, c], section: {circle: 0.4 m}", "[b, c], truss: 20 cm^2"), "a: fixed", "a: pinned"),
               "d: fixed", "d: pinned"),
          "5:29: structures.a.frame.nodes.b: node b: ux: nothing holds the frame against this displacement; fix it, "
          "brace it or connect it");
}

TEST(FrameModel, ANodeThatNothingMeetsIsNamed) {
  refused(with(lone, "d: [6 m, 0]}", "d: [6 m, 0], e: [9 m, 0]}"),
          "5:70: structures.a.frame.nodes.e: node e: no member, spring or constraint is connected to it");
}

TEST(FrameModel, NamesStandOnce) {
  refused(with(lone, "d: [6 m, 0]}", "d: [6 m, 0], b: [9 m, 0]}"),
          "5:67: structures.a.frame.nodes: key \"b\" is given twice; keep one of them");
  refused(with(lone, "right: {", "left: {"),
          "9:9: structures.a.frame.members: key \"left\" is given twice; keep one of them");
  refused(with(grids, "  b:\n", "  a:\n"), "5:3: structures: key \"a\" is given twice; keep one of them");
  refused(with(grids, "floor_mass: 20 t}}", "floor_mass: 20 t}, nodes: {1.1: [0, 9 m]}}"),
          "3:186: structures.a.frame.nodes.1.1: a name must not be empty or contain \".\" or \"/\"; type a name such "
          "as b1");
}

TEST(FrameModel, AMemberHasALength) {
  refused(with(lone, "c: [6 m, 3 m]", "c: [0 m, 3 m]"),
          "8:15: structures.a.frame.members.beam: member 1 (nodes b and c): its two ends are at one point");
}

TEST(FrameModel, AMissingSectionIsNamed) {
  refused(with(lone, ", section: {circle: 0.4 m}}\n        beam", ", section: c40}\n        beam"),
          "7:42: structures.a.frame.members.left.section: unknown section \"c40\". There is no section at all.");
  refused(with(lone, ", section: {circle: 0.4 m}}\n        beam", "}\n        beam"),
          "7:15: structures.a.frame.members.left: the section is missing; type section: {rectangle: [0.4 m, 0.6 m]}, "
          "or truss: 20 cm^2");
}

TEST(FrameModel, SomethingHasMassAndMoves) {
  refused(with(lone, "      masses: {b: 10 t, c: 10 t}\n", ""),
          "4:7: structures.a.frame: nothing in it has mass; type masses: {NODE: 10 t}, floor_mass: 60 t in a grid, or "
          "density: 2500 kg/m^3 in a material");
  refused(with(lone, "supports: {a: fixed, d: fixed}", "supports: {a: fixed, b: fixed, c: fixed, d: fixed}"),
          "4:7: structures.a.frame: all its nodes are held; let one move, or type {wall: {}} instead of the frame");
}

TEST(FrameLink, FloorsThatDoNotFaceAreNotPaired) {
  refused(linked("between: [a, b], floors: all"),
          "9:58: links[0].between: floor 1 of a is 3 m up and faces no floor of b; type floors: any to let it hit the "
          "column there, or floors: level to link only those that face each other");
  refused(
      linked("between: [a, b], floors: level"),
      "9:58: links[0].between: no floor of a is level with one of b; type floors: any to let floors hit the columns");
  refused(linked("between: [a, b], floors: any"),
          "9:59: links[0].between[0]: a: a push there acts on ry of node 1.1, which has no mass; type masses: {1.1: "
          "{ry: 100 kg m^2}}, or mass: consistent with a density");
}

TEST(FrameLink, FramesInSpaceStandApart) {
  const std::string space = in_space(grids);
  refused(with(space, "origin: [6.02, 0]", "origin: [0, 0]"),
          "9:58: links[0].between: a and b stand on each other: a reaches from x = 0 m to 6 m and from y = 0 m to 6 m, "
          "b from x = 0 m to 6 m and from y = 0 m to 6 m; give one of them an origin, such as origin: [6.1 m, 0 m]");
  refused(with(space, "origin: [6.02, 0]", "origin: [6.02, 6.02]"),
          "9:58: links[0].between: a and b stand apart along x and along y: no side of the one faces the other; move "
          "one by its origin");
}

// Masts have no width; they stand in one line, and a plane frame in the line of an edge.
TEST(FrameLink, FramesWithoutWidthFaceEachOther) {
  const auto mast = [](const std::string& name, const std::string& origin) {
    return "  " + name + ": {frame: {dimension: 3, origin: " + origin +
           ", material: {E: 30 GPa}, nodes: {foot: [0, 0, 0], top: [0, 0, 3]},\n"
           "    members: {c: {between: [foot, top], section: {circle: 0.4}}}, supports: {foot: fixed}, masses: {top: 1 "
           "t}, floors: [{nodes: [top], rigid: false}]}, damping: 5 %}\n";
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
      "6 m, "
      "columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}, damping: 5 %}\n";
  EXPECT_EQ(direction(mast("a", "[0, 0]") + plane), Eigen::Vector3d(1, 0, 0));
  EXPECT_THROW(direction(mast("a", "[0, 0]") + mast("b", "[0, 0]")), InputError);
}

TEST(FrameLink, EdgesFaceEachOther) {
  const std::string space = in_space(grids);
  refused(with(linked("between: [a.1, b.1], points: 2", space), "origin: [6.02, 0]", "origin: [6.02, 6]"),
          "9:70: links[0].points: the two meet at one point; leave it out");
  refused(with(linked("between: [a.1, b.1], points: 0", space), "origin: [6.02, 0]", "origin: [6.02, 5]"),
          "9:78: links[0].points: takes an integer from 1 to 100; \"0\" is outside");
  // The plans face each other by a mast beside the floor, the floors do not.
  const std::string ell =
      "structures:\n"
      "  a: {frame: {origin: [0, 0], material: {E: 30 GPa}, grid: {storeys: 1, bays: [1, 1], storey_height: 3 m, "
      "bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t},\n"
      "      nodes: {f: [0, 8, 0], g: [0, 8, 3]}, members: {m: {between: [f, g], section: {circle: 0.4}}}, supports: "
      "{f: fixed}, masses: {g: 1 t}}, damping: 5 %}\n"
      "  b: {frame: {origin: [6.02, 7], material: {E: 30 GPa}, grid: {storeys: 1, bays: [1, 1], storey_height: 3 m, "
      "bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}, damping: 5 %}\n"
      "links: [{between: [a, b], gap: 20 mm, law: hertz, stiffness: 1e9}]\n"
      "analysis: {duration: 1}\n";
  refused(ell,
          "5:9: links[0]: the edges of a and b pass each other: from 0 m to 6 m and from 7 m to 13 m; move one by its "
          "origin, or link nodes");
}

TEST(FrameLink, SeveralPointsNeedAnEdge) {
  refused(linked("between: [a.1, b.1], points: 2"),
          "9:70: links[0].points: several points need floors of structures in space on both sides; leave it out");
  refused(linked("between: [a.1, {structure: b, node: 1.0.0}], points: 2", in_space(grids)),
          "9:94: links[0].points: the two meet at one point; leave it out");
}

TEST(FrameLink, FrictionNeedsAFrameAForceAndItsVelocity) {
  refused(linked("between: [a.1, b.1], sliding_velocity: 5 mm/s"),
          "9:70: links[0].sliding_velocity: belongs to friction; type friction: 0.3 beside it, or leave it out");
  refused(linked("between: [a.1, b.1], friction: -0.3"),
          "9:80: links[0].friction: takes a number >= 0 such as \"5 %\"; \"-0.3\" is outside");
  refused(linked("between: [a.1, b.1], friction: 0.3, sliding_velocity: 0"),
          "9:103: links[0].sliding_velocity: takes a velocity > 0 such as \"0.3 m/s\"; \"0\" is outside");
  refused(with(linked("between: [a.1, b.1], friction: 0.3"), "law: hertz, stiffness: 2.75e9",
               "law: stereomechanical, restitution: 0.5"),
          "9:80: links[0].friction: needs a law with a force; a stereomechanical contact gives velocities only");
  refused(
      "structures:\n"
      "  left: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n"
      "  right: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n"
      "links: [{between: [left, right], gap: 20 mm, law: hertz, stiffness: 2.75e9, friction: 0.3}]\n"
      "analysis: {duration: 1}\n",
      "4:77: links[0].friction: needs a frame: the others move along x only and cannot slide; leave it out");
}

TEST(FrameLink, ItsEndsExist) {
  refused(linked("between: [a.1, {structure: b, node: 1.7}]"),
          "9:64: links[0].between[1]: b: unknown node \"1.7\". Did you mean \"1.0\"?");
  refused(linked("between: [a.1, {structure: b, elevation: 9 m}]"),
          "9:64: links[0].between[1]: b: there is no column 9 m up; its members reach from 0 mm to 5 m");
  refused(linked("between: [a.1, {structure: b, elevation: 3 m}]"),
          "9:64: links[0].between[1]: b: a push there acts on ry of node 1.0, which has no mass; type masses: {1.0: "
          "{ry: 100 kg m^2}}, or mass: consistent with a density");
  refused(linked("between: [a.1, {structure: b, elevation: 3 kN}]"),
          "9:90: links[0].between[1].elevation: takes a length such as \"20 mm\"; \"3 kN\" is a force");
  refused(linked("between: [a.1, {structure: b, floor: 3}]"),
          "9:86: links[0].between[1].floor: \"3\" names no floor of b, which has the floors 1 to 2; type b.2");
  refused(linked("between: [a.1, {structure: b, floor: 1, node: 1.0}]"),
          "9:64: links[0].between[1]: takes one of floor, node and elevation; keep one of them");
  refused(linked("between: [a.1, {node: 1.0}]"),
          "9:64: links[0].between[1]: key \"structure\" is missing; type \"structure: left\"");
  refused(linked("between: [a.1, {structure: b, storey: 1}]"),
          "9:79: links[0].between[1]: unknown key \"storey\". Allowed: structure, floor, node, elevation, face.");
  refused(linked("between: [a.3, b.1]"),
          "9:59: links[0].between[0]: \"a.3\" names no floor of a, which has the floors 1 to 2; type a.2");
  refused(linked("between: [a, b.1]"),
          "9:59: links[0].between[0]: which of the 2 floors of a? Type a.2, or add floors: all");
}

TEST(FrameLink, AHeldNodeCannotBeHit) {
  refused(linked("between: [a.1, {structure: b, node: 0.0}]"),
          "9:64: links[0].between[1]: node 0.0 of b is held by its support and cannot be hit; name a floor, or a node "
          "that moves");
}

TEST(FrameLink, ANodeWithoutMassCannotBeHit) {
  refused(with(linked("between: [a.1, {structure: b, node: t}]"),
               "columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}\n    damping: 5 %\nlinks",
               "columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}, nodes: {t: [0, 7]}, members: {m: "
               "{between: [2.0, t], section: {circle: 0.4}}}}\n    damping: 5 %\nlinks"),
          "9:64: links[0].between[1]: node t of b has no mass; give it one, or name a floor");
}

TEST(FrameLink, AFrameWithoutFloorsIsHitAtItsNodes) {
  const std::string links = "links: [{between: [a, w], gap: 20 mm, law: hertz, stiffness: 2.75e9}]\n";
  const std::string yaml =
      with(with(lone, "      floors: [{nodes: [b, c]}]\n", ""), "analysis", "  w: {wall: {}}\n" + links + "analysis");
  refused(yaml, "14:20: links[0].between[0]: a has no floors; name a node, as in {structure: a, node: NAME}");
  refused(with(yaml, "[a, w]", "[a.1, w]"),
          "14:20: links[0].between[0]: a has no floors; name a node, as in {structure: a, node: NAME}");
  refused(with(yaml, "[a, w]", "[a, w], floors: all"),
          "14:19: links[0].between: a has no floors; name a node, as in {structure: a, node: NAME}, and leave "
          "\"floors\" out");
  EXPECT_NO_THROW(test::model_of(with(yaml, "[a, w]", "[{structure: a, node: c}, w]")));
}

TEST(FrameLink, ATiltedStartMustLeaveAGap) {
  const std::string leaning = with(grids, "floor_mass: 20 t}}", "floor_mass: 20 t}, loads: {1.1: {ux: 900 kN}}}");
  refused(leaning,
          "9:11: links[0].gap: a and b overlap by 25.34 mm at the start; they lean towards each other under their "
          "loads: move b away by 25.34 mm or more with its origin");
}

const std::string harmonic = "{harmonic: {amplitude: 1, period: 1, duration: 1}}";

std::string moved(const std::string& section, const std::string& yaml = grids) {
  return "ground_motion: " + section + "\n" + yaml;
}

TEST(FrameGround, ComponentsCanBeFollowed) {
  refused(moved("{components: {y: " + harmonic + "}}"),
          "1:30: ground_motion.components.y: no structure is in space; leave the motion along y out");
  refused(moved("{components: {w: " + harmonic + "}}"),
          "1:30: ground_motion.components: unknown key \"w\". Allowed: x, y, z.");
  refused(moved("{components: {}}"),
          "1:29: ground_motion.components: takes motions along x, y, z; type components: {x: {record: FILE}, y: "
          "{record: FILE}}");
  refused(moved("{components: {x: " + harmonic + "}, harmonic: {amplitude: 1, period: 1, duration: 1}}"),
          "1:86: ground_motion: unknown key \"harmonic\". Allowed: components, wave.");
  EXPECT_NO_THROW(test::model_of(moved("{components: {z: " + harmonic + "}}")));
  EXPECT_NO_THROW(test::model_of(moved("{components: {y: " + harmonic + "}}", in_space(grids))));
  const std::string own = with(grids, "    damping: 5 %\n  b",
                               "    damping: 5 %\n    ground_motion: {components: {y: " + harmonic + "}}\n  b");
  refused(own,
          "5:34: structures.a.ground_motion.components.y: the structure is not in space; leave the motion along y out");
  const std::string oscillator =
      "structures:\n  a: {oscillator: {mass: 1 t, period: 1, damping: 5 %}, ground_motion: {components: {z: " +
      harmonic + "}}}\nanalysis: {duration: 1}\n";
  refused(oscillator,
          "2:86: structures.a.ground_motion.components.z: the structure does not move up and down; leave the motion "
          "along z out");
}

TEST(FrameGround, AWaveRunsSomewhere) {
  const std::string motion = "harmonic: {amplitude: 1, period: 1, duration: 1}, wave: ";
  refused(moved("{" + motion + "{velocity: 0}}"),
          "1:84: ground_motion.wave.velocity: takes a velocity > 0 such as \"0.3 m/s\"; \"0\" is outside");
  refused(moved("{" + motion + "{direction: x}}"),
          "1:73: ground_motion.wave: key \"velocity\" is missing; type \"velocity: 500 m/s\"");
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: z}}"),
          "1:104: ground_motion.wave.direction: unknown direction \"z\". Allowed: x, y.");
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: [1]}}"),
          "1:104: ground_motion.wave.direction: takes x, y, or two numbers; type direction: [0.6, 0.8]");
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: [0, 0]}}"),
          "1:104: ground_motion.wave.direction: has no length; type direction: [0.6, 0.8]");
  refused(moved("{wave: {velocity: 500 m/s}}"),
          "1:16: ground_motion: takes one of record, harmonic, sum, pulse, synthetic, displacement; for a still ground "
          "leave \"ground_motion\" out");
  refused(moved("{" + motion + "{velocity: 500 m/s, direction: y}}"),
          "1:67: ground_motion.wave: reaches all supports at once; give the frames an origin each, or leave it out");
  EXPECT_NO_THROW(test::model_of(moved("{" + motion + "{velocity: 500 m/s}}")));
  refused(moved("{displacement: {harmonic: {amplitude: 1 mm, period: 1, duration: 1}}, wave: {velocity: 500 m/s}}"),
          "1:92: ground_motion.wave: the ground motion begins with a velocity, which it cannot take up at once where "
          "the wave arrives; "
          "take a motion that begins at rest");
  EXPECT_NO_THROW(
      test::model_of(moved("{displacement: {harmonic: {amplitude: 1 mm, period: 1, duration: 1, phase: 90 deg}}, wave: "
                           "{velocity: 500 m/s}}")));
  refused(
      with(grids, "    damping: 5 %\n  b",
           "    damping: 5 %\n    ground_motion: {" + motion + "{velocity: 500 m/s}}\n  b"),
      "5:20: structures.a.ground_motion: a wave belongs to the ground_motion of all structures; give this one a delay");
}

TEST(FrameGround, ADelayNeedsAMotion) {
  const std::string late = with(grids, "    damping: 5 %\n  b", "    damping: 5 %\n    delay: 0.2 s\n  b");
  refused(late, "5:5: structures.a.delay: nothing moves the ground here; give a ground_motion, or leave the delay out");
  refused(with(late, "0.2 s", "-0.2 s"),
          "5:12: structures.a.delay: takes a time >= 0 such as \"0.5 s\"; \"-0.2 s\" is outside");
  refused(with(late, "0.2 s", "0.2 m"),
          "5:12: structures.a.delay: takes a time such as \"0.5 s\"; \"0.2 m\" is a length");
  EXPECT_NO_THROW(test::model_of(moved(harmonic, late)));
  refused(moved("{harmonic: {amplitude: 1, period: 1, duration: 1, initial_velocity: 1}}", late),
          "6:12: structures.a.delay: the ground motion begins with a velocity, which it cannot take up at once after a "
          "delay; leave the "
          "delay out, or give harmonics another phase");
  refused(with(lone, "d: fixed}", "d: {fix: fixed, delay: 0.2 s}}"),
          "2:3: structures.a: support d has a delay, and nothing moves the ground here; give a ground_motion, or leave "
          "the delay out");
}

}  // namespace frame_link_input_test
}  // namespace pounding
