// Springs whose motions wait, because a bound is sure that all of them stay elastic.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/stepping/relative_motion.hpp>
#include "support/hinge_frame.hpp"
#include "support/without_range.hpp"

namespace pounding {
namespace springs_that_wait_test {

using test::HingeFrame;

constexpr double far = std::numeric_limits<double>::infinity();
const GroundMotion shake(Harmonic{4.0, 0.7, 2.0});

// Two frames with a contact between them, a spring of which stands away from zero at rest.
struct Frames {
  HingeFrame frame{{.frames = 2, .mirrored = true}, shake};
  ModalSolver solver;
  LinkSet links;
  RelativeMotion relative;
  DeformationBound bound;
  std::mt19937 random{3};
  std::normal_distribution<double> normal;

  Frames()
      : solver(prepared(frame).system),
        links(frame.system, solver.relief()),
        relative(links, solver, 3),
        bound(*relative.bound()) {}

  static HingeFrame& prepared(HingeFrame& frame) {
    frame.add_contact(std::make_unique<GapLink<laws::HertzDamped>>(
        laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.65}, 0.02, 0));
    frame.system.gravity_offset.setZero(frame.system.links());
    frame.system.gravity_offset[1 + 4] = 1e-3;
    return frame;
  }

  Instant instant() {
    Instant x;
    x.motion = Eigen::MatrixXd::NullaryExpr(solver.size(), Instant::columns, [&] { return normal(random); });
    relative.gather(x);
    return x;
  }
};

TEST(DeformationBound, IsNeverBelowTheDeformationOfAnySpring) {
  Frames frames;
  const int count = frames.links.springs();
  for (int repetition = 0; repetition < 50; ++repetition) {
    Eigen::VectorXd low(count), high(count);
    for (int i = 0; i < count; ++i) {
      low[i] = -0.01 - std::abs(frames.normal(frames.random));
      high[i] = 0.01 + std::abs(frames.normal(frames.random));
    }
    frames.bound.set(low, high);
    const Instant x = frames.instant();
    const DeformationBound::Reach reach = frames.bound.reach(x);
    const double ahead = std::abs(frames.normal(frames.random));
    double at = 0, after = 0;
    for (int i = 0; i < count; ++i) {
      const int link = 1 + i;
      const double c = frames.links.by_gravity(link), room = std::min(high[i] - c, c - low[i]);
      const double d = x.relative(link, Instant::u), v = x.relative(link, Instant::v);
      at = std::max(at, std::abs(d) / room);
      after = std::max(after, (std::abs(d) + ahead * std::abs(v)) / room);
    }
    EXPECT_GE(reach.at, at);
    EXPECT_GE(reach.after(ahead), after);
    EXPECT_GT(at, 0);
  }
}

TEST(DeformationBound, IsTheDeformationWhereOneModeBendsOneSpring) {
  Frames frames;
  const int count = frames.links.springs();
  for (int spring = 0; spring < count; ++spring) {
    Eigen::VectorXd low = Eigen::VectorXd::Constant(count, -far), high = -low;
    low[spring] = -0.02;
    high[spring] = 0.03;
    frames.bound.set(low, high);
    const double room = 0.02 + frames.links.by_gravity(1 + spring);
    for (int mode = 0; mode < frames.solver.size(); ++mode) {
      Instant x;
      x.motion = Eigen::MatrixXd::Zero(frames.solver.size(), Instant::columns);
      x.motion(mode, Instant::u) = -2;
      x.motion(mode, Instant::v) = 3;
      frames.relative.gather(x);
      const DeformationBound::Reach reach = frames.bound.reach(x);
      EXPECT_NEAR(reach.at, std::abs(x.relative(1 + spring, Instant::u)) / room, 1e-9 * reach.at);
      EXPECT_NEAR(reach.by_rate, std::abs(x.relative(1 + spring, Instant::v)) / room, 1e-9 * reach.by_rate);
    }
  }
}

TEST(DeformationBound, IsSureOfNothingWhereASpringHasNoRoom) {
  Frames frames;
  const int count = frames.links.springs();
  Eigen::VectorXd low = Eigen::VectorXd::Constant(count, -1), high = -low;
  Instant at_rest;
  at_rest.motion = Eigen::MatrixXd::Zero(frames.solver.size(), Instant::columns);
  EXPECT_FALSE(DeformationBound::inside(frames.bound.reach(at_rest).at)) << "before any range is set";
  frames.bound.set(low, high);
  EXPECT_TRUE(DeformationBound::inside(frames.bound.reach(at_rest).at));
  high[4] = 0.5 * frames.links.by_gravity(1 + 4);
  frames.bound.set(low, high);
  EXPECT_FALSE(DeformationBound::inside(frames.bound.reach(at_rest).at));
}

TEST(RelativeMotion, OfSpringsHasTheSameBitsWhenItWaited) {
  Frames frames;
  const Instant all = frames.instant();
  Instant late = all;
  for (const int columns : {1, 2, 3}) {
    late.relative.setConstant(7);
    frames.relative.gather_others(late);
    EXPECT_EQ(late.springs_known, 0);
    EXPECT_EQ(late.relative.row(0), all.relative.row(0));
    EXPECT_EQ(late.relative(1, 0), 7);
    frames.relative.gather_springs(late, columns);
    EXPECT_EQ(Eigen::MatrixXd(late.relative.leftCols(columns)), Eigen::MatrixXd(all.relative.leftCols(columns)));
    frames.relative.gather_springs(late);
    EXPECT_EQ(late.relative, all.relative);
  }
}

constexpr Scheme esdirk{.kind = Scheme::Kind::esdirk4};
constexpr Scheme alpha{.kind = Scheme::Kind::generalized_alpha};
constexpr Scheme damped{.kind = Scheme::Kind::generalized_alpha, .spectral_radius = 0.8};

class SpringsThatWait : public testing::TestWithParam<Scheme> {};

INSTANTIATE_TEST_SUITE_P(Schemes, SpringsThatWait, testing::Values(esdirk, alpha, damped),
                         [](const auto& test) { return "scheme" + std::to_string(test.index); });

struct Seen {
  long steps = 0, trials = 0, waited = 0;
  double largest = 0;           // size of a deformation over that at the yield, inside steps too
  double first_loss = far;      // end of the step in which a hinge first lost energy [s]
  std::vector<double> numbers;  // energies of every step, and all that there is at the end
};

// The steps are looked at one by one only with `looks`: then nothing waits for long.
Seen run(HingeFrame& frame, const Scheme& scheme, bool looks) {
  ModalSolver solver(frame.system);
  Stepper stepper(frame.system, solver, {.tolerance = 1e-4, .scheme = scheme, .max_step = 0.02});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(frame.system.size());
  stepper.start(0, zero, zero);
  StepController controller(stepper);
  ErrorControl policy(0.02);
  Seen seen;
  const auto note = [&](auto&&... values) { (seen.numbers.push_back(values), ...); };
  const auto note_steps = [&] {
    for (const LinkStep& step : stepper.link_steps())
      note(step.motion_begin.penetration, step.motion_begin.rate, step.motion_middle.penetration,
           step.motion_middle.rate, step.motion_end.penetration, step.motion_end.rate, step.force_begin,
           step.force_middle, step.force_end, step.acceleration_end);
  };
  for (double h = 1e-3; stepper.time() < 2.5;) {
    h = controller.advance(h, 2.5, policy);
    ++seen.steps;
    if (stepper.instant_end_minus().springs_known == 0) ++seen.waited;
    const Energies now = stepper.energies();
    note(now.strain, now.hysteretic, now.kinetic);
    if (now.hysteretic > 0) seen.first_loss = std::min(seen.first_loss, stepper.time());
    for (int i = 0; looks && i < frame.hinges(); ++i) {
      const LinkStep& step = stepper.link_steps()[frame.system.contact_count() + i];
      const double yields = frame.springs[i]->yield_deformation();
      seen.largest = std::max(seen.largest, std::abs(step.motion_end.penetration) / yields);
      if (step.motion_begin.rate * step.motion_end.rate >= 0) continue;
      const CubicPenetration between(step.motion_begin, step.motion_end, step.end - step.begin);
      seen.largest = std::max(seen.largest, std::abs(between.at(between.turn())) / yields);
    }
    if (seen.steps % 37 == 0) note_steps();
  }
  note_steps();
  seen.trials = controller.trials();
  const State& end = stepper.state();
  for (const Eigen::VectorXd* values : {&end.u, &end.v, &end.a, &end.force})
    seen.numbers.insert(seen.numbers.end(), values->begin(), values->end());
  for (const auto& spring : frame.springs) note(spring->slip(), spring->lost(), spring->stored_correction());
  return seen;
}

// Around the strength at which a hinge just reaches its yield moment, between two ends of steps, the yield is found or
// not found in the same step as by the long way.
TEST_P(SpringsThatWait, YieldInTheSameStepAsByTheLongWay) {
  for (const bool bears : {false, true}) {
    const auto frame_of = [&](double strength) {
      auto frame =
          std::make_unique<HingeFrame>(HingeFrame::Options{.strength = strength, .frames = 2, .mirrored = true}, shake);
      frame->add_contact(std::make_unique<GapLink<laws::HertzDamped>>(
          laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.65}, 0.02, 0));
      if (!bears) return frame;
      frame->system.gravity_offset.setZero(frame->system.links());
      for (int i = 0; i < frame->hinges(); ++i)
        frame->system.gravity_offset[1 + i] = 0.2 * std::sin(1 + i) * frame->springs[i]->yield_deformation() / strength;
      return frame;
    };
    const double strong = 100;
    const auto elastic = frame_of(strong);
    const double just = strong * run(*elastic, GetParam(), true).largest;
    int yielded = 0;
    for (const double strength :
         {10 * just, 1.5 * just, (1 + 1e-6) * just, (1 - 1e-6) * just, 0.99 * just, 0.5 * just}) {
      const auto quick = frame_of(strength), slow = frame_of(strength);
      std::vector<std::unique_ptr<test::WithoutRange>> hidden;
      for (Spring*& spring : slow->system.springs)
        spring = hidden.emplace_back(std::make_unique<test::WithoutRange>(*spring)).get();
      const Seen a = run(*quick, GetParam(), false), b = run(*slow, GetParam(), false);
      EXPECT_EQ(a.trials, b.trials) << strength / just;
      EXPECT_EQ(a.first_loss, b.first_loss) << strength / just;
      EXPECT_EQ(a.numbers, b.numbers) << strength / just;
      EXPECT_EQ(b.waited, 0);
      EXPECT_GT(a.waited, strength > 5 * just ? 0.9 * a.steps : 5) << strength / just;
      yielded += a.first_loss < far;
    }
    EXPECT_EQ(yielded, 3);
  }
}

}  // namespace springs_that_wait_test
}  // namespace pounding
