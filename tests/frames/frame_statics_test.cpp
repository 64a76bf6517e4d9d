// Frames at rest against hand solutions: trusses, loads on nodes and members, weight, P-Delta, mechanisms.

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/frames/frame.hpp>
#include <pounding/frames/static_solver.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace frame_statics_test {

using test::refusal;

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Section slender{.area = 0.12, .inertia_y = 1.6e-3, .inertia_z = 0.9e-3, .torsion = 2e-3};
const Section deep{
    .area = 0.12, .inertia_y = 1.6e-3, .inertia_z = 0.9e-3, .torsion = 2e-3, .shear_area_y = 0.07, .shear_area_z = 0.1};
const Material steel{.young = 200e9, .shear = 80e9, .density = 7850};
const Material light{.young = 200e9, .shear = 80e9};
const double g = 9.80665;

double displacement(const AssembledFrame& f, const VectorXd& q, int node, Dof dof) {
  return f.motion(node, dof).dot(q);
}

// Forces on the ends of a member, including its own load.
Vector12 true_end_forces(const Frame& frame, int member, const AssembledFrame& f, const VectorXd& q,
                         bool gravity = false) {
  return frame.end_force_rows(member, f) * q + frame.fixed_end_forces(member, gravity);
}

// P at the foot of the post; the deflection is the sum of N^2 L/(EA)/P.
TEST(Truss, CarriesTheKingPostBridge) {
  test::Book book("Frames at rest",
                  "king post, P at the foot of the post: joints by hand, deflection by the unit-load theorem",
                  "rounding");
  const double l = 4, h = 3, p = 5e4, area = 2e-3, d = std::hypot(l, h);
  for (const int dimension : {2, 3}) {
    Frame frame(dimension);
    for (const Vector3d& at : {Vector3d(0, 0, 0), {l, 0, 0}, {2 * l, 0, 0}, {l, 0, h}}) frame.add_node(at);
    const std::vector<std::pair<int, int>> bars{{0, 1}, {1, 2}, {0, 3}, {3, 2}, {1, 3}};
    for (const auto& [a, b] : bars) frame.add_truss(a, b, area, steel);
    frame.fix(0, {Dof::ux, Dof::uz});
    frame.fix(2, {Dof::uz});
    if (dimension == 3)
      for (int node = 0; node < 4; ++node) frame.fix(node, {Dof::uy});
    frame.add_load(1, Dof::uz, -p);
    const AssembledFrame f = frame.assemble();
    ASSERT_EQ(f.size(), 5);  // no rotations
    const VectorXd q = frame.rest(f);
    const double chord = p / 2 * l / h, diagonal = -p / 2 * d / h;
    const std::vector<double> expected{chord, chord, diagonal, diagonal, p}, lengths{l, l, d, d, h};
    double work = 0;
    for (int i = 0; i < 5; ++i) {
      const Vector12 forces = frame.end_forces(i, f, q);
      book.near("axial force of each bar [N]", forces[6], expected[i], 1e-11 * p);
      book.near("axial force at the other end [N]", forces[0], -expected[i], 1e-11 * p);
      book.near("forces other than axial [N]", forces.norm(), std::hypot(forces[0], forces[6]), 1e-11 * p);
      work += expected[i] * expected[i] * lengths[i] / (steel.young * area);
    }
    book.near("deflection under P [m]", displacement(f, q, 1, Dof::uz), -work / p, 1e-11 * work / p);
  }
}

TEST(Truss, CarriesASpaceTripod) {
  test::Book book("Frames at rest", "three bars to one point in space: equilibrium of the point", "rounding");
  Frame frame(3);
  const std::vector<Vector3d> feet{{2, 0, 0}, {-1, 1.5, 0}, {-1, -2, 0.5}};
  const Vector3d top(0.2, 0.1, 3), force(3e4, -2e4, -8e4);
  for (const Vector3d& foot : feet) frame.fix(frame.add_node(foot));
  const int loaded = frame.add_node(top);
  Eigen::Matrix3d directions;
  for (int i = 0; i < 3; ++i) {
    frame.add_truss(i, loaded, 1e-3 * (1 + i), steel);
    directions.col(i) = (top - feet[i]).normalized();
  }
  for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz}) frame.add_load(loaded, dof, force[static_cast<int>(dof)]);
  const AssembledFrame f = frame.assemble();
  ASSERT_EQ(f.size(), 3);
  const Vector3d n = directions.inverse() * force, u = frame.rest(f);
  for (int i = 0; i < 3; ++i) {
    book.near("axial force [N]", frame.end_forces(i, f, u)[6], n[i], 1e-10 * force.norm());
    const double stretch = n[i] * (top - feet[i]).norm() / (steel.young * 1e-3 * (1 + i));
    book.near("stretch [m]", directions.col(i).dot(u), stretch, 1e-10 * u.norm());
  }
}

