// Contradictions in drawn frames: a different gap, overlaps, the wrong side, ends that do not face each other.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include "support/models.hpp"

namespace pounding {
namespace drawing_input_test {

using test::at, test::mentions, test::refused;

// Options of a grid: origin, storey height, bays.
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

TEST(DrawingInput, TheGapAgreesWithTheDrawing) {
  refused(linked(pair("982 m"), "between: [a, b], floors: all, gap: 20 mm"), at("7:41", "links[0].gap"),
          mentions({"20 mm", "6 m", "982 m", "976 m", "-975.98 m", "1"}));
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 200 mm"), at("7:41", "links[0].gap"),
          mentions({"200 mm", "6 m", "6.02 m", "20 mm", "180 mm", "1"}));
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 0"), at("7:41", "links[0].gap"),
          mentions({"0 mm", "6 m", "6.02 m", "-20 mm", "1"}));
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 20.2 mm"), at("7:41", "links[0].gap"),
          mentions({"20.2 mm", "6 m", "6.02 m", "20 mm", "0.2 mm", "1"}));
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: [20 mm, 30 mm]"), at("7:41", "links[0].gap"),
          mentions({"30 mm", "6 m", "6.02 m", "20 mm", "10 mm", "2"}));
  refused(linked(pair("6.02 m"), "between: [a, b], floors: all, gap: 20"), at("7:41", "links[0].gap"),
          mentions({"20 m", "6 m", "6.02 m", "20 mm", "19.98 m", "1"}));
  refused(linked(pair("6 m"), "between: [a.1, b.1], gap: 20 mm"), at("7:32", "links[0].gap"),
          mentions({"20 mm", "6 m", "0 mm", "1"}));
  refused(linked(in_space("6.05 m, 0"), "between: [a, b], floors: all, gap: 20 mm"), at("7:41", "links[0].gap"),
          mentions({"20 mm", "6 m", "6.05 m", "50 mm", "-30 mm", "1"}));
  refused(linked(in_space("0, 6.05 m"), "between: [a, b], floors: all, gap: 20 mm"), at("7:41", "links[0].gap"),
          mentions({"20 mm", "6 m", "6.05 m", "50 mm", "-30 mm", "1"}));
  refused(linked(in_space("0, -6.05 m"), "between: [a, b], floors: all, gap: 20 mm"), at("7:41", "links[0].gap"),
          mentions({"20 mm", "0 mm", "-50 mm", "30 mm", "1"}));
  refused(linked(masts(), "between: [a, b], gap: 20 mm"), at("7:28", "links[0].gap"),
          mentions({"20 mm", "0 mm", "2 m", "-1.98 m"}));
  refused(linked(masts(), "between: [{structure: a, node: top}, {structure: b, node: top}], gap: 1 m"),
          at("7:76", "links[0].gap"), mentions({"0 mm", "2 m", "-1 m"}));
  refused(linked(pair("6.02 m", "2 m"), "between: [a.1, {structure: b, elevation: 3 m}], gap: 50 mm"),
          at("7:59", "links[0].gap"), mentions({"50 mm", "6 m", "3 m", "6.02 m", "20 mm", "30 mm", "1"}));
  refused(linked(pair("6.02 m", "2 m"), "between: [a, b], floors: any, gap: 50 mm"), at("7:41", "links[0].gap"),
          mentions({"50 mm", "2 m", "6 m", "6.02 m", "20 mm", "30 mm", "1"}));
  refused(linked(pair("6.02 m") + grid("c", "12.02 m"), "between: [b, c], floors: all, gap: 20 mm"),
          at("9:41", "links[0].gap"), mentions({"20 mm", "12.02 m", "0 mm", "1"}));
}

