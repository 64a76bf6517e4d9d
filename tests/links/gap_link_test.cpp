// A gap link in isolation: the test acts as the integrator and passes one accepted state after another.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include <pounding/links/gap_link.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace gap_link_test {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A user's law: F = k d + c d', with a coefficient calibrated at touch so that touches can be distinguished.
struct MyLaw {
  static constexpr std::string_view name = "my_law";
  double stiffness = 1000;
  double damping_by_speed = 10;

  void check() const {
    if (!(stiffness > 0)) throw std::invalid_argument(std::string(name) + " needs a positive stiffness");
  }
  double damping_for(double closing_speed) const { return damping_by_speed * closing_speed; }
  laws::Response contact(double penetration, double rate, const laws::Impact& impact) const noexcept {
    return {stiffness * penetration + impact.damping * rate, stiffness, impact.damping};
  }
};

/// MyLaw that may pull.
struct MyStickyLaw : MyLaw {
  static constexpr bool may_pull = true;
};

/// MyLaw that adds the penetration at the end of the force to the gap.
struct MyDentedLaw : MyLaw {
  static constexpr bool leaves_indentation = true;
};

LinkStep step_between(double begin, double end, const LinkMotion& from, const LinkMotion& to) {
  return {.begin = begin, .end = end, .motion_begin = from, .motion_middle = {}, .motion_end = to};
}

/// Touched at time 0 with a closing speed of 2 m/s.
template <class Law = MyLaw>
GapLink<Law> touched() {
  GapLink<Law> link(Law{}, 0.1, 3);
  link.on_event(0, 0, {0, 2});
  return link;
}

/// touched(), then reversed at a penetration of 0.2 m.
template <class Law = MyLaw>
GapLink<Law> reversed() {
  GapLink<Law> link = touched<Law>();
  link.accept(step_between(0, 1, {0, 2}, {0.2, 0}));
  link.on_event(0, 1, {0.2, 0});
  return link;
}

void expect_same(const laws::Response& a, const laws::Response& b) {
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.by_penetration, b.by_penetration);
  EXPECT_EQ(a.by_rate, b.by_rate);
}

TEST(GapLink, TakesALawThatTheLibraryDoesNotKnow) {
  GapLink<MyLaw> link = touched();
  const laws::Response answer = link.evaluate({0.01, 0.5});
  EXPECT_DOUBLE_EQ(answer.force, 1000 * 0.01 + 10 * 2 * 0.5);
  EXPECT_DOUBLE_EQ(answer.by_penetration, 1000);
  EXPECT_DOUBLE_EQ(answer.by_rate, 20);
}

TEST(GapLink, ActsWithoutTensionUnlessItsLawMayPull) {
  EXPECT_EQ(GapLink<MyLaw>(MyLaw{}, 0.1).acting_force(-3), 0);
  EXPECT_EQ(GapLink<MyLaw>(MyLaw{}, 0.1).acting_force(2), 2);
  EXPECT_EQ(GapLink<MyStickyLaw>(MyStickyLaw{}, 0.1).acting_force(-3), -3);
}

TEST(GapLink, RefusesWhatItsLawRefuses) {
  try {
    GapLink<MyLaw>({.stiffness = -1}, 0.1);
    FAIL() << "a negative stiffness was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"my_law"}));
  }
}

TEST(GapLink, OpenGapHasExactlyNoForceAndNoSlopes) {
  const GapLink<MyLaw> link(MyLaw{}, 0.1);
  for (const LinkMotion& motion :
       {LinkMotion{-0.05, 3}, LinkMotion{0, 3}, LinkMotion{0.05, 3}, LinkMotion{-1e-300, -3}})
    expect_same(link.evaluate(motion), {0, 0, 0});
}

TEST(GapLink, MeasuresPenetrationFromTheGap) {
  const GapLink<MyLaw> link(MyLaw{}, 0.1);
  EXPECT_DOUBLE_EQ(link.penetration(0), -0.1);
  EXPECT_DOUBLE_EQ(link.penetration(0.25), 0.15);
}

