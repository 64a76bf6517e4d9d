// Frames that are drawn by the axes of their columns: gaps between faces, advice where a drawing seems to be one of
// axes, and mistakes.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/elements.hpp>
#include <pounding/model/describe.hpp>
#include <pounding/model/plausible.hpp>
#include "support/refusals.hpp"

namespace pounding {
namespace face_input_test {

using test::model_of;
using test::refused;

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
         "bay_width: 5 m, columns: {rectangle: [0.4, 0.5]}, beams: {rectangle: [0.3, 0.6]}, "
         "floor_mass: 60 t}}, damping: 5 %}\nlinks: [{between: [A, B], " +
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
  EXPECT_NE(
      describe(model_of(yaml))
          .find(
              "link A.2-B.2: hertz, gap 40 mm between faces (300 mm from the axis of column 1.3 and 250 mm as typed)"),
      std::string::npos)
      << describe(model_of(yaml));
  EXPECT_NE(resolved_yaml(model_of(yaml)).find("face: [0.3, 0.25]"), std::string::npos);
  EXPECT_NE(resolved_yaml(model_of(yaml)).find("face_from: [column 1.3, the input]"), std::string::npos)
      << resolved_yaml(model_of(yaml));
  const std::string of_structures = pair("18.59 m", ", face: auto", ", face: auto");
  EXPECT_NE(
      describe(model_of(of_structures))
          .find("gap 40 mm between faces (300 mm from the axis of column 1.3 and 250 mm from the axis of column 1.0)"),
      std::string::npos)
      << describe(model_of(of_structures));
  EXPECT_EQ(describe(model_of(pair("18.04 m"))).find("faces"), std::string::npos);
}

// Columns of a frame in space are as deep along x as along their local z, and along y as wide as along their local y.
TEST(Faces, OfFramesInSpaceAreThoseOfTheirSides) {
  const auto house = [](const std::string& name, const std::string& at, const std::string& face) {
    return fmt::format(
        "  {}: {{frame: {{origin: [{}], face: {}, material: {{E: 30 GPa}}, grid: {{storeys: 1, bays: [1, 1], "
        "storey_height: 3 m, bay_width: 6 m, "
        "columns: {{rectangle: [0.4, 0.8]}}, beams: {{rectangle: [0.3, 0.5]}}, floor_mass: 20 t}}}}, damping: 5 %}}\n",
        name, at, face);
  };
  const std::string block =
      "structures:\n" + house("a", "0, 0", "auto") + house("b", "6.83 m, 0", "auto") + house("c", "0, 6.43 m", "auto") +
      "links: [{between: neighbours, points: 2, law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 1}\n";
  EXPECT_EQ(gaps(block), Gaps(4, 0.03));
  std::string wide = block;
  wide.replace(wide.find("6.83 m"), 6, "8.3 m");
  EXPECT_EQ(gaps(wide), Gaps(2, 0.03)) << "1.5 m between faces are no neighbours";
  wide.replace(wide.find("8.3 m"), 5, "7.7 m");
  EXPECT_EQ(gaps(wide), (Gaps{0.9, 0.9, 0.03, 0.03})) << "within 1 m from face to face";
}

TEST(Faces, AreThoseOfColumnsInLineWithASetBack) {
  const std::string stepped =
      "structures:\n  a: {frame: {face: auto, material: {E: 30 GPa, density: 2500}, mass: consistent, sections: {big: "
      "{rectangle: [0.6, 0.8]}, small: {rectangle: [0.3, 0.4]}, beam: {rectangle: [0.3, 0.5]}},\n"
      "    nodes: {f: [0, 0], g: [6, 0], h: [12, 0], i: [0, 3], j: [6, 3], k: [12, 3], l: [0, 6], m: [6, 6]},\n"
      "    members: {c1: {between: [f, i], section: big}, c2: {between: [g, j], section: small}, c3: {between: [h, k], "
      "section: big}, c4: {between: [i, l], section: big}, c5: {between: [j, m], section: small},\n"
      "      b1: {between: [i, j], section: beam}, b2: {between: [j, k], section: beam}, b3: {between: [l, m], "
      "section: beam}},\n"
      "    supports: {f: fixed, g: fixed, h: fixed}, floors: [{nodes: [i, j, k]}, {nodes: [l, m]}]}, damping: 5 %}\n"
      "  b: {frame: {origin: [12.44 m], material: {E: 30 GPa}, grid: {storeys: 2, bays: 1, storey_height: 3, "
      "bay_width: 5, columns: {circle: 0.4}, beams: {circle: 0.4}, floor_mass: 20 t}}, damping: 5 %}\n"
      "links: [{between: [a, b], floors: all, law: hertz, stiffness: 2.75e9}]\nanalysis: {duration: 1}\n";
  EXPECT_EQ(gaps(stepped), (Gaps{0.04, 6.24}));
}

TEST(Faces, AreAdvisedWhereADrawingSeemsToBeOneOfAxes) {
  refused(pair("18.59 m"),
          "4:47: links[0].gap: is 40 mm, but floor 1 of A (x = 18 m) and floor 1 of B (x = 18.59 m) are drawn 590 mm "
          "apart; if the frames are drawn by "
          "the axes of their columns, type face: auto in A and B: the columns reach 300 mm and 250 mm beyond the axes, "
          "and 40 mm remain between "
          "faces; if they are drawn by their faces, leave the gap out to take this distance, or move B by -550 mm "
          "along x with its origin");
  refused(pair("18.59 m", ", face: auto"),
          "4:47: links[0].gap: is 40 mm, but floor 1 of A (x = 18 m) and floor 1 of B (x = 18.59 m) are drawn 290 mm "
          "apart between faces 300 mm and 0 mm "
          "before the axes; if the frames are drawn by the axes of their columns, type face: auto in B: the columns "
          "reach 0 mm and 250 mm beyond the "
          "axes, and 40 mm remain between faces; if they are drawn by their faces, leave the gap out to take this "
          "distance, or move B by -250 mm along x "
          "with its origin");
  refused(pair("18.59 m", "", "", "{area: 0.36, inertia_y: 0.0108}"),
          "4:47: links[0].gap: is 40 mm, but floor 1 of A (x = 18 m) and floor 1 of B (x = 18.59 m) are drawn 590 mm "
          "apart; if the frames are drawn by "
          "the axes of their columns, type face: 300 mm in A and face: 250 mm in B: the columns reach 300 mm and 250 "
          "mm beyond the axes, and 40 mm "
          "remain between faces; if they are drawn by their faces, leave the gap out to take this distance, or move B "
          "by -550 mm along x with its origin");
  // A gap that the drawing gives, or that was taken from an earlier refusal, is doubted as well.
  for (const std::string rest : {"floors: level", "floors: level, gap: 590 mm"}) {
    const std::vector<std::string> doubts =
        implausible(model_of(pair("18.59 m", "", "", "{rectangle: [0.6, 0.6]}", rest)));
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_EQ(doubts[0],
              "link A.1-B.1: the gap is 590 mm, and the columns reach 300 mm and 250 mm beyond their axes; if the "
              "frames are drawn by axes, type "
              "face: auto in A and B, which leaves 40 mm between faces (where it is meant: accept: [face])");
    EXPECT_TRUE(
        implausible(model_of(pair("18.59 m", ", face: 0", ", face: 0", "{rectangle: [0.6, 0.6]}", rest))).empty());
  }
  EXPECT_TRUE(implausible(model_of(pair("18.04 m"))).empty());
}

TEST(Faces, AreRefusedWhereTheyCannotBe) {
  refused(pair("18.04 m", ", face: auto", ", face: auto"),
          "4:19: links[0].between: floor 1 of A (x = 18 m) and floor 1 of B (x = 18.04 m) overlap by 510 mm between "
          "faces 300 mm and 250 mm before the axes; "
          "leave face out where a frame is drawn by its faces, or move B by 550 mm along x with its origin");
  refused(pair("18.59 m", ", face: auto", "", "{area: 0.36, inertia_y: 0.0108}"),
          "4:20: links[0].between[0]: face: auto needs sections with a size, and that of column 1.3 at floor 1 of A is "
          "given by numbers; type the "
          "distance from the axis to the face, some face: 300 mm by its area and inertia");
  refused(pair("18.59 m", ", face: -1 m"),
          "2:36: structures.A.frame.face: takes a length >= 0 such as \"20 mm\"; \"-1 m\" is outside");
  refused(pair("18.59 m", ", face: axes"),
          "2:36: structures.A.frame.face: takes auto, half the depth of the outer columns, or a length such as 0.3 m; "
          "\"axes\" was read");
  refused(
      "structures:\n  a: {oscillator: {mass: 100 t, period: 1}, damping: 5 %, face: auto}\nanalysis: {duration: 1}\n",
      "2:59: structures.a.face: face is for frames, which are drawn; gaps to this oscillator are typed, from face to "
      "face: leave face out");
  std::string twice = pair("18.59 m", ", face: auto");
  twice.insert(twice.find(", damping: 5 %}\n  B"), ", face: 0.3 m");
  EXPECT_THROW(model_of(twice), InputError);
}

}  // namespace face_input_test
}  // namespace pounding
