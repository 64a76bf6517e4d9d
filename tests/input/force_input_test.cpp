// Errors in forces, displaced frames, falling bodies and frames without supports: location and text to type.

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include <pounding/input/input.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/reports/describe.hpp>
#include "support/models.hpp"

namespace pounding {
namespace force_input_test {

using test::at, test::mentions, test::refused;

std::string building(const std::string& force) {
  return "analysis: {duration: 1}\nstructures:\n  a:\n    shear_building: {storeys: 3, mass: 20 t, stiffness: 20 "
         "MN/m}\n    damping: 5 %\n    forces:\n      - {" +
         force + "}\n";
}

std::string frame(const std::string& more, const std::string& beside = "",
                  const std::string& supports = "{a: fixed, d: fixed}") {
  return "analysis: {duration: 1}\nstructures:\n  a:\n    damping: 5 %\n" + beside +
         "    frame:\n      material: {E: 30 GPa}\n      nodes: {a: [0, 0], b: [0, 3 m], c: [6 m, 3 m], d: [6 m, 0]}\n "
         "     members:\n        left: {between: [a, b], section: {circle: 0.4 m}}\n        beam: {between: [b, c], "
         "section: {circle: 0.4 m}}\n        right: {between: [d, c], section: {circle: 0.4 m}}\n      supports: " +
         supports + "\n      masses: {b: 10 t, c: 10 t}\n" + more;
}

const std::string pulse = "pulse: {shape: sine, amplitude: 20 kN, duration: 0.1}";

TEST(ForceInput, ReportsForcesThatCannotAct) {
  refused(building("floor: 4, " + pulse), at("7:9", "structures.a.forces[0]"), mentions({"4", "3"}));
  refused(building(pulse), at("7:9", "structures.a.forces[0]"), mentions({"floor: 3"}));
  refused(building("floor: 1, dof: uy, " + pulse), at("7:9", "structures.a.forces[0]"), mentions({"uy", "ux"}));
  refused(building("node: b, " + pulse), at("7:9", "structures.a.forces[0]"));
  refused(building("floor: 1, node: b, " + pulse), at("7:20", "structures.a.forces[0].node"));
  refused("structures:\n  a: {wall: {}, forces: [{" + pulse + "}]}\n", at("2:26", "structures.a.forces[0]"),
          mentions({"wall", "ground"}));
  refused(frame("", "    forces: [{node: e, " + pulse + "}]\n"), at("5:14", "structures.a.forces[0]"),
          mentions({"e", "a", "b", "c"}));
  refused(frame("", "    forces: [{floor: 1, " + pulse + "}]\n"), at("5:14", "structures.a.forces[0]"),
          mentions({"node: b"}));
  refused(frame("", "    forces: [{node: a, " + pulse + "}]\n"), at("5:14", "structures.a.forces[0]"),
          mentions({"ux"}));
  refused(frame("", "    forces: [{node: b, dof: ry, pulse: {shape: sine, amplitude: 20 kN m, duration: 0.1}}]\n"),
          at("5:14", "structures.a.forces[0]"), mentions({"mass: consistent", "100 kg m^2", "ry"}));
  refused(frame("", "    forces: [{node: b, dof: uy, " + pulse + "}]\n"), at("5:14", "structures.a.forces[0]"),
          mentions({"uy", "ux"}));
}

TEST(ForceInput, ReportsIncompleteTimeHistories) {
  refused(building("floor: 1"), at("7:9", "structures.a.forces[0]"), mentions({"step_force"}));
  refused(building("floor: 1, " + pulse + ", step_force: {amplitude: 1 kN}"),
          at("7:75", "structures.a.forces[0].step_force"), mentions({"pulse", "step_force"}));
  refused(building("floor: 1, harmonic: {amplitude: 20 kN, duration: 1}"),
          at("7:30", "structures.a.forces[0].harmonic"), mentions({"period: 0.5 s"}));
  refused(building("floor: 1, harmonic: {amplitude: 20 kN, period: 1, frequency: 1 Hz, duration: 1}"),
          at("7:60", "structures.a.forces[0].harmonic.frequency"), mentions({"period", "frequency"}));
  refused(building("floor: 1, harmonic: {amplitude: 20 kN, frequency: 15 rad/s, duration: 1}"),
          at("7:60", "structures.a.forces[0].harmonic.frequency"), mentions({"2.5 Hz", "15 rad/s"}));
  refused(building("floor: 1, start: 1 s, " + pulse), at("7:20", "structures.a.forces[0].start"), mentions({"record"}));
  refused(building("floor: 1, scale: 2, " + pulse), at("7:20", "structures.a.forces[0].scale"), mentions({"record"}));
  refused(building("floor: 1, pulse: {shape: sine, amplitude: 20 kg, duration: 0.1}"),
          at("7:52", "structures.a.forces[0].pulse.amplitude"), mentions({"200 kN", "20 kg"}));
  refused("analysis: {duration: 1}\nstructures: {a: {body: {mass: 1 t}, forces: []}}\n",
          at("2:45", "structures.a.forces"));
  refused("structures: {a: {body: {mass: 1 t}, forces: [{step_force: {amplitude: 1 kN}}]}}\n", at("1:1"),
          mentions({"analysis: {duration: 10 s}"}));
  refused("analysis: {duration: 1}\nstructures: {a: {body: {mass: 1 t}, forces: {step_force: {amplitude: 1 kN}}}}\n",
          at("2:45", "structures.a.forces"), mentions({"harmonic: {amplitude: 20 kN, period: 0.5 s, duration: 10 s}"}));
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
  refused(building("floor: 1, record: " + bare), at("7:28", "structures.a.forces[0].record"),
          mentions({bare, "units:"}));
  refused(building("floor: 1, units: g, record: " + bare), at("7:38", "structures.a.forces[0].record"),
          mentions({bare, "g"}));
}

TEST(ForceInput, DescribesForces) {
  const std::string said =
      describe(test::model_of(building("floor: 2, harmonic: {amplitude: 20 kN, frequency: 2 Hz, duration: 1}")));
  EXPECT_NE(said.find("     force on floor 2 ux: harmonic, 20 kN at 0.5 s for 1 s\n"), said.npos) << said;
  std::string text = frame("", "    forces: [{node: b, dof: ry, step_force: {amplitude: 7 kN m}}]\n");
  const std::string mass = "masses: {b: 10 t";
  text.replace(text.find(mass), mass.size(), "masses: {b: {ux: 10 t, uz: 10 t, ry: 5 t m^2}");
  const std::string turns = describe(test::model_of(text));
  EXPECT_NE(turns.find("     force on node b ry: step to 7 kN m at 0 s\n"), turns.npos) << turns;
}

TEST(DisplacedFrameInput, ReportsInvalidDisplacements) {
  refused(frame("      initial_displacement: 5 mm\n"), at("14:29", "structures.a.frame.initial_displacement"),
          mentions({"initial_node_displacements: {b: {ux: 5 mm}}"}));
  refused(frame("      floors: [{nodes: [b, c]}]\n      initial_displacement: [1 mm, 2 mm]\n"),
          at("15:29", "structures.a.frame.initial_displacement"), mentions({"20 mm", "2"}));
  refused(frame("      initial_node_displacements: {a: {ux: 1 mm}}\n"),
          at("14:35", "structures.a.frame.initial_node_displacements"), mentions({"ux"}));
  refused(frame("      initial_node_displacements: {e: {ux: 1 mm}}\n"),
          at("14:35", "structures.a.frame.initial_node_displacements"), mentions({"e", "a", "b", "c"}));
  refused(frame("      floors: [{nodes: [b, c], rigid: true}]\n      initial_node_displacements: {b: {ux: 1 mm}, c: "
                "{ux: 1 mm}}\n"),
          at("15:35", "structures.a.frame.initial_node_displacements"));
  refused(frame("      initial_node_displacements: {b: {ry: 0.01}}\n"),
          at("14:35", "structures.a.frame.initial_node_displacements"), mentions({"ry"}));
  refused(frame("      initial_node_displacements: {b: 5 mm}\n"),
          at("14:39", "structures.a.frame.initial_node_displacements.b"), mentions({"{ux: 5 mm}"}));
}

TEST(DisplacedFrameInput, ReportsOverlapsWithNeighbours) {
  const std::string grid =
      "grid: {storeys: 1, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, "
      "floor_mass: 20 t, rigid_floors: true}";
  refused("analysis: {duration: 1}\nstructures:\n  a: {damping: 5 %, frame: {material: {E: 30 GPa}, " + grid +
              ", initial_displacement: 30 mm}}\n  b: {damping: 5 %, frame: {origin: [6.02], material: {E: 30 GPa}, " +
              grid + "}}\nlinks:\n  - {between: [a, b], floors: level, law: hertz, stiffness: 1e9}\n",
          at("6:5", "links[0]"), mentions({"10 mm"}));
}

TEST(FreeFrameInput, ReportsLoadsWithoutSupports) {
  EXPECT_NO_THROW(test::model_of(frame("", "", "none")));
  refused(frame("", "", "fixed"), at("12:17", "structures.a.frame.supports"), mentions({"{a: fixed}"}));
  refused(frame("      gravity: true\n", "", "none"), at("6:7", "structures.a.frame"), mentions({"gravity"}));
  refused(frame("      geometry: corotational\n", "", "none"), at("6:7", "structures.a.frame"));
  refused(frame("      springs: [{node: b, dof: ux, stiffness: 1 MN/m}]\n", "", "none"),
          at("6:7", "structures.a.frame"));
  refused(frame("      initial_node_displacements: {b: {ux: 1 mm}}\n", "", "none"),
          at("14:35", "structures.a.frame.initial_node_displacements"), mentions({"initial_velocity"}));
}

}  // namespace force_input_test
}  // namespace pounding