// Patch test: displacements that are linear in the coordinates give every bar of an irregular mesh the same strain, and
// no force at interior nodes. Rigid-body motions give no force anywhere.
TEST(Truss, PassesThePatchTest) {
  test::Book book("Frames at rest",
                  "patch test: linear displacements give every bar the same strain, a rigid motion "
                  "none",
                  "rounding");
  for (const int dimension : {2, 3}) {
    Frame frame(dimension);
    const std::vector<double> stations{0, 0.7, 1.1, 2.6, 3};
    const Vector3d along = Vector3d(1, dimension == 3 ? 0.4 : 0, -0.6).normalized();
    for (const double s : stations) frame.add_node(s * along);
    for (int i = 0; i < 4; ++i) frame.add_truss(i, i + 1, 1e-3, light);
    const AssembledFrame f = frame.assemble();
    VectorXd stretched(f.size()), turned(f.size());
    for (int j = 0; j < f.size(); ++j) {
      const auto [node, dof] = f.unknowns[j];
      const Vector3d x = f.positions[node], across = Vector3d(0, 1, 0).cross(x);
      stretched[j] = 1e-3 * x[static_cast<int>(dof)] + 0.1;
      turned[j] = 0.3 + across[static_cast<int>(dof)];
    }
    for (int i = 0; i < 4; ++i) {
      book.near("axial force under a uniform strain [N]", frame.end_forces(i, f, stretched)[6],
                steel.young * 1e-3 * 1e-3, 1e-9 * steel.young * 1e-6);
      book.near("axial force under a rotation [N]", frame.end_forces(i, f, turned)[6], 0, 1e-9 * steel.young * 1e-6);
    }
    const VectorXd forces = f.stiffness * stretched;
    const int each = dimension;  // translations of a node
    EXPECT_LT(forces.segment(each, f.size() - 2 * each).norm(), 1e-9 * forces.norm());
    EXPECT_LT((f.stiffness * turned).norm(), 1e-13 * MatrixXd(f.stiffness).norm());
  }
}

TEST(Truss, HangsHalfItsMassAtEachEndAndTakesAPullAcrossAsAString) {
  test::Book book("Frames at rest", "a truss member: half of its mass at each end, N/L in the transverse direction",
                  "rounding");
  Frame frame(2);
  frame.add_node({0, 0, 0});
  frame.add_node({2.5, 0, 0});
  frame.add_truss(0, 1, 1e-2, steel);
  frame.fix(0);
  AssembledFrame f = frame.assemble();
  book.near("mass at an end [kg]", f.mass.coeff(1, 1), steel.density * 1e-2 * 2.5 / 2, 1e-12);
  EXPECT_EQ(f.stiffness.coeff(1, 1), 0);
  frame.set_axial_force(0, 7e4);
  f = frame.assemble();
  book.near("stiffness across [N/m]", f.stiffness.coeff(1, 1), 7e4 / 2.5, 1e-9);
}

