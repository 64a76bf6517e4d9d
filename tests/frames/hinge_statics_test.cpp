// Statics of frame hinges: limit loads of portals, springs at separate nodes, cut members, equilibrium.

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pounding/core/units.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include "support/book.hpp"
#include "support/dense.hpp"
#include "yielding_statics.hpp"

namespace pounding {
namespace hinge_statics_test {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test::YieldingStatics;

constexpr double plastic = 200e3;  // [N m]
const Material concrete{.young = 30e9, .shear = 12.5e9};

Structure made(const Frame& frame, bool gravity = false) {
  FrameModel model{.frame = frame};
  model.gravity = gravity;
  return make_structure(std::move(model));
}

// Fixed feet, 4 m high, span 8 m, a node at midspan. Hinges at the feet, at the column tops and at midspan.
Frame portal(double hardening) {
  Frame frame(2);
  const Section section = without_shear_deformation(rectangle_section(0.4, 0.4));
  const int a = frame.add_node({0, 0, 0}), b = frame.add_node({0, 0, 4}), c = frame.add_node({4, 0, 4}),
            d = frame.add_node({8, 0, 4}), e = frame.add_node({8, 0, 0});
  for (const int foot : {a, e}) frame.fix(foot);
  for (const int node : {b, c, d}) frame.add_mass(node, 1e3);
  const int left = frame.add_member(a, b, section, concrete), first = frame.add_member(b, c, section, concrete);
  frame.add_member(c, d, section, concrete);
  const int right = frame.add_member(e, d, section, concrete);
  for (const auto& [member, at] : {std::pair(left, MemberEnd::start),
                                   {left, MemberEnd::end},
                                   {first, MemberEnd::end},
                                   {right, MemberEnd::start},
                                   {right, MemberEnd::end}})
    frame.add_hinge({.member = member, .at = at, .yield_moment = plastic, .hardening = hardening});
  return frame;
}

// Unknowns x, z, ry of one corner, of midspan and of the other corner.
double limit_load(double across, double down) {
  const Structure s = made(portal(0));
  VectorXd load = VectorXd::Zero(9);
  load[0] = across;
  load[4] = -down;
  const VectorXd ones = VectorXd::Ones(5);
  const test::Pushed pushed = test::push(s, load, plastic * ones, 0 * ones, 1e12);
  EXPECT_TRUE(pushed.is_mechanism);
  return pushed.events.back().factor;
}

TEST(HingeStatics, PortalsCollapseAtTheLoadsOfLimitAnalysis) {
  test::Book book(
      "Hinges of frames",
      "limit analysis of a portal with fixed feet, h = 4 m, l = 8 m, Mp = 200 kN m: mechanisms of sway, beam and both",
      "round-off of the event-to-event path");
  book.near("lateral load, 4 Mp/h [N]", limit_load(1, 0), 4 * plastic / 4, 1e-9 * 200e3);
  book.near("load at midspan, 8 Mp/l [N]", limit_load(0, 1), 8 * plastic / 8, 1e-9 * 200e3);
  book.near("equal loads, 6 Mp/(h + l/2) [N]", limit_load(1, 1), 6 * plastic / (4 + 8.0 / 2), 1e-9 * 150e3);
  book.near("a quarter of the lateral load at midspan, 4 Mp/h [N]", limit_load(1, 0.25), 4 * plastic / 4, 1e-9 * 200e3);
}

// A cantilever yields at M = F L and continues with a flexibility of L^3/3EI + L^2/h.
TEST(HingeStatics, HardeningIsThatOfTheMemberInDoubleCurvature) {
  const double alpha = 0.03, length = 3, inertia = 0.4 * 0.4 * 0.4 * 0.4 / 12, ei = 30e9 * inertia;
  Frame frame(2);
  const int foot = frame.add_node({0, 0, 0}), top = frame.add_node({0, 0, length});
  frame.fix(foot);
  frame.add_mass(top, 1e3);
  frame.add_member(foot, top, without_shear_deformation(rectangle_section(0.4, 0.4)), concrete);
  frame.add_hinge({.member = 0, .yield_moment = plastic, .hardening = alpha});
  const Structure s = made(frame);
  const LoadedSpring spring(s.yielding[0].spring());
  EXPECT_DOUBLE_EQ(spring->stiffness(), 4 * ei / length);
  const double h = alpha * 6 * ei / length / (1 - alpha), ratio = h / (4 * ei / length + h);
  EXPECT_NEAR(spring.evaluate({2 * spring->yield_deformation(), 0}).force, -(1 - ratio) * plastic, 1e-12 * plastic);
  EXPECT_EQ(s.yielding_flexibility.coeff(0, 0), 0);
  VectorXd load = VectorXd::Zero(3);
  load[0] = 1;
  const double yields_at = plastic / length, more = 10e3;
  const test::Pushed pushed =
      test::push(s, load, VectorXd::Constant(1, plastic), VectorXd::Constant(1, ratio), yields_at + more);
  ASSERT_EQ(pushed.events.size(), 1u);
  EXPECT_NEAR(pushed.events[0].factor, yields_at, 1e-11 * yields_at);
  const double bends = (yields_at + more) * length * length * length / (3 * ei);
  EXPECT_NEAR(pushed.u[0], bends + more * length * length / h, 1e-11 * pushed.u[0]);

  // Both ends in double curvature: the guided top moves by V (h^3/12 EI), and by 1/alpha of that beyond yielding.
  Frame guided(2);
  guided.add_node({0, 0, 0}), guided.add_node({0, 0, length});
  guided.fix(0), guided.fix(1, {Dof::ry, Dof::uz});
  guided.add_mass(1, Dof::ux, 1e3);
  guided.add_member(0, 1, without_shear_deformation(rectangle_section(0.4, 0.4)), concrete);
  for (const MemberEnd at : {MemberEnd::start, MemberEnd::end})
    guided.add_hinge({.member = 0, .at = at, .yield_moment = plastic, .hardening = alpha});
  const Structure storey = made(guided);
  const double yields = 2 * plastic / length;
  const test::Pushed both = test::push(storey, VectorXd::Ones(1), VectorXd::Constant(2, plastic),
                                       VectorXd::Constant(2, ratio), yields + more);
  const double elastic = length * length * length / (12 * ei);
  EXPECT_NEAR(both.u[0], yields * elastic + more * elastic / alpha, 1e-11 * both.u[0]);
}

// The frame of three storeys whose reference periods come from springs between explicit rotations.
Frame three_storeys(bool with_nodes, double after = 1, bool cut = false) {
  const Section column = without_shear_deformation(rectangle_section(0.4, 0.4)),
                beam = without_shear_deformation(rectangle_section(0.3, 0.5));
  const double of_column = 10 * 6 * 30e9 * column.inertia_y / 3.2, of_beam = 10 * 6 * 30e9 * beam.inertia_y / 6;
  Frame frame(2);
  const auto hinged = [&](int joint, double stiffness) {
    const int end = frame.add_node(frame.position(joint));
    frame.tie(joint, end, {Dof::ux, Dof::uz});
    frame.add_spring(end, joint, Dof::ry, after * stiffness);
    return end;
  };
  const auto member = [&](int start, int end, const Section& section, bool at_start, bool at_end, double stiffness) {
    const double length = (frame.position(end) - frame.position(start)).norm();
    std::vector<int> parts;
    if (with_nodes) {
      parts = {frame.add_member(at_start ? hinged(start, stiffness) : start, at_end ? hinged(end, stiffness) : end,
                                section, concrete)};
      return;
    }
    parts = add_member_in_parts(frame, std::string("m").append(std::to_string(frame.members())), start, end,
                                {.section = section, .material = concrete, .parts = cut ? 2 : 1});
    for (const auto& [is_there, number, at] :
         {std::tuple(at_start, parts.front(), MemberEnd::start), {at_end, parts.back(), MemberEnd::end}})
      if (is_there)
        frame.add_hinge({.member = number,
                         .at = at,
                         .yield_moment = plastic,
                         .stiffness_factor = 10,
                         .member_length = length,
                         .spring_hardening = 0.003});
  };
  std::vector<std::array<int, 2>> nodes;
  for (int storey = 0; storey <= 3; ++storey)
    nodes.push_back({frame.add_node({0, 0, 3.2 * storey}), frame.add_node({6, 0, 3.2 * storey})});
  for (const int foot : nodes[0]) frame.fix(foot);
  for (int storey = 1; storey <= 3; ++storey) {
    for (const int i : {0, 1}) {
      frame.add_mass(nodes[storey][i], 20e3);
      member(nodes[storey - 1][i], nodes[storey][i], column, storey == 1, false, of_column);
    }
    member(nodes[storey][0], nodes[storey][1], beam, true, true, of_beam);
  }
  return frame;
}

MatrixXd condensed(const Structure& s) { return test::dense::condense(s.stiffness, s.mass).stiffness; }

TEST(HingeStatics, SpringsInSeriesAreAsSoftAsSpringsBetweenNodes) {
  test::Book book("Hinges of frames",
                  "frame of three storeys with springs of 10 x 6EI/L between explicit rotations, numpy", "rounding");
  const Structure by_nodes = made(three_storeys(true)), in_series = made(three_storeys(false)),
                  cut = made(three_storeys(false, 1, true));
  const MatrixXd expected = condensed(by_nodes);
  EXPECT_LT((condensed(in_series) - expected).norm(), 1e-11 * expected.norm());
  const VectorXd squares = test::dense::eigenvalues(condensed(in_series) / 20e3);
  const std::array periods{0.6818603273427927, 0.20395156106588447, 0.1121575387117127};
  for (int i = 0; i < 3; ++i)
    book.near("period " + std::to_string(i + 1) + " [s]", 2 * M_PI / std::sqrt(squares[i]), periods[i], 1e-10);
  EXPECT_EQ(cut.yielding.size(), 8u);
}

// All springs keep 0.003 of their k: the frame with softer springs against the forces -(1 - b) k d of the structure.
TEST(HingeStatics, YieldedSpringsAreAsSoftAsTheirHardening) {
  const Structure softer = made(three_storeys(true, 0.003)), yielding = made(three_storeys(false));
  const YieldingStatics statics(yielding);
  VectorXd load = VectorXd::Zero(softer.size()), same = VectorXd::Zero(yielding.size());
  for (int i = 0; i < 6; ++i) load[3 * i] = same[3 * i] = 1e3 * (i + 1), load[3 * i + 1] = same[3 * i + 1] = -2e3;
  const int count = static_cast<int>(statics.k.size());
  MatrixXd matrix = -statics.flexibility();
  for (int i = 0; i < count; ++i) matrix(i, i) += 1 / (0.997 * statics.k[i]);
  const VectorXd forces =
      -test::dense::solve(matrix, statics.b.transpose() * statics.unknowns(same, VectorXd::Zero(count)));
  const VectorXd u = statics.unknowns(same, forces), expected = test::dense::solve(softer.stiffness, load);
  for (int i = 0; i < 18; ++i) EXPECT_NEAR(u[i], expected[i], 1e-9 * expected.cwiseAbs().maxCoeff()) << i;
}

// Forces of 1, 2 and 3 on the floors; feet yield at 250 kN m, beams at 180 kN m.
TEST(HingeStatics, AFrameIsPushedAsByAnEventToEventSolution) {
  test::Book book(
      "Hinges of frames",
      "frame of three storeys pushed by forces 1:2:3 with springs between explicit rotations, event to event, numpy",
      "rounding");
  const Structure s = made(three_storeys(false));
  VectorXd load = VectorXd::Zero(s.size()), yield = VectorXd::Constant(8, 180e3);
  for (int node = 0; node < 6; ++node) load[3 * node] = (node / 2 + 1) / 12.0;
  for (int i = 0; i < 8; ++i)
    if (s.yielding[i].name == "m0 start" || s.yielding[i].name == "m1 start") yield[i] = 250e3;
  const auto push = [&](double shear) { return test::push(s, load, yield, VectorXd::Constant(8, 0.003), shear); };
  const test::Pushed pushed = push(281089.3420768575);
  const std::array shears{154154.0043071987, 173374.28926297135, 200263.802283439, 224069.1288371512};
  const std::array roofs{0.022216740348755742, 0.027098754713510975, 0.040130700818526016, 0.07195632964019727};
  const std::array first{"m2", "m5", "m0", "m8"};
  ASSERT_EQ(pushed.events.size(), 8u);
  for (int i = 0; i < 4; ++i) {
    for (int both : {2 * i, 2 * i + 1}) {
      book.near("base shear when hinges yield [N]", pushed.events[both].factor, shears[i], 1e-9 * shears[i]);
      const std::string member = s.yielding[pushed.events[both].part].name.substr(0, 2);
      EXPECT_TRUE(member == first[i] || (i == 2 && member == "m1")) << member;
    }
    book.near("displacement of the roof then [m]", push(shears[i]).u[12], roofs[i], 1e-9 * 0.25);
  }
  book.near("displacement of the roof at the end [m]", pushed.u[12], 0.25, 1e-9 * 0.25);
}

TEST(HingeStatics, AMemberThatIsCutYieldsAlike) {
  for (const bool rigid : {true, false}) {
    std::vector<test::Pushed> pushed;
    for (const int parts : {1, 2, 3}) {
      Frame frame(2);
      frame.add_node({0, 0, 0}), frame.add_node({1, 0, 4}), frame.add_node({6, 0, 4});
      frame.fix(0), frame.fix(2, {Dof::uz});
      frame.add_mass(1, 1e3), frame.add_mass(2, Dof::ux, 1e3);
      const Section section = rectangle_section(0.4, 0.4);  // with shear deformation
      frame.add_member(1, 2, section, concrete);
      const std::vector<int> column =
          add_member_in_parts(frame, "column", 0, 1, {.section = section, .material = concrete, .parts = parts});
      const double length = frame.position(1).norm();
      for (const auto& [member, at] : {std::pair(column.front(), MemberEnd::start), {column.back(), MemberEnd::end}})
        frame.add_hinge({.member = member,
                         .at = at,
                         .yield_moment = plastic,
                         .hardening = 0.05,
                         .stiffness_factor = rigid ? 0.0 : 10.0,
                         .member_length = length});
      const Structure s = made(frame);
      VectorXd load = VectorXd::Zero(s.size()), ratio(2);
      load[0] = 1, load[1] = -0.3;
      for (int i = 0; i < 2; ++i) {  // slope beyond the yield moment
        const LoadedSpring spring(s.yielding[i].spring());
        ratio[i] = 1 + spring.evaluate({2 * spring->yield_deformation(), 0}).by_penetration / spring->stiffness();
      }
      pushed.push_back(test::push(s, load, VectorXd::Constant(2, plastic), ratio, 1e6));
      ASSERT_EQ(pushed.back().events.size(), 2u);
    }
    for (int other : {1, 2}) {
      for (int i : {0, 1}) EXPECT_NEAR(pushed[other].u[i], pushed[0].u[i], 1e-9 * pushed[0].u.head(2).norm()) << other;
      for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(pushed[other].events[i].part, pushed[0].events[i].part);
        EXPECT_NEAR(pushed[other].events[i].factor, pushed[0].events[i].factor, 1e-9 * pushed[0].events[i].factor);
      }
    }
  }
}

// Rigid end zones, shear deformation, releases, inclined members, both axes, springs and rigid-plastic hinges in one
// frame.
FrameModel space_frame() {
  FrameModel model{.frame = Frame(3)};
  Frame& frame = model.frame;
  const Section section = rectangle_section(0.4, 0.6);
  frame.add_node({0, 0, 0}, "a"), frame.add_node({5, 0, 0}, "b"), frame.add_node({0.5, 0.2, 3}, "c"),
      frame.add_node({5, 0.4, 3.1}, "d");
  frame.add_node({0.5, 4, 3}, "e"), frame.add_node({0.4, 4.2, 0}, "f");
  frame.fix(0), frame.fix(1, {Dof::ux, Dof::uy, Dof::uz}), frame.fix(5);
  frame.add_spring(1, Dof::ry, 3e7);
  for (const int node : {2, 3, 4}) frame.add_mass(node, 5e3);
  const auto member = [&](int start, int end, const BeamOptions& options) {
    return frame.add_member(start, end, section, concrete, options);
  };
  member(0, 2, {.end_offset = {0, 0, -0.3}});
  member(1, 3, {.reference = Vector3d(1, 1, 0), .start_offset = {0, 0, 0.2}});
  member(2, 3, {.start_offset = {0.2, 0, 0}, .end_offset = {-0.2, 0, 0}, .end_releases = {Dof::rz}});
  member(2, 4, {.start_releases = {Dof::rx}});
  member(4, 5, {});
  int number = 0;
  for (int m = 0; m < 5; ++m)
    for (const MemberEnd at : {MemberEnd::start, MemberEnd::end})
      for (const BendingAxis about : {BendingAxis::y, BendingAxis::z}) {
        if (m == 2 && at == MemberEnd::end && about == BendingAxis::z) continue;
        Hinge hinge{.member = m, .at = at, .about = about, .yield_moment = plastic, .hardening = 0.02};
        if (++number % 3 == 0) hinge.stiffness_factor = 8;
        if (number % 5 == 0) hinge.stiffness = 9e7, hinge.stiffness_factor = 0;
        frame.add_hinge(hinge);
      }
  model.floors.push_back({.label = "1", .nodes = {2, 3, 4}, .elevation = 3});
  return model;
}

// For any hinge forces, the moment of each is k d + F, and members, joints and the whole frame are in equilibrium.
TEST(HingeStatics, EndForcesOfYieldingMembersAreInEquilibrium) {
  const FrameModel model = space_frame();
  const Structure s = make_structure(model);
  const YieldingStatics statics(s);
  ASSERT_EQ(statics.k.size(), 19);
  VectorXd load(s.size()), forces(19);
  for (int i = 0; i < s.size(); ++i) load[i] = 10e3 * std::sin(3.0 * i + 1);
  for (int i = 0; i < 19; ++i) forces[i] = 50e3 * std::cos(2.0 * i);
  const VectorXd u = statics.unknowns(load, forces);
  const VectorXd all = s.forces.rows * u + s.forces.by_yielding * forces, moments = statics.moments(u, forces);
  for (int i = 0; i < 19; ++i) {
    const Hinge& hinge = model.frame.hinges()[i];
    EXPECT_NEAR(all[hinge.member * 12 + hinge.place()], moments[i], 1e-9 * plastic) << s.yielding[i].name;
  }
  EXPECT_NEAR(all[2 * 12 + 11], 0, 1e-6) << "released";
  EXPECT_NEAR(all[3 * 12 + 3], 0, 1e-6) << "released";

  // On the members: forces and moments about the start, in global axes. On the joints: the member end forces and the
  // springs.
  for (int m = 0; m < 5; ++m) {
    const Beam& beam = model.frame.beam(m);
    const auto [start, end] = model.frame.ends(m);
    const VectorXd local = all.segment(12 * m, 12);
    const Vector3d at_start = beam.axes().transpose() * local.segment<3>(0),
                   at_end = beam.axes().transpose() * local.segment<3>(6);
    const Vector3d start_moment = beam.axes().transpose() * local.segment<3>(3),
                   end_moment = beam.axes().transpose() * local.segment<3>(9);
    const Vector3d from = model.frame.position(start) + beam.options().start_offset,
                   to = model.frame.position(end) + beam.options().end_offset;
    EXPECT_LT((at_start + at_end).norm(), 1e-5) << m;
    EXPECT_LT((start_moment + end_moment + (to - from).cross(at_end)).norm(), 1e-5) << m;
  }
  MatrixXd taken = MatrixXd::Zero(6, 6);
  for (int m = 0; m < 5; ++m) {
    const Beam& beam = model.frame.beam(m);
    for (const auto& [node, first, offset] : {std::tuple(model.frame.ends(m)[0], 0, beam.options().start_offset),
                                              std::tuple(model.frame.ends(m)[1], 6, beam.options().end_offset)}) {
      const Vector3d force = beam.axes().transpose() * all.segment<3>(12 * m + first);
      const Vector3d turn = beam.axes().transpose() * all.segment<3>(12 * m + first + 3);
      taken.col(node).head<3>() += force;
      taken.col(node).tail<3>() += turn + offset.cross(force);
    }
  }
  const AssembledFrame assembled = model.frame.assemble();
  for (int i = 0; i < s.size(); ++i) {
    const auto [node, dof] = assembled.unknowns[i];
    const double spring = node == 1 && dof == Dof::ry ? 3e7 * u[i] : 0;
    EXPECT_NEAR(taken(static_cast<int>(dof), node) + spring, load[i], 1e-5) << s.unknowns[i];
  }
  // The support forces at the feet equal the member end forces; the spring at node b pushes back.
  ASSERT_EQ(s.forces.supports.size(), 3u);
  const auto b_turns = std::find(s.unknowns.begin(), s.unknowns.end(), "node b ry") - s.unknowns.begin();
  const std::vector<int> feet{0, 1, 5};
  for (int foot = 0; foot < 3; ++foot)
    for (int dof = 0; dof < 6; ++dof) {
      double expected = taken(dof, feet[foot]);
      if (feet[foot] == 1 && dof >= 3) expected = dof == 4 ? -3e7 * u[b_turns] : 0;
      EXPECT_NEAR(all[5 * 12 + 6 * foot + dof], expected, 1e-5) << foot << dof;
    }
}

TEST(HingeStatics, StoreyShearsOfYieldingFramesAreTheLoadAbove) {
  const Structure s = make_structure(space_frame());
  const YieldingStatics statics(s);
  VectorXd load = VectorXd::Zero(s.size()), forces(19);
  load += 10e3 * s.floors[0].motion[0] + 7e3 * s.floors[0].motion[1];
  for (int i = 0; i < 19; ++i) forces[i] = 50e3 * std::cos(2.0 * i);
  const VectorXd u = statics.unknowns(load, forces);
  const Floor& floor = s.floors[0];
  ASSERT_EQ(floor.storey_shear_by_yielding.size(), 2u);
  EXPECT_NEAR(floor.storey_shear[0].dot(u) + floor.storey_shear_by_yielding[0].dot(forces), 10e3, 1e-5);
  EXPECT_NEAR(floor.storey_shear[1].dot(u) + floor.storey_shear_by_yielding[1].dot(forces), 7e3, 1e-5);
}

// p_delta: the same frame with pins in place of the yielded hinges, and springs there, under the same axial forces.
TEST(HingeStatics, YieldedHingesUnderPDeltaAreSpringsInTheColumns) {
  const Section section = without_shear_deformation(rectangle_section(0.4, 0.4));
  const double ei = 30e9 * section.inertia_y, h = 0.05 * 6 * ei / 5 / 0.95;
  const auto column = [&](bool by_nodes) {
    Frame frame(2);
    frame.add_node({0, 0, 0}), frame.add_node({0, 0, 5});
    frame.fix(0);
    frame.add_mass(1, 1e3);
    const int foot = by_nodes ? frame.add_node({0, 0, 0}) : 0;
    if (by_nodes) {
      frame.tie(0, foot, {Dof::ux, Dof::uz});
      frame.add_spring(foot, 0, Dof::ry, h);
    }
    frame.add_member(foot, 1, section, concrete, {.axial_force = -400e3});
    if (!by_nodes) frame.add_hinge({.member = 0, .yield_moment = plastic, .hardening = 0.05});
    return made(frame);
  };
  const Structure yielding = column(false), pinned = column(true);
  const YieldingStatics statics(yielding);
  const double k = statics.k[0], ratio = h / (k + h);
  VectorXd load = VectorXd::Zero(3), same = VectorXd::Zero(pinned.size());
  load[0] = same[0] = 10e3;
  const double free = statics.b.col(0).dot(statics.unknowns(load, VectorXd::Zero(1)));
  const VectorXd force = VectorXd::Constant(1, -free / (1 / ((1 - ratio) * k) - statics.flexibility()(0, 0)));
  const VectorXd u = statics.unknowns(load, force), expected = test::dense::solve(pinned.stiffness, same);
  EXPECT_NEAR(u[0], expected[0], 1e-10 * expected[0]);
  EXPECT_NEAR(u[2], expected[2], 1e-10 * std::abs(expected[2]));
}

}  // namespace hinge_statics_test
}  // namespace pounding
