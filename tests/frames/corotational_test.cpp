// Corotational members and frames: derivatives, rigid motions and the limit of small displacements; then published
// large deflections and limit points.

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pounding/frames/corotational.hpp>
#include "support/book.hpp"
#include "support/dense.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace corotational_test {

using test::refusal;

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;

const Section deep{
    .area = 0.9, .inertia_y = 0.24, .inertia_z = 0.02, .torsion = 0.05, .shear_area_y = 0.7, .shear_area_z = 0.75};
const Material unit_steel{.young = 1.0, .shear = 0.4, .density = 0};
const BeamOptions with_offsets{
    .reference = Vector3d(0.3, 1, 0.2), .start_offset = {0.2, -0.1, 0.3}, .end_offset = {-0.1, 0.25, 0.1}};

// A linear and a corotational model of one frame.
struct Model {
  Frame frame;
  std::vector<CorotationalMember> members{};

  void add_member(int start, int end, const Section& section, const Material& material,
                  const BeamOptions& options = {}) {
    frame.add_member(start, end, section, material, options);
    members.push_back({start, end, section, material, options});
  }
  CorotationalFrame corotational() const { return {frame.assemble(), members}; }
};

// Members of equal length along a line, fixed at the start.
Model cantilever(int dimension, const Vector3d& tip, int members, const Section& section, const Material& material) {
  Model model{Frame(dimension)};
  for (int i = 0; i <= members; ++i) model.frame.add_node(tip * i / members);
  model.frame.fix(0);
  for (int i = 0; i < members; ++i) model.add_member(i, i + 1, section, material);
  return model;
}

VectorXd unit_load(const Model& model, int node, Dof dof) { return model.frame.assemble().motion(node, dof); }

double displacement(const Model& model, const VectorXd& q, int node, Dof dof) {
  return model.frame.assemble().motion(node, dof).dot(q);
}

