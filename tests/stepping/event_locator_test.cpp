// Event location on closed-form motions: the test acts as the integrator, and each trial is a formula.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pounding/core/error.hpp>
#include <pounding/laws/hertz.hpp>
#include <pounding/laws/stereomechanical.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/event_locator.hpp>

#include "support/bilinear_spring.hpp"

namespace pounding {
namespace event_locator_test {

constexpr double pi = 3.14159265358979323846;

/// Relative displacement and rate of a link as a function of the time since the beginning.
using Path = std::function<LinkMotion(double)>;

Path uniform(double at_begin, double rate) {
  return [=](double t) { return LinkMotion{at_begin + rate * t, rate}; };
}
/// Like `uniform`, with an acceleration.
Path thrown(double at_begin, double rate, double acceleration) {
  return
      [=](double t) { return LinkMotion{at_begin + rate * t + 0.5 * acceleration * t * t, rate + acceleration * t}; };
}

struct Formulas {
  std::vector<Path> paths;
  std::vector<std::unique_ptr<const Contact>> contacts;
  std::vector<ContactMemory> memories;
  std::vector<std::unique_ptr<const Spring>> springs;
  System system;
  MotionScales scales{{0.1}, {1.0}};
  RigidContacts rigid;
  Instant now;
  Trial trial;
  int trials = 0;
  double unsolved_below = 0;                 // steps shorter than this fail
  double wild_below = 0;                     // steps shorter than this have a huge error
  static constexpr double longest_step = 1;  // [s]

  void add(std::unique_ptr<const Contact> contact, Path path) {
    memories.push_back(contact->initial());
    contacts.push_back(std::move(contact));
    paths.push_back(std::move(path));
  }
  void add(double gap, Path path) {
    add(std::make_unique<GapContact<laws::Hertz>>(laws::Hertz{.stiffness = 1e9}, gap), std::move(path));
  }
  // An event of the last contact.
  void on_event(double rate) { contacts.back()->on_event(memories.back(), 0, 0, {0, rate}); }
  void write(double t, Instant& x) const {
    const int count = static_cast<int>(paths.size());
    x.time = t;
    x.force = Eigen::VectorXd::Zero(count);
    x.relative.resize(count, 3);
    for (int i = 0; i < count; ++i) {
      constexpr double shortly = 1e-6;
      const LinkMotion m = paths[i](t);
      x.relative.row(i) << m.penetration, m.rate,
          (paths[i](t + shortly).rate - paths[i](t - shortly).rate) / (2 * shortly);
    }
  }
  bool try_step(double h, std::optional<double> end) {
    ++trials;
    if (h < unsolved_below) return false;
    trial.h = h;
    trial.error = h < wild_below ? 1e6 : 0.5;
    write(h, trial.end);
    trial.end.time = end.value_or(h);
    return true;
  }
  std::optional<LocatedEvents> locate(double h, std::optional<double> end = std::nullopt) {
    system.gap_jacobian.resize(0, static_cast<int>(paths.size()));
    for (const auto& contact : contacts) system.contacts.push_back(contact.get());
    for (const auto& spring : springs) system.elements.push_back(spring.get());
    system.initial_contacts = memories;
    const LinkSet links(system);
    const EventFunctions functions(links, rigid, scales, longest_step);
    SpringForces forces(links);
    const EventLocator locator(functions, forces);
    write(0, now);
    try_step(h, end);
    trials = 0;
    return locator.locate(now, trial, true,
                          [this](double length, std::optional<double> at) { return try_step(length, at); });
  }
};

TEST(EventLocator, FindsATouchToTheLastDigits) {
  Formulas f;
  const double w = 2 * pi / 0.5;
  f.add(0.02, [=](double t) { return LinkMotion{0.05 * std::sin(w * t), 0.05 * w * std::cos(w * t)}; });
  const auto located = f.locate(0.1);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->step, std::asin(0.4) / w, 1e-13);
  EXPECT_EQ(f.trial.h, located->step) << "the trial ends there";
  ASSERT_EQ(located->events.size(), 1u);
  EXPECT_EQ(located->events[0].link, 0);
  EXPECT_LE(f.trials, 3) << "located on its path";
}

TEST(EventLocator, FindsTheReversalAndTheSeparationOfAContact) {
  Formulas f;
  f.add(0, thrown(1e-3, 0.1, -2.0));  // reverses after 50 ms
  f.on_event(0.1);
  const auto turn = f.locate(0.09);
  ASSERT_TRUE(turn);
  EXPECT_NEAR(turn->step, 0.05, 1e-12);
  Formulas g;
  g.add(0, thrown(1e-3, -0.1, 0));
  g.on_event(0.1);
  g.on_event(0);
  const auto parted = g.locate(0.05);
  ASSERT_TRUE(parted);
  EXPECT_NEAR(parted->step, 0.01, 1e-12);
}

TEST(EventLocator, LeavesATrialWithoutAnEventAlone) {
  Formulas f;
  f.add(0.02, uniform(0, 0.1));
  EXPECT_FALSE(f.locate(0.19));
  EXPECT_EQ(f.trials, 0);
  EXPECT_EQ(f.trial.h, 0.19);
}

TEST(EventLocator, TakesTheFirstOfSeveral) {
  Formulas f;
  f.add(0.02, uniform(0, 0.3));
  f.add(0.02, uniform(0, 0.5));
  // Appears to be first by its values at the ends, but occurs late.
  f.add(0.02, [](double t) { return LinkMotion{100 * t * t * t, 300 * t * t}; });
  const auto located = f.locate(0.1);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->step, 0.04, 1e-12);
  ASSERT_EQ(located->events.size(), 1u);
  EXPECT_EQ(located->events[0].link, 1);
}