TEST(DrawingInput, FramesDoNotOverlap) {
  refused(linked(pair("5.9 m"), "between: [a, b], floors: all, gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"6 m", "5.9 m", "100 mm", "120 mm", "1"}));
  refused(linked(pair("5.9 m"), "between: [a, b], floors: all"), at("7:15", "links[0].between"),
          mentions({"6 m", "5.9 m", "100 mm", "1"}));
  refused(linked(pair("0"), "between: [a, b], floors: all, gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"6 m", "0 mm", "6.02 m", "1"}));
  refused(linked(pair("5.999 m"), "between: [a.1, b.1], gap: 0"), at("7:15", "links[0].between"),
          mentions({"6 m", "5.999 m", "1 mm"}));
  refused(linked(pair("5.999 m"), "between: [{structure: a, node: 1.1}, {structure: b, node: 1.0}], gap: 0"),
          at("7:15", "links[0].between"), mentions({"6 m", "5.999 m", "1 mm", "1.1", "1.0"}));
  refused(linked(pair("5.9 m", "2 m"), "between: [{structure: a, elevation: 2 m}, b.1]"),
          at("7:15", "links[0].between"), mentions({"2 m", "6 m", "5.9 m", "100 mm", "1"}));
  refused(linked(in_space("5 m, 0"), "between: [a, b], floors: all, gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"origin: [6.1 m, 0 m]", "6 m", "5 m", "11 m"}));
  refused(linked(in_space("0, 0"), "between: [a, b], floors: all"), at("7:15", "links[0].between"),
          mentions({"origin: [6.1 m, 0 m]", "6 m"}));
}

TEST(DrawingInput, TheFirstFrameIsOnTheLeft) {
  refused(linked(pair("6.02 m"), "between: [b, a], floors: all, gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"between: [a, b]", "0 m", "6 m", "6.02 m", "12.02 m"}));
  refused(linked(pair("6.02 m"), "between: [b, a], floors: all"), at("7:15", "links[0].between"),
          mentions({"between: [a, b]", "0 m", "6 m", "6.02 m", "12.02 m"}));
  refused(linked(pair("6.02 m"), "between: [b.1, a.1], gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"between: [a, b]", "0 m", "6 m", "6.02 m", "12.02 m"}));
  refused(linked(in_space("6.02 m, 0"), "between: [b, a], floors: all, gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"between: [a, b]", "0 m", "6 m", "6.02 m", "12.02 m"}));
  refused(linked(masts(), "between: [b, a]"), at("7:15", "links[0].between"),
          mentions({"between: [a, b]", "0 m", "2 m"}));
  refused(linked(masts(), "between: [{structure: b, node: top}, {structure: a, node: top}]"),
          at("7:15", "links[0].between"), mentions({"between: [a, b]", "0 m", "2 m"}));
  EXPECT_NO_THROW(test::model_of(linked(in_space("0, 6.02 m"), "between: [a, b], floors: all")));
  EXPECT_NO_THROW(test::model_of(linked(in_space("0, 6.02 m"), "between: [b, a], floors: all")));
}

TEST(DrawingInput, EndsFaceEachOther) {
  refused(linked(pair("6.02 m"), "between: [a.1, b.2], gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"{structure: b, elevation: 3 m}", "6 m", "1", "2"}));
  refused(linked(pair("6.02 m", "2.2 m"), "between: [a.1, b.1], gap: 20 mm"), at("7:15", "links[0].between"),
          mentions({"{structure: b, elevation: 3 m}", "2.2 m", "1"}));
  refused(linked(pair("6.02 m", "2.2 m"), "between: [a.1, b.1]"), at("7:15", "links[0].between"),
          mentions({"{structure: b, elevation: 3 m}", "2.2 m", "1"}));
  refused(linked(pair("6.02 m"), "between: [a.1, {structure: b, node: 2.0}]"), at("7:15", "links[0].between"),
          mentions({"{structure: b, elevation: 3 m}", "6 m", "1", "2.0"}));
  refused(linked(pair("6.02 m"), "between: [{structure: a, node: 2.1}, b.1]"), at("7:15", "links[0].between"),
          mentions({"{structure: b, elevation: 6 m}", "3 m", "2.1"}));
  refused(linked(pair("6.02 m"), "between: [{structure: a, elevation: 1 m}, b.1]"), at("7:15", "links[0].between"),
          mentions({"{structure: b, elevation: 1 m}", "3 m"}));
  refused(linked(mast("a", "0") + mast("b", "2 m", "9 m"), "between: [a, b]"), at("7:15", "links[0].between"),
          mentions({"{structure: b, elevation: 3 m}", "9 m", "1"}));
  refused(linked(in_space("6.02 m, 0"), "between: [{structure: a, node: 1.1.0}, {structure: b, node: 1.0.1}]"),
          at("7:15", "links[0].between"), mentions({"0 mm", "6 m", "1.1.0", "1.0.1"}));
  refused(linked(in_space("6.02 m, 3 m"), "between: [{structure: a, node: 1.1.0}, {structure: b, node: 1.0.0}]"),
          at("7:15", "links[0].between"), mentions({"0 mm", "3 m", "1.1.0", "1.0.0"}));
  refused(linked(in_space("6.02 m, 3 m"), "between: [a.1, {structure: b, node: 1.0.1}]"),
          at("7:15", "links[0].between"), mentions({"6 m", "9 m", "1.0.1"}));
  refused(linked(in_space("6.02 m, 6.02 m"), "between: [a, b], floors: all"), at("7:15", "links[0].between"),
          mentions({"origin"}));
  refused(linked(in_space("6.02 m, 0", "2.5 m"), "between: [a, b], floors: all"), at("7:15", "links[0].between"),
          mentions({"floors: any", "floors: level", "3 m", "1"}));
  EXPECT_NO_THROW(test::model_of(linked(pair("6.02 m", "2.6 m"), "between: [a.1, b.1]")));
  EXPECT_NO_THROW(test::model_of(linked(in_space("6.02 m, 3 m"), "between: [a, b], floors: all")));
}

// A floor in space is hit at the node or the column.
TEST(DrawingInput, AFloorIsHitAtTheOtherEnd) {
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
  refused(linked(grid("a", "0") + "  w: {wall: {}}\n", "between: [a, w], floors: all"), at("6:5", "links[0]"),
          mentions({"gap: 20 mm"}));
  refused(linked("  w: {wall: {}}\n" + grid("a", "0"), "between: [w, a.1]"), at("6:5", "links[0]"),
          mentions({"gap: 20 mm"}));
  refused(linked(grid("a", "0") + oscillator, "between: [a.1, o]"), at("6:5", "links[0]"), mentions({"gap: 20 mm"}));
  refused(linked("  ball: {body: {mass: 1 t}}\n" + grid("a", "0"), "between: [ball, a.1]"), at("6:5", "links[0]"),
          mentions({"gap: 20 mm"}));
  refused(linked(building + grid("a", "0"), "between: [s, a], floors: all"), at("6:5", "links[0]"),
          mentions({"gap: 20 mm"}));
  refused(linked(building + oscillator, "between: [s.1, o]"), at("5:5", "links[0]"), mentions({"gap: 20 mm"}));
}

}  // namespace drawing_input_test
}  // namespace pounding