double distance(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

Vector12 in_plane_of(Vector12 u, int dimension) {
  if (dimension == 2)
    for (const int i : {1, 3, 5, 7, 9, 11}) u[i] = 0;
  return u;
}

// Strongly deformed and rotated; all components differ.
Vector12 deformed(int dimension, double size) {
  Vector12 u;
  u << 0.3, -0.2, 0.5, 0.7, 1.1, -0.6, -0.8, 0.9, 0.4, 0.4, 1.4, -0.2;
  return in_plane_of(size * u, dimension);
}

std::vector<CorotationalBeam> various_members(int dimension) {
  const Vector3d from(0.4, 0, 0.1), to(2.0, 0, 1.3);
  BeamOptions plane_offsets{.start_offset = {0.2, 0, 0.3}, .end_offset = {-0.1, 0, 0.1}};
  BeamOptions hinged;
  hinged.end_releases = {Dof::ry};
  std::vector<CorotationalBeam> all;
  for (const BeamOptions& options : {BeamOptions{}, hinged, dimension == 2 ? plane_offsets : with_offsets}) {
    all.emplace_back(from, to, deep, unit_steel, options, dimension);
    all.emplace_back(to, from, deep, unit_steel, options, dimension);
  }
  return all;
}

// Central differences of fourth order: an error of about 1e-11 with this step.
template <class Function>
auto derivative(Function&& f, Vector12 u, int at) -> decltype(f(u)) {
  const double h = 2e-3;
  const auto moved = [&](double by) {
    Vector12 v = u;
    v[at] += by;
    return f(v);
  };
  const auto near = moved(h), near_back = moved(-h), far = moved(2 * h), far_back = moved(-2 * h);
  return (8 * (near - near_back) - (far - far_back)) / (12 * h);
}

TEST(CorotationalBeam, ForceIsTheGradientOfTheEnergyAndTangentThatOfTheForce) {
  for (const int dimension : {2, 3})
    for (const CorotationalBeam& beam : various_members(dimension))
      for (const double size : {1.0, 0.3, 1e-3}) {
        const Vector12 u = deformed(dimension, size);
        Matrix12 tangent;
        const auto at_u = beam.evaluate(u, tangent);
        Vector12 gradient = Vector12::Zero();
        Matrix12 slope = Matrix12::Zero();
        for (int i = 0; i < 12; ++i) {
          if (dimension == 2 && i % 2 == 1) continue;
          gradient[i] = derivative([&](const Vector12& v) { return beam.evaluate(v).energy; }, u, i);
          slope.col(i) = derivative(
              [&](const Vector12& v) -> Vector12 { return in_plane_of(beam.evaluate(v).force, dimension); }, u, i);
        }
        if (dimension == 2)
          for (const int i : {1, 3, 5, 7, 9, 11}) tangent.row(i).setZero(), tangent.col(i).setZero();
        EXPECT_LT((at_u.force - gradient).cwiseAbs().maxCoeff(), 1e-8 * size) << dimension << " size " << size;
        EXPECT_LT(distance(tangent, slope), 1e-8) << dimension << " size " << size;
      }
}

// The raw differences, without the symmetrization in `evaluate`.
TEST(CorotationalBeam, DifferencesOfTheForceAreSymmetric) {
  for (const int dimension : {2, 3})
    for (const CorotationalBeam& beam : various_members(dimension)) {
      Matrix12 slope = Matrix12::Zero();
      for (int i = 0; i < 12; ++i)
        if (dimension == 3 || i % 2 == 0)
          slope.col(i) =
              derivative([&](const Vector12& v) -> Vector12 { return in_plane_of(beam.evaluate(v).force, dimension); },
                         deformed(dimension, 1.0), i);
      EXPECT_LT(distance(slope, slope.transpose()), 1e-8) << dimension;
    }
}

TEST(CorotationalBeam, TurningAsARigidBodyTakesNoForce) {
  const Vector3d from(0.4, 0, 0.1), to(2.0, 0, 1.3);
  for (const int dimension : {2, 3})
    for (const double angle : {0.1, 1.0, 3.0, 3.5, 6.0, 9.0}) {
      if (dimension == 3 && angle > 2 * pi) continue;  // the domain of the rotation vector
      const Vector3d axis = dimension == 2 ? Vector3d(0, 1, 0) : Vector3d(1, -2, 2) / 3;
      const Eigen::Matrix3d r = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      const Vector3d shift(3, dimension == 2 ? 0 : -2, 5);
      Vector12 u, reversed;
      u << r * from - from + shift, angle * axis, r * to - to + shift, angle * axis;
      reversed << u.tail<6>(), u.head<6>();
      bool is_reversed = true;
      for (const CorotationalBeam& beam : various_members(dimension)) {
        is_reversed = !is_reversed;  // reverse every second member
        if (is_reversed) std::swap(u, reversed);
        EXPECT_LT(beam.evaluate(u).force.cwiseAbs().maxCoeff(), 2e-14 * angle) << dimension << " " << angle;
        EXPECT_LT(beam.evaluate(u).energy, 1e-28);
        if (is_reversed) std::swap(u, reversed);
      }
    }
}

TEST(CorotationalBeam, HasTheForcesOfBeamInItsTurnedAxes) {
  const Vector3d from(0.4, 0, 0.1), to(2.0, 0, 1.3);
  for (const int dimension : {2, 3}) {
    const Vector12 small = deformed(dimension, 1e-5);
    const Beam linear(from, to, deep, unit_steel);
    const CorotationalBeam beam(from, to, deep, unit_steel, {}, dimension);
    EXPECT_LT(distance(beam.end_forces(small), linear.end_forces(small)), 3e-5) << dimension;
    // Deformation first, then the same rotation at both ends.
    const Eigen::Matrix3d r = Eigen::AngleAxisd(2.2, Vector3d(0, 1, 0)).toRotationMatrix();
    Vector12 u;
    for (const int end : {0, 6}) {
      const Vector3d &x = end == 0 ? from : to, turn = small.segment<3>(end + 3);
      const Eigen::AngleAxisd both(r * Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix());
      u.segment<3>(end) = r * (x + small.segment<3>(end)) - x;
      u.segment<3>(end + 3) = both.angle() * both.axis();
    }
    EXPECT_LT(distance(beam.end_forces(u), beam.end_forces(small)), 1e-9) << dimension;
  }
}

TEST(CorotationalBeam, IsBeamForSmallDisplacements) {
  const Vector3d from(0.4, 0, 0.1), to(2.0, 0, 1.3);
  for (const BeamOptions& options : {BeamOptions{}, with_offsets}) {
    const CorotationalBeam beam(from, to, deep, unit_steel, options, 3);
    const Matrix12 k = Beam(from, to, deep, unit_steel, options).stiffness();
    Matrix12 at_rest;
    beam.evaluate(Vector12::Zero(), at_rest);
    EXPECT_LT(distance(at_rest, k), 1e-14);
    // The even part of the difference in the force is of second order, the odd part of third order.
    const Vector12 u = deformed(3, 1e-5);
    const Vector12 odd = 0.5 * (beam.evaluate(u).force - beam.evaluate(-u).force);
    EXPECT_LT(distance(odd, k * u), 1e-8);
  }
}

TEST(CorotationalBeam, InSpaceIsThatInAPlaneForMotionsInThePlane) {
  const Vector3d from(0.4, 0, 0.1);
  for (const Vector3d& to : {Vector3d(2.0, 0, 1.3), Vector3d(0.4, 0, 2.1), Vector3d(-1, 0, 0.1)}) {
    const CorotationalBeam plane(from, to, deep, unit_steel, {}, 2), space(from, to, deep, unit_steel, {}, 3);
    const Vector12 u = deformed(2, 1.0);
    Matrix12 k_plane, k_space;
    const auto a = plane.evaluate(u, k_plane), b = space.evaluate(u, k_space);
    EXPECT_NEAR(a.energy, b.energy, 1e-14 * b.energy);
    EXPECT_LT(distance(a.force, b.force), 1e-13);
    EXPECT_LT(distance(in_plane(k_plane), in_plane(k_space)), 1e-13);
  }
}

TEST(CorotationalFrame, IsTheLinearFrameAtRestAndDiffersByItsExcess) {
  const Section square{.area = 1, .inertia_y = 1.0 / 12, .inertia_z = 1.0 / 12, .torsion = 0.14};
  Model model = cantilever(3, {2, 1, 1}, 3, square, unit_steel);
  model.frame.add_spring(3, Dof::uz, 0.7);
  model.frame.add_node({3, 1, 0});
  model.frame.add_member(3, 4, square, unit_steel);  // stays linear
  const AssembledFrame assembled = model.frame.assemble();
  const CorotationalFrame frame = model.corotational();
  const VectorXd rest = VectorXd::Zero(frame.size());
  EXPECT_LT(distance(frame.tangent(rest), assembled.stiffness), 1e-15);
  VectorXd q(frame.size());
  for (int i = 0; i < q.size(); ++i) q[i] = 0.4 * std::sin(1.0 + i);
  const double h = 1e-4;
  for (int i = 0; i < q.size(); ++i) {
    VectorXd step = VectorXd::Zero(q.size());
    step[i] = h;
    const double work = (frame.energy(q + step) - frame.energy(q - step)) / (2 * h);
    EXPECT_NEAR(frame.force(q)[i], work, 1e-6 * frame.force(q).norm());
    const VectorXd slope = (frame.force(q + step) - frame.force(q - step)) / (2 * h);
    EXPECT_LT(distance(MatrixXd(frame.tangent(q)).col(i), slope), 1e-6);
  }
  // The frame keeps no history.
  const VectorXd once = frame.force(q);
  frame.force(-q);
  EXPECT_EQ(frame.force(q), once);
}

// A plane cantilever of unit length and bending stiffness.
Model slender_cantilever(int dimension, int members) {
  const double ei = 1, ea = 1e6;  // stretches by at most 1e-5
  const Section section{.area = ea, .inertia_y = ei, .inertia_z = ei, .torsion = ei};
  return cantilever(dimension, {1, 0, 0}, members, section, {.young = 1, .shear = 0.5, .density = 0});
}

// Mattiasson, IJNME 17 (1981) 145-153, table 1: the tip of the elastica under a transverse force P, p = PL^2/EI.
struct Tip {
  double p, shortening, deflection;
};
constexpr std::array mattiasson{Tip{1, 0.05643, 0.30172}, Tip{2, 0.16064, 0.49346}, Tip{3, 0.25442, 0.60325},
                                Tip{4, 0.32894, 0.66996}, Tip{5, 0.38763, 0.71379}, Tip{6, 0.43459, 0.74457},
                                Tip{7, 0.47293, 0.76737}, Tip{8, 0.50483, 0.78498}, Tip{9, 0.53182, 0.79906},
                                Tip{10, 0.55500, 0.81061}};

// The tip by elliptic integrals, Bisshopp & Drucker, Quart. Appl. Math. 3 (1945) 272-275, as a check of the table.
Tip elastica(double p) {
  const auto root = [](double k) { return std::asin(1 / (std::numbers::sqrt2 * k)); };
  double low = 1 / std::numbers::sqrt2, high = 1 - 1e-15;
  for (int i = 0; i < 200; ++i) {
    const double k = 0.5 * (low + high);
    (std::comp_ellint_1(k) - std::ellint_1(k, root(k)) < std::sqrt(p) ? low : high) = k;
  }
  const double k = low, sine = 2 * k * k - 1;
  return {p, 1 - std::sqrt(2 * sine / p), 1 - 2 / std::sqrt(p) * (std::comp_ellint_2(k) - std::ellint_2(k, root(k)))};
}

TEST(CorotationalFrame, FollowsTheElasticaUnderATipForce) {
  test::Book book("Frames with large displacements",
                  "Mattiasson, IJNME 17 (1981) 145-153, table 1, and elliptic integrals by Bisshopp & Drucker, "
                  "Quart. Appl. Math. 3 (1945) 272-275",
                  "20 members, whose error falls with the square of their length; the table has five decimals");
  for (const int dimension : {2, 3}) {
    const int members = 20;
    const Model model = slender_cantilever(dimension, members);
    const auto path = model.corotational().solve(10 * unit_load(model, members, Dof::uz), 10);
    ASSERT_EQ(path.size(), 11u);
    for (const Tip& tip : mattiasson) {
      const VectorXd& q = path[static_cast<int>(tip.p)].q;
      book.near("elastica: axial displacement of the tip [L]", -displacement(model, q, members, Dof::ux),
                tip.shortening, 1e-3);
      book.near("elastica: transverse displacement of the tip [L]", displacement(model, q, members, Dof::uz),
                tip.deflection, 1e-3);
      book.near("elastica by elliptic integrals: axial, difference from the table [L]", elastica(tip.p).shortening,
                tip.shortening, 6e-6);
      book.near("elastica by elliptic integrals: transverse, difference from the table [L]", elastica(tip.p).deflection,
                tip.deflection, 6e-6);
    }
  }
}

TEST(CorotationalFrame, ConvergesToTheElasticaWithTheSquareOfTheMembersLength) {
  test::Book book("Frames with large displacements", "elastica: order two", "the next order of the error");
  const Tip exact = elastica(10);
  std::vector<double> errors;
  for (const int members : {8, 16, 32}) {
    const Model model = slender_cantilever(2, members);
    const VectorXd q = model.corotational().solve(10 * unit_load(model, members, Dof::uz), 10).back().q;
    errors.push_back(std::abs(displacement(model, q, members, Dof::uz) - exact.deflection));
  }
  book.near("order between 8 and 16 members [-]", std::log2(errors[0] / errors[1]), 2, 0.1);
  book.near("order between 16 and 32 members [-]", std::log2(errors[1] / errors[2]), 2, 0.1);
}

// Under an end moment 2 pi EI/L the cantilever closes to a circle. A constant moment bends all members of equal length
// equally, so that the nodes lie exactly on a regular polygon and each end rotates as in the arc: m L/EI.
TEST(CorotationalFrame, RollsIntoACircleUnderAnEndMoment) {
  test::Book book("Frames with large displacements",
                  "a cantilever under an end moment up to two full turns: members of equal length lie on a regular "
                  "polygon, ends rotated by m L/EI",
                  "convergence tolerance of the equilibrium");
  const int members = 12;
  for (const int dimension : {2, 3}) {
    const Model model = slender_cantilever(dimension, members);
    const double maximum = dimension == 2 ? 2 : 0.95;  // full turns; the domain of a rotation vector ends before one
    const auto path = model.corotational().solve(2 * pi * maximum * unit_load(model, members, Dof::ry), 20);
    for (const auto& [factor, q] : path) {
      const double turn = 2 * pi * maximum * factor, part = turn / members;
      book.near("circle: rotation of the tip [rad]", displacement(model, q, members, Dof::ry), turn, 1e-7);
      Vector3d tip(0, 0, 0);  // each member is rotated relative to the previous one, by half of that at the support
      for (int i = 0; i < members; ++i)
        tip += Vector3d(std::cos((i + 0.5) * part), 0, -std::sin((i + 0.5) * part)) / members;
      book.near("circle: x of the tip [L]", 1 + displacement(model, q, members, Dof::ux), tip.x(), 1e-7);
      book.near("circle: z of the tip [L]", displacement(model, q, members, Dof::uz), tip.z(), 1e-7);
      if (dimension == 2 && std::abs(factor - 0.5) < 1e-12) {
        EXPECT_LT(tip.norm(), 1e-14);
      }
    }
  }
}

// First maximum of the load factor on a path, by the parabola through the three points around it.
double limit(const std::vector<CorotationalFrame::Equilibrium>& path) {
  std::size_t i = 1;
  while (i + 1 < path.size() && path[i + 1].factor > path[i].factor) ++i;
  const double a = path[i - 1].factor, b = path[i].factor, c = path[i + 1].factor;
  return b + (a - c) * (a - c) / (8 * (2 * b - a - c));
}

// Lee, Manuel & Rossow, J. Eng. Mech. Div. ASCE 94 (1968) 521-547; here in cm and kN.
Model lees_frame(int members) {
  const double l = 120, load_at = 24;
  const Section section{.area = 6, .inertia_y = 2};
  const Material material{.young = 7200, .shear = 0, .density = 0};
  Model model{Frame(2)};
  model.frame.add_node({0, 0, 0});
  for (int i = 1; i <= members; ++i) {
    model.frame.add_node({0, 0, l * i / members});
    model.add_member(i - 1, i, section, material);
  }
  for (int i = 1; i <= members; ++i) {
    model.frame.add_node({l * i / members, 0, l});
    model.add_member(members + i - 1, members + i, section, material);
  }
  EXPECT_EQ(model.frame.position(members + members / 5).x(), load_at);
  for (const int foot : {0, 2 * members}) model.frame.fix(foot, {Dof::ux, Dof::uz});
  return model;
}

// Load and sag both reverse: the maximum load at a sag of 48.6 cm, then the minimum beyond the maximum sag.
TEST(CorotationalFrame, FollowsLeesFrameThroughItsLimitPoints) {
  test::Book book("Frames with large displacements",
                  "Lee's frame (Lee, Manuel & Rossow, J. Eng. Mech. Div. ASCE 94 (1968) 521-547): independent "
                  "solution of its extensible elastica by shooting, Runge-Kutta of fourth order",
                  "the error is of second order in the length of the members: 5.5e-3, 1.4e-3, 3.4e-4 of the load with "
                  "10, 20, 40 a leg");
  double error = 0;
  for (const int members : {10, 20}) {
    const int loaded = members + members / 5;
    const Model model = lees_frame(members);
    const VectorXd load = -unit_load(model, loaded, Dof::uz);
    const CorotationalFrame frame = model.corotational();
    const auto path = frame.follow(load, 4.0, 160);
    const double coarser = std::exchange(error, limit(path) - 18.5567);
    if (members == 20) {
      book.near("Lee's frame: largest load, 20 members per leg [kN]", limit(path), 18.5567, 2e-3 * 18.5567);
      book.near("Lee's frame: error with 10 members over that with 20 [-]", coarser / error, 4, 0.2);
    }
    // Load and sag both reverse before the load changes to tension.
    double minimum = 0, sag_at_least = 0, most_before = 0, maximum = 0;
    for (const auto& [factor, q] : path) {
      const double sag = -displacement(model, q, loaded, Dof::uz);
      maximum = std::max(maximum, sag);
      if (factor < minimum) {
        minimum = factor;
        sag_at_least = sag;
        most_before = maximum;
      }
      EXPECT_LT((frame.force(q) - factor * load).norm(), 1e-6 * std::max(1.0, std::abs(factor)));
    }
    book.near("Lee's frame: minimum load [kN]", minimum, -9.4144, members == 10 ? 0.25 : 0.06);
    book.near("Lee's frame: sag at the minimum load [cm]", sag_at_least, 58.2, 1);
    book.near("Lee's frame: largest sag before it [cm]", most_before, 61.0, 0.5);
  }
}

TEST(CorotationalFrame, SolvesForALoadBeyondALimitPoint) {
  const int members = 10, loaded = members + members / 5;
  const Model model = lees_frame(members);
  const CorotationalFrame frame = model.corotational();
  const VectorXd load = -25 * unit_load(model, loaded, Dof::uz);
  const auto path = frame.solve(load, 10);
  EXPECT_EQ(path.front().factor, 0);
  EXPECT_EQ(path.back().factor, 1);
  EXPECT_LT((frame.force(path.back().q) - load).norm(), 1e-6);
  EXPECT_GT(-displacement(model, path.back().q, loaded, Dof::uz), 80);  // snapped through
}

// Bathe & Bolourchi, IJNME 14 (1979) 961-986: an eighth of a circle of radius 100, fixed at one end, section 1 x 1,
// with an out-of-plane load of 600. Published tip positions scatter: x 15.5 to 15.9, y 47.0 to 47.2, z 53.4 to 53.5,
// usually with eight straight elements. Bathe & Bolourchi: 15.9, 47.2, 53.4. Simo & Vu-Quoc, CMAME 58 (1986) 79-116:
// 15.79, 47.23, 53.37. They also depend on the torsion constant: many authors use the polar moment 1/6, as here,
// instead of 0.1406. The accurate reference is an independent solution of the curved extensible Kirchhoff rod with 1/6
// by shooting: 15.68536, 47.15215, 53.47176.
TEST(CorotationalFrame, BendsTheArcOfBatheAndBolourchi) {
  test::Book book("Frames with large displacements",
                  "arc of Bathe & Bolourchi, IJNME 14 (1979) 961-986; tips of Simo & Vu-Quoc, CMAME 58 (1986) "
                  "79-116, and of an independent solution of the curved extensible Kirchhoff rod by shooting",
                  "0.3 % of the deflection with eight members; published tips scatter by as much. The error "
                  "is of second order in the length");
  const Vector3d simo(15.79, 47.23, 53.37), rod(15.68536, 47.15215, 53.47176);
  const Section square{.area = 1, .inertia_y = 1.0 / 12, .inertia_z = 1.0 / 12, .torsion = 1.0 / 6};
  std::vector<double> errors;
  for (const int members : {8, 16, 32}) {
    Model model{Frame(3)};
    for (int i = 0; i <= members; ++i) {
      const double angle = pi / 4 * i / members;
      model.frame.add_node({100 * (1 - std::cos(angle)), 100 * std::sin(angle), 0});
      if (i > 0) model.add_member(i - 1, i, square, {.young = 1e7, .shear = 5e6, .density = 0});
    }
    model.frame.fix(0);
    const VectorXd q = model.corotational().solve(600 * unit_load(model, members, Dof::uz), 6).back().q;
    Vector3d tip = model.frame.position(members);
    for (const Dof dof : {Dof::ux, Dof::uy, Dof::uz})
      tip[static_cast<int>(dof)] += displacement(model, q, members, dof);
    if (members == 8) {
      book.below("arc: tip with 8 members, deviation from Simo & Vu-Quoc [-]", (tip - simo).cwiseAbs().maxCoeff(),
                 0.16);  // 0.3 % of the deflection
    }
    errors.push_back((tip - rod).norm());
  }
  book.below("arc: tip with 32 members, deviation from the rod [-]", errors.back(), 5e-3);
  book.near("arc: error with 8 members over that with 16 [-]", errors[0] / errors[1], 4, 0.3);
  book.near("arc: error with 16 members over that with 32 [-]", errors[1] / errors[2], 4, 0.3);
}

// A column of unit length and EI.
TEST(CorotationalFrame, SwaysUnderAxialLoadAsByGeometricStiffness) {
  test::Book book("Frames with large displacements",
                  "sway stiffness of a column under P: P/(tan u/u - 1), u^2 = P L^2/(EI)",
                  "the error of 8 and 16 members");
  const Section section{.area = 1e6, .inertia_y = 1};
  const Material material{.young = 1, .shear = 0, .density = 0};
  const double euler = pi * pi / 4;
  for (const double share : {-0.5, 0.3, 0.8}) {
    const double p = share * euler;
    double exact = p / (std::tan(std::sqrt(std::abs(p))) / std::sqrt(std::abs(p)) - 1);
    if (p < 0) exact = p / (std::tanh(std::sqrt(-p)) / std::sqrt(-p) - 1);
    std::vector<double> errors;
    for (const int members : {8, 16}) {
      const Model model = cantilever(2, {0, 0, 1}, members, section, material);
      const VectorXd down = -unit_load(model, members, Dof::uz), sway = unit_load(model, members, Dof::ux);
      const CorotationalFrame frame = model.corotational();
      const auto stiffness = [&](const MatrixXd& k) { return 1 / sway.dot(test::dense::solve(k, sway)); };
      const double found = stiffness(frame.tangent(frame.solve(p * down, 1).back().q));

      Frame linear(2);
      for (int i = 0; i <= members; ++i) linear.add_node({0, 0, 1.0 * i / members});
      linear.fix(0);
      for (int i = 0; i < members; ++i) linear.add_member(i, i + 1, section, material, {.axial_force = -p});
      book.near("sway stiffness by geometric stiffness [EI/L^3]", stiffness(linear.assemble().stiffness), exact,
                1e-4 * exact);
      errors.push_back(std::abs(found - exact));
    }
    book.below("sway stiffness, 16 members, error [EI/L^3]", errors[1], 3e-3);  // of the stiffness 3 without the load
    book.near("sway: error with 8 members over that with 16 [-]", errors[0] / errors[1], 4, 0.2);
  }
}

TEST(CorotationalFrame, HasAStableStraightColumnBelowTheBucklingLoadOnly) {
  const Model model = slender_cantilever(2, 20);
  const VectorXd push = -pi * pi / 4 * unit_load(model, 20, Dof::ux);
  const CorotationalFrame frame = model.corotational();
  const auto is_stable = [&](double factor) {
    const MatrixXd k = frame.tangent(frame.solve(factor * push, 1).back().q);
    return test::dense::eigenvalues(k).minCoeff() > 0;
  };
  EXPECT_TRUE(is_stable(0.998));
  EXPECT_FALSE(is_stable(1.002));
}

TEST(CorotationalFrame, RefusesWhatItCannotBeMadeOf) {
  const Model model = slender_cantilever(2, 2);
  const AssembledFrame assembled = model.frame.assemble();
  const CorotationalFrame frame = model.corotational();
  auto members = model.members;
  members[1].end = 7;
  EXPECT_TRUE(test::mentions(refusal([&] { CorotationalFrame(assembled, members); }), {"1", "7", "3"}));
  members = model.members;
  members[0].options.axial_force = 3;
  EXPECT_TRUE(test::mentions(refusal([&] { CorotationalFrame(assembled, members); }), {"0"}));
  members = model.members;
  members.push_back(members[0]);
  EXPECT_TRUE(test::mentions(refusal([&] { CorotationalFrame(assembled, members); }), {"1"}));
  EXPECT_TRUE(test::mentions(refusal([&] { frame.force(VectorXd::Zero(5)); }), {"5", "6"}));
  EXPECT_NE(refusal([&] { frame.solve(VectorXd::Zero(6), 3); }), "taken");
  EXPECT_NE(refusal([&] { frame.solve(VectorXd::Ones(6), 0); }), "taken");
  EXPECT_TRUE(test::mentions(refusal([&] { frame.end_forces(2, VectorXd::Zero(6)); }), {"2"}));
}

}  // namespace corotational_test
}  // namespace pounding
