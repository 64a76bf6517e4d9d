// Steps in contact after a touch, where the force of Hertz grows by d^1.5: their order by time and by a root of the time.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <pounding/study/contact_step.hpp>

namespace pounding::study {
namespace contact_step_test {

/// Error of the rate after a part of an impact of unit mass, speed and stiffness, in `count` equal steps by t or by a root of it.
template <class Law>
class Impact {
 public:
  explicit Impact(const Law& law) : law_(law) {
    model_.stiffness = model_.damping = model_.load = {0};
    model_.links.push_back({.gap = 0, .closing = {1}, .law = law});
  }

  double rate(int count, int root) const {
    const Structures<1, 1> structures(model_);
    ContactStep<Law, 1, 1> step(structures);
    std::vector<LinkContact<Law>> links;
    links.emplace_back(law_, 0.0);
    links[0].apply(LinkEvent::touch, 0, 1);
    EXPECT_EQ(links[0].root(), root_);
    auto begin = step.moment(), end = begin;
    begin.v[0] = 1;
    step.complete(links, {}, begin);
    const Clock clock = root == 1 ? Clock() : Clock(0, root);
    const double whole = clock.reading(end_), ds = whole / count;
    for (int i = 0; i < count; ++i) {
      const double s = whole * i / count;
      step.take(links, {}, clock, begin, s, ds, clock.at(s + ds).time, 1, end);
      std::swap(begin, end);
    }
    return begin.v[0];
  }

  /// Powers of the step by which the error falls from 32 to 64 steps.
  double order(int root) const {
    const double exact = rate(4096, root_);
    return std::log2(std::abs(rate(32, root) - exact) / std::abs(rate(64, root) - exact));
  }

  int root_ = 2;
  double end_ = 0.8;

 private:
  Law law_;
  LinearModel model_;
};

TEST(TheFirstStepsOfAnImpact, HaveOrderTwoAndAHalfByTimeAndFiveByItsRoot) {
  const Impact impact(laws::Hertz{.stiffness = 1});
  // The force is smooth but for t^1.5 at the touch: its integral over a first step of h is wrong by h^2.5.
  EXPECT_NEAR(impact.order(1), 2.5, 0.2);
  EXPECT_GT(impact.order(2), 4.5);
}

TEST(TheFirstStepsOfAnImpact, HaveOrderFiveByTheFourthRootForADashpotOfAQuarter) {
  Impact impact(laws::Jankowski{.stiffness = 1, .damping_ratio = 0.35, .reduced_mass = 1});
  impact.root_ = 4;
  // d^0.25 in time: h^1.25.
  EXPECT_NEAR(impact.order(1), 1.25, 0.2);
  EXPECT_GT(impact.order(4), 4.5);
}

TEST(TheFirstStepsOfAnImpact, GoByTimeForALinearLaw) {
  Impact impact(laws::KelvinVoigt{.stiffness = 1, .damping_coefficient = 0.2});
  impact.root_ = 1;
  EXPECT_GT(impact.order(1), 4.5);
}

TEST(TheClockOfAnImpact, FollowsTheExponentsOfTheLaw) {
  const laws::Impact impact{.closing_speed = 1, .damping = 1, .largest_penetration = 0, .slip = 0, .crushed = 0};
  EXPECT_EQ(clock_root(laws::LinearSpring{.stiffness = 1}, impact), 1);
  EXPECT_EQ(clock_root(laws::ModifiedKelvin{.stiffness = 1}, impact), 1);
  EXPECT_EQ(clock_root(laws::HertzDamped{.stiffness = 1}, impact), 2);
  EXPECT_EQ(clock_root(laws::KuwabaraKono{.stiffness = 1}, impact), 2);
  EXPECT_EQ(clock_root(laws::ViscousHertz{.stiffness = 1}, impact), 4);
  EXPECT_EQ(clock_root(laws::Hertz{.stiffness = 1, .exponent = 1.3}, impact), 4);
  EXPECT_EQ(clock_root(laws::Hertz{.stiffness = 1, .exponent = 2}, impact), 1);
}

}  // namespace contact_step_test
}  // namespace pounding::study