// The shear compliance enters both sides of the roller condition.
TEST(MemberLoad, SolvesTheProppedBeam) {
  test::Book book("Frames at rest",
                  "Roark: fixed at one end, on a roller at the other, uniform load w: roller 3wL/8, fixing moment "
                  "wL^2/8, rotation wL^3/(48 EI); with shear by the roller's condition",
                  "rounding");
  const double l = 6, w = 2e4;
  for (const Section& s : {slender, deep})
    for (const int members : {1, 3}) {
      // Along x with the load in z, along x with the load in y, upward with the load in x.
      for (const int turn : {0, 1, 2}) {
        const Vector3d along = turn == 2 ? Vector3d(0, 0, 1) : Vector3d(1, 0, 0);
        const int axis = std::array{2, 1, 0}[turn];
        const double inertia = turn == 1 ? s.inertia_z : s.inertia_y;
        const double shear_area = turn == 1 ? s.shear_area_y : s.shear_area_z;
        const double ei = steel.young * inertia, ga = steel.shear * shear_area;
        Frame frame(turn == 1 ? 3 : 2);
        for (int i = 0; i <= members; ++i) frame.add_node(along * l * i / members);
        for (int i = 0; i < members; ++i) {
          frame.add_member(i, i + 1, s, steel);
          frame.add_member_load(i, -w * Vector3d::Unit(axis));
        }
        frame.fix(0);
        frame.fix(members, {static_cast<Dof>(axis)});
        const AssembledFrame f = frame.assemble();
        const VectorXd q = frame.rest(f);
        const double roller = (w * std::pow(l, 4) / (8 * ei) + w * l * l / (2 * ga)) / (l * l * l / (3 * ei) + l / ga);
        const Vector12 first = true_end_forces(frame, 0, f, q), last = true_end_forces(frame, members - 1, f, q);
        const int moment = turn == 1 ? 5 : 4;
        const Vector3d end(last[6], last[7], last[8]), start(first[0], first[1], first[2]);
        const Eigen::Matrix3d axes = frame.beam(0).axes();
        book.near("propped beam: roller [N]", (axes.transpose() * end)[axis], roller, 1e-10 * w * l);
        book.near("propped beam: force at the fixed end [N]", (axes.transpose() * start)[axis], w * l - roller,
                  1e-10 * w * l);
        book.near("propped beam: fixing moment [N m]", std::abs(first[moment]), w * l * l / 2 - roller * l,
                  1e-10 * w * l * l);
        book.near("propped beam: moment at the roller [N m]", last[6 + moment], 0, 1e-10 * w * l * l);
        const Dof rotation = turn == 1 ? Dof::rz : Dof::ry;
        const double slope = w * l * l * l / (6 * ei) - roller * l * l / (2 * ei);
        book.near("propped beam: rotation at the roller [rad]", std::abs(displacement(f, q, members, rotation)),
                  std::abs(slope), 1e-10 * w * l * l * l / ei);
        if (std::isinf(ga)) {
          EXPECT_NEAR(roller, 3 * w * l / 8, 1e-12 * w * l);
          EXPECT_NEAR(std::abs(slope), w * l * l * l / (48 * ei), 1e-12 * w * l * l * l / ei);
        }
      }
    }
}

// A hinge at the roller instead of a free rotation: the fixed-end forces are released at the hinge.
TEST(MemberLoad, GoesAroundAReleasedEnd) {
  test::Book book("Frames at rest", "Roark: the propped beam with a hinge instead of the roller: 3wL/8, 5wL/8, wL^2/8",
                  "rounding");
  const double l = 6, w = 2e4;
  Frame frame(2);
  frame.add_node({0, 0, 0});
  frame.add_node({l, 0, 0});
  frame.add_member(0, 1, slender, steel, {.end_releases = {Dof::ry}});
  frame.add_member_load(0, {0, 0, -w});
  frame.fix(0);
  frame.fix(1);
  const Vector12 held = frame.fixed_end_forces(0);
  book.near("hinge: force [N]", held[8], 3 * w * l / 8, 1e-12 * w * l);
  book.near("hinge: force at the fixed end [N]", held[2], 5 * w * l / 8, 1e-12 * w * l);
  book.near("hinge: fixing moment [N m]", held[4], -w * l * l / 8, 1e-12 * w * l * l);
  EXPECT_EQ(held[10], 0);
  const AssembledFrame f = frame.assemble();
  EXPECT_EQ(frame.rest(f).size(), 0);
}

