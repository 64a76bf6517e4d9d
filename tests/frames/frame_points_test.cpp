// Points between the ends of a member, support displacements, dashpots, and global forces of the frame.

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/frames/frame.hpp>
#include "support/book.hpp"
#include "support/dense.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace frame_points_test {

using test::refusal;

using Eigen::MatrixX3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Section slender{.area = 0.12, .inertia_y = 1.6e-3, .inertia_z = 0.9e-3, .torsion = 2e-3};
const Section deep{
    .area = 0.12, .inertia_y = 1.6e-3, .inertia_z = 0.9e-3, .torsion = 2e-3, .shear_area_y = 0.07, .shear_area_z = 0.1};
const Material steel{.young = 200e9, .shear = 80e9, .density = 7850};

double relative(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

VectorXd under(const Frame& frame, AssembledFrame f, const VectorXd& load) {
  f.load_at_rest = load;
  return frame.rest(f);
}

TEST(PointOnMember, HasTheHeldEndForcesOfAFixedBeam) {
  test::Book book("Points between the ends of members, support displacements",
                  "Roark: fixed at both ends, P at a from the start: moments P a b^2/L^2 and P a^2 b/L^2, force at "
                  "the start P b^2 (3a + b)/L^3",
                  "rounding");
  const double l = 5, a = 1.7, b = l - a;
  const Beam beam({0, 0, 0}, {l, 0, 0}, slender, steel);
  const Eigen::Matrix<double, 12, 3> held = beam.fixed_end_forces_at(a / l);
  const double near = a * b * b / (l * l), far = a * a * b / (l * l), start = b * b * (3 * a + b) / (l * l * l);
  // A force along +z; upward at the far end; the moment about y turns z into x.
  Vector12 in_z, in_y, in_x;
  in_x << -b / l, 0, 0, 0, 0, 0, -a / l, 0, 0, 0, 0, 0;
  in_y << 0, -start, 0, 0, 0, -near, 0, start - 1, 0, 0, 0, far;
  in_z << 0, 0, -start, 0, near, 0, 0, 0, start - 1, 0, -far, 0;
  book.below("fixed-end forces, axial, largest difference over the largest [-]", relative(held.col(0), in_x), 1e-14);
  book.below("fixed-end forces in y, largest difference over the largest [-]", relative(held.col(1), in_y), 1e-14);
  book.below("fixed-end forces in z, largest difference over the largest [-]", relative(held.col(2), in_z), 1e-14);
}

TEST(PointOnMember, MovesWithTheSimplySupportedBeam) {
  test::Book book("Points between the ends of members, support displacements",
                  "simply supported beam, P at a: deflection P a^2 b^2/(3 EI L) there, of which P a^3 b^3/(3 EI "
                  "L^3) is the bending between fixed ends",
                  "rounding");
  const double l = 5, a = 1.7, b = l - a, p = 3e4, ei = steel.young * slender.inertia_y;
  Frame frame(2);
  frame.add_node({0, 0, 0});
  frame.add_node({l, 0, 0});
  frame.add_member(0, 1, slender, steel);
  frame.fix(0, {Dof::ux, Dof::uz});
  frame.fix(1, {Dof::uz});
  const AssembledFrame f = frame.assemble();
  const auto point = frame.point_on_member(0, a / l, f);
  const VectorXd q = under(frame, f, -p * VectorXd(point.motion[2]));
  const double whole = p * a * a * b * b / (3 * ei * l), held = p * a * a * a * b * b * b / (3 * ei * l * l * l);
  book.near("deflection of the point without the bending between fixed ends [m]", point.motion[2].dot(q),
            -(whole - held), 1e-12 * whole);
  const Vector12 ends = frame.end_force_rows(0, f) * q + point.fixed_ends * Vector3d(0, 0, -p);
  book.near("left support [N]", ends[2], p * b / l, 1e-11 * p);
  book.near("right support [N]", ends[8], p * a / l, 1e-11 * p);
  book.near("left end moment [N m]", ends[4], 0, 1e-11 * p * l);
  book.near("right end moment [N m]", ends[10], 0, 1e-11 * p * l);
}

// A frame with a node at the point is equivalent: all other displacements and the end forces are equal. The point
// itself moves further by the bending between fixed ends, which is the same difference with the nodes fixed.
TEST(PointOnMember, IsTheNodeThatDividesTheMember) {
  struct Case {
    Section section;
    std::vector<Dof> start_releases, end_releases;
  };
  const std::vector<Case> cases{{slender, {}, {}},
                                {deep, {}, {}},
                                {deep, {Dof::ry}, {Dof::ry, Dof::rz}},
                                {deep, {Dof::rx, Dof::rz}, {Dof::ux}},
                                {deep, {}, {Dof::uz, Dof::rx}}};
  const Vector3d foot(0.2, -1, 0), low(0.3, 0.1, 2), high(3.4, 1.6, 3.1);
  const Vector3d start_offset(0.1, 0.2, 0.15), end_offset(-0.2, 0, -0.1), leaning(0.2, 0.3, 1);
  for (const Case& c : cases)
    for (const double along : {0.0, 0.3, 0.85, 1.0}) {
      const Vector3d from = low + start_offset, to = high + end_offset, middle = from + along * (to - from);
      const bool divided = along > 0 && along < 1;
      Frame whole(3), parts(3);
      for (Frame* frame : {&whole, &parts}) {
        for (const Vector3d& at : {foot, low, high, Vector3d(4, 1, 0)}) frame->add_node(at);
        frame->fix(0);
        frame->fix(3);
        frame->add_member(0, 1, deep, steel);
        frame->add_member(3, 2, slender, steel);
      }
      whole.add_member(1, 2, c.section, steel,
                       {.reference = leaning,
                        .start_offset = start_offset,
                        .end_offset = end_offset,
                        .start_releases = c.start_releases,
                        .end_releases = c.end_releases});
      if (divided) {
        parts.add_node(middle);
        parts.add_member(1, 4, c.section, steel,
                         {.reference = leaning, .start_offset = start_offset, .start_releases = c.start_releases});
        parts.add_member(4, 2, c.section, steel,
                         {.reference = leaning, .end_offset = end_offset, .end_releases = c.end_releases});
      }
      const AssembledFrame f = whole.assemble();
      const auto point = whole.point_on_member(2, along, f);
      if (!divided) {
        // At a fixed end the point is the rigid offset of the node, and its nodes take the force.
        if (!(along == 0 ? c.start_releases : c.end_releases).empty()) continue;
        for (int axis = 0; axis < 3; ++axis) {
          const Vector3d& arm = along == 0 ? start_offset : end_offset;
          const VectorXd of_node = f.motion(along == 0 ? 1 : 2, static_cast<Dof>(axis), arm);
          EXPECT_LT(relative(VectorXd(point.motion[axis]), of_node), 1e-13);
        }
        continue;
      }
      Frame held = parts;
      held.fix(1);
      held.fix(2);
      const AssembledFrame g = parts.assemble(), h = held.assemble();
      for (int axis = 0; axis < 3; ++axis) {
        const Dof dof = static_cast<Dof>(axis);
        const Vector3d force = 1e5 * Vector3d::Unit(axis);
        const VectorXd q = under(whole, f, 1e5 * VectorXd(point.motion[axis]));
        const VectorXd r = under(parts, g, 1e5 * VectorXd(g.motion(4, dof)));
        const VectorXd s = under(held, h, 1e5 * VectorXd(h.motion(4, dof)));
        for (const int node : {1, 2})
          for (const Dof d : dofs_of(3))
            EXPECT_NEAR(f.motion(node, d).dot(q), g.motion(node, d).dot(r), 1e-11 * r.cwiseAbs().maxCoeff());
        for (int other = 0; other < 3; ++other) {
          const Dof d = static_cast<Dof>(other);
          const double moves = point.motion[other].dot(q) + h.motion(4, d).dot(s);
          EXPECT_NEAR(moves, g.motion(4, d).dot(r), 1e-10 * r.cwiseAbs().maxCoeff());
        }
        const Vector12 ends = whole.end_force_rows(2, f) * q + point.fixed_ends * force;
        const Vector12 start = parts.end_forces(2, g, r), end = parts.end_forces(3, g, r);
        EXPECT_LT((ends.head<6>() - start.head<6>()).cwiseAbs().maxCoeff(), 1e-9 * 1e5) << along << " " << axis;
        EXPECT_LT((ends.tail<6>() - end.tail<6>()).cwiseAbs().maxCoeff(), 1e-9 * 1e5) << along << " " << axis;
      }
    }
}

// A uniform load is the sum of point forces, here by three-point Gauss quadrature, exact to degree five.
TEST(PointOnMember, SumsToTheMemberLoad) {
  const Vector3d from(0, 1, 0), to(2, -1, 3), load(3, -5, 7);
  const BeamOptions hinged{.start_offset = {0.1, 0, 0.2}, .end_releases = {Dof::ry, Dof::rz}};
  for (const Beam& beam :
       {Beam(from, to, deep, steel), Beam(from, to, deep, steel, hinged), Beam::truss(from, to, 0.1, steel)}) {
    Vector12 sum = Vector12::Zero();
    for (const auto& [at, weight] : {std::pair(-std::sqrt(0.6), 5.0 / 9), {0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}})
      sum += beam.length() / 2 * weight * beam.fixed_end_forces_at((1 + at) / 2) * load;
    EXPECT_LT(relative(beam.fixed_end_forces(load), sum), 1e-13);
  }
}

TEST(PointOnMember, RefusesAPointBesideIt) {
  Frame frame(2);
  frame.fix(frame.add_node({0, 0, 0}));
  frame.add_node({1, 0, 0});
  frame.set_name(frame.add_member(0, 1, slender, steel), "girder");
  const AssembledFrame f = frame.assemble();
  EXPECT_TRUE(test::mentions(refusal([&] { frame.point_on_member(0, 1.5, f); }), {"1.5", "girder"}));
  EXPECT_TRUE(test::mentions(refusal([&] { frame.point_on_member(1, 0.5, f); }), {"1"}));
}

TEST(EndForceRows, AreTheEndForces) {
  Frame frame(3);
  for (const Vector3d& at : {Vector3d(0, 0, 0), {0.3, 0.1, 3}, {4, 1, 3.5}}) frame.add_node(at);
  frame.fix(0);
  frame.tie_rigidly(1, frame.add_node({0.3, 0.1, 3.4}));
  frame.add_member(0, 1, deep, steel);
  frame.add_member(3, 2, slender, steel, {.start_releases = {Dof::ry}, .axial_force = -2e5});
  const AssembledFrame f = frame.assemble();
  const VectorXd q = VectorXd::LinSpaced(f.size(), -1, 2);
  for (int member = 0; member < 2; ++member)
    EXPECT_LT(relative(frame.end_force_rows(member, f) * q, frame.end_forces(member, f, q)), 1e-13);
}

// m q'' + c q' + k q, and c between two nodes acting on their relative velocity.
TEST(Dashpot, DampsOscillators) {
  Frame frame(2);
  for (const double x : {0.0, 1.0, 2.0}) frame.add_node({x, 0, 0}, std::array{"a", "b", "c"}[static_cast<int>(x)]);
  for (const int node : {0, 1}) {
    frame.fix(node, {Dof::uz, Dof::ry});
    frame.add_mass(node, Dof::ux, 3 + node);
    frame.add_spring(node, Dof::ux, 100);
  }
  frame.fix(2, {Dof::uz, Dof::ry});
  frame.tie(1, 2, {Dof::ux});
  frame.add_dashpot(0, Dof::ux, 7);
  frame.add_dashpot(0, 2, Dof::ux, 2);
  const AssembledFrame f = frame.assemble();
  Eigen::Matrix2d damping;
  damping << 9, -2, -2, 2;
  EXPECT_EQ(MatrixXd(f.damping), damping);
  EXPECT_EQ(MatrixXd(f.stiffness), MatrixXd(100 * MatrixXd::Identity(2, 2)));

  EXPECT_TRUE(test::mentions(refusal([&] { frame.add_dashpot(1, Dof::ux, -1); }), {"b"}));
  EXPECT_TRUE(test::mentions(refusal([&] { frame.add_dashpot(1, 1, Dof::ux, 1); }), {"b"}));
  EXPECT_TRUE(test::mentions(refusal([&] { frame.add_dashpot(1, Dof::rx, 1); }), {"rx", "b"}));
  EXPECT_TRUE(test::mentions(refusal([&] {
                               Frame massless = frame;
                               massless.fix(massless.add_node({3, 0, 0}, "d"), {Dof::uz, Dof::ry});
                               massless.add_spring(3, Dof::ux, 5);
                               massless.add_dashpot(3, Dof::ux, 5);
                               massless.assemble();
                             }),
                             {"add_mass", "ux", "d"}));
}

// A frame with different supports: fixed, pinned, on springs, tied to a fixed node.
Frame bridge(int dimension, BeamMass mass) {
  Frame frame(dimension);
  const double y = dimension == 3 ? 1 : 0;
  for (const Vector3d& at : {Vector3d(0, 0, 0), {5, y, -1}, {9, 0, 0}, {0, 0, 4}, {5, y, 4}, {9, 0, 4}, {9, 0, -0.5}})
    frame.add_node(at);
  const BeamOptions options{.mass = mass};
  for (const auto& [a, b] : {std::pair(0, 3), {1, 4}, {2, 5}, {3, 4}, {4, 5}})
    frame.add_member(a, b, deep, steel, options);
  frame.add_truss(0, 4, 1e-2, steel);
  frame.fix(0);
  frame.fix(6);
  frame.tie(6, 2, {Dof::ux, Dof::uz});
  if (dimension == 3) frame.tie(6, 2, {Dof::uy});
  for (const Dof dof : dofs_of(dimension)) frame.add_spring(1, dof, 3e8);
  frame.add_mass(4, 5e3);
  frame.add_mass(1, 1e3);
  return frame;
}

TEST(SupportMotion, SumsToTheMotionOfARigidBody) {
  for (const int dimension : {2, 3})
    for (const BeamMass mass : {BeamMass::lumped, BeamMass::consistent}) {
      const Frame frame = bridge(dimension, mass);
      const AssembledFrame f = frame.assemble();
      MatrixX3d influence = MatrixX3d::Zero(f.size(), 3), load = influence;
      for (const int node : {0, 1, 6}) {
        const auto motion = frame.support_motion({node}, f);
        influence += motion.influence;
        load += motion.load;
        EXPECT_GT(motion.influence.cwiseAbs().maxCoeff(), 0.01);
      }
      EXPECT_LT(relative(influence, f.influence), 1e-11);
      EXPECT_LT(relative(load, f.load), 1e-11);
      const auto together = frame.support_motion({0, 1, 6}, f);
      EXPECT_LT(relative(together.influence, influence), 1e-11);
      EXPECT_LT(relative(together.load, load), 1e-11);
    }
}

// With the support of the same frame free, its rows of K and M couple it to the other unknowns.
TEST(SupportMotion, IsThePartitionOfTheFreeFrame) {
  for (const int dimension : {2, 3})
    for (const BeamMass mass : {BeamMass::lumped, BeamMass::consistent}) {
      Frame free(dimension);
      for (const Vector3d& at : {Vector3d(0, 0, 0), {0, 0, 3}, {4, 0, 3.3}, {4, 0, 0}}) free.add_node(at);
      for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {3, 2}}) free.add_member(a, b, deep, steel, {.mass = mass});
      Frame held = free;
      held.fix(0);
      held.fix(3);
      const AssembledFrame f = held.assemble(), all = free.assemble();
      const int each = dimension == 2 ? 3 : 6, n = f.size();
      ASSERT_EQ(all.size(), n + 2 * each);
      const MatrixXd k = all.stiffness, m = all.mass;
      for (const int node : {0, 3}) {
        const auto motion = held.support_motion({node}, f);
        for (int axis = 0; axis < 3; ++axis) {
          if (dimension == 2 && axis == 1) {
            EXPECT_TRUE(motion.influence.col(1).isZero(0));
            continue;
          }
          const int column = node * each + (dimension == 2 ? axis / 2 : axis);
          const VectorXd infl = -test::dense::solve(k.block(each, each, n, n), k.col(column).segment(each, n));
          const VectorXd load = m.block(each, each, n, n) * infl + m.block(each, column, n, 1);
          EXPECT_LT(relative(motion.influence.col(axis), infl), 1e-10);
          EXPECT_LT((motion.load.col(axis) - load).cwiseAbs().maxCoeff(), 1e-10 * m.diagonal().maxCoeff());
        }
      }
    }
}

