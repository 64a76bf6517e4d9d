/// One fibre member: tangents, elastic limit, offsets, reversals, states, invalid input.

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/frames/corotational.hpp>
#include <pounding/frames/fibre_member.hpp>
#include "sections/reinforced_column.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace fibre_member_test {

using Eigen::Vector3d;
using SharedSection = std::shared_ptr<const sections::FibreSection>;

SharedSection reinforced(int across) {
  sections::RcRectangle dimensions = test::column_dimensions();
  dimensions.across = across;
  return std::make_shared<sections::FibreSection>(test::column_materials("menegotto_pinto"),
                                                  sections::rc_rectangle(dimensions));
}

SharedSection elastic(int across) {
  return std::make_shared<sections::FibreSection>(
      std::vector{materials::make_material({.law = "elastic", .values = {{"E", 30e9}}})},
      sections::rectangle(0.3, 0.5, 0, 20, across));
}

/// Elastic member of the same stiffness.
Section elastic_section(const sections::FibreSection& section, double shear_area) {
  const auto k = section.evaluate(section.states(), {}).stiffness;
  return {.area = k[0] / 30e9,
          .inertia_y = k[3] / 30e9,
          .inertia_z = k[5] / 30e9,
          .torsion = 2e-3,
          .shear_area_y = shear_area,
          .shear_area_z = 0.7 * shear_area};
}

struct Result {
  Vector12 force;
  Matrix12 tangent;
};

/// Converged at these displacements.
Result converged(const FibreMember& member, const FibreMember::State& state, FibreMember::Iterate& iterate,
                 const Vector12& displacements) {
  Result result;
  double change = 1;
  for (int i = 0; i < 100 && change > 1e-15; ++i)
    change = member.linearize(state, iterate, displacements, result.force, result.tangent);
  EXPECT_LT(change, 1e-12);
  return result;
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

/// Displacements of both nodes, in the plane or in space.
Vector12 random_displacements(std::mt19937& random, double translation, double rotation, int dimension) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Vector12 u = Vector12::Zero();
  for (int i = 0; i < 12; ++i)
    if (dimension == 3 || i % 2 == 0) u[i] = unit(random) * (i % 6 < 3 ? translation : rotation);
  return u;
}

const Vector3d start(0.2, 0, 0.1), end_in_plane(1.3, 0, 2.9), end_in_space(1.3, 0.9, 2.9);

FibreMember member_of(const SharedSection& section, FibreMemberOptions options, int dimension,
                      BeamOptions orientation = {}) {
  options.torsion_stiffness = 2e-3 * 12e9;
  orientation.start_offset = {0.1, 0, 0.2}, orientation.end_offset = {-0.05, 0, -0.3};
  if (dimension == 3) orientation.start_offset.y() = 0.15, orientation.reference = Vector3d(0.2, 1, 0.3);
  return {start, dimension == 2 ? end_in_plane : end_in_space, orientation, section, options, dimension};
}

/// All formulations and geometries.
std::vector<FibreMemberOptions> all_options() {
  std::vector<FibreMemberOptions> all;
  for (const auto formulation : {MemberFormulation::force, MemberFormulation::displacement})
    for (const auto geometry : {FrameGeometry::linear, FrameGeometry::p_delta, FrameGeometry::corotational})
      all.push_back({.formulation = formulation,
                     .geometry = geometry,
                     .axial_force = geometry == FrameGeometry::p_delta ? -5e5 : 0});
  all.push_back({.rule = hinge_radau(0.1, 0.05, HingeInterior::elastic),
                 .geometry = FrameGeometry::corotational,
                 .shear_stiffness_y = 3e8,
                 .shear_stiffness_z = 2e8});
  return all;
}

TEST(FibreMember, TheTangentIsTheDerivativeOfTheConvergedForce) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(1);
    for (const FibreMemberOptions& options : all_options()) {
      const FibreMember member = member_of(reinforced(dimension == 2 ? 0 : 4), options, dimension);
      FibreMember::State state = member.undeformed();
      FibreMember::Iterate iterate;
      // Into cracking and yielding, then a random state nearby.
      for (const double size : {1e-3, 3e-3, -2e-3}) {
        member.begin(state, iterate);
        converged(member, state, iterate, random_displacements(random, size, size, dimension));
        member.accept(state, iterate, 0);
      }
      EXPECT_GT(member.dissipated(state), 1);
      const Vector12 u = random_displacements(random, 2e-3, 2e-3, dimension);
      member.begin(state, iterate);
      const Result result = converged(member, state, iterate, u);
      EXPECT_EQ(result.tangent, result.tangent.transpose());
      Matrix12 difference = Matrix12::Zero();
      const double h = 1e-8;
      for (int i = 0; i < 12; ++i) {
        if (dimension == 2 && i % 2 == 1) continue;
        const Vector12 step = h * Vector12::Unit(i);
        auto up = iterate, down = iterate;
        difference.col(i) =
            (converged(member, state, up, u + step).force - converged(member, state, down, u - step).force) / (2 * h);
      }
      EXPECT_LT(distance(result.tangent, difference), 1e-5)
          << dimension << " " << static_cast<int>(options.formulation) << static_cast<int>(options.geometry);
    }
  }
}

