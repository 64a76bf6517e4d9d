// Frames drawn along column axes: gaps between faces, warnings for drawings that seem to use axes, and errors.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/elements.hpp>
#include <pounding/reports/describe.hpp>
#include <pounding/reports/plausible.hpp>
#include "support/models.hpp"

namespace pounding {
namespace face_input_test {

using test::at, test::mentions, test::model_of, test::refused;

// Two plane frames of 18 m and 10 m; `a` and `b` are keys that follow the origin of each.
std::string pair(const std::string& origin, const std::string& a = "", const std::string& b = "",
                 const std::string& columns = "{1-2: {rectangle: [0.6, 0.6]}, 3: {rectangle: [0.5, 0.5]}}",
                 const std::string& rest = "floors: level, gap: 40 mm") {
  return "structures:\n  A: {frame: {origin: [0 m]" + a +
         ", mass: consistent, material: {E: 30 GPa, density: 2500}, grid: {storeys: 3, bays: 3, storey_height: 3.2, "
         "bay_width: 6 m, columns: " +
         columns + ", beams: {rectangle: [0.3, 0.6]}, floor_mass: 90 t}}, damping: 5 %}\n  B: {frame: {origin: [" +
         origin + "]" + b +
         ", mass: consistent, material: {E: 30 GPa, density: 2500}, grid: {storeys: 3, bays: 2, storey_height: 3.2, "
         "bay_width: 5 m, columns: {rectangle: [0.4, 0.5]}, beams: {rectangle: [0.3, 0.6]}, floor_mass: 60 t}}, "
         "damping: 5 %}\nlinks: [{between: [A, B], " +
         rest + ", law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 1}\n";
}

std::vector<double> gaps(const std::string& yaml) {
  std::vector<double> all;
  for (const Link& link : model_of(yaml).links) all.push_back(link.gap);
  return all;
}

using Gaps = std::vector<double>;

TEST(Faces, AreHalfTheDepthOfTheOuterColumnsBeyondTheirAxes) {
  const Gaps typed = gaps(pair("18.59 m", ", face: auto", ", face: auto"));
  EXPECT_EQ(typed, Gaps(3, 0.04)) << "a facade is flat: the third storey of A has smaller columns";
  EXPECT_EQ(gaps(pair("18.59 m", ", face: auto", ", face: auto", "{rectangle: [0.3, 0.6]}", "floors: level")),
            Gaps(3, 0.04));
  EXPECT_EQ(gaps(pair("18.59 m", ", face: 0.3 m", ", face: 0.25", "{circle: 0.5}")), Gaps(3, 0.04));
  EXPECT_EQ(gaps(pair("18.59 m", ", face: auto", ", face: auto", "{tube: {diameter: 0.6, thickness: 0.02}}")),
            Gaps(3, 0.04));
  EXPECT_EQ(gaps(pair("18.59 m", ", face: auto", ", face: auto",
                      "{i_section: {depth: 0.6, width: 0.3, flange: 0.02, web: 0.01}}")),
            Gaps(3, 0.04));
  EXPECT_EQ(gaps(pair("18.34 m", ", face: auto", "")), Gaps(3, 0.04)) << "B is drawn by its faces";
  EXPECT_EQ(gaps(pair("18.04 m")), Gaps(3, 0.04)) << "both are";
  EXPECT_EQ(gaps(pair("18.04 m", ", face: 0", ", face: 0 m")), Gaps(3, 0.04));
}

TEST(Faces, MayBeThoseOfOneEnd) {
  const std::string ends =
      "between: [{structure: A, floor: 2, face: auto}, {structure: B, floor: 2, face: 250 mm}], gap: 40 mm";
  std::string yaml = pair("18.59 m");
  yaml.replace(yaml.find("between: [A, B], floors: level, gap: 40 mm"),
               std::string("between: [A, B], floors: level, gap: 40 mm").size(), ends);
  EXPECT_EQ(gaps(yaml), Gaps{0.04});
  EXPECT_TRUE(mentions(describe(model_of(yaml)), {"40 mm", "300 mm", "250 mm", "1.3", "hertz", "A.2-B.2"}));
  EXPECT_NE(resolved_yaml(model_of(yaml)).find("face: [0.3, 0.25]"), std::string::npos);
  EXPECT_NE(resolved_yaml(model_of(yaml)).find("face_from: [column 1.3, the input]"), std::string::npos)
      << resolved_yaml(model_of(yaml));
  const std::string of_structures = pair("18.59 m", ", face: auto", ", face: auto");
  EXPECT_TRUE(mentions(describe(model_of(of_structures)), {"40 mm", "300 mm", "250 mm", "1.3", "1.0"}));
  EXPECT_EQ(describe(model_of(pair("18.04 m"))).find("faces"), std::string::npos);
}

// In space the depth of a column is along x (local z) and its width along y (local y).
TEST(Faces, OfFramesInSpaceAreThoseOfTheirSides) {
  const auto house = [](const std::string& name, const std::string& at, const std::string& face) {
    return fmt::format(
        "  {}: {{frame: {{origin: [{}], face: {}, material: {{E: 30 GPa}}, grid: {{storeys: 1, bays: [1, 1], "
        "storey_height: 3 m, bay_width: 6 m, columns: {{rectangle: [0.4, 0.8]}}, beams: {{rectangle: [0.3, 0.5]}}, "
        "floor_mass: 20 t}}}}, damping: 5 %}}\n",
        name, at, face);
  };
  const std::string block =
      "structures:\n" + house("a", "0, 0", "auto") + house("b", "6.83 m, 0", "auto") + house("c", "0, 6.43 m", "auto") +
      "links: [{between: neighbours, points: 2, law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 1}\n";
  EXPECT_EQ(gaps(block), Gaps(4, 0.03));
  std::string wide = block;
  wide.replace(wide.find("6.83 m"), 6, "8.3 m");
  EXPECT_EQ(gaps(wide), Gaps(2, 0.03)) << "frames 1.5 m apart are not neighbours";
  wide.replace(wide.find("8.3 m"), 5, "7.7 m");
  EXPECT_EQ(gaps(wide), (Gaps{0.9, 0.9, 0.03, 0.03})) << "within 1 m from face to face";
}

TEST(Faces, AreThoseOfColumnsInLineWithASetBack) {
  const std::string stepped =
      "structures:\n  a: {frame: {face: auto, material: {E: 30 GPa, density: 2500}, mass: consistent, sections: {big: "
      "{rectangle: [0.6, 0.8]}, small: {rectangle: [0.3, 0.4]}, beam: {rectangle: [0.3, 0.5]}},\n    nodes: {f: [0, "
      "0], g: [6, 0], h: [12, 0], i: [0, 3], j: [6, 3], k: [12, 3], l: [0, 6], m: [6, 6]},\n    members: {c1: "
      "{between: [f, i], section: big}, c2: {between: [g, j], section: small}, c3: {between: [h, k], section: big}, "
      "c4: {between: [i, l], section: big}, c5: {between: [j, m], section: small},\n      b1: {between: [i, j], "
      "section: beam}, b2: {between: [j, k], section: beam}, b3: {between: [l, m], section: beam}},\n    supports: {f: "
      "fixed, g: fixed, h: fixed}, floors: [{nodes: [i, j, k]}, {nodes: [l, m]}]}, damping: 5 %}\n  b: {frame: "
      "{origin: [12.44 m], material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 3, bay_width: 5, columns: "
      "{circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}, damping: 5 %}\nlinks: [{between: [a, b], floors: all, "
      "law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 1}\n";
  EXPECT_EQ(gaps(stepped), (Gaps{0.04, 6.24}));
}

TEST(Faces, AreSuggestedIfTheDrawingSeemsToUseAxes) {
  refused(pair("18.59 m"), at("4:47", "links[0].gap"),
          mentions({"face: auto", "40 mm", "18 m", "18.59 m", "590 mm", "300 mm", "250 mm", "-550 mm", "1"}));
  refused(pair("18.59 m", ", face: auto"), at("4:47", "links[0].gap"),
          mentions({"face: auto", "40 mm", "18 m", "18.59 m", "290 mm", "300 mm", "0 mm", "-250 mm", "1"}));
  refused(pair("18.59 m", "", "", "{area: 0.36, inertia_y: 0.0108}"), at("4:47", "links[0].gap"),
          mentions({"face: 300 mm", "face: 250 mm", "40 mm", "18 m", "18.59 m", "590 mm", "-550 mm", "1"}));
  // The warning also applies to a gap from the drawing or from an earlier message.
  for (const std::string rest : {"floors: level", "floors: level, gap: 590 mm"}) {
    const std::vector<std::string> warnings =
        implausible(model_of(pair("18.59 m", "", "", "{rectangle: [0.6, 0.6]}", rest)));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_TRUE(
        mentions(warnings[0], {"accept: [face]", "face: auto", "590 mm", "300 mm", "250 mm", "40 mm", "A.1-B.1"}));
    EXPECT_TRUE(
        implausible(model_of(pair("18.59 m", ", face: 0", ", face: 0", "{rectangle: [0.6, 0.6]}", rest))).empty());
  }
  EXPECT_TRUE(implausible(model_of(pair("18.04 m"))).empty());
}

TEST(Faces, AreRejectedForOtherStructures) {
  refused(pair("18.04 m", ", face: auto", ", face: auto"), at("4:19", "links[0].between"),
          mentions({"18 m", "18.04 m", "510 mm", "300 mm", "250 mm", "550 mm", "1"}));
  refused(pair("18.59 m", ", face: auto", "", "{area: 0.36, inertia_y: 0.0108}"), at("4:20", "links[0].between[0]"),
          mentions({"300 mm", "1.3"}));
  refused(pair("18.59 m", ", face: -1 m"), at("2:36", "structures.A.frame.face"), mentions({"20 mm", "-1 m"}));
  refused(pair("18.59 m", ", face: axes"), at("2:36", "structures.A.frame.face"), mentions({"axes", "0.3 m"}));
  refused(
      "structures:\n  a: {oscillator: {mass: 100 t, period: 1}, damping: 5 %, face: auto}\nanalysis: {duration: 1}\n",
      at("2:59", "structures.a.face"));
  std::string twice = pair("18.59 m", ", face: auto");
  twice.insert(twice.find(", damping: 5 %}\n  B"), ", face: 0.3 m");
  EXPECT_THROW(model_of(twice), InputError);
}

}  // namespace face_input_test
}  // namespace pounding
