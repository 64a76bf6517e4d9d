// Frame hinges in isolation: error messages, two yield moments, gravity, names.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include <pounding/core/units.hpp>
#include <pounding/frames/frame_structure.hpp>
#include <pounding/frames/sections.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace hinge_test {

constexpr double yield = 200e3;
const Material concrete{.young = 30e9, .shear = 12.5e9};
const Section square = without_shear_deformation(rectangle_section(0.4, 0.4));

void refused(const std::function<void()>& act, const test::Facts& facts,
             std::source_location line = std::source_location::current()) {
  test::expect_message(test::refusal(act), "", facts, line);
}

// A beam of 6 m between two walls, cut at midspan, where a mass hangs: members "left" and "right".
Frame held_beam(int dimension = 2, const BeamOptions& left = {}) {
  Frame frame(dimension);
  frame.add_node({0, 0, 0}), frame.add_node({3, 0, 0}), frame.add_node({6, 0, 0});
  frame.fix(0), frame.fix(2);
  frame.add_mass(1, 10e3);
  frame.set_name(frame.add_member(0, 1, square, concrete, left), "left");
  frame.set_name(frame.add_member(1, 2, square, concrete), "right");
  return frame;
}

Structure made(const Frame& frame, FrameGeometry geometry = FrameGeometry::linear, bool gravity = false) {
  FrameModel model{.frame = frame, .geometry = geometry};
  model.gravity = gravity;
  return make_structure(std::move(model));
}

TEST(Hinges, RefuseWhatCannotBe) {
  const auto add = [](const Hinge& hinge, int dimension = 2, const BeamOptions& options = {}) {
    return [=] { held_beam(dimension, options).add_hinge(hinge); };
  };
  refused(add({.member = 7, .yield_moment = yield}), {"7", "2"});
  refused(add({.yield_moment = 0}), {"left"});
  refused(add({.yield_moment = yield, .hogging_moment = -1}), {"left"});
  for (const double hardening : {-0.01, 1.0, std::nan("")})
    refused(add({.yield_moment = yield, .hardening = hardening}), {"left", "[0, 1)"});
  refused(add({.yield_moment = yield, .ultimate_rotation = 0}), {"left", "ultimate_rotation"});
  refused(add({.yield_moment = yield, .stiffness = -1}), {"left", "stiffness_factor", "member_length"});
  refused(add({.yield_moment = yield, .stiffness = 1e8, .stiffness_factor = 10}), {"left", "stiffness_factor"});
  refused(add({.about = BendingAxis::z, .yield_moment = yield}), {"left"});
  refused(add({.yield_moment = yield}, 2, {.start_releases = {Dof::ry}}), {"left", "ry"});
  refused(add({.about = BendingAxis::z, .yield_moment = yield}, 3, {.start_releases = {Dof::rz}}), {"left", "rz"});
  refused(add({.yield_moment = yield, .law = hysteresis::BoucWen{}}), {"left", "stiffness_factor"});
  refused(add({.yield_moment = yield, .hogging_moment = yield, .stiffness_factor = 10, .law = hysteresis::BoucWen{}}),
          {"left", "bouc_wen", "hogging_moment"});
  for (const auto& [name, law] : std::vector<std::pair<std::string, hysteresis::HingeLaw>>{
           {"stiffness", hysteresis::BoucWen{.initial_stiffness = 1}},
           {"yield_moment", hysteresis::PeakOriented{.yield_force = yield}},
           {"spring_hardening", hysteresis::MenegottoPinto{.hardening = 0.1}},
           {"negative_yield_force", hysteresis::Bilinear{.negative_yield_force = yield}}})
    refused(add({.yield_moment = yield, .stiffness_factor = 10, .law = law}), {"left", name, "hinge"});
  refused(
      [] {
        Frame frame = held_beam();
        frame.add_hinge({.yield_moment = yield});
        frame.add_hinge({.yield_moment = yield});
      },
      {"left"});
  refused(
      [] {
        Frame frame = held_beam();
        const int tie = frame.add_truss(0, 1, 1e-3, concrete);
        frame.set_name(tie, "tie");
        frame.add_hinge({.member = tie, .yield_moment = yield});
      },
      {"tie"});
}