TEST(FibreMember, ElasticFibresAreAnElasticBeam) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (const int dimension : {2, 3})
    for (const double shear_area : {infinite, 0.12})
      for (const auto formulation : {MemberFormulation::force, MemberFormulation::displacement}) {
        if (formulation == MemberFormulation::displacement && shear_area < infinite) continue;
        const SharedSection section = elastic(dimension == 2 ? 0 : 12);
        const FibreMember member = member_of(section,
                                             {.rule = lobatto(3),
                                              .formulation = formulation,
                                              .shear_stiffness_y = 12e9 * shear_area,
                                              .shear_stiffness_z = 12e9 * 0.7 * shear_area},
                                             dimension);
        BeamOptions orientation{.start_offset = {0.1, 0, 0.2}, .end_offset = {-0.05, 0, -0.3}};
        if (dimension == 3) orientation.start_offset.y() = 0.15, orientation.reference = Vector3d(0.2, 1, 0.3);
        const Beam beam(start, dimension == 2 ? end_in_plane : end_in_space, elastic_section(*section, shear_area),
                        {.young = 30e9, .shear = 12e9}, orientation);
        std::mt19937 random(2);
        const Vector12 u = random_displacements(random, 0.01, 0.01, dimension);
        FibreMember::Iterate iterate;
        const FibreMember::State rest = member.undeformed();
        member.begin(rest, iterate);
        const Result result = converged(member, rest, iterate, u);
        Matrix12 expected = beam.stiffness();
        if (dimension == 2)
          for (int i = 1; i < 12; i += 2) expected.row(i).setZero(), expected.col(i).setZero();
        EXPECT_LT(distance(result.tangent, expected), 1e-12);
        EXPECT_LT(distance(result.force, expected * u), 1e-11);
        EXPECT_LT(distance(member.end_forces(iterate.linearized_forces(), u), beam.end_forces(u)), 1e-11);
        if (dimension == 3) {
          EXPECT_LT(distance(member.initial_stiffness(), expected), 1e-12);
        }
      }
}

TEST(FibreMember, ElasticFibresAreACorotationalBeamInLargeRotations) {
  for (const int dimension : {2, 3}) {
    const SharedSection section = elastic(dimension == 2 ? 0 : 12);
    const FibreMember member = member_of(section, {.geometry = FrameGeometry::corotational}, dimension);
    BeamOptions orientation{.start_offset = {0.1, 0, 0.2}, .end_offset = {-0.05, 0, -0.3}};
    if (dimension == 3) orientation.start_offset.y() = 0.15, orientation.reference = Vector3d(0.2, 1, 0.3);
    const CorotationalBeam beam(start, dimension == 2 ? end_in_plane : end_in_space,
                                elastic_section(*section, std::numeric_limits<double>::infinity()),
                                {.young = 30e9, .shear = 12e9}, orientation, dimension);
    std::mt19937 random(3);
    for (int i = 0; i < 5; ++i) {
      // Small deformations on a large rotation about the origin.
      const Vector3d turn = random_displacements(random, 0, 1, dimension).segment<3>(3);
      Vector12 u = random_displacements(random, 0.003, 0.003, dimension);
      for (const int node : {0, 6}) {
        u.segment<3>(node) += finite_rotation::turned_by(
            turn, node == 0 ? start : Vector3d(dimension == 2 ? end_in_plane : end_in_space));
        u.segment<3>(node + 3) += turn;
      }
      FibreMember::Iterate iterate;
      const FibreMember::State rest = member.undeformed();
      member.begin(rest, iterate);
      const Result result = converged(member, rest, iterate, u);
      Matrix12 tangent;
      const CorotationalBeam::Response expected = beam.evaluate(u, tangent);
      EXPECT_LT(distance(result.force, expected.force), 1e-10);
      EXPECT_LT(distance(result.tangent, tangent), 1e-10);
      EXPECT_LT(distance(member.end_forces(iterate.linearized_forces(), u), beam.end_forces(u)), 1e-10);
    }
  }
}