// Subdivided or not, in both planes.
TEST(MemberLoad, BendsAndShearsTheDeepCantilever) {
  test::Book book("Frames at rest",
                  "Timoshenko's deep cantilever: w L^4/(8 EI) + w L^2/(2 G As), p L^2/(2 EA) along it", "rounding");
  const double l = 0.8, w = 3e5;
  for (const int members : {1, 4}) {
    Frame frame(3);
    for (int i = 0; i <= members; ++i) frame.add_node({0.1, 0.2, l * i / members});
    for (int i = 0; i < members; ++i) {
      frame.add_member(i, i + 1, deep, steel);
      frame.add_member_load(i, {w, 2 * w, 0});
      frame.add_member_load(i, {0, 0, 3 * w});
    }
    frame.fix(0);
    const AssembledFrame f = frame.assemble();
    const VectorXd q = frame.rest(f);
    const auto tip = [&](double inertia, double shear_area) {
      return w * std::pow(l, 4) / (8 * steel.young * inertia) + w * l * l / (2 * steel.shear * shear_area);
    };
    // Local z of a column is global -x, local y global y.
    book.near("tip deflection along x over closed form [-]",
              displacement(f, q, members, Dof::ux) / tip(deep.inertia_y, deep.shear_area_z), 1, 1e-11);
    book.near("tip deflection along y over closed form [-]",
              displacement(f, q, members, Dof::uy) / (2 * tip(deep.inertia_z, deep.shear_area_y)), 1, 1e-11);
    book.near("stretch over closed form [-]",
              displacement(f, q, members, Dof::uz) / (3 * w * l * l / (2 * steel.young * deep.area)), 1, 1e-11);
  }
}

TEST(MemberLoad, SolvesThePortalOfKleinlogel) {
  test::Book book("Frames at rest",
                  "Kleinlogel, Rahmenformeln, frame 48 (fixed portal, members of constant length), w on the beam: k "
                  "= Ib h/(Ic l), M_foot = w l^2/(12 (k + 2)), M_corner = -2 M_foot, thrust 3 M_foot/h",
                  "rounding");
  const double h = 4, l = 7, w = 2.5e4;
  Section girder = slender;
  girder.inertia_y = 4.1e-3;
  Frame frame(2);
  for (const Vector3d& at : {Vector3d(0, 0, 0), {0, 0, h}, {l, 0, h}, {l, 0, 0}}) frame.add_node(at);
  frame.fix(0);
  frame.fix(3);
  for (const int node : {1, 2}) frame.fix(node, {Dof::uz});
  frame.tie_floor(1, {2});
  frame.add_member(0, 1, slender, steel);
  frame.add_member(1, 2, girder, steel);
  frame.add_member(3, 2, slender, steel);
  frame.add_member_load(1, {0, 0, -w});
  const AssembledFrame f = frame.assemble();
  const VectorXd q = frame.rest(f);
  const double k = girder.inertia_y * h / (slender.inertia_y * l), foot = w * l * l / (12 * (k + 2));
  const Vector12 left = true_end_forces(frame, 0, f, q), beam = true_end_forces(frame, 1, f, q);
  book.near("portal: moment at the foot [N m]", std::abs(left[4]), foot, 1e-11 * w * l * l);
  book.near("portal: moment at the corner [N m]", std::abs(left[10]), 2 * foot, 1e-11 * w * l * l);
  EXPECT_GT(left[4] * left[10], 0);  // the moments at both ends have the same sense
  book.near("portal: thrust [N]", std::abs(left[2]), 3 * foot / h, 1e-11 * w * l);
  book.near("portal: left end moment of the beam [N m]", beam[4], -2 * foot, 1e-11 * w * l * l);
  book.near("portal: right end moment of the beam [N m]", beam[10], 2 * foot, 1e-11 * w * l * l);
  book.near("portal: end force of the beam [N]", beam[2], w * l / 2, 1e-11 * w * l);
  book.near("portal: sway [m]", displacement(f, q, 1, Dof::ux), 0, 1e-16);
}