TEST(Hinges, RefuseStructuresThatTheyCannotStandIn) {
  Frame frame = held_beam();
  frame.add_hinge({.yield_moment = yield});
  refused([&] { made(frame, FrameGeometry::corotational); }, {"geometry: p_delta"});
  FrameModel apart{.frame = frame};
  apart.supports = {{.name = "late", .nodes = {2}, .delay = 0.1}};
  refused([&] { make_structure(apart); }, {"ground_motion"});
  const Structure alike = made(frame);
  refused([&] { alike.supports_along({1, 0, 0}); }, {"wave"});
}

TEST(Hinges, RefuseAContactBetweenTheEndsOfTheirMember) {
  Frame frame(2);
  frame.add_node({0, 0, 0}), frame.add_node({0, 0, 3});
  frame.fix(0);
  frame.add_mass(1, 1e3), frame.add_mass(1, Dof::ry, 10);
  frame.set_name(frame.add_member(0, 1, square, concrete), "c");
  EXPECT_EQ(made(frame).surface->column(2, Side::plus_x, 0).member, 0);
  frame.add_hinge({.yield_moment = yield});
  const auto hit = [&](double elevation) {
    return [&, elevation] { made(frame).surface->column(elevation, Side::plus_x, 0); };
  };
  refused(hit(2), {"c", "parts: 2"});
  refused(hit(0.4), {"c", "parts: 8"});
  frame.add_hinge({.at = MemberEnd::end, .yield_moment = yield});
  refused(hit(2), {"c", "parts: 4"});
  refused(hit(2.9), {"c", "parts: 31"});
}

TEST(Hinges, AreNotHitInTheNextPartEither) {
  Frame frame(2);
  frame.add_node({0, 0, 0}), frame.add_node({0, 0, 3});
  frame.fix(0);
  frame.add_mass(1, 1e3), frame.add_mass(1, Dof::ry, 10);
  const std::vector<int> parts =
      add_member_in_parts(frame, "c", 0, 1, {.section = square, .material = concrete, .parts = 3});
  for (const int node : {2, 3}) frame.add_mass(node, 10), frame.add_mass(node, Dof::ry, 1);
  frame.add_hinge({.member = parts[2], .at = MemberEnd::end, .yield_moment = yield});
  EXPECT_EQ(made(frame).surface->column(1.5, Side::plus_x, 0).member, parts[1]);
  refused([&] { made(frame).surface->column(2.2, Side::plus_x, 0); }, {"members: {c: {parts: 4}}", "c/3"});
}

// A mass of 10 t at midspan: W L/8 = 73.55 kN m at the walls (hogging) and at midspan (sagging).
TEST(Hinges, StandUnderGravityAsFarAsTheyStayElastic) {
  const double moment = 10e3 * standard_gravity * 6 / 8;
  const auto with = [](double sagging, double hogging, double factor = 0) {
    Frame frame = held_beam();
    for (const MemberEnd at : {MemberEnd::start, MemberEnd::end})
      frame.add_hinge(
          {.member = 0, .at = at, .yield_moment = sagging, .hogging_moment = hogging, .stiffness_factor = factor});
    return frame;
  };
  const Structure s = made(with(yield, yield), FrameGeometry::linear, true);
  ASSERT_EQ(s.yielding.size(), 2u);
  EXPECT_EQ(s.yielding[0].name, "left start");
  EXPECT_EQ(s.yielding[0].law, "hinge");
  // The start hogs: a negative moment; the end sags: also a negative one.
  for (const YieldingPart& part : s.yielding)
    EXPECT_NEAR(part.stiffness() * part.at_rest, -moment, 1e-9 * moment) << part.name;
  const Eigen::VectorXd forces = s.forces.rows * s.at_rest + s.forces.at_rest;
  EXPECT_NEAR(forces[2], -moment, 1e-9 * moment);

  EXPECT_NO_THROW(made(with(80e3, 80e3), FrameGeometry::linear, true));
  EXPECT_NO_THROW(made(with(60e3, 80e3), FrameGeometry::linear, false));
  refused([&] { made(with(60e3, 80e3), FrameGeometry::linear, true); }, {"left end", "-73.55 kN m", "-60 kN m"});
  refused([&] { made(with(80e3, 60e3), FrameGeometry::linear, true); }, {"left start", "-73.55 kN m", "-60 kN m"});
}