TEST(SupportMotion, OfAPortalByHand) {
  test::Book book("Points between the ends of members, support displacements",
                  "one foot of a portal moves: with columns k1 and k2 a rigid floor follows by k1/(k1 + k2)",
                  "rounding");
  Frame frame(2);
  for (const Vector3d& at : {Vector3d(0, 0, 0), {4, 0, 0}, {0, 0, 3}, {4, 0, 3}}) frame.add_node(at);
  Section stiffer = slender;
  stiffer.inertia_y *= 3;
  frame.add_member(0, 2, slender, {.young = 200e9});
  frame.add_member(1, 3, stiffer, {.young = 200e9});
  for (const int foot : {0, 1}) frame.fix(foot);
  for (const int top : {2, 3}) frame.fix(top, {Dof::ry}), frame.fix(top, {Dof::uz});
  frame.tie_floor(2, {3});
  frame.add_mass(2, 100);
  frame.add_mass(3, 300);
  const AssembledFrame f = frame.assemble();
  ASSERT_EQ(f.size(), 1);
  const auto left = frame.support_motion({0}, f), right = frame.support_motion({1}, f);
  book.near("fraction of the left foot's motion [-]", left.influence(0, 0), 0.25, 1e-14);
  book.near("fraction of the right foot's motion [-]", right.influence(0, 0), 0.75, 1e-14);
  book.near("load of the left foot's motion [kg]", left.load(0, 0), 100, 1e-11);
  EXPECT_TRUE(left.influence.col(2).isZero(0));
}

