// Beam-columns against closed forms: flexibility, mass and geometric stiffness, axes, releases, offsets.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pounding/frames/beam.hpp>
#include "support/book.hpp"
#include "support/dense.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace beam_test {

using test::refusal;

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double infinite = std::numeric_limits<double>::infinity();
const Section slender{.area = 0.18, .inertia_y = 5.4e-3, .inertia_z = 1.35e-3, .torsion = 3.2e-3};
const Section deep{
    .area = 0.9, .inertia_y = 0.24, .inertia_z = 0.02, .torsion = 0.05, .shear_area_y = 0.7, .shear_area_z = 0.75};
const Material concrete{.young = 30e9, .shear = 12.5e9, .density = 2500};

Matrix6 tip(const Matrix12& m) { return m.bottomRightCorner<6, 6>(); }

// Maximum difference relative to the maximum entry.
double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

// The six motions of a rigid body about the origin, as displacements of two nodes.
Eigen::Matrix<double, 12, 6> rigid_motions(const Vector3d& start, const Vector3d& end) {
  Eigen::Matrix<double, 12, 6> motions = Eigen::Matrix<double, 12, 6>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d unit = Vector3d::Unit(axis);
    motions.col(axis) << unit, Vector3d::Zero(), unit, Vector3d::Zero();
    motions.col(3 + axis) << unit.cross(start), unit, unit.cross(end), unit;
  }
  return motions;
}

// The beam is along x.
TEST(Beam, ActsAsACantileverUnderEveryTipLoad) {
  test::Book book("A beam-column alone",
                  "Timoshenko, Strength of Materials: tip of a cantilever under each tip force and moment; shear "
                  "adds F L/(G As)",
                  "rounding");
  for (const Section& s : {slender, deep}) {
    const double l = 3.7, e = concrete.young, g = concrete.shear, iy = s.inertia_y, iz = s.inertia_z;
    Matrix6 flexibility = Matrix6::Zero();
    flexibility(0, 0) = l / (e * s.area);
    flexibility(1, 1) = l * l * l / (3 * e * iz) + l / (g * s.shear_area_y);
    flexibility(2, 2) = l * l * l / (3 * e * iy) + l / (g * s.shear_area_z);
    flexibility(3, 3) = l / (g * s.torsion);
    flexibility(4, 4) = l / (e * iy);
    flexibility(5, 5) = l / (e * iz);
    flexibility(1, 5) = flexibility(5, 1) = l * l / (2 * e * iz);
    flexibility(2, 4) = flexibility(4, 2) = -l * l / (2 * e * iy);  // a downward slope is a positive ry
    const Beam beam({1, 2, 3}, {1 + l, 2, 3}, s, concrete);
    const Matrix6 found = test::dense::inverse(tip(beam.stiffness()));
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j)
        book.near("flexibility of the tip, i j over sqrt(ii jj) [m/N, 1/N, 1/(N m)]", found(i, j), flexibility(i, j),
                  1e-12 * std::sqrt(flexibility(i, i) * flexibility(j, j)));
  }
}

TEST(Beam, OfAPlaneFrameIsThePartWithUxUzRy) {
  test::Book book("A beam-column alone", "slope-deflection: 12 EI/L^3, 6 EI/L^2, 4 EI/L, 2 EI/L, EA/L", "rounding");
  const double l = 2.5, ea = concrete.young * slender.area / l, ei = concrete.young * slender.inertia_y;
  const double a = 12 * ei / (l * l * l), b = 6 * ei / (l * l), c = 4 * ei / l;
  Matrix6 expected;  // the textbook's matrix with the rotations reversed, since ry turns z into x
  expected << ea, 0, 0, -ea, 0, 0, 0, a, -b, 0, -a, -b, 0, -b, c, 0, b, c / 2, -ea, 0, 0, ea, 0, 0, 0, -a, b, 0, a, b,
      0, -b, c / 2, 0, b, c;
  book.below("stiffness of a plane member, largest difference over the largest entry [-]",
             distance(in_plane(Beam({0, 0, 0}, {l, 0, 0}, slender, concrete).stiffness()), expected), 1e-14);
  // Bending about the other axis and torsion are not involved and may be omitted.
  const Section plane{.area = slender.area, .inertia_y = slender.inertia_y};
  EXPECT_LT(distance(in_plane(Beam({0, 0, 0}, {l, 0, 0}, plane, {.young = 30e9}).stiffness()), expected), 1e-14);
}