TEST(Hinges, ALoadBetweenTheEndsCountsAtRest) {
  Frame frame = held_beam();
  for (const int member : {0, 1}) frame.add_member_load(member, {0, 0, -10e3});
  frame.add_hinge({.member = 0, .yield_moment = yield});
  FrameModel model{.frame = frame};
  model.gravity = false;
  const Structure s = make_structure(model);
  EXPECT_NEAR(s.yielding[0].stiffness() * s.yielding[0].at_rest, -10e3 * 36 / 12, 1e-9 * 30e3) << "q l^2/12";
}

// A consistent mass distributes the weight: w l^2/12 at the wall, also in the reported end forces.
TEST(Hinges, AWeightBetweenTheEndsCountsAtRest) {
  Frame frame(2);
  frame.add_node({0, 0, 0}), frame.add_node({3, 0, 0}), frame.add_node({6, 0, 0});
  frame.fix(0), frame.fix(2);
  const Material heavy{.young = 30e9, .density = 2500};
  for (const int node : {0, 1}) frame.add_member(node, node + 1, square, heavy, {.mass = BeamMass::consistent});
  frame.add_hinge({.member = 0, .yield_moment = yield});
  const Structure s = made(frame, FrameGeometry::linear, true);
  const double moment = 2500 * 0.16 * standard_gravity * 36 / 12;
  EXPECT_NEAR(s.yielding[0].stiffness() * s.yielding[0].at_rest, -moment, 1e-9 * moment);
  EXPECT_NEAR((s.forces.rows * s.at_rest + s.forces.at_rest)[2], -moment, 1e-9 * moment);
}

// The Bouc-Wen law has no straight part. Its spring of 20 EI/m in series with 4EI/L of the whole beam takes 20/(20 +
// 4/6) of 73.55 kN m before it softens; see tests/run/rest_test.cpp.
TEST(Hinges, ALawThatIsNeverStraightTakesGravityBelowItsYieldMoment) {
  Frame frame = held_beam();
  const auto bouc_wen = [](double moment) {
    return Hinge{
        .yield_moment = moment, .stiffness_factor = 10, .spring_hardening = 0.02, .law = hysteresis::BoucWen{}};
  };
  frame.add_hinge(bouc_wen(yield));
  const Structure s = made(frame, FrameGeometry::linear, true);
  EXPECT_EQ(s.yielding[0].law, "bouc_wen");
  EXPECT_NEAR(s.yielding[0].stiffness() * s.yielding[0].at_rest, -71.18e3, 5);
  Frame weak = held_beam();
  weak.add_hinge(bouc_wen(70e3));
  refused([&] { made(weak, FrameGeometry::linear, true); }, {"-71.18 kN m", "-70 kN m"});
}

