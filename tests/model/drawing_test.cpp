// The gap between frames is the distance in the drawing, without the round-off of coordinates.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <pounding/elements.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace drawing_test {

using test::refusal;

GridFrame grid(double origin, int storeys = 2, double storey_height = 3) {
  GridFrame frame{.storeys = storeys,
                  .bays_x = 1,
                  .storey_height = {storey_height},
                  .bay_width_x = {6},
                  .column = rectangle_section(0.4, 0.4),
                  .beam = rectangle_section(0.3, 0.5),
                  .material = isotropic(30e9),
                  .floor_mass = {6e4}};
  frame.origin.x() = origin;
  return frame;
}

struct Pair {
  explicit Pair(double origin, double storey_height = 3)
      : left(model.add("left", make_structure(grid(0)), {.damping = 0.05})),
        right(model.add("right", make_structure(grid(origin, 2, storey_height)), {.damping = 0.05})) {}

  double gap(const LinkOptions& options = {.floors = FacingFloors::all}) {
    model.link(left, right, options, laws::Hertz{.stiffness = 1e9});
    return model.links.back().gap;
  }

  Model model;
  StructureHandle left, right;
};

TEST(DrawnGap, IsTheDistanceToTheLastTypedDigit) {
  EXPECT_EQ(Pair(6.02).gap(), 0.02) << "6.02 - 6 is 0.01999999999999957";
  EXPECT_EQ(Pair(6.0254).gap(), 0.0254);
  EXPECT_EQ(Pair(7.5).gap(), 1.5);
}

TEST(DrawnGap, IsNoneWhereRoundingParts) {
  EXPECT_EQ(Pair(6).gap(), 0);
  EXPECT_EQ(Pair(6 + 1e-15).gap(), 0);
  EXPECT_EQ(Pair(6 - 1e-15).gap(), 0);
  EXPECT_EQ(Pair(6 - 1e-15).gap({.gap = 0, .floors = FacingFloors::all}), 0);
  EXPECT_EQ(Pair(0.1 + 0.2 + 5.7).gap({.gap = 0, .floors = FacingFloors::all}), 0);
  EXPECT_FALSE(std::signbit(Pair(6 - 1e-15).gap()));
}

// Two equal frames next to each other under their weight.
Model leaning(int storeys, double floor_mass, double load = 0) {
  const auto heavy = [&](double origin) {
    GridFrame parts_of = grid(origin, storeys);
    parts_of.floor_mass = {floor_mass};
    FrameModel model{.frame = Frame(2)};
    const GridParts parts = add_grid(model, parts_of);
    for (const int foot : parts.feet) model.frame.fix(foot);
    // Towards the other frame.
    if (load != 0) model.frame.add_load(model.floors.back().nodes.front(), Dof::ux, origin < 1 ? load : -load);
    model.gravity = true;
    return make_structure(model);
  };
  Model model;
  const StructureHandle left = model.add("left", heavy(0.1), {.damping = 0.05}),
                        right = model.add("right", heavy(6.1), {.damping = 0.05});
  model.link(left, right, {.floors = FacingFloors::all}, laws::Hertz{.stiffness = 1e9});
  return model;
}

// Under their weight equal frames sway by the round-off of their displacements at rest, which grows with the
// displacements.
TEST(DrawnGap, OfZeroHoldsUnderGravity) {
  for (const int storeys : {2, 7, 30})
    for (const double floor_mass : {6e4, 6e7, 6e12}) {
      EXPECT_NO_THROW(EXPECT_EQ(leaning(storeys, floor_mass).links.at(1).gap, 0))
          << storeys << " storeys of " << floor_mass << " kg";
    }
}

TEST(DrawnGap, OfZeroIsRefusedWhereFramesLeanTogether) {
  EXPECT_NE(test::refusal([] { leaning(2, 6e4, 1e-6); }).find("overlap by"), std::string::npos);
}

TEST(DrawnGap, IsTheGivenOneWhereTheyDifferByRounding) {
  EXPECT_EQ(Pair(6.02).gap({.gap = 0.02009, .floors = FacingFloors::all}), 0.02009);
  EXPECT_EQ(Pair(6.333).gap({.gap = 1.0 / 3, .floors = FacingFloors::all}), 1.0 / 3) << "a thousandth";
  EXPECT_TRUE(test::mentions(refusal([] { Pair(6.02).gap({.gap = 0.0202, .floors = FacingFloors::all}); }),
                             {"20.2 mm", "6 m", "6.02 m", "20 mm", "0.2 mm", "1"}));
  EXPECT_TRUE(test::mentions(refusal([] { Pair(988).gap({.gap = 0.02, .floors = FacingFloors::all}); }),
                             {"20 mm", "6 m", "988 m", "982 m", "-981.98 m", "1"}));
}

