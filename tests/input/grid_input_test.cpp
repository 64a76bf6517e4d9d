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

// A portal of one bay with a load on its beam.
std::string portal(const std::string& load, const std::string& rest = "") {
  return "material: {E: 30 GPa}\ngrid: {storeys: 1, bays: 1, storey_height: 4 m, bay_width: 6 m, columns: {area: 0.1 "
         "m^2, inertia_y: 2e-3 m^4}, beams: {area: 0.1 m^2, inertia_y: 4e-3 m^4}, " +
         load + "}\n" + rest;
}

TEST(GridInput, LoadsBendBeamsAsBetweenFixedEnds) {
  const FrameModel m = read(portal("beams_load: -25 kN/m, floor_mass: 1 t", "gravity: false\n"));
  const Vector12 ends = m.frame.fixed_end_forces(1);
  EXPECT_NEAR(std::abs(ends[4]), 25e3 * 36 / 12, 1e-6);
  EXPECT_NEAR(std::abs(ends[10]), 25e3 * 36 / 12, 1e-6);
}

// Kleinlogel: with k = (I beam/I column) (h/L), the moment at the top of fixed columns is w L^2/(6 (k + 2)).
TEST(GridInput, MomentsAtRestAreThoseOfThePortal) {
  const FrameModel m = read(portal("beams_load: -25 kN/m, floor_mass: 1 t", "gravity: false\n"));
  const AssembledFrame assembled = m.frame.assemble(m.has_gravity());
  const Vector12 ends = m.frame.end_forces(1, assembled, m.frame.rest(assembled)) + m.frame.fixed_end_forces(1);
  ASSERT_EQ(m.frame.member_name(1), "beam x 1.0");
  const double k = 2.0 * 4 / 6;
  EXPECT_NEAR(std::abs(ends[4]), 25e3 * 36 / (6 * (k + 2)), 0.01 * 45e3) << "axial deformation of the columns only";
  EXPECT_NEAR(std::abs(ends[2]), 75e3, 1e-6 * 75e3);
}

TEST(GridInput, LoadCasesAreCombined) {
  const std::string cases = "dead_load: -20 kN/m, live_load: -10 kN/m, combination: {live: 0.3}, floor_mass: 1 t";
  EXPECT_NEAR(read(portal(cases)).frame.fixed_end_forces(1)[2], 23e3 * 3, 1e-6);
  const FrameModel by_storey = read(frame("C50", "B60, beams_load: {1-2: -25 kN/m, 3: [-15 kN/m, -10 kN/m]}"));
  const auto load_of = [&](const std::string& name) {
    for (int member = 0; member < by_storey.frame.members(); ++member)
      if (by_storey.frame.member_name(member) == name) return by_storey.frame.fixed_end_forces(member)[2] / 3;
    return 0.0;
  };
  EXPECT_NEAR(load_of("beam x 2.1"), 25e3, 1e-6);
  EXPECT_NEAR(load_of("beam x 3.0"), 15e3, 1e-6);
  EXPECT_NEAR(load_of("beam x 3.1"), 10e3, 1e-6);
  refused(portal("live_load: -10 kN/m"), "2:", mentions({"combination: {dead: 1, live: 0.3}"}));
  refused(portal("beams_load: -10 kN/m, dead_load: -5 kN/m"), "2:", mentions({"beams_load", "dead_load"}));
  refused(portal("mass_from_loads: true"), "2:", mentions({"beams_load: -25 kN/m"}));
  refused(portal("beams_load: 10 kN/m, mass_from_loads: true"), "2:", mentions({"10 kN/m"}));
  refused(portal("beams_load: -10 kN"), "2:", mentions({"10 kN"}));
}

// The mass of a load weighs what the load weighs, and once.
TEST(GridInput, MassFromLoadsDoesNotWeighTwice) {
  constexpr double g = 9.80665;
  for (const std::string gravity : {"", "gravity: true\n", "gravity: false\n"}) {
    const FrameModel m = read(portal("beams_load: -25 kN/m, mass_from_loads: true", gravity));
    const AssembledFrame assembled = m.frame.assemble(m.has_gravity());
    EXPECT_NEAR(assembled.load.col(0).sum(), 25e3 * 6 / g, 1e-6) << gravity;
    const Vector12 column = m.frame.end_forces(0, assembled, m.frame.rest(assembled));
    EXPECT_NEAR(std::abs(column[0]), 75e3, 1e-6 * 75e3) << gravity;
  }
}

TEST(GridInput, TakesStandardSections) {
  const FrameModel m = read(
      "material: S355\ngrid: {storeys: 2, bays: 1, storey_height: 3 m, bay_width: 6 m, columns: [HEB400, {profile: "
      "heb 400, axis: weak}], beams: IPE300, floor_mass: 20 t}\n");
  EXPECT_NEAR(m.frame.beam(0).section().inertia_y, 57680e-8, 10e-8);
  EXPECT_NEAR(m.frame.beam(3).section().inertia_y, 10820e-8, 5e-8);
  EXPECT_EQ(m.frame.beam(1).section().depth, 0.3);
  EXPECT_EQ(m.frame.beam(1).material().strength, 355e6);
  refused(frame("HEB410", "B60"), "3:", mentions({"HEB410", "HEB400", "HEB450"}));
  refused(frame("{profile: IPE301}", "B60"), "3:", mentions({"IPE301", "IPE300"}));
}

}  // namespace grid_input_test
}  // namespace pounding