TEST(Gravity, LoadsWithTheWeightOfAllMasses) {
  test::Book book("Frames at rest",
                  "a hanging bar: rho g L^2/(2E) + M g L/(EA), lumped or consistent; a heavy cantilever: m g "
                  "L^4/(8 EI)",
                  "rounding");
  const double l = 5, extra = 300;
  for (const int dimension : {2, 3})
    for (const BeamMass kind : {BeamMass::lumped, BeamMass::consistent}) {
      Frame hanging(dimension), cantilever(dimension);
      for (int i = 0; i <= 3; ++i) {
        hanging.add_node({0, 0, -l * i / 3});
        cantilever.add_node({l * i / 3, 0, 0});
      }
      for (int i = 0; i < 3; ++i)
        for (Frame* frame : {&hanging, &cantilever}) frame->add_member(i, i + 1, slender, steel, {.mass = kind});
      hanging.fix(0);
      cantilever.fix(0);
      hanging.add_mass(3, extra);
      const AssembledFrame f = hanging.assemble(true), c = cantilever.assemble(true);
      const double stretch =
          steel.density * g * l * l / (2 * steel.young) + extra * g * l / (steel.young * slender.area);
      book.near("stretch by weight over closed form [-]", displacement(f, hanging.rest(f), 3, Dof::uz) / -stretch, 1,
                1e-11);
      EXPECT_TRUE(hanging.assemble().load_at_rest.isZero(0));

      const double weight = steel.density * slender.area * g, ei = steel.young * slender.inertia_y;
      const VectorXd q = cantilever.rest(c);
      const Vector12 foot = true_end_forces(cantilever, 0, c, q, true);
      if (kind == BeamMass::consistent) {
        book.near("heavy cantilever: tip over closed form [-]",
                  displacement(c, q, 3, Dof::uz) / (-weight * std::pow(l, 4) / (8 * ei)), 1, 1e-11);
        book.near("heavy cantilever: force at the foot [N]", foot[2], weight * l, 1e-10 * weight * l);
        book.near("heavy cantilever: moment at the foot [N m]", foot[4], -weight * l * l / 2, 1e-10 * weight * l * l);
      } else {
        book.near("heavy cantilever, lumped: force at the foot [N]", foot[2], weight * l * 5 / 6,
                  1e-10 * weight * l);  // the lower half of the member at the foot is carried by the support
      }
    }
}

// The tip of a column with axial load P, pushed by H.
TEST(PDelta, AmplifiesTheSwayOfAColumn) {
  test::Book book("Frames at rest",
                  "Timoshenko & Gere, Theory of Elastic Stability, section 1.11: tip H L^3/(3 EI) 3 (tan u - u)/u^3 "
                  "with u^2 = P L^2/(EI)",
                  "16 members with cubic shape functions: halving them divides the error by 16");
  const double l = 4, h = 1e3, ei = steel.young * slender.inertia_y, p = 0.6 * M_PI * M_PI * ei / (4 * l * l);
  const double u = std::sqrt(p * l * l / ei);
  const double exact = h * l * l * l / (3 * ei) * 3 * (std::tan(u) - u) / (u * u * u);
  const auto error = [&](int members, int dimension) {
    Frame frame(dimension);
    for (int i = 0; i <= members; ++i) frame.add_node({0, 0, l * i / members});
    Section s = slender;
    s.inertia_z = 2 * s.inertia_y;  // sway is along x, not y
    for (int i = 0; i < members; ++i) frame.add_member(i, i + 1, s, light);
    frame.fix(0);
    frame.add_load(members, Dof::ux, h);
    frame.add_load(members, Dof::uz, -p);
    frame.add_p_delta(false);
    EXPECT_NEAR(frame.beam(0).axial_force(), -p, 1e-9 * p);
    const AssembledFrame f = frame.assemble();
    return displacement(f, frame.rest(f), members, Dof::ux) / exact - 1;
  };
  EXPECT_GT(u / std::sqrt(3.0), 0.7);  // P-Delta more than doubles the sway
  book.near("P-Delta: sway over closed form, less one [-]", error(16, 2), 0, 1e-6);
  book.near("P-Delta: sway in space, less that in a plane [-]", error(16, 3), error(16, 2), 1e-9);
  book.near("P-Delta: error with 2 members over that with 4 [-]", error(2, 2) / error(4, 2), 16, 1);
}

TEST(PDelta, LetsAHingedColumnLeanOnTheRest) {
  test::Book book("Frames at rest", "a hinged bar that leans on a spring: (k - P/h) u = H", "rounding");
  const double h = 3, k = 4e6, p = 3e6, push = 1e4;
  Frame frame(2);
  frame.add_node({0, 0, 0});
  frame.add_node({0, 0, h});
  frame.add_truss(0, 1, 0.1, light);
  frame.fix(0, {Dof::ux, Dof::uz});
  frame.add_spring(1, Dof::ux, k);
  frame.add_load(1, Dof::uz, -p);
  frame.add_load(1, Dof::ux, push);
  frame.add_p_delta(false);
  const AssembledFrame f = frame.assemble();
  book.near("leaning column: displacement [m]", displacement(f, frame.rest(f), 1, Dof::ux), push / (k - p / h),
            1e-9 * push / k);
}