TEST(SupportMotion, ReachesAMassThroughItsSpringsInProportion) {
  test::Book book("Points between the ends of members, support displacements",
                  "two springs on one mass: in proportion to their stiffness", "rounding");
  Frame frame(2);
  frame.add_node({0, 0, 0}, "pier");
  frame.add_node({1, 0, 0}, "deck");
  frame.add_spring(0, Dof::ux, 30);
  frame.add_spring(1, Dof::ux, 10);
  frame.tie(1, 0, {Dof::ux});
  for (const int node : {0, 1}) frame.fix(node, {Dof::ry}), frame.fix(node, {Dof::uz});
  frame.add_mass(1, 8);
  const AssembledFrame f = frame.assemble();
  book.near("fraction of the first spring's motion [-]", frame.support_motion({0}, f).influence(0, 0), 0.75, 1e-15);
  book.near("the same, listed twice [-]", frame.support_motion({0, 0}, f).influence(0, 0), 0.75,
            1e-15);  // listed twice
  book.near("load of the second spring's motion [kg]", frame.support_motion({1}, f).load(0, 0), 2, 1e-14);

  frame.add_node({2, 0, 0}, "tip");
  frame.add_member(1, 2, slender, steel);
  EXPECT_TRUE(test::mentions(refusal([&] { frame.support_motion({2}, frame.assemble()); }), {"tip"}));
}