TEST(FibreMember, AxialForceAtRestPullsTheChordBack) {
  FibreMemberOptions options{.geometry = FrameGeometry::p_delta, .axial_force = 1e6};
  const FibreMember linear(Vector3d::Zero(), {0, 0, 4}, {}, elastic(0), {}, 2);
  const FibreMember tense(Vector3d::Zero(), {0, 0, 4}, {}, elastic(0), options, 2);
  Vector12 u = Vector12::Zero();
  u[6] = 0.01;
  FibreMember::Iterate a, b;
  linear.begin(linear.undeformed(), a), tense.begin(tense.undeformed(), b);
  const Vector12 excess =
      converged(tense, tense.undeformed(), b, u).force - converged(linear, linear.undeformed(), a, u).force;
  EXPECT_NEAR(excess[6], 1e6 * 0.01 / 4, 1e-6);
  EXPECT_NEAR(excess[0], -1e6 * 0.01 / 4, 1e-6);
  EXPECT_NEAR(tense.potential(u), 1e6 * 0.01 * 0.01 / 8, 1e-9);
  EXPECT_EQ(tense.initial_stiffness(), linear.initial_stiffness());
}

TEST(FibreMember, ConvergedResultsDependOnStateAndDisplacementsOnly) {
  const FibreMember member = member_of(reinforced(0), {.geometry = FrameGeometry::corotational}, 2);
  std::mt19937 random(4);
  const Vector12 u = random_displacements(random, 4e-3, 4e-3, 2);
  const FibreMember::State rest = member.undeformed();
  FibreMember::Iterate direct, detour;
  member.begin(rest, direct), member.begin(rest, detour);
  const Result expected = converged(member, rest, direct, u);
  converged(member, rest, detour, random_displacements(random, 4e-3, 4e-3, 2));
  EXPECT_LT(distance(converged(member, rest, detour, u).force, expected.force), 1e-9);
  // The correction of a converged iterate is zero, and a repeated one without effect.
  EXPECT_LT(member.update(detour, u), 1e-12);
  EXPECT_EQ(member.update(detour, u), 0);
}

/// A parabola of displacements in time with its extremum at t = 0.55; a member by displacements has section
/// deformations in proportion.
TEST(FibreMember, FibresFollowReversalsInsideAStep) {
  const FibreMember member(Vector3d::Zero(), {0, 0, 3}, {}, reinforced(0),
                           {.rule = lobatto(3), .formulation = MemberFormulation::displacement}, 2);
  const auto at = [](double t) {
    Vector12 u = Vector12::Zero();
    u[6] = 0.05 - 0.1 * (t - 0.55) * (t - 0.55);
    return u;
  };
  FibreMember::Iterate iterate;
  Vector12 force;
  Matrix12 tangent;
  const auto go_to = [&](FibreMember::State& state, double t) {
    member.begin(state, iterate);
    member.linearize(state, iterate, at(t), force, tangent);
    return member.accept(state, iterate, 1e-6);
  };
  FibreMember::State state = member.undeformed();
  EXPECT_FALSE(go_to(state, 0));
  FibreMember::State expected = state, straight = state;
  member.begin(state, iterate);
  // Stages are not in the order of time.
  for (const double t : {0.5, 83.0 / 250, 31.0 / 50, 17.0 / 20, 1.0}) {
    member.linearize(state, iterate, at(t), force, tangent);
    member.record_stage(iterate, t);
  }
  EXPECT_TRUE(member.accept(state, iterate, 1e-6));
  go_to(expected, 0.55), go_to(expected, 1), go_to(straight, 1);
  EXPECT_NEAR(member.dissipated(state), member.dissipated(expected), 1e-9 * member.dissipated(expected));
  EXPECT_NEAR(member.stored(state), member.stored(expected), 1e-9 * member.stored(expected));
  EXPECT_GT(std::abs(member.dissipated(straight) - member.dissipated(expected)), 1e-3 * member.dissipated(expected));
  const auto force_at = [&](const FibreMember::State& from) {
    member.begin(from, iterate);
    member.linearize(from, iterate, at(0.3), force, tangent);
    return force[6];
  };
  const double probe = force_at(expected);
  EXPECT_NEAR(force_at(state), probe, 1e-9 * std::abs(probe));
  EXPECT_GT(std::abs(force_at(straight) - probe), 1e-3 * std::abs(probe));
}

TEST(FibreMember, TheLargestStrainIsThatOfTheOuterFibres) {
  const FibreMember member(Vector3d::Zero(), {0, 0, 3}, {}, elastic(0),
                           {.formulation = MemberFormulation::displacement}, 2);
  FibreMember::State state = member.undeformed();
  FibreMember::Iterate iterate;
  for (const double turn : {0.01, 0.002}) {
    Vector12 u = Vector12::Zero();
    u[10] = turn, u[8] = 0.003;
    member.begin(state, iterate);
    converged(member, state, iterate, u);
    member.accept(state, iterate, 0);
  }
  // Curvature 4 theta/L at the end; the outer of 20 layers of 0.5 m.
  EXPECT_NEAR(member.largest_strain(state), 0.001 + 0.2375 * 4 * 0.01 / 3, 1e-12);
}