TEST(GapLink, WithoutAGapAnswersPressureOnly) {
  GapLink<MyLaw> link(MyLaw{}, 0);
  EXPECT_EQ(link.phase(), ContactPhase::open);
  EXPECT_GT(link.event_functions({-1e-6, 1}, 0)[0], 0);
  EXPECT_LT(link.event_functions({1e-6, 1}, 0)[0], 0);
  expect_same(link.evaluate({-1e-6, -1}), {0, 0, 0});
  link.on_event(0, 0, {0, 2});
  EXPECT_GT(link.evaluate({0.01, 0}).force, 0);
}

TEST(GapLink, WalksFromTouchThroughReversalToSeparation) {
  GapLink<MyStickyLaw> link(MyStickyLaw{}, 0.1, 3);
  EXPECT_EQ(link.phase(), ContactPhase::open);
  EXPECT_TRUE(link.impacts().empty());
  link.on_event(0, 5, {0, 2});
  EXPECT_EQ(link.phase(), ContactPhase::approach);
  ASSERT_EQ(link.impacts().size(), 1u);
  EXPECT_TRUE(std::isnan(link.impacts()[0].t_end)) << "an unfinished impact has no end";
  link.on_event(0, 6, {0.2, 0});
  EXPECT_EQ(link.phase(), ContactPhase::restitution);
  link.on_event(0, 7, {0, -1.5});
  EXPECT_EQ(link.phase(), ContactPhase::open);

  const ImpactRow& row = link.impacts()[0];
  EXPECT_EQ(row.link, 3);
  EXPECT_EQ(row.t_start, 5);
  EXPECT_EQ(row.t_end, 7);
  EXPECT_EQ(row.t_release, 7);
  EXPECT_EQ(row.v_approach, 2);
  EXPECT_EQ(row.v_separation, 1.5);
  EXPECT_EQ(row.restitution, 0.75);
  expect_same(link.evaluate({0.01, 1}), {0, 0, 0});
}

TEST(GapLink, GoesSlackWhereItsForceWouldPullAndOpensAtZeroPenetration) {
  GapLink<MyLaw> link = reversed();
  link.on_event(1, 2, {0.04, -2});
  EXPECT_EQ(link.phase(), ContactPhase::slack);
  expect_same(link.evaluate({0.04, -2}), {0, 0, 0});
  expect_same(link.evaluate({0.04, 5}), {0, 0, 0});
  link.on_event(0, 3, {0, -1});
  EXPECT_EQ(link.phase(), ContactPhase::open);
  EXPECT_EQ(link.impacts()[0].t_release, 2);
  EXPECT_EQ(link.impacts()[0].t_end, 3);
}

// After the release the spring of adams_impact presses again at 0.23 mm. A long step ends beyond the separation, where
// a small penetration carries the sign. It must be detected even if it is smaller than the round-off of bodies that
// moved by metres.
TEST(GapLink, SeesBeyondTheSeparationThatItsForceCameBack) {
  GapLink<laws::AdamsImpact> link(
      {.stiffness = 4.98847907e11, .depth = 1.1035778e-3, .damping_coefficient = 9.1e7, .reduced_mass = 8182}, 0);
  link.on_event(0, 0, {0, 3.545});
  LinkStep pressed;
  pressed.begin = 0, pressed.end = 5e-4;
  pressed.motion_begin = {0, 3.545};
  pressed.motion_middle = pressed.motion_end = {8.1e-4, 0};
  link.accept(pressed);
  link.on_event(0, 5e-4, {8.1e-4, 0});
  link.on_event(1, 1e-3, {7.4e-4, -0.148});
  ASSERT_EQ(link.phase(), ContactPhase::slack);
  const LinkMotion slack{7e-4, -0.148}, pressing{1e-4, -0.148}, beyond{-1.5e-4, -0.148}, rounding{5e-12, 5e-12};
  EXPECT_GT(link.event_functions(slack, 0)[1], link.force_event_noise(slack, rounding));
  for (const LinkMotion& motion : {pressing, beyond})
    EXPECT_LT(link.event_functions(motion, 0)[1], -1e3 * link.force_event_noise(motion, rounding))
        << motion.penetration;
}