// [sagging, hogging] has the same meaning at both ends, although their moments have opposite signs.
TEST(Hinges, YieldAtTwoMoments) {
  for (const int dimension : {2, 3})
    for (const BendingAxis about : {BendingAxis::y, BendingAxis::z}) {
      if (dimension == 2 && about == BendingAxis::z) continue;
      Frame frame = held_beam(dimension);
      for (const MemberEnd at : {MemberEnd::start, MemberEnd::end})
        frame.add_hinge(
            {.member = 0, .at = at, .about = about, .yield_moment = 150e3, .hogging_moment = 250e3, .hardening = 0.02});
      const Structure s = made(frame);
      const auto unknown = [&](const std::string& name) {
        return static_cast<int>(std::find(s.unknowns.begin(), s.unknowns.end(), "node 1 " + name) - s.unknowns.begin());
      };
      Eigen::VectorXd sag = Eigen::VectorXd::Zero(s.size());
      // Down along z or along -y with the far end level: the start hogs and the far end sags.
      sag[unknown(about == BendingAxis::y ? "uz" : "uy")] = -1;
      for (int i = 0; i < 2; ++i) {
        const LoadedSpring spring(s.yielding[i].spring());
        const double k = spring->stiffness(), d = s.yielding[i].deformation.dot(sag);
        const double yields_at = *spring.corner(d * 1e3);
        EXPECT_NEAR(std::abs(k * yields_at), i == 0 ? 250e3 : 150e3, 1e-6) << dimension << static_cast<int>(about) << i;
        EXPECT_NEAR(std::abs(k * *spring.corner(-d * 1e3)), i == 0 ? 150e3 : 250e3, 1e-6);
        EXPECT_NEAR(spring->yield_deformation(), 150e3 / k, 1e-15);
      }
    }
}

// The same for a law with separate parameters for hogging: the maximum moment is 20 mrad after yield sagging, 50 mrad
// hogging.
TEST(Hinges, DeteriorateByParametersOfTheirSides) {
  hysteresis::ImkBilinear law;
  law.dp = 0.02;
  law.dp_neg = 0.05;
  law.dpc = 0.2;
  Frame frame = held_beam();
  for (const MemberEnd at : {MemberEnd::start, MemberEnd::end})
    frame.add_hinge({.member = 0,
                     .at = at,
                     .yield_moment = 150e3,
                     .hogging_moment = 250e3,
                     .hardening = 0.02,
                     .stiffness_factor = 10,
                     .law = law});
  const Structure s = made(frame);
  const auto down = std::find(s.unknowns.begin(), s.unknowns.end(), "node 1 uz") - s.unknowns.begin();
  for (int i = 0; i < 2; ++i) {
    // Down with the far end level: the start hogs and the far end sags.
    const double way = -std::copysign(1.0, s.yielding[i].deformation.dot(Eigen::VectorXd::Unit(s.size(), down)));
    for (const bool hogs : {true, false}) {
      LoadedSpring spring(s.yielding[i].spring());
      const double to = hogs == (i == 0) ? way : -way, yields_at = *spring.corner(to);
      EXPECT_NEAR(std::abs(spring->stiffness() * yields_at), hogs ? 250e3 : 150e3, 1e-6);
      spring.load(1.01 * yields_at);
      EXPECT_NEAR(std::abs(*spring.corner(to) - yields_at), hogs ? 0.05 : 0.02, 1e-12);
    }
  }
}

TEST(Hinges, AreNamedByMemberEndAndAxis) {
  Frame plane = held_beam(), space = held_beam(3);
  plane.add_hinge({.member = 1, .at = MemberEnd::end, .yield_moment = yield});
  space.add_hinge(
      {.member = 0, .about = BendingAxis::z, .yield_moment = yield, .stiffness_factor = 5, .member_length = 6});
  EXPECT_EQ(plane.hinge_name(0), "right end");
  EXPECT_EQ(space.hinge_name(0), "left start z");
  EXPECT_DOUBLE_EQ(space.bending_stiffness(space.hinges()[0]), 6 * 30e9 * square.inertia_z / 6);
  const Structure s = made(space);
  EXPECT_EQ(s.yielding[0].law, "bilinear");
  EXPECT_DOUBLE_EQ(s.yielding[0].stiffness(), 5 * 30e9 * square.inertia_z);
}

// Such a law checks its parameters against the stiffness of the spring.
TEST(Hinges, ALawIsCheckedWithItsStiffness) {
  const hysteresis::PeakOriented cracking{.cracking_force = 0.5 * yield, .deformation_at_yield = 0.03};
  Frame frame = held_beam();
  frame.add_hinge({.yield_moment = yield, .stiffness_factor = 10, .law = cracking});
  EXPECT_EQ(made(frame).yielding[0].law, "peak_oriented");
  refused([&] { held_beam().add_hinge({.yield_moment = yield, .stiffness = yield / 0.04, .law = cracking}); },
          {"yield_rotation", "yield_moment", "0.03", "0.04", "left"});
}