TEST(GridFrame, CarriesItsInertiaToTheGround) {
  test::Book book("Points between the ends of members, support displacements",
                  "statics: under a push of 1 g the columns' shears at the ground are the mass above times g",
                  "rounding");
  for (const int bays_y : {0, 2})
    for (const bool rigid : {false, true}) {
      GridFrame grid;
      grid.storeys = 3;
      grid.bays_x = 2;
      grid.bays_y = bays_y;
      grid.storey_height = {3.5, 3.0, 2.8};
      grid.bay_width_x = {5, 7};
      if (bays_y > 0) grid.bay_width_y = {4, 6};
      grid.column = deep;
      grid.beam = slender;
      grid.material = steel;
      grid.floor_mass = {4e4, 5e4, 3e4};
      grid.rigid_floors = rigid;
      Frame frame = make_frame(grid);
      const AssembledFrame f = frame.assemble();
      const double g = 9.80665;
      const std::vector<Dof> directions = bays_y == 0 ? std::vector{Dof::ux} : std::vector{Dof::ux, Dof::uy};
      for (const Dof dof : directions) {
        const int axis = static_cast<int>(dof);
        const VectorXd q = under(frame, f, f.load.col(axis) * g);
        double shear = 0;
        for (int member = 0; member < frame.members(); ++member) {
          const int foot = frame.ends(member)[0];
          if (frame.position(foot).z() != 0) continue;
          shear -= (frame.beam(member).axes().transpose() * frame.end_forces(member, f, q).head<3>())[axis];
        }
        // The lower halves of the first-storey columns rest on the ground and do not count.
        const double columns = 3.0 * (bays_y + 1) * (9.3 - 1.75),
                     beams = 3 * (12.0 * (bays_y + 1) + (bays_y > 0 ? 30 : 0));
        const double mass = 12e4 + steel.density * (deep.area * columns + slender.area * beams);
        book.near("shear at the ground [N]", shear, mass * g, 1e-9 * mass * g);
      }
    }
}