TEST(GapLink, ReengagesFromSlackWhenItsForceComesBack) {
  GapLink<MyLaw> closing = reversed(), opening = reversed();
  closing.on_event(1, 2, {0.04, -2});
  closing.on_event(1, 3, {0.03, 0.1});
  EXPECT_EQ(closing.phase(), ContactPhase::approach);
  opening.on_event(1, 2, {0.04, -2});
  opening.on_event(1, 3, {0.03, -0.1});
  EXPECT_EQ(opening.phase(), ContactPhase::restitution);
  EXPECT_DOUBLE_EQ(opening.evaluate({0.03, -0.1}).force, 1000 * 0.03 - 20 * 0.1);
  // It presses until it parts: the first release was not final.
  EXPECT_TRUE(std::isnan(opening.impacts()[0].t_release));
  opening.on_event(0, 4, {0, -0.1});
  EXPECT_EQ(opening.impacts()[0].t_release, 4);
  EXPECT_EQ(opening.impacts().size(), 1u) << "one touch is one impact";
}

TEST(GapLink, PressedAgainBeforeItPartedKeepsItsClosingSpeed) {
  GapLink<MyLaw> link = reversed();
  link.on_event(2, 2, {0.1, 0});
  EXPECT_EQ(link.phase(), ContactPhase::approach);
  EXPECT_DOUBLE_EQ(link.evaluate({0.1, 1}).by_rate, 10 * 2);
  EXPECT_EQ(link.impacts().size(), 1u);
}

TEST(GapLink, TakesTheClosingSpeedAfreshAtEachTouch) {
  GapLink<MyLaw> link = reversed();
  link.on_event(0, 2, {0, -1});
  link.on_event(0, 9, {0, 0.5});
  EXPECT_DOUBLE_EQ(link.evaluate({0.01, 1}).by_rate, 10 * 0.5);
  ASSERT_EQ(link.impacts().size(), 2u);
  EXPECT_EQ(link.impacts()[1].v_approach, 0.5);
}

TEST(GapLink, MarginsArePositiveWhileThePhaseLasts) {
  GapLink<MyLaw> link(MyLaw{}, 0.1);
  EXPECT_DOUBLE_EQ(link.event_functions({-0.02, 1}, 0)[0], 0.02);
  EXPECT_LT(link.event_functions({0.02, 1}, 0)[0], 0);
  link = touched();
  EXPECT_GT(link.event_functions({0.02, 1}, 0)[0], 0);
  EXPECT_LT(link.event_functions({0.02, -1}, 0)[0], 0);
  link = reversed();
  const Contact::EventFunctions pressing = link.event_functions({0.05, -1}, 0);
  for (const double value : pressing) EXPECT_GT(value, 0);
  EXPECT_LT(link.event_functions({-0.01, -1}, 0)[0], 0) << "parted";
  EXPECT_LT(link.event_functions({0.02, -2}, 0)[1], 0) << "the force would pull";
  EXPECT_LT(link.event_functions({0.05, 1}, 0)[2], 0) << "pressed again";
  link.on_event(1, 2, {0.02, -2});
  for (const double value : link.event_functions({0.02, -2}, 0)) EXPECT_GT(value, 0);
  EXPECT_LT(link.event_functions({-0.01, -2}, 0)[0], 0) << "parted";
  EXPECT_LT(link.event_functions({0.02, 1}, 0)[1], 0) << "the force is back";
}