TEST(Hinges, LawsSpeakOfMoments) {
  const auto add = [](const hysteresis::HingeLaw& law, double spring_hardening = 0) {
    return [=] {
      held_beam().add_hinge(
          {.yield_moment = yield, .stiffness = yield / 0.01, .spring_hardening = spring_hardening, .law = law});
    };
  };
  using hysteresis::PeakOriented;
  refused(add(PeakOriented{.cracking_force = 1e5}), {"left", "peak_oriented", "cracking_moment", "yield_rotation"});
  refused(add(PeakOriented{.cracking_force = 3e5, .deformation_at_yield = 0.03}),
          {"cracking_moment is 3e+05", "yield_moment", "2e+05"});
  refused(add(PeakOriented{.cracking_force = 1e5, .deformation_at_yield = 0.005}),
          {"yield_rotation is 0.005", "yield_moment/stiffness", "0.01"});
  refused(add(PeakOriented{.cracking_force = 1e5, .deformation_at_yield = 0.03}, 0.5), {"spring_hardening is 0.5"});
  refused(add(hysteresis::BoucWen{.exponent = -1}), {"left", "exponent", "-1"});
}

hysteresis::Hysteretic backbone() {
  hysteresis::Hysteretic law;
  law.s2p = 300e3, law.e2p = 0.03, law.s3p = 250e3, law.e3p = 0.06;
  law.s2n = -150e3, law.s3n = -100e3;
  return law;
}

// The first points are those of the moments and the stiffness of the hinge; p is sagging at both ends of a member.
TEST(Hinges, ABackboneStartsAtTheYieldMoment) {
  constexpr double k = yield / 0.01, hogging = 0.5 * yield;
  for (const MemberEnd end : {MemberEnd::start, MemberEnd::end}) {
    Frame frame = held_beam();
    frame.add_hinge({.at = end, .yield_moment = yield, .hogging_moment = hogging, .stiffness = k, .law = backbone()});
    const Structure s = made(frame);
    const LoadedSpring spring(s.yielding[0].spring());
    const double sagging = end == MemberEnd::start ? 1 : -1;
    const auto moment = [&](double d) { return sagging * (k * sagging * d + spring.evaluate({sagging * d, 0}).force); };
    EXPECT_NEAR(moment(0.02), 0.5 * (yield + 300e3), 1e-6);
    EXPECT_NEAR(moment(0.045), 275e3, 1e-6);
    EXPECT_NEAR(moment(-0.005), -hogging, 1e-6);
    EXPECT_NEAR(moment(-0.03), -150e3, 1e-6);
    EXPECT_NEAR(moment(-0.045), -125e3, 1e-6);
    EXPECT_NEAR(s.yielding[0].parameter("spring_hardening"), (300e3 - yield) / 0.02 / k, 1e-12);
    const YieldLimits& limits = s.yielding[0].limits;
    EXPECT_EQ(sagging > 0 ? limits.positive_force : limits.negative_force, yield);
    EXPECT_EQ(sagging > 0 ? limits.negative_force : limits.positive_force, hogging);
  }
  const auto add = [](const Hinge& hinge) { return [=] { held_beam().add_hinge(hinge); }; };
  refused(add({.yield_moment = yield, .hardening = 0.1, .stiffness = k, .law = backbone()}),
          {"left", "hysteretic", "remove hardening"});
  refused(add({.yield_moment = yield, .stiffness = yield / 0.04, .law = backbone()}), {"left", "e2p", "0.04"});
  hysteresis::Hysteretic set = backbone();
  set.s1n = -1e5;
  refused(add({.yield_moment = yield, .stiffness = k, .law = set}), {"left", "s1n", "hinge"});
}