// Rigid-body motions cause no force in any element, and a uniform motion acts on the whole mass.
TEST(Frame, GivesNoForceToTheMotionOfARigidBody) {
  for (const int dimension : {2, 3}) {
    Frame frame(dimension);
    const double y = dimension == 3 ? 0.7 : 0;
    for (const Vector3d& at : {Vector3d(0, 0, 0), {3, y, 1}, {4, -y, 3}, {1, 0, 4}, {2, y, 5}}) frame.add_node(at);
    frame.add_member(0, 1, deep, steel, {.start_offset = {0.1, 0, 0.2}, .end_releases = {Dof::ry}});
    frame.add_member(1, 2, slender, steel, {.mass = BeamMass::consistent});
    frame.add_member(2, 3, deep, steel);
    frame.add_truss(0, 2, 1e-2, steel);
    frame.tie_rigidly(3, 4);
    const AssembledFrame f = frame.assemble();
    for (const Dof turn : dofs_of(dimension)) {
      VectorXd q(f.size());
      for (int j = 0; j < f.size(); ++j) {
        const auto [node, dof] = f.unknowns[j];
        const bool rotates = turn >= Dof::rx;
        const Vector3d axis = Vector3d::Unit(static_cast<int>(turn) % 3);
        const Vector3d moves = rotates ? Vector3d(axis.cross(f.positions[node])) : axis;
        q[j] = dof < Dof::rx ? moves[static_cast<int>(dof)] : (rotates ? axis[static_cast<int>(dof) - 3] : 0);
      }
      EXPECT_LT((f.stiffness * q).cwiseAbs().maxCoeff(), 1e-13 * MatrixXd(f.stiffness).cwiseAbs().maxCoeff());
      for (int member = 0; member < frame.members(); ++member)
        EXPECT_LT(frame.end_forces(member, f, q).norm(), 1e-12 * MatrixXd(f.stiffness).cwiseAbs().maxCoeff());
    }
  }
}