// The force of a Hertz spring is zero on both sides of the separation. Its sign just before shows which came first.
TEST(GapLink, TellsASeparationFromAnEarlierReleaseJustPastIt) {
  GapLink<laws::HertzDamped> link(laws::HertzDamped{.stiffness = 1000, .damping_coefficient = 400}, 0.1);
  link.on_event(0, 0, {0, 2});
  link.accept(step_between(0, 1, {0, 2}, {0.2, 0}));
  link.on_event(0, 1, {0.2, 0});
  EXPECT_GT(link.event_functions({-1e-6, -2}, 0)[1], 0) << "it pressed until separation";
  EXPECT_LT(link.event_functions({-1e-6, -3}, 0)[1], 0) << "without the release it would have pulled before";
}

TEST(GapLink, MayPullOnlyWhenItsLawSaysSo) {
  const GapLink<MyStickyLaw> sticky = reversed<MyStickyLaw>();
  EXPECT_LT(sticky.evaluate({0.01, -2}).force, 0);
  EXPECT_EQ(sticky.event_functions({0.01, -2}, 0)[1], infinite) << "a pull does not end the impact";
  EXPECT_LT(reversed().event_functions({0.01, -2}, 0)[1], 0);
}

TEST(GapLink, AddsTheIndentationThatItsLawLeavesToTheGap) {
  GapLink<MyDentedLaw> link = reversed<MyDentedLaw>();
  link.on_event(1, 2, {0.03, -1.5});
  EXPECT_EQ(link.phase(), ContactPhase::open);
  EXPECT_DOUBLE_EQ(link.gap(), 0.1 + 0.03);
  EXPECT_DOUBLE_EQ(link.penetration(0.13), 0);
  EXPECT_EQ(link.impacts()[0].t_end, 2);
  EXPECT_EQ(link.impacts()[0].v_separation, 1.5);
}

TEST(GapLink, KomodromosWidensItsGapAndKelvinVoigtDoesNot) {
  const auto gap_after = [](auto law, int event) {
    GapLink link(law, 0.02);
    link.on_event(0, 0, {0, 1});
    link.on_event(0, 1, {0.01, 0});
    link.on_event(event, 2, {0.004, -0.5});
    return link.gap();
  };
  EXPECT_DOUBLE_EQ(gap_after(laws::Komodromos{.stiffness = 9.35e7, .restitution = 0.65, .reduced_mass = 6e4}, 1),
                   0.024);
  EXPECT_EQ(gap_after(laws::KelvinVoigtNoTension{.stiffness = 9.35e7, .restitution = 0.65, .reduced_mass = 6e4}, 1),
            0.02);
}

TEST(GapLink, EvaluateAndMarginsMoveNothing) {
  GapLink<laws::BilinearHertz> link(laws::BilinearHertz{.stiffness = 2.75e9, .restitution = 0.65, .reduced_mass = 6e4},
                                    0.01);
  link.on_event(0, 0, {0, 1});
  const laws::Response before = link.evaluate({0.004, 0.5});
  // Trial steps that the solver discards, far from the accepted state.
  for (int i = 0; i < 50; ++i) {
    link.evaluate({0.1 * i, 10.0 * i});
    link.evaluate({-0.1, -50});
    link.event_functions({0.2, -3}, 1e9);
  }
  expect_same(link.evaluate({0.004, 0.5}), before);
  EXPECT_EQ(link.phase(), ContactPhase::approach);
  EXPECT_EQ(link.impacts()[0].peak_force, 0);
  EXPECT_EQ(link.work(), 0);
  // An accepted state does change the memory of the law: unloading follows another line than loading.
  link.accept(step_between(0, 0.01, {0, 1}, {0.01, 0.2}));
  EXPECT_LT(link.evaluate({0.004, 0.5}).force, before.force);
}

