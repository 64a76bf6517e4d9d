// Contradictions of the drawing of frames: another gap, overlaps, the wrong side, ends that pass each other.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "support/refusals.hpp"

namespace pounding {
namespace drawing_input_test {

using test::refused;

// Options of a grid: its origin, the height of a storey, the bays.
std::string grid(const std::string& name, const std::string& origin, const std::string& height = "3 m",
                 const std::string& bays = "1") {
  return "  " + name + ": {frame: {origin: [" + origin +
         "], material: {E: 30 GPa, density: 2500 kg/m^3}, mass: consistent,\n    grid: {storeys: 2, bays: " + bays +
         ", storey_height: " + height +
         ", bay_width: 6 m, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}, damping: 5 %}\n";
}

std::string mast(const std::string& name, const std::string& x, const std::string& height = "3 m") {
  return "  " + name + ": {frame: {material: {E: 30 GPa}, nodes: {foot: [" + x + ", 0], top: [" + x + ", " + height +
         "]}, members: {c: {between: [foot, top], section: {circle: 0.4}}},\n    supports: {foot: fixed}, masses: "
         "{top: 5 t}, floors: [{nodes: [top]}]}, damping: 5 %}\n";
}

// Two grids of 6 m, the second at this origin.
std::string pair(const std::string& origin, const std::string& height = "3 m") {
  return grid("a", "0") + grid("b", origin, height);
}
std::string in_space(const std::string& origin, const std::string& height = "3 m") {
  return grid("a", "0, 0", "3 m", "[1, 1]") + grid("b", origin, height, "[1, 1]");
}
std::string masts() { return mast("a", "0") + mast("b", "2 m"); }

std::string linked(const std::string& structures, const std::string& link) {
  return "structures:\n" + structures + "links:\n  - {" + link +
         ", law: hertz, stiffness: 2.75e9}\nanalysis: {duration: 1}\n";
}

TEST(DrawingInput, AGapIsTheOneThatIsDrawn) {
  refused(linked(pair("982 m"), "between: [a, b], floors: all, gap: 20 mm"),
          "7:41: links[0].gap: is 20 mm, but floor 1 of a (x = 6 m) and floor 1 of b (x = 982 m) are drawn 976 m "
          "apart; leave the gap "
          "out to take this distance, or move b by -975.98 m along x with its origin");
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 200 mm"),
          "7:41: links[0].gap: is 200 mm, but floor 1 of a (x = 6 m) and floor 1 of b (x = 6.02 m) are drawn 20 mm "
          "apart; leave the gap "
          "out to take this distance, or move b by 180 mm along x with its origin");
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 0"),
          "7:41: links[0].gap: is 0 mm, but floor 1 of a (x = 6 m) and floor 1 of b (x = 6.02 m) are drawn 20 mm "
          "apart; leave the gap "
          "out to take this distance, or move b by -20 mm along x with its origin");
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 20.2 mm"),
          "7:41: links[0].gap: is 20.2 mm, but floor 1 of a (x = 6 m) and floor 1 of b (x = 6.02 m) are drawn 20 mm "
          "apart; leave the "
          "gap out to take this distance, or move b by 0.2 mm along x with its origin");
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: [20 mm, 30 mm]"),
          "7:41: links[0].gap: is 30 mm, but floor 2 of a (x = 6 m) and floor 2 of b (x = 6.02 m) are drawn 20 mm "
          "apart; leave the gap "
          "out to take this distance, or move b by 10 mm along x with its origin");
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 20"),
          "7:41: links[0].gap: is 20 m, but floor 1 of a (x = 6 m) and floor 1 of b (x = 6.02 m) are drawn 20 mm "
          "apart; leave the gap "
          "out to take this distance, or move b by 19.98 m along x with its origin");
  refused(linked(pair("6 m"), "between: [a.1, b.1], gap: 20 mm"),
          "7:32: links[0].gap: is 20 mm, but floor 1 of a (x = 6 m) and floor 1 of b (x = 6 m) are drawn 0 mm apart; "
          "leave the gap out "
          "to take this distance, or move b by 20 mm along x with its origin");
  refused(linked(in_space("6.05 m, 0"), "between: [a, b], floors: all, gap: 20 mm"),
          "7:41: links[0].gap: is 20 mm, but floor 1 of a (x = 6 m) and floor 1 of b (x = 6.05 m) are drawn 50 mm "
          "apart; leave the gap "
          "out to take this distance, or move b by -30 mm along x with its origin");
  refused(linked(in_space("0, 6.05 m"), "between: [a, b], floors: all, gap: 20 mm"),
          "7:41: links[0].gap: is 20 mm, but floor 1 of a (y = 6 m) and floor 1 of b (y = 6.05 m) are drawn 50 mm "
          "apart; leave the gap "
          "out to take this distance, or move b by -30 mm along y with its origin");
  refused(linked(in_space("0, -6.05 m"), "between: [a, b], floors: all, gap: 20 mm"),
          "7:41: links[0].gap: is 20 mm, but floor 1 of a (y = 0 mm) and floor 1 of b (y = -50 mm) are drawn 50 mm "
          "apart; leave the gap "
          "out to take this distance, or move b by 30 mm along y with its origin");
  refused(linked(masts(), "between: [a, b], gap: 20 mm"),
          "7:28: links[0].gap: is 20 mm, but floor 1 of a (x = 0 mm) and floor 1 of b (x = 2 m) are drawn 2 m apart; "
          "leave the gap out "
          "to take this distance, or move b by -1.98 m along x with its origin");
  refused(linked(masts(), "between: [{structure: a, node: top}, {structure: b, node: top}], gap: 1 m"),
          "7:76: links[0].gap: is 1 m, but node top of a (x = 0 mm) and node top of b (x = 2 m) are drawn 2 m apart; "
          "leave the gap out "
          "to take this distance, or move b by -1 m along x with its origin");
  refused(linked(pair("6.02 m", "2 m"), "between: [a.1, {structure: b, elevation: 3 m}], gap: 50 mm"),
          "7:59: links[0].gap: is 50 mm, but floor 1 of a (x = 6 m) and the column of b 3 m up (x = 6.02 m) are drawn "
          "20 mm apart; "
          "leave the gap out to take this distance, or move b by 30 mm along x with its origin");
  refused(linked(pair("6.02 m", "2 m"), "between: [a, b], floors: any, gap: 50 mm"),
          "7:41: links[0].gap: is 50 mm, but the column of a 2 m up (x = 6 m) and floor 1 of b (x = 6.02 m) are drawn "
          "20 mm apart; "
          "leave the gap out to take this distance, or move b by 30 mm along x with its origin");
  refused(linked(pair("6.02 m") + grid("c", "12.02 m"), "between: [b, c], floors: all, gap: 20 mm"),
          "9:41: links[0].gap: is 20 mm, but floor 1 of b (x = 12.02 m) and floor 1 of c (x = 12.02 m) are drawn 0 mm "
          "apart; leave the "
          "gap out to take this distance, or move c by 20 mm along x with its origin");
}