const std::vector<hysteresis::HingeLaw> every_law{hysteresis::Bilinear{}, hysteresis::MenegottoPinto{},
                                                  hysteresis::BoucWen{}, hysteresis::PeakOriented{}};

// Ratio of the stiffness far beyond yield to the initial one.
double kept(const YieldingPart& part) {
  const LoadedSpring spring(part.spring());
  return 1 + spring.evaluate({1e3 * part.yield_deformation(), 0}).by_penetration / part.stiffness();
}

// A spring k and a member end K = 6EI/L in double curvature have the stiffness K k/(K + k), and K b k/(K + b k) after
// yield.
TEST(Hinges, HardeningIsTheRatioOfTheMemberEndInEveryForm) {
  constexpr double a = 0.02, of_member = 6 * 30e9 * 0.4 * 0.4 * 0.4 * 0.4 / 12 / 3;
  for (const double factor : {0.5, 10.0, 300.0}) {
    const double k = factor * of_member, b = a / (1 + factor * (1 - a));
    EXPECT_NEAR((of_member * b * k / (of_member + b * k)) / (of_member * k / (of_member + k)), a, 1e-15);
    std::vector<Hinge> forms{{.yield_moment = yield, .hardening = a, .stiffness_factor = factor}};
    for (const hysteresis::HingeLaw& law : every_law)
      forms.push_back({.yield_moment = yield, .hardening = a, .stiffness_factor = factor, .law = law});
    for (const Hinge& form : forms) {
      Frame frame = held_beam();
      frame.add_hinge(form);
      const Structure s = made(frame);
      const YieldingPart& hinge = s.yielding[0];
      EXPECT_NEAR(kept(hinge), b, 1e-6 * b) << hinge.law;
      EXPECT_NEAR(hinge.parameter("spring_hardening"), b, 1e-15) << hinge.law;
      EXPECT_NEAR(hinge.parameter("end_stiffness"), of_member * k / (of_member + k), 1e-6 * of_member) << hinge.law;
      EXPECT_NEAR(hinge.parameter("end_tangent"), a * hinge.parameter("end_stiffness"), 1e-6 * a * of_member)
          << hinge.law;
    }
  }
  Frame rigid = held_beam();
  rigid.add_hinge({.yield_moment = yield, .hardening = a});
  const Structure s = made(rigid);
  EXPECT_NEAR(s.yielding[0].parameter("end_tangent"), a * of_member, 1e-6 * a * of_member);
}

TEST(Hinges, SpringHardeningIsThatOfTheBareSpring) {
  for (const hysteresis::HingeLaw& law : every_law) {
    Frame frame = held_beam();
    frame.add_hinge({.yield_moment = yield, .stiffness_factor = 10, .spring_hardening = 0.02, .law = law});
    const Structure s = made(frame);
    EXPECT_NEAR(kept(s.yielding[0]), 0.02, 1e-8) << s.yielding[0].law;
    EXPECT_NEAR(s.yielding[0].parameter("hardening"), 0.02 * 11 / 1.2, 1e-12) << s.yielding[0].law;
  }
}

// Ductility is the rotation of the member end over its yield rotation My L/4EI: 1 + 4EI p/(My L) without hardening,
// with plastic rotation p.
TEST(Hinges, DuctilityHasOneDefinition) {
  constexpr double of_end = 4 * 30e9 * 0.4 * 0.4 * 0.4 * 0.4 / 12 / 3, plastic = 0.01;
  for (const double factor : {0.0, 0.5, 10.0, 1e6}) {
    Frame frame = held_beam();
    frame.add_hinge({.yield_moment = yield, .stiffness_factor = factor});
    const Structure s = made(frame);
    const YieldingPart& hinge = s.yielding[0];
    const double at_yield = hinge.yield_deformation();
    EXPECT_NEAR(hinge.limits.ductility({0, at_yield + plastic}, {0, yield}), 1 + plastic / (yield / of_end), 1e-9)
        << factor;
    EXPECT_NEAR(hinge.limits.ductility({-0.5 * at_yield, 0}, {-0.5 * yield, 0}), 0.5, 1e-12) << factor;
  }
  // The other end of the left member is released: 3EI/L.
  Frame released = held_beam(2, {.end_releases = {Dof::ry}});
  released.add_hinge({.yield_moment = yield, .stiffness_factor = 10, .member_length = 3});
  const Structure s = made(released);
  EXPECT_NEAR(s.yielding[0].limits.ductility({0, s.yielding[0].yield_deformation() + plastic}, {0, yield}),
              1 + plastic / (yield / (0.75 * of_end)), 1e-9);
}