// Deflections of a beam without loads between its ends, for unit (w, t) of its ends.
Eigen::Vector4d shape(double x, double l, double phi) {
  const double s = x / l, f = 1 / (1 + phi);
  return {f * (1 - 3 * s * s + 2 * s * s * s + phi * (1 - s)),
          f * l * (s - 2 * s * s + s * s * s + phi / 2 * (s - s * s)), f * (3 * s * s - 2 * s * s * s + phi * s),
          f * l * (s * s * s - s * s + phi / 2 * (s * s - s))};
}

// Integral of g(x) g(x)^T over the length for polynomials up to degree 7, by four Gauss points.
Eigen::Matrix4d integral(double l, const std::function<Eigen::Vector4d(double)>& g) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const auto& [at, weight] :
       {std::pair(0.339981043584856265, 0.652145154862546143), {0.861136311594052575, 0.347854845137453857}})
    for (const double side : {-1.0, 1.0}) {
      const Eigen::Vector4d value = g(l / 2 * (1 + side * at));
      sum += l / 2 * weight * value * value.transpose();
    }
  return sum;
}

TEST(Beam, HasMassAndGeometricStiffnessOfItsShapeFunctions) {
  test::Book book("A beam-column alone", "integrals of the exact shape functions of a beam with shear, by Gauss's rule",
                  "round-off of slopes by differences");
  for (const Section& s : {slender, deep}) {
    const double l = 1.9, h = 1e-3;
    for (const bool about_y : {true, false}) {
      const double inertia = about_y ? s.inertia_y : s.inertia_z,
                   shear_area = about_y ? s.shear_area_z : s.shear_area_y;
      const double phi = 12 * concrete.young * inertia / (concrete.shear * shear_area * l * l);
      // A central difference of a cubic has an error of exactly h^2 w'''/6, which Richardson extrapolation removes.
      const auto slope = [&](double x) -> Eigen::Vector4d {
        const auto d = [&](double step) -> Eigen::Vector4d {
          return (shape(x + step, l, phi) - shape(x - step, l, phi)) / (2 * step);
        };
        return (4 * d(h) - d(2 * h)) / 3;
      };
      const Eigen::Array4i at = about_y ? Eigen::Array4i(2, 4, 8, 10) : Eigen::Array4i(1, 5, 7, 11);
      const Eigen::Vector4d sign = about_y ? Eigen::Vector4d(1, -1, 1, -1) : Eigen::Vector4d::Ones();
      const auto part = [&](const Matrix12& m) -> Eigen::Matrix4d {
        return sign.asDiagonal() * m(at, at) * sign.asDiagonal();
      };
      book.below("consistent mass, largest difference over the largest entry [-]",
                 distance(part(beam_mass(s, concrete, l)),
                          concrete.density * s.area * integral(l, [&](double x) { return shape(x, l, phi); })),
                 1e-13);
      book.below("geometric stiffness, largest difference over the largest entry [-]",
                 distance(part(beam_geometric_stiffness(s, concrete, l)), integral(l, slope)), 1e-11);
    }
  }
}

TEST(Beam, GivesNoForceToTheMotionOfARigidBody) {
  const Vector3d start(1, -2, 0.5), end(4, 1, 2.5);
  BeamOptions options{.start_offset = {0.2, 0.1, -0.3}, .end_offset = {-0.1, 0.3, 0.2}};
  for (const auto& releases : {std::vector<Dof>{}, {Dof::ry, Dof::rz}, {Dof::ux, Dof::ry}}) {
    options.end_releases = releases;
    const Beam beam(start, end, deep, concrete, options);
    const auto motions = rigid_motions(start, end);
    EXPECT_LT((beam.stiffness() * motions).cwiseAbs().maxCoeff(), 1e-13 * beam.stiffness().cwiseAbs().maxCoeff());
    EXPECT_EQ(beam.stiffness(), beam.stiffness().transpose());
    EXPECT_EQ((test::dense::eigenvalues(beam.stiffness()).array().abs() < 1e-12 * beam.stiffness().norm()).count(),
              6 + static_cast<int>(releases.size()));
  }
}