// A tower with set-back upper floors.
TEST(DrawnGap, IsThatOfEachFloor) {
  const auto stepped = [] {
    FrameModel model{.frame = Frame(2)};
    const double x[][2] = {{0, 0}, {9, 0}, {0, 3}, {9, 3}, {0, 6}, {6, 6}, {6, 3}};
    const char* names[] = {"a", "b", "c", "d", "e", "f", "g"};
    for (int i = 0; i < 7; ++i) model.frame.add_node({x[i][0], 0, x[i][1]}, names[i]);
    const Section s = rectangle_section(0.4, 0.4);
    for (const auto& [from, to] :
         std::vector<std::pair<int, int>>{{0, 2}, {1, 3}, {2, 6}, {6, 3}, {2, 4}, {6, 5}, {4, 5}})
      model.frame.add_member(from, to, s, isotropic(30e9));
    for (const int node : {2, 3, 4, 5}) model.frame.add_mass(node, 2e4);
    model.frame.fix(0), model.frame.fix(1);
    model.floors = {{.label = "1", .nodes = {2, 6, 3}, .elevation = 3},
                    {.label = "2", .nodes = {4, 5}, .elevation = 6}};
    return make_structure(model);
  };
  Model model;
  const StructureHandle left = model.add("left", stepped(), {.damping = 0.05});
  const StructureHandle right = model.add("right", make_structure(grid(9.05)), {.damping = 0.05});
  model.link(left, right, {.floors = FacingFloors::all}, laws::Hertz{.stiffness = 1e9});
  EXPECT_EQ(model.links[0].gap, 0.05);
  EXPECT_EQ(model.links[1].gap, 3.05);
}

// Plane frames may overlap: a deck over a low building.
TEST(DrawnGap, IsThatOfTheEndsWhereFramesReachOverEachOther) {
  const auto cantilever = [](double foot, double tip) {
    FrameModel model{.frame = Frame(2)};
    model.frame.add_node({foot, 0, 0}, "foot");
    model.frame.add_node({foot, 0, 9}, "top");
    model.frame.add_node({tip, 0, 9}, "tip");
    for (int i = 0; i < 2; ++i) model.frame.add_member(i, i + 1, rectangle_section(0.8, 0.8), isotropic(30e9));
    model.frame.add_mass(1, 2e4), model.frame.add_mass(2, 2e4);
    model.frame.fix(0);
    model.floors = {{.label = "deck", .nodes = {1, 2}, .elevation = 9}};
    return make_structure(model);
  };
  Model model;
  const StructureHandle deck = model.add("deck", cantilever(0, 8), {.damping = 0.05});
  const StructureHandle low = model.add("low", make_structure(grid(5)), {.damping = 0.05});
  const StructureHandle other = model.add("other", cantilever(14, 8.03), {.damping = 0.05});
  model.link(deck.floor(1), other.floor(1), {}, laws::Hertz{.stiffness = 1e9});
  EXPECT_EQ(model.links[0].gap, 0.03);
  EXPECT_TRUE(
      test::mentions(refusal([&] { model.link(deck.floor(1), low.floor(2), {}, laws::Hertz{.stiffness = 1e9}); }),
                     {"8 m", "5 m", "3 m", "2"}));
}

TEST(DrawnGap, IsOfEndsThatAreLevel) {
  const auto first_floors = [](double storey_height) {
    Pair pair(6.02, storey_height);
    pair.model.link(pair.left.floor(1), pair.right.floor(1), {}, laws::Hertz{.stiffness = 1e9});
    return pair.model.links[0].gap;
  };
  EXPECT_EQ(first_floors(2.6), 0.02) << "beams 0.5 m deep meet";
  EXPECT_TRUE(
      test::mentions(refusal([&] { first_floors(2.4); }), {"{structure: right, elevation: 3 m}", "2.4 m", "1"}));
}

TEST(DrawnGap, StaysRequiredWithoutADrawing) {
  Pair pair(6.02);
  const StructureHandle wall = pair.model.add("wall", make_wall());
  EXPECT_TRUE(
      test::mentions(refusal([&] { pair.model.link(pair.right.floor(1), wall, {}, laws::Hertz{.stiffness = 1e9}); }),
                     {"{.gap = 0.02}"}));
}

}  // namespace drawing_test
}  // namespace pounding