TEST(FibreMember, ArchivedStatesContinueBitwise) {
  const FibreMember member = member_of(reinforced(4), {.geometry = FrameGeometry::corotational}, 3);
  std::mt19937 random(5);
  FibreMember::State state = member.undeformed();
  FibreMember::Iterate iterate;
  const auto step = [&](FibreMember::State& of) {
    member.begin(of, iterate);
    const Result result = converged(member, of, iterate, random_displacements(random, 5e-3, 5e-3, 3));
    member.accept(of, iterate, 0);
    return result.force;
  };
  for (int i = 0; i < 5; ++i) step(state);
  Archive written;
  state.archive(written);
  Archive read(written.bytes());
  FibreMember::State copy = member.undeformed();
  copy.archive(read);
  read.expect_end();
  const std::mt19937 before = random;
  const Vector12 expected = step(state);
  random = before;
  EXPECT_EQ(step(copy), expected);
  EXPECT_EQ(member.dissipated(copy), member.dissipated(state));
  EXPECT_EQ(member.stored(copy), member.stored(state));
  EXPECT_EQ(member.largest_strain(copy), member.largest_strain(state));
}

// Fibres without tension: a joint that opens has no stiffness at all.
TEST(FibreMember, SectionsWithoutStiffnessHaveExactForces) {
  const auto section = std::make_shared<sections::FibreSection>(
      std::vector{materials::make_material({.law = "elastic_no_tension", .values = {{"E", 30e9}}})},
      sections::rectangle(0.3, 0.5, 0, 20));
  for (const auto formulation : {MemberFormulation::force, MemberFormulation::displacement}) {
    const FibreMember member(Vector3d::Zero(), {0, 0, 3}, {}, section, {.formulation = formulation}, 2);
    const FibreMember::State state = member.undeformed();
    FibreMember::Iterate iterate;
    member.begin(state, iterate);
    Vector12 u = Vector12::Zero();
    u[8] = 0.003;
    const Result open = converged(member, state, iterate, u);
    EXPECT_LT(open.force.cwiseAbs().maxCoeff(), 1);
    EXPECT_TRUE(open.tangent.allFinite());
    // Closed again.
    u[8] = -0.003;
    const Result closed = converged(member, state, iterate, u);
    EXPECT_NEAR(closed.force[8], -30e9 * 0.15 * 0.001, 1);
  }
}

TEST(FibreMember, InvalidMembersAreRejected) {
  const auto rejection = [](const BeamOptions& orientation, const FibreMemberOptions& options, int dimension = 2) {
    return test::refusal(
        [&] { FibreMember(Vector3d::Zero(), {0, 0, 3}, orientation, reinforced(0), options, dimension); });
  };
  EXPECT_TRUE(test::mentions(rejection({.end_releases = {Dof::ry}}, {}), {"releases"}));
  EXPECT_TRUE(test::mentions(rejection({.axial_force = 1}, {}), {"axial force"}));
  EXPECT_TRUE(test::mentions(rejection({}, {.axial_force = 1}), {"p_delta"}));
  EXPECT_TRUE(test::mentions(rejection({}, {.rule = {}}), {"point"}));
  EXPECT_TRUE(test::mentions(rejection({}, {.shear_stiffness_z = -1}), {"shear stiffness", "-1"}));
  EXPECT_TRUE(test::mentions(rejection({}, {.formulation = MemberFormulation::displacement, .shear_stiffness_z = 1}),
                             {"shear", "forces"}));
  EXPECT_TRUE(test::mentions(rejection({}, {.rule = hinge_radau(0.1, 0.1, HingeInterior::elastic),
                                            .formulation = MemberFormulation::displacement}),
                             {"elastic", "forces"}));
  EXPECT_TRUE(test::mentions(rejection({}, {}, 3), {"torsion stiffness", "0"}));
  // Layers at y = 0 cannot bend about z.
  EXPECT_TRUE(test::mentions(rejection({}, {.torsion_stiffness = 1}, 3), {"bending", "z"}));
  const FibreMember member(Vector3d::Zero(), {0, 0, 3}, {}, reinforced(0), {}, 2);
  FibreMember::Iterate iterate;
  member.begin(member.undeformed(), iterate);
  EXPECT_TRUE(test::mentions(test::refusal([&] { member.record_stage(iterate, 0); }), {"stage", "0"}));
}

}  // namespace fibre_member_test
}  // namespace pounding