// The load at which add_p_delta reports that the stiffness is not positive definite.
TEST(PDelta, RefusesAColumnBeyondEulersLoad) {
  test::Book book("Frames at rest", "Euler: pi^2 EI/(4 L^2)", "eight members");
  const double l = 4, ei = steel.young * slender.inertia_y, euler = M_PI * M_PI * ei / (4 * l * l);
  const auto column = [&](double load) {
    Frame frame(2);
    for (int i = 0; i <= 8; ++i) frame.add_node({0, 0, l * i / 8}, i == 8 ? "head" : "");
    for (int i = 0; i < 8; ++i) frame.set_name(frame.add_member(i, i + 1, slender, light), "part " + std::to_string(i));
    frame.fix(0);
    frame.add_load(8, Dof::uz, -load);
    frame.add_p_delta(false);
  };
  double stands = 0, falls = 2 * euler;
  for (int i = 0; i < 40; ++i) {
    const double middle = (stands + falls) / 2;
    (refusal([&] { column(middle); }) == "taken" ? stands : falls) = middle;
  }
  book.near("load at which P-Delta finds a column unstable, over Euler's [-]", stands / euler, 1, 1e-3);
  // The message names the head and one of the parts under the same compression.
  const std::string text = refusal([&] { column(1.1 * euler); });
  EXPECT_TRUE(test::mentions(text, {"head", "ux", "part"}));
}

// The axial forces of two different columns under a stiff beam depend on the load sharing, which depends on them.
TEST(PDelta, SettlesWhereTheAxialForcesAreThoseAtRest) {
  Frame frame(2);
  for (const Vector3d& at : {Vector3d(0, 0, 0), {6, 0, 0}, {0, 0, 8}, {6, 0, 8}}) frame.add_node(at);
  frame.fix(0);
  frame.fix(1);
  frame.add_member(0, 2, slender, light);
  frame.add_member(1, 3, {.area = 0.02, .inertia_y = 3e-4}, light);
  frame.add_member(2, 3, slender, light);
  frame.add_member_load(2, {1e4, 0, -4e5});
  const AssembledFrame linear = frame.assemble();
  const Vector12 before = true_end_forces(frame, 1, linear, frame.rest(linear));
  frame.add_p_delta(false);
  const AssembledFrame f = frame.assemble();
  const VectorXd q = frame.rest(f);
  for (int member = 0; member < 3; ++member) {
    const Vector12 ends = true_end_forces(frame, member, f, q);
    EXPECT_NEAR((ends[6] - ends[0]) / 2, frame.beam(member).axial_force(), 1e-8 * 1e6) << member;
  }
  EXPECT_GT(std::abs(before[6] - frame.beam(1).axial_force()), 1e3);
}

TEST(PDelta, LeavesTheFrameAsItWasWhenItRefuses) {
  Frame frame(2);
  frame.add_node({0, 0, 0});
  frame.add_node({0, 0, 4});
  frame.fix(0);
  frame.add_member(0, 1, slender, light, {.axial_force = 5});
  frame.add_load(1, Dof::uz, -1e9);
  EXPECT_NE(refusal([&] { frame.add_p_delta(false); }), "taken");
  EXPECT_EQ(frame.beam(0).axial_force(), 5);
}

