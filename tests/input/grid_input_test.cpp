// Grids in the input: sections by storey and line, changed members, subdivided members.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/input/frames/frame_input.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace grid_input_test {

using test::at, test::mentions;

// Lines 1 to 3; `columns` and `beams` are the values of these keys, `rest` contains further keys of the frame.
std::string frame(const std::string& columns, const std::string& beams, const std::string& rest = "") {
  return "material: {E: 30 GPa, density: 2500}\nsections: {C60: {rectangle: [0.6, 0.6]}, C50: {rectangle: [0.5, 0.5]}, "
         "B60: {rectangle: [0.3, 0.6]}, B50: {rectangle: [0.3, 0.5]}}\ngrid: {storeys: 3, bays: 2, storey_height: 3 m, "
         "bay_width: 6 m, floor_mass: 20 t, beams: " +
         beams + ", columns: " + columns + "}\n" + rest;
}

FrameModel read(const std::string& yaml) { return read_frame(Input::read_text(yaml, "test.yaml")).model; }

double depth(const FrameModel& model, const std::string& name) {
  for (int member = 0; member < model.frame.members(); ++member) {
    const Section& section = model.frame.beam(member).section();
    if (model.frame.member_name(member) == name) return std::sqrt(12 * section.inertia_y / section.area);
  }
  throw std::invalid_argument("no member " + name);
}

void refused(const std::string& yaml, const std::string& location, const test::Facts& facts = {},
             std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal<InputError>([&] { read(yaml); }), "test.yaml:" + location, facts, line);
}

TEST(GridInput, SectionsChangeWithTheStorey) {
  for (const std::string columns :
       {"[C60, C60, C50]", "{1-2: C60, 3: C50}", "{3: {rectangle: [0.5, 0.5]}, 1-2: C60}"}) {
    const FrameModel m = read(frame(columns, "B60"));
    EXPECT_NEAR(depth(m, "column 1.0"), 0.6, 1e-12) << columns;
    EXPECT_NEAR(depth(m, "column 2.2"), 0.6, 1e-12) << columns;
    EXPECT_NEAR(depth(m, "column 3.1"), 0.5, 1e-12) << columns;
  }
}

TEST(GridInput, SectionsChangeWithTheLine) {
  const FrameModel m = read(frame("{1: [C50, C60, C50], 2-3: C50}", "[[B60, B50], B50, B60]"));
  EXPECT_NEAR(depth(m, "column 1.0"), 0.5, 1e-12);
  EXPECT_NEAR(depth(m, "column 1.1"), 0.6, 1e-12);
  EXPECT_NEAR(depth(m, "column 2.1"), 0.5, 1e-12);
  EXPECT_NEAR(depth(m, "beam x 1.0"), 0.6, 1e-12);
  EXPECT_NEAR(depth(m, "beam x 1.1"), 0.5, 1e-12);
  EXPECT_NEAR(depth(m, "beam x 3.0"), 0.6, 1e-12);
}

TEST(GridInput, RejectsMissingAndRepeatedStoreys) {
  refused(frame("{1-2: C60}", "B60"), at("3:104", "grid.columns"), mentions({"{1-3: C60, 4-5: C50}"}));
  refused(frame("{1-2: C60, 2-3: C50}", "B60"), at("3:115", "grid.columns.2-3"), mentions({"2"}));
  refused(frame("{1-4: C60}", "B60"), at("3:105", "grid.columns.1-4"), mentions({"1-4", "3"}));
  refused(frame("{1-2: C60, 3x: C50}", "B60"), at("3:115", "grid.columns.3x"), mentions({"3x", "4", "1-3"}));
  refused(frame("[C60, C50]", "B60"), at("3:104", "grid.columns"), mentions({"3", "2"}));
  refused(frame("[[C60, C50], C60, C60]", "B60"), at("3:105", "grid.columns[0]"), mentions({"3", "2"}));
  refused(frame("{1-2: C60, 3: C55}", "B60"), at("3:118", "grid.columns.3"), mentions({"C55", "C50"}));
}

TEST(GridInput, MembersOfTheGridMayDiffer) {
  const FrameModel m = read(
      frame("C50", "B60", "members: {column 1.1: {section: C60}, brace: {between: [0.0, 1.1], truss: 20 cm^2}}\n"));
  EXPECT_NEAR(depth(m, "column 1.1"), 0.6, 1e-12);
  EXPECT_NEAR(depth(m, "column 1.0"), 0.5, 1e-12);
  EXPECT_EQ(m.frame.member_name(m.frame.members() - 1), "brace");
  refused(frame("C50", "B60", "members: {column 4.1: {section: C60}}\n"), at("4:11", "members.column 4.1"),
          mentions({"column 4.1", "column 1.1"}));
  refused(frame("C50", "B60", "members: {column 1.1: {between: [0.1, 1.1], section: C60}}\n"),
          at("4:24", "members.column 1.1.between"));
}

TEST(GridInput, GroupsOfMembersMayDiffer) {
  const FrameModel m = read(frame("C50", "B60",
                                  "members: {columns: {section: C60}, columns 2: {section: B60, parts: 2}, column 3.2: "
                                  "{parts: 4}, beams: {section: B50}}\n"));
  EXPECT_NEAR(depth(m, "column 1.0"), 0.6, 1e-12);
  EXPECT_NEAR(depth(m, "column 2.2/2"), depth(read(frame("C50", "B60")), "beam x 1.0"), 1e-12);
  EXPECT_NEAR(depth(m, "column 3.2/4"), 0.5, 1e-12);
  EXPECT_NEAR(depth(m, "beam x 3.1"), depth(read(frame("C50", "B50")), "beam x 1.0"), 1e-12);
  refused(frame("C50", "B60", "members: {columns 3: {section: C60}}\n"), at("4:11", "members.columns 3"),
          mentions({"columns 3", "columns 0"}));
}

TEST(GridInput, MembersMayBeSubdivided) {
  const std::string cut =
      "members: {column 2.0: {parts: 3}, post: {between: [0.1, a], section: C50, parts: 2, load: [0, -1 "
      "kN/m]}}\nnodes: {a: [7 m, 0]}\n";
  const FrameModel whole = read(frame("C50", "B60")), m = read(frame("C50", "B60", cut));
  EXPECT_EQ(m.frame.nodes(), whole.frame.nodes() + 2 + 1 + 1);
  EXPECT_EQ(m.frame.members(), whole.frame.members() + 2 + 2);
  EXPECT_NEAR(depth(m, "column 2.0/2"), 0.5, 1e-12);
  EXPECT_NEAR(depth(m, "post/1"), 0.5, 1e-12);
}

}  // namespace grid_input_test
}  // namespace pounding