// A half-sine penetration d = sin(t) gives k d + c d' = A sin(t + phi). One accepted step over a sixth of it finds the
// peak.
TEST(GapLink, PeakInsideAStepIsThatOfTheLawOnTheMotionBetweenItsEnds) {
  GapLink<MyLaw> link = touched();
  const double phi = std::atan2(link.evaluate({0, 1}).force, link.evaluate({1, 0}).force);
  const double top = M_PI / 2 - phi, begin = top - 0.3, end = top + 0.2;
  LinkStep step = step_between(begin, end, {std::sin(begin), std::cos(begin)}, {std::sin(end), std::cos(end)});
  step.acceleration_begin = -std::sin(begin);
  step.acceleration_end = -std::sin(end);
  step.force_begin = link.evaluate(step.motion_begin).force;
  step.force_end = link.evaluate(step.motion_end).force;
  const double peak = link.evaluate({std::sin(top), std::cos(top)}).force;
  link.accept(step);
  EXPECT_NEAR(link.impacts()[0].peak_force, peak, 2e-6 * peak);
  EXPECT_NEAR(link.impacts()[0].t_peak, top, 1e-4);
}

TEST(GapLink, StepsKeptWhileItIsOpenLeaveNoTrace) {
  GapLink<MyLaw> link(MyLaw{}, 0.1);
  LinkStep step = step_between(0, 1, {-0.1, 1}, {-0.05, 1});
  step.force_end = 7;
  link.accept(step);
  EXPECT_TRUE(link.impacts().empty());
  EXPECT_EQ(link.work(), 0);
}

template <class Make>
std::string refusal(Make make) {
  return test::refusal([&] { make(); });
}

TEST(GapLink, RefusesAGapThatIsNoNumber) {
  for (const double gap : {none, infinite, -infinite}) {
    EXPECT_TRUE(test::mentions(refusal([&] { GapLink<MyLaw>(MyLaw{}, gap); }), {"gap"})) << gap;
  }
  for (const double gap : {none, infinite})
    EXPECT_TRUE(test::mentions(refusal([&] { RigidGapLink(0.5, gap); }), {"gap"})) << gap;
  EXPECT_TRUE(test::mentions(refusal([&] { RigidGapLink(0.5, -1e-9); }), {"gap"}));
}

TEST(GapLink, BeginsPressedWithTheEnergyThatItStores) {
  GapLink<laws::LinearSpring> link({.stiffness = 1000}, -0.2, 3);
  EXPECT_EQ(link.contact().first_loading(0.1).force, 100);
  EXPECT_EQ(link.phase(), ContactPhase::open);
  link.press(0.2);
  EXPECT_EQ(link.phase(), ContactPhase::approach);
  EXPECT_EQ(link.evaluate({0.2, 0}).force, 200);
  EXPECT_DOUBLE_EQ(link.work(), 20);
  ASSERT_EQ(link.impacts().size(), 1u);
  EXPECT_EQ(link.impacts()[0].t_start, 0);
  EXPECT_EQ(link.impacts()[0].v_approach, 0);
  // It separates from rest: 200 N over 0.2 m, half of it on average.
  link.on_event(0, 0, {0.2, 0});
  LinkStep step = step_between(0, 1, {0.2, -0.2}, {0, -0.2});
  step.motion_middle = {0.1, -0.2};
  step.force_begin = 200, step.force_middle = 100;
  link.accept(step);
  link.on_event(0, 1, {0, -0.2});
  EXPECT_NEAR(link.work(), 0, 1e-12);
  EXPECT_NEAR(link.impacts()[0].energy_lost, 0, 1e-12);
  EXPECT_TRUE(std::isnan(link.impacts()[0].restitution)) << "no closing speed";
}