TEST(Hinges, RefuseTwoMeaningsOfHardening) {
  const auto add = [](const Hinge& hinge) { return [=] { held_beam().add_hinge(hinge); }; };
  refused(add({.yield_moment = yield, .spring_hardening = 0.02}), {"left", "spring_hardening", "stiffness_factor"});
  refused(add({.yield_moment = yield, .hardening = 0.1, .stiffness_factor = 10, .spring_hardening = 0.02}),
          {"left", "spring_hardening"});
  for (const double value : {-0.01, 1.0, std::nan("")}) {
    refused(add({.yield_moment = yield, .hardening = value, .stiffness_factor = 10, .law = hysteresis::BoucWen{}}),
            {"left", "[0, 1)"});
    refused(add({.yield_moment = yield, .stiffness_factor = 10, .spring_hardening = value}),
            {"left", "[0, 1)", "spring_hardening"});
  }
}

TEST(Hinges, RigidPlasticOnesAddNoStiffness) {
  Frame frame = held_beam();
  const Structure without = made(frame);
  for (const int member : {0, 1})
    for (const MemberEnd at : {MemberEnd::start, MemberEnd::end})
      frame.add_hinge({.member = member, .at = at, .yield_moment = yield, .hardening = 0.03});
  EXPECT_EQ((made(frame).stiffness - without.stiffness).norm(), 0);
}

TEST(Hinges, KeepAJointInPlaceWhoseEndsAllYield) {
  for (const bool holds : {false, true}) {  // whether the beam stays elastic at the right column
    Frame frame(2);
    frame.add_node({0, 0, 0}), frame.add_node({0, 0, 3.5}), frame.add_node({6, 0, 3.5}), frame.add_node({6, 0, 0});
    frame.fix(0), frame.fix(3);
    frame.add_mass(1, 20e3), frame.add_mass(2, 20e3);
    const int left = frame.add_member(0, 1, square, concrete), beam = frame.add_member(1, 2, square, concrete),
              right = frame.add_member(3, 2, square, concrete);
    for (const int member : {left, beam, right})
      for (const MemberEnd at : {MemberEnd::start, MemberEnd::end})
        if (!holds || member != beam || at == MemberEnd::start)
          frame.add_hinge({.member = member, .at = at, .yield_moment = yield});
    const Structure portal = made(frame);
    for (int i = 0; i < static_cast<int>(portal.yielding.size()); ++i) {
      const Hinge& hinge = frame.hinges()[i];
      const auto [start, end] = frame.ends(hinge.member);
      const int node = hinge.at == MemberEnd::start ? start : end;
      EXPECT_NEAR(kept(portal.yielding[i]), node == 1 || (node == 2 && !holds) ? 1e-8 : 0, 1e-15)
          << frame.hinge_name(i) << holds;
    }
  }
}

TEST(Hinges, KeepTheirHardeningAtSuchAJoint) {
  Frame frame = held_beam();
  frame.add_hinge(
      {.member = 0, .at = MemberEnd::end, .yield_moment = yield, .stiffness_factor = 10, .spring_hardening = 0.02});
  frame.add_hinge({.member = 1, .at = MemberEnd::start, .yield_moment = yield, .stiffness_factor = 10});
  const Structure beam = made(frame);
  EXPECT_NEAR(kept(beam.yielding[0]), 0.02, 1e-15);
  EXPECT_NEAR(kept(beam.yielding[1]), 0, 1e-15);
}

}  // namespace hinge_test
}  // namespace pounding