TEST(DrawingInput, FramesDoNotOverlap) {
  refused(linked(pair("5.9 m"), "between: [a, b], floors: all, gap: 20 mm"),
          "7:15: links[0].between: floor 1 of a (x = 6 m) and floor 1 of b (x = 5.9 m) overlap by 100 mm; move b by "
          "120 mm along x with "
          "its origin");
  refused(linked(pair("5.9 m"), "between: [a, b], floors: all"),
          "7:15: links[0].between: floor 1 of a (x = 6 m) and floor 1 of b (x = 5.9 m) overlap by 100 mm; move b by "
          "100 mm along x with "
          "its origin, or farther");
  refused(linked(pair("0"), "between: [a, b], floors: all, gap: 20 mm"),
          "7:15: links[0].between: floor 1 of a (x = 6 m) and floor 1 of b (x = 0 mm) overlap by 6 m; move b by 6.02 m "
          "along x with its "
          "origin");
  refused(linked(pair("5.999 m"), "between: [a.1, b.1], gap: 0"),
          "7:15: links[0].between: floor 1 of a (x = 6 m) and floor 1 of b (x = 5.999 m) overlap by 1 mm; move b by 1 "
          "mm along x with "
          "its origin");
  refused(linked(pair("5.999 m"), "between: [{structure: a, node: 1.1}, {structure: b, node: 1.0}], gap: 0"),
          "7:15: links[0].between: node 1.1 of a (x = 6 m) and node 1.0 of b (x = 5.999 m) overlap by 1 mm; move b by "
          "1 mm along x with "
          "its origin");
  refused(linked(pair("5.9 m", "2 m"), "between: [{structure: a, elevation: 2 m}, b.1]"),
          "7:15: links[0].between: the column of a 2 m up (x = 6 m) and floor 1 of b (x = 5.9 m) overlap by 100 mm; "
          "move b by 100 mm "
          "along x with its origin, or farther");
  refused(linked(in_space("5 m, 0"), "between: [a, b], floors: all, gap: 20 mm"),
          "7:15: links[0].between: a and b stand on each other: a reaches from x = 0 m to 6 m and from y = 0 m to 6 m, "
          "b from x = 5 m "
          "to 11 m and from y = 0 m to 6 m; give one of them an origin, such as origin: [6.1 m, 0 m]");
  refused(linked(in_space("0, 0"), "between: [a, b], floors: all"),
          "7:15: links[0].between: a and b stand on each other: a reaches from x = 0 m to 6 m and from y = 0 m to 6 m, "
          "b from x = 0 m "
          "to 6 m and from y = 0 m to 6 m; give one of them an origin, such as origin: [6.1 m, 0 m]");
}