TEST(GapLink, PressedFromTheStartNeedsAForceWithoutAClosingSpeed) {
  const test::Facts facts{"impact_velocity", "linear_spring", "hertz"};
  const auto pressing = [](const auto& law) { return [law] { GapLink(law, -1e-3).press(1e-3); }; };
  EXPECT_TRUE(test::mentions(refusal(pressing(laws::HertzDamped{.stiffness = 2e9, .restitution = 0.5})), facts));
  EXPECT_TRUE(test::mentions(
      refusal(pressing(laws::BilinearHertz{.stiffness = 2e9, .restitution = 0.5, .reduced_mass = 1e4})), facts));
  EXPECT_EQ(refusal(pressing(laws::HertzDamped{.stiffness = 2e9, .restitution = 0.5, .impact_velocity = 0.3})),
            "taken");
  EXPECT_EQ(refusal(pressing(laws::HertzDamped{.stiffness = 2e9, .damping_coefficient = 1e8})), "taken");
  EXPECT_EQ(refusal(pressing(laws::Jankowski{.stiffness = 2e9, .restitution = 0.5, .reduced_mass = 1e4})), "taken");
  EXPECT_NE(refusal([] { RigidGapLink(0.5, 0).press(1e-3); }), "taken");
}

// First twice as deep, then the original depth again: the gap follows the deepest penetration, whatever the rounding of
// the located ends.
TEST(GapLink, ElastoplasticWidensItsGapWithTheDeepestPenetrationOfAll) {
  GapLink<laws::Elastoplastic> link({.stiffness = 2e9, .exponent = 1, .restitution = 0.6}, 0.1);
  const auto impact = [&](double deep, double left) {
    link.on_event(0, 0, {0, 1});
    link.accept(step_between(0, 1, {0, 1}, {deep, 0}));
    link.on_event(0, 1, {deep, 0});
    link.on_event(1, 2, {left, -0.6});
    EXPECT_EQ(link.phase(), ContactPhase::open);
  };
  impact(5e-3, 0.64 * 5e-3 * (1 + 1e-9));
  EXPECT_DOUBLE_EQ(link.gap(), 0.1 + 0.64 * 5e-3);
  EXPECT_DOUBLE_EQ(link.penetration(0.1 + 0.64 * 5e-3 + 1e-3), 1e-3);
  impact(1e-3, 0);
  EXPECT_DOUBLE_EQ(link.gap(), 0.1 + 0.64 * 5e-3) << "elastic below the crushed depth";
  impact(3e-3, 0.64 * 1.2e-3);
  EXPECT_DOUBLE_EQ(link.gap(), 0.1 + 0.64 * 6.2e-3) << "3 mm beyond an indentation of 3.2 mm";
}

TEST(GapLink, WorkOfAnImpactIsLostOrStoredWhileItLasts) {
  auto link = touched();  // F = 1000 d + 20 d'
  link.accept({.begin = 0,
               .end = 0.1,
               .motion_begin = {0, 2},
               .motion_middle = {0.1, 2},
               .motion_end = {0.2, 2},
               .force_begin = 40,
               .force_middle = 140,
               .force_end = 240});
  EXPECT_NEAR(link.impacts()[0].energy_stored, 0.5 * 1000 * 0.2 * 0.2, 1e-12);
  EXPECT_NEAR(link.impacts()[0].energy_lost, link.work() - 20, 1e-12);
  EXPECT_TRUE(still_presses(link.impacts()[0]));
  Archive written;
  link.archive(written);
  Archive read(written.bytes());
  auto other = touched();
  other.archive(read);
  for (GapLink<MyLaw>* each : {&link, &other}) {
    each->on_event(0, 0.1, {0.2, 0});
    each->on_event(1, 0.1, {0.2, -2});
    EXPECT_EQ(each->phase(), ContactPhase::slack);
    EXPECT_EQ(each->impacts()[0].energy_stored, 0) << "the force is zero";
    EXPECT_EQ(each->impacts()[0].energy_lost, each->work());
    EXPECT_FALSE(still_presses(each->impacts()[0]));
  }
}

