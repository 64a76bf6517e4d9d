// Mistakes in forces over time, in displaced frames, in falling bodies and in frames without supports: where, and what
// to type.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include <pounding/input/input.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/model/describe.hpp>
#include <pounding/model/ground_plan.hpp>
#include "support/refusals.hpp"

namespace pounding {
namespace force_input_test {

using test::refused;

std::string building(const std::string& force) {
  return "analysis: {duration: 1}\nstructures:\n  a:\n    shear_building: {storeys: 3, mass: 20 t, stiffness: 20 "
         "MN/m}\n    damping: 5 %\n"
         "    forces:\n      - {" +
         force + "}\n";
}

std::string frame(const std::string& more, const std::string& beside = "",
                  const std::string& supports = "{a: fixed, d: fixed}") {
  return "analysis: {duration: 1}\nstructures:\n  a:\n    damping: 5 %\n" + beside +
         "    frame:\n      material: {E: 30 GPa}\n      nodes: {a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], d: [6 m, 0]}\n "
         "     members:\n"
         "        left: {between: [a, b], section: {circle: 0.4 m}}\n        beam: {between: [b, c], section: {circle: "
         "0.4 m}}\n"
         "        right: {between: [d, c], section: {circle: 0.4 m}}\n      supports: " +
         supports + "\n      masses: {b: 10 t, c: 10 t}\n" + more;
}

const std::string pulse = "pulse: {shape: sine, amplitude: 20 kN, duration: 0.1}";

TEST(ForceInput, SaysWhereForcesCannotAct) {
  refused(building("floor: 4, " + pulse), "7:9: structures.a.forces[0]: there is no floor 4 among 3");
  refused(building(pulse), "7:9: structures.a.forces[0]: its place is missing; type floor: 3, or the node of a frame");
  refused(building("floor: 1, dof: uy, " + pulse),
          "7:9: structures.a.forces[0]: a force on a floor acts along ux; \"uy\" was given");
  refused(building("node: b, " + pulse), "7:9: structures.a.forces[0]: it has no nodes; name a floor");
  refused(building("floor: 1, node: b, " + pulse),
          "7:20: structures.a.forces[0].node: a force acts on a floor or on a node; keep one of the two");
  refused("structures:\n  a: {wall: {}, forces: [{" + pulse + "}]}\n",
          "2:26: structures.a.forces[0]: a wall moves with the ground, whatever pushes it; leave the force out");
  refused(frame("", "    forces: [{node: e, " + pulse + "}]\n"),
          "5:14: structures.a.forces[0]: unknown node \"e\". Allowed: a, b, c, d.");
  refused(
      frame("", "    forces: [{floor: 1, " + pulse + "}]\n"),
      "5:14: structures.a.forces[0]: the frame has no floors; type the node on which the force acts, as in node: b");
  refused(frame("", "    forces: [{node: a, " + pulse + "}]\n"),
          "5:14: structures.a.forces[0]: node a ux is held, and a force there moves nothing; leave it out");
  refused(frame("", "    forces: [{node: b, dof: ry, pulse: {shape: sine, amplitude: 20 kN m, duration: 0.1}}]\n"),
          "5:14: structures.a.forces[0]: the force acts on node b ry, which has no mass; give it one under masses, "
          "such as 100 kg m^2, or type "
          "mass: consistent with a density");
  refused(frame("", "    forces: [{node: b, dof: uy, " + pulse + "}]\n"),
          "5:14: structures.a.forces[0]: unknown displacement \"uy\". Did you mean \"ux\"?");
}

TEST(ForceInput, SaysWhatACourseNeeds) {
  refused(building("floor: 1"),
          "7:9: structures.a.forces[0]: its course over time is missing; it is one of record, harmonic, sum, pulse, "
          "step_force");
  refused(building("floor: 1, " + pulse + ", step_force: {amplitude: 1 kN}"),
          "7:75: structures.a.forces[0].step_force: \"pulse\" and \"step_force\" are both given; make two forces of "
          "them, which add");
  refused(building("floor: 1, harmonic: {amplitude: 20 kN, duration: 1}"),
          "7:30: structures.a.forces[0].harmonic: key \"period\" is missing; type \"period: 0.5 s\"");
  refused(
      building("floor: 1, harmonic: {amplitude: 20 kN, period: 1, frequency: 1 Hz, duration: 1}"),
      "7:60: structures.a.forces[0].harmonic.frequency: \"period\" and \"frequency\" are both given; keep one of them");
  refused(building("floor: 1, harmonic: {amplitude: 20 kN, frequency: 15 rad/s, duration: 1}"),
          "7:60: structures.a.forces[0].harmonic.frequency: takes turns in a second such as \"2.5 Hz\"; \"15 rad/s\" "
          "is a circular frequency, divide "
          "by 2 pi");
  refused(building("floor: 1, start: 1 s, " + pulse),
          "7:20: structures.a.forces[0].start: belongs to a record or sum; type it inside pulse");
  refused(building("floor: 1, scale: 2, " + pulse), "7:20: structures.a.forces[0].scale: belongs to a record");
  refused(building("floor: 1, pulse: {shape: sine, amplitude: 20 kg, duration: 0.1}"),
          "7:52: structures.a.forces[0].pulse.amplitude: takes a force such as \"200 kN\"; \"20 kg\" is a mass");
  refused("analysis: {duration: 1}\nstructures: {a: {body: {mass: 1 t}, forces: []}}\n",
          "2:45: structures.a.forces: holds no force; leave it out");
  refused("structures: {a: {body: {mass: 1 t}, forces: [{step_force: {amplitude: 1 kN}}]}}\n",
          "1:1: the duration is missing; type analysis: {duration: 10 s}");
  refused("analysis: {duration: 1}\nstructures: {a: {body: {mass: 1 t}, forces: {step_force: {amplitude: 1 kN}}}}\n",
          "2:45: structures.a.forces: takes a list, one force a line; type - {floor: 3, harmonic: {amplitude: 20 kN, "
          "period: 0.5 s, duration: 10 s}}");
}

TEST(ForceInput, ReadsRecordsOfForces) {
  const std::string file = testing::TempDir() + "pounding_forces.csv", bare = testing::TempDir() + "pounding_bare.csv";
  std::ofstream(file) << "t [s], F [kN]\n0, 0\n0.1, 2\n0.3, -1\n";
  std::ofstream(bare) << "0 0\n0.1 2\n0.3 -1\n";
  const auto read = [](const std::string& text) { return ground_plan(test::model_of(text)).motions.back(); };
  const GroundMotion stated = read(building("floor: 1, record: " + file + ", scale: 2, start: 0.5 s"));
  EXPECT_DOUBLE_EQ(stated.acceleration(0.6), 4000);
  EXPECT_NEAR(stated.acceleration(0.7), 1000, 1e-9);
  EXPECT_EQ(stated.acceleration(0.9), 0);
  EXPECT_DOUBLE_EQ(read(building("floor: 1, units: MN, record: " + bare)).peak(), 2e6);
  refused(building("floor: 1, record: " + bare), "7:28: structures.a.forces[0].record: " + bare +
                                                     ": the file does not state the unit of its forces; add "
                                                     "\"units:\" with N, kN or MN");
  refused(building("floor: 1, units: g, record: " + bare), "7:38: structures.a.forces[0].record: " + bare +
                                                               ": units: \"g\" is not the unit of a force; "
                                                               "type N, kN or MN");
}

TEST(ForceInput, SaysWhatAForceIs) {
  const std::string said =
      describe(test::model_of(building("floor: 2, harmonic: {amplitude: 20 kN, frequency: 2 Hz, duration: 1}")));
  EXPECT_NE(said.find("     force on floor 2 ux: harmonic, 20 kN at 0.5 s for 1 s\n"), said.npos) << said;
  std::string text = frame("", "    forces: [{node: b, dof: ry, step_force: {amplitude: 7 kN m}}]\n");
  const std::string mass = "masses: {b: 10 t";
  text.replace(text.find(mass), mass.size(), "masses: {b: {ux: 10 t, uz: 10 t, ry: 5 t m^2}");
  const std::string turns = describe(test::model_of(text));
  EXPECT_NE(turns.find("     force on node b ry: step to 7 kN m at 0 s\n"), turns.npos) << turns;
}

TEST(DisplacedFrameInput, SaysWhatCannotBeHeld) {
  refused(frame("      initial_displacement: 5 mm\n"),
          "14:29: structures.a.frame.initial_displacement: the frame has no floors; type "
          "initial_node_displacements: {b: {ux: 5 mm}}, or give it floors");
  refused(frame("      floors: [{nodes: [b, c]}]\n      initial_displacement: [1 mm, 2 mm]\n"),
          "15:29: structures.a.frame.initial_displacement: takes a length such as \"20 mm\" or a list of 1 from the "
          "ground up; a list of 2 was read");
  refused(frame("      initial_node_displacements: {a: {ux: 1 mm}}\n"),
          "14:35: structures.a.frame.initial_node_displacements: ux of node a is held by the supports; leave it out");
  refused(frame("      initial_node_displacements: {e: {ux: 1 mm}}\n"),
          "14:35: structures.a.frame.initial_node_displacements: unknown node \"e\". Allowed: a, b, c, d.");
  refused(frame("      floors: [{nodes: [b, c], rigid: true}]\n      initial_node_displacements: {b: {ux: 1 mm}, c: "
                "{ux: 1 mm}}\n"),
          "15:35: structures.a.frame.initial_node_displacements: two of the displacements are tied to each other; keep "
          "one of them");
  refused(frame("      initial_node_displacements: {b: {ry: 0.01}}\n"),
          "14:35: structures.a.frame.initial_node_displacements: ry of node b has no mass, and would spring back at "
          "once; leave it out, or give it a "
          "mass");
  refused(
      frame("      initial_node_displacements: {b: 5 mm}\n"),
      "14:39: structures.a.frame.initial_node_displacements.b: takes displacements by their names; type {ux: 5 mm}");
}

TEST(DisplacedFrameInput, SaysWhereItOverlapsItsNeighbour) {
  const std::string grid =
      "grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, "
      "floor_mass: 20 t, "
      "rigid_floors: true}";
  refused("analysis: {duration: 1}\nstructures:\n  a: {damping: 5 %, frame: {material: {E: 30 GPa}, " + grid +
              ", initial_displacement: 30 mm}}\n"
              "  b: {damping: 5 %, frame: {origin: [6.02], material: {E: 30 GPa}, " +
              grid + "}}\nlinks:\n  - {between: [a, b], floors: level, law: hertz, stiffness: 1e9}\n",
          "6:5: links[0]: a and b overlap by 10 mm at the start; they are displaced towards each other: move b away by "
          "10 mm or more with its origin");
}

TEST(FreeFrameInput, SaysWhatNeedsSupports) {
  EXPECT_NO_THROW(test::model_of(frame("", "", "none")));
  refused(frame("", "", "fixed"),
          "12:17: structures.a.frame.supports: takes supports by their nodes, such as {a: fixed}, feet for those of a "
          "grid, or none; "
          "\"fixed\" was read");
  refused(frame("      gravity: true\n", "", "none"),
          "6:7: structures.a.frame: without supports nothing bears loads or weights; leave out loads and gravity");
  refused(frame("      geometry: corotational\n", "", "none"),
          "6:7: structures.a.frame: without supports the geometry is linear; leave the geometry out");
  refused(frame("      springs: [{node: b, dof: ux, stiffness: 1 MN/m}]\n", "", "none"),
          "6:7: structures.a.frame: the frame has no supports, and node b is held; leave out supports: none, or what "
          "holds the node");
  refused(frame("      initial_node_displacements: {b: {ux: 1 mm}}\n", "", "none"),
          "14:35: structures.a.frame.initial_node_displacements: without supports no forces hold a frame in a shape; "
          "leave it out, or give an "
          "initial_velocity");
}

}  // namespace force_input_test
}  // namespace pounding