TEST(DrawingInput, TheFirstOneStandsOnTheLeft) {
  refused(linked(pair("6.02 m"), "between: [b, a], floors: all, gap: 20 mm"),
          "7:15: links[0].between: a stands on the left of b: it reaches from x = 0 m to 6 m, and b from x = 6.02 m to "
          "12.02 m; name "
          "the left one first, between: [a, b]");
  refused(linked(pair("6.02 m"), "between: [b, a], floors: all"),
          "7:15: links[0].between: a stands on the left of b: it reaches from x = 0 m to 6 m, and b from x = 6.02 m to "
          "12.02 m; name "
          "the left one first, between: [a, b]");
  refused(linked(pair("6.02 m"), "between: [b.1, a.1], gap: 20 mm"),
          "7:15: links[0].between: a stands on the left of b: it reaches from x = 0 m to 6 m, and b from x = 6.02 m to "
          "12.02 m; name "
          "the left one first, between: [a, b]");
  refused(linked(in_space("6.02 m, 0"), "between: [b, a], floors: all, gap: 20 mm"),
          "7:15: links[0].between: a stands on the left of b: it reaches from x = 0 m to 6 m, and b from x = 6.02 m to "
          "12.02 m; name "
          "the left one first, between: [a, b]");
  refused(linked(masts(), "between: [b, a]"),
          "7:15: links[0].between: a stands on the left of b: it reaches from x = 0 m to 0 m, and b from x = 2 m to 2 "
          "m; name the left "
          "one first, between: [a, b]");
  refused(linked(masts(), "between: [{structure: b, node: top}, {structure: a, node: top}]"),
          "7:15: links[0].between: a stands on the left of b: it reaches from x = 0 m to 0 m, and b from x = 2 m to 2 "
          "m; name the left "
          "one first, between: [a, b]");
  EXPECT_NO_THROW(test::model_of(linked(in_space("0, 6.02 m"), "between: [a, b], floors: all")));
  EXPECT_NO_THROW(test::model_of(linked(in_space("0, 6.02 m"), "between: [b, a], floors: all")));
}