// A moving rigid bar: m v^2/2, and m L^2/12 + m r^2 about a transverse axis; twist with the polar inertia of the
// section.
TEST(Beam, HasTheKineticEnergyOfARigidBar) {
  test::Book book("A beam-column alone", "a rigid bar: m, m L^2/12 + m r^2, and the polar inertia of the section",
                  "rounding");
  const double l = 4.0, m = concrete.density * deep.area * l;
  const Vector3d start(1, 0, 0), end(1 + l, 0, 0);
  const Beam bar(start, end, deep, concrete, {.mass = BeamMass::consistent});
  const auto motions = rigid_motions(start, end);
  const double about = m * l * l / 12 + m * std::pow(1 + l / 2, 2);
  const double polar = m / deep.area * (deep.inertia_y + deep.inertia_z);
  const Eigen::Vector<double, 6> expected(m, m, m, polar, about, about);
  book.below("inertia of a moving bar, largest difference over the largest entry [-]",
             distance((motions.transpose() * bar.mass() * motions).diagonal(), expected), 1e-14);
  EXPECT_EQ(bar.total_mass(), m);

  // Neither offsets nor releases change the mass.
  const BeamOptions options{
      .start_offset = {0.5, 0, 0}, .end_releases = {Dof::ry, Dof::ux}, .mass = BeamMass::consistent};
  const Beam shorter(start, end, deep, concrete, options);
  const double mass = concrete.density * deep.area * 3.5;
  for (int axis = 0; axis < 3; ++axis)
    book.near("mass with offsets and releases [kg]", motions.col(axis).dot(shorter.mass() * motions.col(axis)), mass,
              1e-12 * mass);
  for (const int released : {6, 10}) EXPECT_TRUE(shorter.mass().row(released).isZero(0));
}

TEST(Beam, LumpsHalfItsMassToTheTranslationsOfEachNode) {
  const Beam beam({0, 0, 0}, {1, 2, 2}, deep, concrete, {.start_offset = {0, 0, 0.1}, .end_offset = {0, 0, 0.1}});
  const double half = concrete.density * deep.area * 3 / 2;
  Vector12 expected;
  expected << half, half, half, 0, 0, 0, half, half, half, 0, 0, 0;
  EXPECT_LT(distance(beam.mass(), Matrix12(expected.asDiagonal())), 1e-15);
}

TEST(Beam, KeepsItsLocalYHorizontalAndItsLocalZUp) {
  Matrix3d expected;
  expected << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  EXPECT_EQ(beam_axes({5, 0, 0}), expected);
  expected << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  EXPECT_EQ(beam_axes({0, 5, 0}), expected);
  expected << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // an upward column
  EXPECT_EQ(beam_axes({0, 0, 5}), expected);
  expected << 0, 0, -1, 0, -1, 0, -1, 0, 0;  // a downward column
  EXPECT_EQ(beam_axes({0, 0, -5}), expected);

  const Matrix3d skew = beam_axes({1, -2, 3});
  EXPECT_NEAR(skew(1, 2), 0, 1e-16);
  EXPECT_GT(skew(2, 2), 0);
  EXPECT_LT(distance(skew * skew.transpose(), Matrix3d::Identity()), 1e-15);
  EXPECT_NEAR(skew.determinant(), 1, 1e-15);

  const Matrix3d turned = beam_axes({1, -2, 3}, Vector3d(0.3, 1, 0.2));
  EXPECT_GT(turned.row(2).dot(Vector3d(0.3, 1, 0.2)), 0);
  EXPECT_NEAR(turned.row(1).dot(Vector3d(0.3, 1, 0.2)), 0, 1e-15);
}