TEST(Rest, NamesWhatNothingHolds) {
  const auto with = [](auto&& change) {
    return refusal([&] {
      Frame frame(2);
      frame.add_node({0, 0, 0}, "left foot");
      frame.add_node({0, 0, 3}, "left");
      frame.add_node({4, 0, 3.5}, "right");
      frame.add_node({4, 0, 0}, "right foot");
      for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {3, 2}}) frame.add_member(a, b, slender, steel);
      change(frame);
      frame.add_load(1, Dof::uz, -1);
      frame.rest(frame.assemble());
    });
  };
  EXPECT_EQ(with([](Frame& f) { f.fix(0), f.fix(3); }), "taken");
  // Rigid translation along x: the first of equal displacements is reported.
  EXPECT_TRUE(test::mentions(with([](Frame& f) { f.fix(0, {Dof::uz}), f.fix(3, {Dof::uz}); }), {"left foot", "ux"}));
  EXPECT_TRUE(
      test::mentions(with([](Frame& f) {
                       f.fix(0, {Dof::ux, Dof::uz});  // rotation about the left foot: the highest point moves furthest
                     }),
                     {"right", "uz"}));
  // One hinge too many: a bar hangs off the frame.
  EXPECT_TRUE(test::mentions(with([](Frame& f) {
                               f.fix(0), f.fix(3);
                               f.add_truss(2, f.add_node({6, 0, 3.5}, "flap"), 1e-3, steel);
                             }),
                             {"flap", "uz"}));
  // A shaft in its bearings: only the rotation is free.
  EXPECT_TRUE(test::mentions(refusal([] {
                               Frame frame(3);
                               frame.add_node({0, 0, 0}, "bearing");
                               frame.add_node({2, 0, 0});
                               frame.add_member(0, 1, slender, steel);
                               for (const int node : {0, 1}) frame.fix(node, {Dof::ux, Dof::uy, Dof::uz});
                               frame.rest(frame.assemble());
                             }),
                             {"bearing", "rx"}));
  // Pinned feet and corners: a sway mechanism.
  EXPECT_TRUE(test::mentions(refusal([] {
                               Frame frame(2);
                               for (const Vector3d& at : {Vector3d(0, 0, 0), {0, 0, 3}, {4, 0, 3}, {4, 0, 0}})
                                 frame.add_node(at);
                               for (const int foot : {0, 3}) frame.fix(foot, {Dof::ux, Dof::uz});
                               for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {3, 2}})
                                 frame.add_truss(a, b, 1e-3, steel);
                               frame.rest(frame.assemble());
                             }),
                             {"1", "ux"}));
}

// A weak member next to a stiff spring is not a mechanism.
TEST(Rest, HoldsWhatIsOnlyWeak) {
  test::Book book("Frames at rest", "cantilever of 300 members: L^3/(3 EI)",
                  "round-off, amplified by 300 members next to a spring of 1e15 N/m");
  const int n = 300;
  const double l = 30, ei = steel.young * slender.inertia_y;
  Frame frame(2);
  for (int i = 0; i <= n; ++i) frame.add_node({l * i / n, 0, 0});
  for (int i = 0; i < n; ++i) frame.add_member(i, i + 1, slender, light);
  frame.fix(0);
  frame.add_spring(n / 2, Dof::ux, 1e15);
  frame.add_load(n, Dof::uz, 1);
  const AssembledFrame f = frame.assemble();
  book.near("tip over closed form, weak next to stiff [-]",
            displacement(f, frame.rest(f), n, Dof::uz) / (l * l * l / (3 * ei)), 1, 1e-6);
}

TEST(Frame, RefusesAMotionThatItsMassesDoNotDetermine) {
  const auto with = [](auto&& change) {
    return refusal([&] {
      Frame frame(2);
      for (const double x : {0.0, 1.0, 2.0}) frame.add_node({x, 0, 0});
      frame.add_member(0, 1, slender, light);
      frame.fix(0);
      frame.add_mass(1, 10);
      change(frame);
      frame.require_motion(frame.assemble());
    });
  };
  EXPECT_EQ(with([](Frame& f) { f.add_member(1, 2, slender, light); }), "taken");
  EXPECT_EQ(with([](Frame& f) { f.add_truss(1, 2, 1e-3, light), f.fix(2, {Dof::uz}); }), "taken");
  EXPECT_EQ(with([](Frame& f) { f.add_truss(1, 2, 1e-3, light), f.tie(1, 2, {Dof::uz}); }), "taken");
  // Slightly rotated, so that the transverse direction is not an unknown.
  EXPECT_TRUE(test::mentions(with([](Frame& f) {
                               f.tie_rigidly(1, 2);
                               f.add_truss(1, f.add_node({2, 0, 1}, "end"), 1e-3, light);
                             }),
                             {"ux", "end"}));
}

}  // namespace frame_statics_test
}  // namespace pounding