TEST(DrawingInput, EndsFaceEachOther) {
  refused(linked(pair("6.02 m"), "between: [a.1, b.2], gap: 20 mm"),
          "7:15: links[0].between: floor 1 of a (z = 3 m) and floor 2 of b (z = 6 m) do not face each other; link ends "
          "that are level, "
          "or the column there, as in {structure: b, elevation: 3 m}");
  refused(linked(pair("6.02 m", "2.2 m"), "between: [a.1, b.1], gap: 20 mm"),
          "7:15: links[0].between: floor 1 of a (z = 3 m) and floor 1 of b (z = 2.2 m) do not face each other; link "
          "ends that are "
          "level, or the column there, as in {structure: b, elevation: 3 m}");
  refused(linked(pair("6.02 m", "2.2 m"), "between: [a.1, b.1]"),
          "7:15: links[0].between: floor 1 of a (z = 3 m) and floor 1 of b (z = 2.2 m) do not face each other; link "
          "ends that are "
          "level, or the column there, as in {structure: b, elevation: 3 m}");
  refused(linked(pair("6.02 m"), "between: [a.1, {structure: b, node: 2.0}]"),
          "7:15: links[0].between: floor 1 of a (z = 3 m) and node 2.0 of b (z = 6 m) do not face each other; link "
          "ends that are level, "
          "or the column there, as in {structure: b, elevation: 3 m}");
  refused(linked(pair("6.02 m"), "between: [{structure: a, node: 2.1}, b.1]"),
          "7:15: links[0].between: node 2.1 of a (z = 6 m) and floor 1 of b (z = 3 m) do not face each other; link "
          "ends that are level, "
          "or the column there, as in {structure: b, elevation: 6 m}");
  refused(linked(pair("6.02 m"), "between: [{structure: a, elevation: 1 m}, b.1]"),
          "7:15: links[0].between: the column of a 1 m up (z = 1 m) and floor 1 of b (z = 3 m) do not face each other; "
          "link ends that "
          "are level, or the column there, as in {structure: b, elevation: 1 m}");
  refused(linked(mast("a", "0") + mast("b", "2 m", "9 m"), "between: [a, b]"),
          "7:15: links[0].between: floor 1 of a (z = 3 m) and floor 1 of b (z = 9 m) do not face each other; link ends "
          "that are level, "
          "or the column there, as in {structure: b, elevation: 3 m}");
  refused(linked(in_space("6.02 m, 0"), "between: [{structure: a, node: 1.1.0}, {structure: b, node: 1.0.1}]"),
          "7:15: links[0].between: node 1.1.0 of a (y = 0 mm) and node 1.0.1 of b (y = 6 m) do not face each other; "
          "link ends that do, "
          "or move one of the two by its origin");
  refused(linked(in_space("6.02 m, 3 m"), "between: [{structure: a, node: 1.1.0}, {structure: b, node: 1.0.0}]"),
          "7:15: links[0].between: node 1.1.0 of a (y = 0 mm) and node 1.0.0 of b (y = 3 m) do not face each other; "
          "link ends that do, "
          "or move one of the two by its origin");
  refused(linked(in_space("6.02 m, 3 m"), "between: [a.1, {structure: b, node: 1.0.1}]"),
          "7:15: links[0].between: floor 1 of a (y = 6 m) and node 1.0.1 of b (y = 9 m) do not face each other; link "
          "ends that do, or "
          "move one of the two by its origin");
  refused(linked(in_space("6.02 m, 6.02 m"), "between: [a, b], floors: all"),
          "7:15: links[0].between: a and b stand apart along x and along y: no side of the one faces the other; move "
          "one by its origin");
  refused(linked(in_space("6.02 m, 0", "2.5 m"), "between: [a, b], floors: all"),
          "7:15: links[0].between: floor 1 of a is 3 m up and faces no floor of b; type floors: any to let it hit the "
          "column there, or "
          "floors: level to link only those that face each other");
  EXPECT_NO_THROW(test::model_of(linked(pair("6.02 m", "2.6 m"), "between: [a.1, b.1]")));
  EXPECT_NO_THROW(test::model_of(linked(in_space("6.02 m, 3 m"), "between: [a, b], floors: all")));
}

// A floor in space is hit where the node or the column stands.
TEST(DrawingInput, AFloorIsHitWhereTheOtherEndStands) {
  const auto across = [](const std::string& structures, const std::string& link) {
    const Model model = test::model_of(linked(structures, link));
    const Link& first = model.links.at(0);
    EXPECT_NEAR(first.left.point.position.y(), first.right.point.position.y(), 1e-12);
    return first.left.point.position.y();
  };
  EXPECT_EQ(across(in_space("6.02 m, 0"), "between: [a.1, {structure: b, node: 1.0.1}]"), 6);
  EXPECT_EQ(across(in_space("6.02 m, 4 m"), "between: [a.1, {structure: b, node: 1.0.0}]"), 4);
  EXPECT_EQ(across(in_space("6.02 m, 4 m", "2 m"), "between: [a.1, {structure: b, elevation: 3 m}]"), 4);
  EXPECT_EQ(across(in_space("6.02 m, -2 m", "2 m"), "between: [{structure: a, elevation: 2 m}, b.1]"), 0);
}

TEST(DrawingInput, WithoutADrawingTheGapIsGiven) {
  const std::string oscillator = "  o: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n";
  const std::string building =
      "  s: {shear_building: {storeys: 2, mass: 100 t, stiffness: 1 GN/m, height: 3 m}, damping: 5 %}\n";
  refused(linked(grid("a", "0") + "  w: {wall: {}}\n", "between: [a, w], floors: all"),
          R"(6:5: links[0]: key "gap" is missing; type "gap: 20 mm")");
  refused(linked("  w: {wall: {}}\n" + grid("a", "0"), "between: [w, a.1]"),
          R"(6:5: links[0]: key "gap" is missing; type "gap: 20 mm")");
  refused(linked(grid("a", "0") + oscillator, "between: [a.1, o]"),
          R"(6:5: links[0]: key "gap" is missing; type "gap: 20 mm")");
  refused(linked("  ball: {body: {mass: 1 t}}\n" + grid("a", "0"), "between: [ball, a.1]"),
          R"(6:5: links[0]: key "gap" is missing; type "gap: 20 mm")");
  refused(linked(building + grid("a", "0"), "between: [s, a], floors: all"),
          R"(6:5: links[0]: key "gap" is missing; type "gap: 20 mm")");
  refused(linked(building + oscillator, "between: [s.1, o]"),
          R"(5:5: links[0]: key "gap" is missing; type "gap: 20 mm")");
}

}  // namespace drawing_input_test
}  // namespace pounding