TEST(EventLocator, GroupsEventsThatOnlyRoundOffKeepsApart) {
  Formulas f;
  f.add(0.02, uniform(0, 0.5));
  f.add(0.03, uniform(0.01 - 1e-13, 0.5));
  f.add(0.02, uniform(-1e-4, 0.5));
  const auto located = f.locate(0.1);
  ASSERT_TRUE(located);
  ASSERT_EQ(located->events.size(), 2u) << "the third occurs 0.2 ms later";
  EXPECT_EQ(located->events[0].link + located->events[1].link, 1);
}

// Separated at both ends of the trial, overlapping in between.
TEST(EventLocator, SeesATouchAndARebound) {
  Formulas f;
  f.add(0.02, thrown(0, 0.5, -6.0));  // highest at 20.8 mm
  const auto located = f.locate(0.2);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->step, (0.5 - std::sqrt(0.25 - 12 * 0.02)) / 6, 1e-11);
  Formulas miss;
  miss.add(0.021, thrown(0, 0.5, -6.0));
  EXPECT_FALSE(miss.locate(0.2, std::nextafter(0.2, 1.0)));
  EXPECT_EQ(miss.trial.h, 0.2);
  EXPECT_EQ(miss.trial.end.time, std::nextafter(0.2, 1.0)) << "its exact end is retained";
}

TEST(EventLocator, AnswersZeroForBodiesThatCloseFaceToFace) {
  Formulas f;
  f.add(0.02, uniform(0.02, 0.3));
  const auto located = f.locate(0.1);
  ASSERT_TRUE(located);
  EXPECT_EQ(located->step, 0);
}

// On the wrong side by round-off at the beginning, then separated, then a touch.
TEST(EventLocator, WaitsForBodiesThatPartAndComeBack) {
  Formulas f;
  f.add(0.02, thrown(0.02 + 1e-15, -0.1, 4.0));  // back after 50 ms
  const auto located = f.locate(0.08);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->step, 0.05, 1e-11);
}

// Separated by less than the round-off of the motion, then closed again: no step resolves the bounce of a rigid contact
// there. A compliant contact would end and begin in the same location and keep its speed.
TEST(EventLocator, WaitsInRoundOffForCompliantContactsOnly) {
  const auto hop = thrown(0, -1e-8, 1e-2);  // 5e-15 m wide, over after 2 us
  Formulas f;
  f.add(0, hop);
  const auto located = f.locate(0.1);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->step, 2e-6, 1e-8);
  Formulas rigid;
  rigid.add(make_contact(laws::Stereomechanical{.restitution = 0.5}, 0), hop);
  const auto in_place = rigid.locate(0.1);
  ASSERT_TRUE(in_place);
  EXPECT_EQ(in_place->step, 0);
}

// A rest that ends and begins again after 2 us, 6e-15 m wide: without the wait it would end and begin indefinitely.
TEST(EventLocator, WaitsInRoundOffForRigidBodiesThatPartFromARest) {
  Formulas f;
  f.add(make_contact(laws::Stereomechanical{.restitution = 0.5}, 0),
        [](double t) { return LinkMotion{-1e-2 * t * t + 5e3 * t * t * t, -2e-2 * t + 1.5e4 * t * t}; });
  const auto located = f.locate(1e-4);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->step, 2e-6, 1e-7);
}

TEST(EventLocator, ShortensATrialToTheCornerOfASpring) {
  Formulas f;
  f.springs.push_back(std::make_unique<BilinearSpring>(BilinearSpring::Parameters{1e6, 1e3, 0.1}));  // yields at 1 mm
  f.paths.push_back(uniform(0, 0.02));
  EXPECT_FALSE(f.locate(0.2)) << "a corner is not an event";
  EXPECT_NEAR(f.trial.h, 0.05, 1e-3 * 0.2);
}

TEST(EventLocator, FailsWithoutATrialThatCanBeKept) {
  Formulas f;
  f.add(0.02, uniform(0, 0.5));
  f.unsolved_below = 0.09;
  EXPECT_THROW(f.locate(0.1), SolverError);
}

// A hop of 1e-6 of the trial: the false position method alone would converge too slowly.
TEST(EventLocator, FindsTheEndOfATinyHop) {
  Formulas f;
  f.add(0, thrown(0, -5e-6, 10));  // back after 1 us
  const auto located = f.locate(1);
  ASSERT_TRUE(located);
  EXPECT_NEAR(located->step, 1e-6, 1e-10);
  EXPECT_LE(f.trials, 40);
}

// Stage equations with several solutions: if a fraction of an accepted step is far off, it belongs to another solution.
// Fixed steps have no error estimate to judge this.
TEST(EventLocator, DoesNotTakeAnotherSolutionForTheMotion) {
  Formulas f;
  f.add(0.02, uniform(0, 0.5));
  f.wild_below = 0.09;
  EXPECT_THROW(f.locate(0.1), LostTrial);
  Formulas fixed;
  fixed.add(0.02, uniform(0, 0.5));
  fixed.wild_below = 0.2;
  EXPECT_NEAR(fixed.locate(0.1)->step, 0.04, 1e-12);
}

}  // namespace event_locator_test
}  // namespace pounding