TEST(MakeContact, GivesEachLawItsOwnKindOfContact) {
  EXPECT_TRUE(make_contact(laws::Stereomechanical{.restitution = 0.5}, 0.1, 2)->is_rigid());
  const auto soft = make_contact(laws::LinearSpring{.stiffness = 1000}, 0.1, 2);
  EXPECT_FALSE(soft->is_rigid());
  ContactMemory memory = soft->initial();
  soft->on_event(memory, 0, 0, {0, 1});
  EXPECT_DOUBLE_EQ(soft->evaluate(memory, {0.01, 0}).force, 10);
  EXPECT_EQ(memory.impacts()[0].link, 2);
}

TEST(RigidGapLink, RefusesARestitutionOutsideZeroToOne) {
  for (const double e : {-0.1, 1.2, none})
    EXPECT_TRUE(test::mentions(refusal([&] { RigidGapLink(e, 0.1); }), {"[0, 1]"})) << e;
}

TEST(RigidGapLink, BouncesWithoutForceAndWithoutDuration) {
  RigidGapLink link(0.5, 0.1, 4);
  EXPECT_TRUE(link.contact().is_rigid());
  EXPECT_EQ(link.contact().restitution(), 0.5);
  EXPECT_DOUBLE_EQ(link.event_functions({-0.02, 1}, 0)[0], 0.02);
  link.jumped(2, {.impulse = 300, .work = 150, .rate_before = 2, .rate_after = -1}, false);
  EXPECT_EQ(link.phase(), ContactPhase::open);
  expect_same(link.evaluate({0.01, 1}), {0, 0, 0});
  ASSERT_EQ(link.impacts().size(), 1u);
  const ImpactRow& row = link.impacts()[0];
  EXPECT_EQ(row.link, 4);
  EXPECT_EQ(row.t_start, 2);
  EXPECT_EQ(row.t_end, 2);
  EXPECT_EQ(row.restitution, 0.5);
  EXPECT_EQ(row.impulse, 300);
  // The impulse acts while the rate changes from 2 to -1 m/s; its work is that at the mean rate.
  EXPECT_DOUBLE_EQ(row.energy_lost, 300 * 0.5);
  EXPECT_TRUE(std::isnan(row.peak_force));
}

TEST(RigidGapLink, IsHeldAfterItsLastBounceAndReleasedWhenTheForcePulls) {
  RigidGapLink link(0.5, 0.1);
  link.jumped(2, {.impulse = 300, .work = 150e-6, .rate_before = 1e-6}, true);
  EXPECT_EQ(link.phase(), ContactPhase::resting);
  EXPECT_GT(link.event_functions({0, 0}, 40)[0], 0) << "pressed together";
  EXPECT_LT(link.event_functions({0, 0}, -40)[0], 0) << "pulled apart";
  link.accept({.begin = 2,
               .end = 5,
               .motion_begin = {},
               .motion_middle = {},
               .motion_end = {},
               .force_begin = 40,
               .force_middle = 40,
               .force_end = 40});
  EXPECT_TRUE(std::isnan(link.impacts()[0].t_end)) << "still in contact";
  link.on_event(0, 5, {0, 0});
  EXPECT_EQ(link.phase(), ContactPhase::open);
  EXPECT_EQ(link.impacts()[0].t_end, 5);
  EXPECT_DOUBLE_EQ(link.impacts()[0].impulse, 300 + 40 * 3);
  EXPECT_EQ(link.work(), 150e-6);
}

TEST(RigidGapLink, HitWhileItRestsPartsAgain) {
  RigidGapLink link(0.5, 0.1);
  link.jumped(2, {.impulse = 300, .work = 150e-6, .rate_before = 1e-6}, true);
  link.jumped(3, {.impulse = 50, .work = 12.5, .rate_before = 1, .rate_after = -0.5}, false);
  EXPECT_EQ(link.phase(), ContactPhase::open);
  ASSERT_EQ(link.impacts().size(), 1u);
  EXPECT_EQ(link.impacts()[0].t_end, 3);
  EXPECT_DOUBLE_EQ(link.impacts()[0].impulse, 350);
}

}  // namespace gap_link_test
}  // namespace pounding
