// Links between all adjacent structures: pairs, floors, agreement with links defined by hand, and errors.

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include <pounding/model/neighbours.hpp>
#include "support/models.hpp"

namespace pounding {
namespace neighbours_input_test {

using test::at, test::mentions, test::refused;

// A house of 6 m by 6 m with its corner at `at`.
std::string house(const std::string& name, const std::string& at, int storeys = 1, const std::string& height = "3 m") {
  return fmt::format(
      "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa, density: 2500}}, mass: consistent, grid: {{storeys: {}, "
      "bays: [1, 1], storey_height: {}, bay_width: 6 m, columns: {{circle: 0.4}}, beams: {{circle: 0.4}}, floor_mass: "
      "20 t}}}}, damping: 5 %}}\n",
      name, at, storeys, height);
}

std::string plane(const std::string& name, const std::string& at) {
  return fmt::format(
      "  {}: {{frame: {{origin: [{}], material: {{E: 30 GPa}}, grid: {{storeys: 1, bays: 1, storey_height: 3 m, "
      "bay_width: 6 m, columns: {{circle: 0.4}}, beams: {{circle: 0.4}}, floor_mass: 20 t}}}}, damping: 5 %}}\n",
      name, at);
}

std::string mast(const std::string& name, const std::string& at) {
  return fmt::format(
      "  {}: {{frame: {{dimension: 3, origin: [{}], material: {{E: 30 GPa}}, nodes: {{foot: [0, 0, 0], top: [0, 0, "
      "3]}}, members: {{c: {{between: [foot, top], section: {{circle: 0.4}}}}}}, supports: {{foot: fixed}}, masses: "
      "{{top: 1 t}}, floors: [{{nodes: [top], rigid: false}}]}}, damping: 5 %}}\n",
      name, at);
}

const std::string law = ", law: hertz, stiffness: 2.75e9}\n";

std::string model(const std::string& structures, const std::string& links = "") {
  return "structures:\n" + structures + (links.empty() ? "" : "links:\n" + links) + "analysis: {duration: 1}\n";
}

std::string linked(const std::string& structures, const std::string& keys = "between: neighbours") {
  return model(structures, "  - {" + keys + law);
}

// "a-b 20 mm"
std::vector<std::string> pairs(const std::string& structures, double within = usual_reach) {
  const Model read = test::model_of(model(structures));
  std::vector<std::string> names;
  for (const Neighbours& pair : neighbours(read, within))
    names.push_back(fmt::format("{}-{} {:.6g} mm", read.structures[pair.left].name, read.structures[pair.right].name,
                                1e3 * pair.distance));
  return names;
}

using Names = std::vector<std::string>;

std::vector<std::string> names(const std::string& yaml) {
  std::vector<std::string> all;
  for (const Link& link : test::model_of(yaml).links) all.push_back(link.name);
  return all;
}

// Two staggered rows, and a house diagonally behind c, 3.05 m from e across the corner of the others.
const std::string block = house("e", "9.04, 6.05") + house("a", "0, 0") + house("b", "6.02, 0") +
                          house("c", "12.07, 0") + house("d", "3, 6.05") + house("f", "18.09, 6.02");

TEST(Neighbours, OfAPlanAgreeWithThoseFoundByHand) {
  EXPECT_EQ(pairs(block),
            (Names{"b-e 50 mm", "c-e 50 mm", "d-e 40 mm", "a-b 20 mm", "a-d 50 mm", "b-c 50 mm", "b-d 50 mm"}));
}

TEST(Neighbours, AreWithinTheMaximumDistance) {
  EXPECT_EQ(pairs(block, 0.045), (Names{"d-e 40 mm", "a-b 20 mm"}));
  // e faces f over 3.05 m; further pairs in line have another house between them.
  EXPECT_EQ(pairs(block, 100), (Names{"b-e 50 mm", "c-e 50 mm", "d-e 40 mm", "e-f 3050 mm", "a-b 20 mm", "a-d 50 mm",
                                      "b-c 50 mm", "b-d 50 mm"}));
}

TEST(Neighbours, MayTouch) {
  EXPECT_EQ(pairs(house("a", "0, 0") + house("b", "6, 0") + house("c", "0, 6")), (Names{"a-b 0 mm", "a-c 0 mm"}));
  // Typed decimals are rounded to a tenth of a millimetre.
  EXPECT_EQ(pairs(house("a", "0, 0") + house("b", "5.99995, 0")), (Names{"a-b 0 mm"}));
}

TEST(Neighbours, DoNotMeetAtACornerOnly) {
  EXPECT_EQ(pairs(house("a", "0, 0") + house("b", "6, 6")), Names{});
  EXPECT_EQ(pairs(house("a", "0, 0") + house("b", "6.02, 6.02")), Names{});
  // In a block whose walls touch along y, diagonal houses end in one line.
  EXPECT_EQ(pairs(house("a", "0, 0") + house("b", "6.02, 6")), Names{});
  EXPECT_EQ(pairs(house("a", "0, 0") + house("b", "6.02, -6.00005")), Names{});
  EXPECT_EQ(pairs(house("a", "0, 0") + house("b", "6.02, 5.99")), (Names{"a-b 20 mm"}));
}

TEST(Neighbours, HaveNoStructureBetweenThem) {
  const std::string ends = house("a", "0, 0") + house("c", "12.04, 0");
  EXPECT_EQ(pairs(ends, 10), (Names{"a-c 6040 mm"}));
  EXPECT_EQ(pairs(ends + house("b", "6.02, 0"), 10), (Names{"a-b 20 mm", "b-c 20 mm"}));
  // A house that extends only half way into the space between them also blocks the pair.
  EXPECT_EQ(pairs(ends + house("b", "6.02, 3"), 10), (Names{"a-b 20 mm", "b-c 20 mm"}));
  EXPECT_EQ(pairs(ends + house("b", "6.02, 6.01"), 10), (Names{"a-c 6040 mm"}));
  EXPECT_EQ(pairs(house("a", "0, 0") + house("c", "6.04, 0") + mast("b", "6.02, 3")),
            (Names{"a-b 20 mm", "b-c 20 mm"}));
  EXPECT_EQ(pairs(house("a", "0, 0") + house("c", "6.04, 0") + mast("b", "6.02, 7")), (Names{"a-c 40 mm"}));
}

TEST(Neighbours, MayHaveNoWidth) {
  EXPECT_EQ(pairs(mast("a", "0, 0") + mast("b", "0.5, 0")), (Names{"a-b 500 mm"}));
  EXPECT_EQ(pairs(mast("a", "0, 0") + mast("b", "0, -0.5")), (Names{"b-a 500 mm"}));
  EXPECT_EQ(pairs(mast("a", "0, 0") + mast("b", "0.5, 0.5")), Names{});
  EXPECT_EQ(pairs(house("a", "0, 0") + mast("b", "6.5, 6")), (Names{"a-b 500 mm"}));
  EXPECT_EQ(pairs(house("a", "0, 0") + mast("b", "6.5, 6.1")), Names{});
}

TEST(Neighbours, OfPlaneFramesAreInARow) {
  EXPECT_EQ(pairs(plane("c", "12.05") + plane("a", "0") + plane("b", "6.02")), (Names{"b-c 30 mm", "a-b 20 mm"}));
  EXPECT_EQ(pairs(plane("a", "0") + plane("b", "6.02") + plane("c", "12.05"), 10), (Names{"a-b 20 mm", "b-c 30 mm"}));
}

TEST(Neighbours, AreStructuresWithAPosition) {
  EXPECT_EQ(pairs("  o: {oscillator: {mass: 1 t, period: 1}, damping: 5 %}\n" + house("a", "0, 0") +
                  "  w: {wall: {}}\n" + house("b", "6.02, 0")),
            (Names{"a-b 20 mm"}));
}

void expect_same_links(const std::string& found, const std::string& by_hand) {
  const Model first = test::model_of(found), second = test::model_of(by_hand);
  ASSERT_EQ(first.links.size(), second.links.size());
  for (std::size_t i = 0; i < first.links.size(); ++i) {
    const Link &a = first.links[i], &b = second.links[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(std::tie(a.gap, a.direction, a.reduced_mass, a.friction, a.stiffness_from),
              std::tie(b.gap, b.direction, b.reduced_mass, b.friction, b.stiffness_from))
        << a.name;
    for (const auto& [own, other] : {std::pair(&a.left, &b.left), std::pair(&a.right, &b.right)}) {
      EXPECT_EQ(std::tie(own->structure, own->floor, own->label, own->point.position, own->point.mass),
                std::tie(other->structure, other->floor, other->label, other->point.position, other->point.mass))
          << a.name;
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ((own->point.motion[axis] - other->point.motion[axis]).norm(), 0) << a.name;
    }
    ASSERT_EQ(a.parameters.size(), b.parameters.size());
    for (std::size_t k = 0; k < a.parameters.size(); ++k)
      EXPECT_EQ(a.parameters[k].value, b.parameters[k].value) << a.name;
  }
}

TEST(LinksOfNeighbours, AgreeWithLinksDefinedByHand) {
  const std::string structures = house("a", "0, 0", 3) + house("b", "6.02, 0", 2) + house("c", "3, 6.05", 3);
  const std::string rest = ", points: 3, friction: 0.3, law: hertz_damped, stiffness: auto, restitution: 0.65}\n";
  expect_same_links(model(structures, "  - {between: neighbours" + rest),
                    model(structures, "  - {between: [a, b], floors: all" + rest + "  - {between: [a, c], floors: all" +
                                          rest + "  - {between: [b, c], floors: all" + rest));
  EXPECT_EQ(names(linked(structures, "between: neighbours, points: 1")),
            (Names{"a.1-b.1", "a.2-b.2", "a.1-c.1", "a.2-c.2", "a.3-c.3", "b.1-c.1", "b.2-c.2"}));
}

TEST(LinksOfNeighbours, SkipPairsThatAreLinkedAbove) {
  const std::string structures = house("a", "0, 0") + house("b", "6.02, 0") + house("c", "12.04, 0");
  const Model read = test::model_of(model(
      structures,
      "  - {between: [b.1, c.1], points: 1, law: linear_spring, stiffness: 1e8}\n  - {between: neighbours, points: 1" +
          law));
  ASSERT_EQ(read.links.size(), 2u);
  EXPECT_EQ(read.links[0].name + " " + read.links[0].law, "b.1-c.1 linear_spring");
  EXPECT_EQ(read.links[1].name + " " + read.links[1].law, "a.1-b.1 hertz");
  refused(model(structures, "  - {between: neighbours, points: 1" + law + "  - {between: neighbours" + law),
          at("7:6", "links[1].between"));
}

TEST(LinksOfNeighbours, FollowTheElevationsOfFloors) {
  // 3 m and 6 m next to 2 m, 4 m and 6 m.
  const std::string structures = house("a", "0, 0", 2) + house("b", "6.02, 0", 3, "2 m");
  refused(linked(structures), at("5:15", "links[0].between"), mentions({"floors: any", "floors: level", "3 m", "1"}));
  EXPECT_EQ(names(linked(structures, "between: neighbours, floors: level, points: 1")), (Names{"a.2-b.3"}));
  EXPECT_EQ(names(linked(structures, "between: neighbours, floors: any")),
            (Names{"a@2m-b.1", "a.1-b@3m", "a@4m-b.2", "a.2-b.3#1", "a.2-b.3#2"}));
  refused(linked(house("a", "0, 0", 1) + house("b", "6.02, 0", 1, "2 m"), "between: neighbours, floors: level"),
          at("5:15", "links[0].between"), mentions({"floors: any"}));
}

// A tower of 4 m on a podium of 8 m: its upper floor is set back by 4 m.
const std::string podium =
    "  a: {frame: {dimension: 3, material: {E: 30 GPa}, nodes: {a0: [0, 0, 0], b0: [4, 0, 0], c0: [8, 0, 0], a1: [0, "
    "0, 3], b1: [4, 0, 3], c1: [8, 0, 3], a2: [0, 0, 6], b2: [4, 0, 6]},\n    members: {m1: {between: [a0, a1], "
    "section: {circle: 0.4}}, m2: {between: [b0, b1], section: {circle: 0.4}}, m3: {between: [c0, c1], section: "
    "{circle: 0.4}}, m4: {between: [a1, a2], section: {circle: 0.4}}, m5: {between: [b1, b2], section: {circle: "
    "0.4}}},\n    supports: {a0: fixed, b0: fixed, c0: fixed}, masses: {a1: 5 t, b1: 5 t, c1: 5 t, a2: 5 t, b2: 5 t}, "
    "floors: [{nodes: [a1, b1, c1]}, {nodes: [a2, b2]}]}, damping: 5 %}\n";

TEST(LinksOfNeighbours, SkipFloorsThatAreSetBack) {
  EXPECT_EQ(names(linked(podium + house("b", "8.02, -3", 2))), (Names{"a.1-b.1"}));
  EXPECT_EQ(names(linked(podium + house("b", "8.02, -3", 2), "between: neighbours, within: 5 m")),
            (Names{"a.1-b.1", "a.2-b.2"}));
}

TEST(LinksOfNeighbours, UseTheDrawnGap) {
  const Model read = test::model_of(linked(house("a", "0, 0") + house("b", "6.02005, 0") + house("c", "0, 6.02"),
                                           "between: neighbours, points: 1, gap: 20 mm"));
  for (const Link& link : read.links) EXPECT_EQ(link.gap, 0.02) << link.name;
  refused(linked(house("a", "0, 0") + house("b", "6.02, 0") + house("c", "0, 6.05"), "between: neighbours, gap: 20 mm"),
          at("6:32", "links[0].gap"), mentions({"20 mm", "6 m", "6.05 m", "50 mm", "-30 mm", "1"}));
  refused(linked(house("a", "0, 0") + house("b", "6.02, 0"), "between: neighbours, gap: [20 mm, 20 mm]"),
          at("5:32", "links[0].gap"), mentions({"gap"}));
}

TEST(LinksOfNeighbours, ReportErrors) {
  const std::string near = house("a", "0, 0") + house("b", "6.02, 0");
  refused(linked(near, "between: neighbors"), at("5:15", "links[0].between"), mentions({"neighbors", "neighbours"}));
  refused(linked(near, "between: all"), at("5:15", "links[0].between"),
          mentions({"between: [left, right]", "between: neighbours"}));
  refused(linked(near, "between: neighbours, name: walls"), at("5:27", "links[0].name"));
  refused(linked(near, "between: neighbours, within: 0"), at("5:35", "links[0].within"), mentions({"20 mm", "0"}));
  refused(linked(near, "between: [a.1, b.1], within: 1 m"), at("5:27", "links[0].within"));
  refused(linked(near, "between: neighbours, within: 10 mm"), at("5:15", "links[0].between"),
          mentions({"within: 20 mm"}));
  refused(linked(house("a", "0, 0") + house("b", "6.42, 0"), "between: neighbours, within: 10 mm"),
          at("5:15", "links[0].between"), mentions({"face: auto", "within: 420 mm", "20 mm"}));
  refused(linked(house("a", "0, 0") + house("b", "9, 9")), at("5:15", "links[0].between"), mentions({"origin"}));
  refused(linked(house("a", "0, 0") + "  w: {wall: {}}\n"), at("5:15", "links[0].between"),
          mentions({"between: [left, right]"}));
  refused(linked("  w: {wall: {}}\n  o: {oscillator: {mass: 1 t, period: 1}, damping: 5 %}\n"),
          at("5:15", "links[0].between"), mentions({"between: [left, right]"}));
  refused(linked(house("a", "0, 0") + house("b", "5, 3")), at("5:15", "links[0].between"),
          mentions({"origin: [6.1 m, 0 m]", "6 m", "5 m", "11 m", "3 m", "9 m"}));
  refused(linked(plane("a", "0") + plane("b", "5.9")), at("5:15", "links[0].between"),
          mentions({"6 m", "5.9 m", "100 mm", "1"}));
}

}  // namespace neighbours_input_test
}  // namespace pounding