TEST(Frame, NamesNodesAndMembersInItsTexts) {
  Frame frame(2);
  frame.add_node({0, 0, 0}, "base");
  frame.add_node({0, 0, 3}, "roof");
  const int column = frame.add_member(0, 1, slender, steel);
  EXPECT_EQ(frame.member_name(column), "0 (nodes base and roof)");
  frame.set_name(column, "c1");
  EXPECT_EQ(frame.member_name(column), "c1");
  EXPECT_EQ(frame.node_name(1), "roof");
  const auto with = [&](auto&& change) {
    return refusal([&] {
      Frame copy = frame;
      change(copy);
      copy.assemble();
    });
  };
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_node({0, 1, 0}, "side"); }), {"y", "side"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_node({5, 0, 0}, "lost"); }), {"lost"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_member(0, 0, slender, steel); }), {"1"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_truss(0, 1, 0, steel); }), {"1"}));
  EXPECT_TRUE(
      test::mentions(with([](Frame& f) { f.add_truss(0, 1, 1, {.young = 1, .density = -1}); }), {"1", "density"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_load(1, Dof::ux, NAN); }), {"ux", "roof"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_load(1, Dof::uy, 1); }), {"uy", "roof"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_member_load(0, {0, 1, 0}); }), {"c1"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_member_load(0, {0, 0, NAN}); }), {"c1"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.add_member_load(1, {0, 0, 1}); }), {"1"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.set_axial_force(0, NAN); }), {"c1"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.tie(0, 1, {Dof::ux}), f.fix(1); }), {"ux", "roof"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) {
                               f.add_truss(1, f.add_node({3, 0, 3}, "eye"), 1e-3, steel);
                               f.add_load(2, Dof::ry, 1);
                             }),
                             {"ry", "eye"}));
  EXPECT_TRUE(test::mentions(refusal([&] { frame.assemble().motion(1, Dof::uy); }), {"uy", "roof"}));
  EXPECT_TRUE(test::mentions(with([](Frame& f) {
                               f.add_member(0, 1, slender, steel,
                                            {.start_releases = {Dof::ry}, .end_releases = {Dof::ry}});
                               f.set_name(1, "strut");
                               f.set_axial_force(1, -12.1 * steel.young * slender.inertia_y / 9);
                             }),
                             {"strut"}));

  const Frame grid = make_frame({.storeys = 1,
                                 .bays_x = 1,
                                 .bays_y = 1,
                                 .storey_height = {3},
                                 .bay_width_x = {4},
                                 .bay_width_y = {5},
                                 .column = slender,
                                 .beam = slender,
                                 .material = steel,
                                 .floor_mass = {1},
                                 .rigid_floors = true});
  EXPECT_EQ(grid.node_name(5), "1.1.0");
  EXPECT_EQ(grid.node_name(8), "floor 1");
  EXPECT_EQ(grid.member_name(0), "column 1.0.0");
  EXPECT_EQ(grid.member_name(1), "beam x 1.0.0");
  EXPECT_EQ(grid.member_name(2), "beam y 1.0.0");
}

}  // namespace frame_points_test
}  // namespace pounding