TEST(Beam, IsTheSameInEveryOrientation) {
  const Vector3d start(0.3, -1, 2), end(3, 1.5, 2.4), reference(0.2, 0.1, 1);
  BeamOptions options{.reference = reference,
                      .start_offset = {0.1, 0.2, -0.1},
                      .end_releases = {Dof::rz},
                      .axial_force = -3e5,
                      .mass = BeamMass::consistent};
  const Beam beam(start, end, deep, concrete, options);
  const Matrix3d turn = Eigen::AngleAxisd(2.3, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  options.reference = turn * reference;
  options.start_offset = turn * options.start_offset;
  const Beam turned(turn * start, turn * end, deep, concrete, options);
  Matrix12 all = Matrix12::Zero();
  for (int i = 0; i < 12; i += 3) all.block<3, 3>(i, i) = turn;
  EXPECT_LT(distance(turned.stiffness(), all * beam.stiffness() * all.transpose()), 1e-13);
  EXPECT_LT(distance(turned.mass(), all * beam.mass() * all.transpose()), 1e-13);
}

TEST(Beam, CarriesNothingThroughAReleasedEnd) {
  test::Book book("A beam-column alone", "a member with a hinge at its end: 3 EI/L^3", "rounding");
  const double l = 3, ei = concrete.young * slender.inertia_y, three = 3 * ei / (l * l * l);
  const Beam pinned({0, 0, 0}, {l, 0, 0}, slender, concrete, {.end_releases = {Dof::ry}});
  const Matrix12 k = pinned.stiffness();
  book.near("transverse stiffness at the hinge [N/m]", k(8, 8), three, 1e-12 * three);
  book.near("rotational stiffness of the other end, 3 EI/L [N m]", k(4, 4), three * l * l, 1e-12 * three * l * l);
  EXPECT_TRUE(k.row(10).isZero(0));
  // Bending in the other plane is unchanged.
  book.near("bending in the other plane, 12 EI/L^3 [N/m]", k(7, 7),
            12 * concrete.young * slender.inertia_z / (l * l * l), 1e-12 * k(7, 7));

  const Beam truss({0, 0, 0}, {l, 0, 0}, slender, concrete,
                   {.start_releases = {Dof::ry, Dof::rz, Dof::rx}, .end_releases = {Dof::ry, Dof::rz}});
  Matrix12 bar = Matrix12::Zero();
  bar(0, 0) = bar(6, 6) = concrete.young * slender.area / l;
  bar(0, 6) = bar(6, 0) = -bar(0, 0);
  EXPECT_LT(distance(truss.stiffness(), bar), 1e-12);

  // Releases are in local axes: for a column the same one is about global y as well.
  const Beam column({0, 0, 0}, {0, 0, l}, slender, concrete, {.end_releases = {Dof::ry}});
  book.near("transverse stiffness at the hinge of a column [N/m]", column.stiffness()(6, 6), three, 1e-12 * three);
}

// A rod hinged at both ends with axial force N has the lateral stiffness of a string.
TEST(Beam, HingedAtBothEndsHasTheStiffnessOfAString) {
  test::Book book("A beam-column alone", "a string under N: N/L", "the difference of stiffnesses 1e4 times larger");
  const double l = 3, n = -2e5;
  const BeamOptions hinged{.start_releases = {Dof::ry}, .end_releases = {Dof::ry}, .axial_force = n};
  const Beam rod({0, 0, 0}, {l, 0, 0}, slender, concrete, hinged);
  book.near("transverse stiffness of a hinged rod [N/m]", rod.stiffness()(8, 8), n / l,
            1e-9 * -n / l);  // the difference of stiffnesses 1e4 times larger
}

TEST(Beam, HasRigidOffsets) {
  test::Book book("A beam-column alone",
                  "unit-load theorem: EI w/F = L^3/3 + L^2 a + L a^2 with a rigid arm a; L/EA + d^2 L/EI below the "
                  "nodes",
                  "rounding");
  const double l = 2, a = 0.4, b = 0.3, ei = concrete.young * slender.inertia_y;
  const Beam beam({0, 0, 0}, {b + l + a, 0, 0}, slender, concrete,
                  {.start_offset = {b, 0, 0}, .end_offset = {-a, 0, 0}});
  EXPECT_NEAR(beam.length(), l, 1e-15);
  const double w = (l * l * l / 3 + l * l * a + l * a * a) / ei;
  book.near("deflection with a rigid arm [m/N]", test::dense::inverse(tip(beam.stiffness()))(2, 2), w, 1e-12 * w);

  // A beam below its nodes: an axial force F at the node bends it with F d and also moves the node by the rotation of
  // the end.
  const double d = 0.5;
  const Beam below({0, 0, 0}, {l, 0, 0}, slender, concrete, {.start_offset = {0, 0, -d}, .end_offset = {0, 0, -d}});
  const double u = l / (concrete.young * slender.area) + d * d * l / ei;
  book.near("stretch of a beam below its nodes [m/N]", test::dense::inverse(tip(below.stiffness()))(0, 0), u,
            1e-12 * u);
}

TEST(Beam, ReturnsTheForcesOnItsEndsInLocalAxes) {
  test::Book book("A beam-column alone", "statics of a column with a force at its top", "rounding");
  const double l = 3, f = 5e3;
  const Beam column({0, 0, 0}, {0, 0, l}, slender, concrete);
  Vector12 u = Vector12::Zero();
  Eigen::Vector<double, 6> load;
  load << f, 0, -2 * f, 0, 0, 0;
  u.tail<6>() = test::dense::solve(tip(column.stiffness()), load);
  Vector12 expected;  // local x is global z, local z is global -x
  expected << 2 * f, 0, f, 0, -f * l, 0, -2 * f, 0, -f, 0, 0, 0;
  book.below("end forces, largest difference over the largest [-]", distance(column.end_forces(u), expected), 1e-11);
}

TEST(Beam, RefusesWhatCannotBe) {
  const auto with = [](auto&& change) {
    return refusal([&] {
      Section s = slender;
      Material m = concrete;
      BeamOptions o;
      Vector3d end(1, 0, 0);
      change(s, m, o, end);
      Beam(Vector3d::Zero(), end, s, m, o);
    });
  };
  EXPECT_EQ(with([](auto&, auto&, auto&, auto&) {}), "taken");
  EXPECT_NE(with([](auto&, auto&, auto&, auto& end) { end.setZero(); }), "taken");
  EXPECT_NE(with([](auto&, auto&, auto& o, auto&) { o.end_offset = {-1, 0, 0}; }), "taken");
  EXPECT_TRUE(test::mentions(with([](auto& s, auto&, auto&, auto&) { s.area = 0; }), {"inertia_y"}));
  EXPECT_TRUE(test::mentions(with([](auto& s, auto&, auto&, auto&) { s.inertia_y = -1; }), {"inertia_y"}));
  EXPECT_TRUE(test::mentions(with([](auto&, auto& m, auto&, auto&) { m.young = infinite; }), {"inertia_y"}));
  EXPECT_TRUE(test::mentions(with([](auto& s, auto&, auto&, auto&) { s.torsion = -1; }), {"inertia_z"}));
  EXPECT_TRUE(test::mentions(with([](auto& s, auto&, auto&, auto&) { s.shear_area_z = 0; }), {"shear"}));
  EXPECT_TRUE(test::mentions(with([](auto& s, auto& m, auto&, auto&) { s.shear_area_z = 1, m.shear = 0; }), {"shear"}));
  EXPECT_NE(with([](auto&, auto&, auto&, auto& end) { end.x() = infinite; }), "taken");
  EXPECT_NE(with([](auto&, auto&, auto& o, auto&) { o.start_releases = o.end_releases = {Dof::rx}; }), "taken");
  EXPECT_NE(
      with([](auto&, auto&, auto& o, auto&) { o.start_releases = {Dof::ry, Dof::uz}, o.end_releases = {Dof::ry}; }),
      "taken");
  for (const double length : {0.7, 1.1, 3.3})  // singular up to round-off
    EXPECT_NE(with([&](auto& s, auto&, auto& o, auto& end) {
                s = deep, end = {length, 0.2, -0.9}, o.start_releases = {Dof::ry, Dof::uz}, o.end_releases = {Dof::ry};
              }),
              "taken");
  EXPECT_NE(with([](auto& s, auto&, auto& o, auto&) { s.torsion = 0, o.end_releases = {Dof::rx}; }), "taken");
  EXPECT_TRUE(
      test::mentions(with([](auto&, auto&, auto& o, auto&) { o.reference = Vector3d(2, 0, 0); }), {"reference"}));
  EXPECT_TRUE(test::mentions(with([](auto&, auto&, auto& o, auto&) { o.axial_force = infinite; }), {"axial"}));
}

}  // namespace beam_test
}  // namespace pounding
