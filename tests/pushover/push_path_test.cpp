// Paths of pushover analyses against closed forms, limit analysis and curves of other programs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/hysteresis/all.hpp>
#include <pounding/pushover/push_path.hpp>
#include <pounding/structures/hysteretic_spring.hpp>
#include <pounding/structures/oscillators.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"
#include "support/yielding_frames.hpp"

namespace pounding {
namespace push_path_test {

using test::Book;
using test::HandMadeFrame;
using test::HingedFrame;
using test::TestHinge;
using test::unit_row;

constexpr double rigid = std::numeric_limits<double>::infinity();

PushOptions at(int control, const Eigen::VectorXd& load, std::vector<double> targets) {
  return {.load = load, .control = unit_row(static_cast<int>(load.size()), control), .targets = std::move(targets)};
}

std::set<std::string> yields_at(const Structure& s, const PushPath& path, int point) {
  std::set<std::string> names;
  for (const PushEvent& event : path.events)
    if (event.point == point && event.kind == PushEvent::Kind::yields) names.insert(s.yielding[event.part].name);
  return names;
}

void expect_curve_of_the_frame(const std::string& how, const Structure& s) {
  const HingedFrame frame;
  const PushPath path = push(s, at(frame.roof(), frame.triangular(s.size()), {0.25}));
  ASSERT_EQ(path.points.size(), 6u);
  const double roof[] = {22.21674, 27.09875, 40.13070, 71.95633, 250},
               shear[] = {154.1540, 173.3743, 200.2638, 224.0691, 281.0893};
  Book book("pushover of a frame with hinges, " + how,
            "event to event on another assembly of the stiffness, in Python (numpy)",
            "half a unit of the last printed digit");
  for (int i = 0; i < 5; ++i) {
    book.near("displacement of the roof [mm]", 1e3 * path.points[i + 1].displacement, roof[i], 5.1e-6);
    book.near("base shear [kN]", path.points[i + 1].factor / 1e3, shear[i], 5.1e-5);
  }
  EXPECT_EQ(yields_at(s, path, 1), (std::set<std::string>{"beam 1 left", "beam 1 right"}));
  EXPECT_EQ(yields_at(s, path, 2), (std::set<std::string>{"beam 2 left", "beam 2 right"}));
  EXPECT_EQ(yields_at(s, path, 3), (std::set<std::string>{"foot 0", "foot 1"}));
  EXPECT_EQ(yields_at(s, path, 4), (std::set<std::string>{"beam 3 left", "beam 3 right"}));
  EXPECT_EQ(path.mechanism, 4);
  EXPECT_EQ(path.mechanism_parts.size(), 8u);
  EXPECT_EQ(path.collapse, "");
}

TEST(PushPath, MeetsTheCurveOfAFrameWithSpringsAtItsHinges) {
  expect_curve_of_the_frame("springs beside joints", HingedFrame().with_springs());
}

TEST(PushPath, MeetsTheCurveOfAFrameWithHingesInSeries) {
  expect_curve_of_the_frame("hinges in series", HingedFrame().in_series());
}

// Fixed feet, 4 m high, 8 m wide, a node at midspan. Rigid-plastic hinges at the feet, at the corners and at midspan.
// Unknowns: x, z, rotation of the left corner, of midspan, of the right corner.
Structure portal(double moment, double hardening) {
  const double e = 200e9, a = 0.01, i = 1e-4;
  HandMadeFrame frame(9);
  const TestHinge foot[] = {{"left foot", moment, hardening, rigid}, {"right foot", moment, hardening, rigid}},
                  corner[] = {{"left corner", moment, hardening, rigid}, {"right corner", moment, hardening, rigid}},
                  middle{"middle", moment, hardening, rigid};
  const auto column = test::plane_beam(e, a, i, {0, 0}, {0, 4});
  frame.hinged_member(column, {-1, -1, -1, 0, 1, 2}, &foot[0], &corner[0]);
  frame.hinged_member(column, {-1, -1, -1, 6, 7, 8}, &foot[1], &corner[1]);
  const auto half = test::plane_beam(e, a, i, {0, 0}, {4, 0});
  frame.hinged_member(half, {0, 1, 2, 3, 4, 5}, nullptr, &middle);
  frame.member(half, {3, 4, 5, 6, 7, 8});
  return frame.structure();
}

// Path for a horizontal force h at the left corner and a vertical force v at midspan; its largest factor is the limit
// load.
PushPath push_portal(double h, double v, int control, double hardening = 0) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(9);
  load[0] = h, load[4] = -v;
  PushOptions options = at(control, load, {0.5});
  if (control == 4) options.control = -options.control;
  return push(portal(200e3, hardening), options);
}

TEST(PushPath, MeetsTheLimitLoadsOfAPortal) {
  Book book("limit loads of a portal", "mechanisms of limit analysis: 4 M/h, 8 M/l, 6 M/(h + l/2), 4 M/h",
            "round-off: the path is exact, and the hinges have no hardening");
  book.near("factor by a horizontal force [N]", push_portal(1, 0, 0).points.back().factor, 200e3, 2e-4);
  book.near("factor by a vertical force [N]", push_portal(0, 1, 4).points.back().factor, 200e3, 2e-4);
  book.near("factor by both [N]", push_portal(1, 1, 0).points.back().factor, 150e3, 2e-4);
  book.near("factor by a quarter of the vertical force [N]", push_portal(1, 0.25, 0).points.back().factor, 200e3, 2e-4);
}

TEST(PushPath, NamesTheMechanismOfAPortal) {
  const Structure s = portal(200e3, 0);
  const auto hinges = [&](double h, double v, int control) {
    const PushPath path = push_portal(h, v, control);
    EXPECT_TRUE(path.mechanism);
    std::set<std::string> names;
    for (const int part : path.mechanism_parts) names.insert(s.yielding[part].name);
    return names;
  };
  EXPECT_EQ(hinges(1, 0, 0), (std::set<std::string>{"left foot", "right foot", "left corner", "right corner"}));
  EXPECT_EQ(hinges(0, 1, 4), (std::set<std::string>{"left corner", "right corner", "middle"}));
  EXPECT_EQ(hinges(1, 1, 0), (std::set<std::string>{"left foot", "right foot", "middle", "right corner"}));
}

TEST(PushPath, LeavesAPortalThatHardensAboveItsLimitLoad) {
  const PushPath path = push_portal(1, 0, 0, 1e-6);
  EXPECT_GT(path.points.back().factor, 200e3 * (1 + 1e-8));
  EXPECT_LT(path.points.back().factor, 200e3 * (1 + 1e-3));
  EXPECT_TRUE(path.mechanism);
}

TEST(PushPath, EndsWhereAMechanismLeavesTheDisplacementStill) {
  // The beam fails under the vertical force while the roof is controlled sideways by a small one.
  const PushPath path = push_portal(1e-3, 1, 0);
  EXPECT_NE(path.collapse.find("middle"), std::string::npos) << path.collapse;
  EXPECT_NE(path.collapse.find("left corner"), std::string::npos) << path.collapse;
  EXPECT_LT(path.points.back().displacement, 0.5);
}

// Storeys in series under fractions of a load that sum to one at the ground: each storey follows its own law.
struct Storeys {
  std::vector<double> stiffness{160e6, 150e6, 130e6, 100e6}, yield{1.6e6, 1.45e6, 1.15e6, 0.7e6},
      shares{0.1, 0.2, 0.3, 0.4};
  double hardening = 0.05;

  Structure structure() const {
    return make_shear_building(
        {.storeys = 4, .mass = 200e3, .stiffness = stiffness, .yield_force = yield, .hardening = hardening});
  }
  Eigen::VectorXd load() const { return Eigen::Map<const Eigen::VectorXd>(shares.data(), 4); }
  // Displacement of the roof while the base shear grows for the first time.
  double roof(double base_shear) const {
    double sum = 0, share = 1;
    for (std::size_t i = 0; i < 4; share -= shares[i++]) {
      const double v = share * base_shear;
      sum += v <= yield[i] ? v / stiffness[i] : yield[i] / stiffness[i] + (v - yield[i]) / (hardening * stiffness[i]);
    }
    return sum;
  }
};

TEST(PushPath, IsThatOfStoreysInSeries) {
  const Storeys storeys;
  const PushPath path = push(storeys.structure(), at(3, storeys.load(), {0.5}));
  Book book("pushover of storeys in series", "closed form: every storey by its own bilinear law", "rounding");
  for (std::size_t i = 1; i < path.points.size(); ++i)
    book.near("displacement of the roof [m]", path.points[i].displacement, storeys.roof(path.points[i].factor), 1e-14);
  // In order of strength over the fraction of the load: 1.6, 1.611, 1.643, 1.75 MN.
  std::vector<int> order;
  for (const PushEvent& event : path.events) order.push_back(event.part);
  EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(path.mechanism, 1) << "one yielding storey is a mechanism";
}

TEST(PushPath, GoesRoundTheLoopOfAStorey) {
  const Structure s =
      make_oscillator({.mass = 1e5, .stiffness = 10e6, .damping_ratio = 0.0, .yield_force = 100e3, .hardening = 0.1});
  const PushPath path = push(s, at(0, Eigen::VectorXd::Ones(1), {0.03, -0.03, 0.03}));
  double area = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i)
    if (path.points[i].displacement != path.points[i - 1].displacement)
      area += 0.5 * (path.points[i].factor + path.points[i - 1].factor) *
              (path.points[i].displacement - path.points[i - 1].displacement);
  // The first branch to 30 mm and a full loop 4 (1 - b) fy (dmax - dy).
  const double first = 0.5 * 0.01 * 100e3 + 0.02 * 110e3, loop = 4 * 0.9 * 100e3 * 0.02;
  EXPECT_NEAR(area, first + loop, 1e-9 * loop);
  std::vector<PushEvent::Kind> kinds;
  for (const PushEvent& event : path.events) kinds.push_back(event.kind);
  using enum PushEvent::Kind;
  EXPECT_EQ(kinds, (std::vector{yields, unloads, yields, unloads, yields}));
  EXPECT_TRUE(path.events.front().is_first);
  EXPECT_FALSE(path.events.back().is_first);
}

TEST(PushPath, GoesOnWhenStoreysWithoutHardeningYieldTogether) {
  Storeys storeys;
  storeys.hardening = 0;
  storeys.yield = {1.6e6, 0.9 * 1.6e6, 0.7 * 1.6e6, 0.4 * 1.6e6};  // all storeys yield simultaneously
  const PushPath path = push(storeys.structure(), at(3, storeys.load(), {0.5}));
  EXPECT_EQ(path.collapse, "");
  EXPECT_NEAR(path.points.back().factor, 1.6e6, 1e-6);
  EXPECT_EQ(path.points.back().displacement, 0.5);
}

TEST(PushPath, FollowsALoadThatFallsToItsEnd) {
  // P-Delta as a spring of negative stiffness in parallel with a storey without hardening. Yields at 100 kN and 10 mm,
  // then falls by 1 MN/m from 90 kN to zero at 100 mm.
  Structure s =
      make_oscillator({.mass = 1e5, .stiffness = 10e6, .damping_ratio = 0.0, .yield_force = 100e3, .hardening = 0.0});
  s.stiffness.coeffRef(0, 0) -= 1e6;
  const PushPath path = push(s, at(0, Eigen::VectorXd::Ones(1), {0.2}));
  ASSERT_EQ(path.points.size(), 3u);
  EXPECT_NEAR(path.points[1].factor, 90e3, 1e-6);
  EXPECT_NEAR(path.points[2].displacement, 0.1, 1e-12);
  EXPECT_NEAR(path.points[2].factor, 0, 1e-6);
  EXPECT_TRUE(test::mentions(path.collapse, {"100 mm", "1"}));
}

TEST(PushPath, StartsFromTheDeformationsOfGravity) {
  const HingedFrame frame;
  Structure s = frame.with_springs();
  const double yield = s.yielding[2].yield_deformation();
  s.yielding[2].at_rest = 0.5 * yield;
  s.yielding[3].at_rest = -0.5 * yield;
  const PushPath path = push(s, at(frame.roof(), frame.triangular(s.size()), {0.25}));
  EXPECT_NEAR(path.points.front().deformations[2], 0.5 * yield, 1e-18);
  // One end of the beam at half the moment, then the other.
  EXPECT_NEAR(path.points[1].displacement, 0.5 * 22.21674e-3, 1e-8);
  EXPECT_EQ(yields_at(s, path, 1).size(), 1u);
}

TEST(PushPath, RefusesWhatCannotBePushed) {
  const HingedFrame frame;
  Structure s = frame.with_springs();
  s.yielding[2].at_rest = -1.25 * s.yielding[2].yield_deformation();
  const auto push_it = [&] { push(s, at(frame.roof(), frame.triangular(s.size()), {0.25})); };
  EXPECT_TRUE(test::mentions(test::refusal(push_it), {"1.25"}));
  EXPECT_NE(test::refusal([&] { push(s, at(frame.roof(), -frame.triangular(s.size()), {0.25})); }), "taken");
  s.yielding.clear();
  EXPECT_NE(test::refusal(push_it), "taken");
}

TEST(PushPath, LeavesTheSpringsAsTheyWereGiven) {
  const HingedFrame frame;
  const Structure s = frame.in_series();
  const PushOptions options = at(frame.roof(), frame.triangular(s.size()), {0.1, -0.1, 0.25});
  const PushPath first = push(s, options), second = push(s, options);
  ASSERT_EQ(first.points.size(), second.points.size());
  for (std::size_t i = 0; i < first.points.size(); ++i) EXPECT_EQ(first.points[i].factor, second.points[i].factor);
}

// An independent path: Newton's method for all unknowns and the load factor in small steps, bilinear hinges by a
// separate return mapping.
class SmallSteps {
 public:
  SmallSteps(const Structure& s, const Eigen::VectorXd& load, int control, double hardening)
      : load_(load), control_(control), hardening_(hardening), u_(Eigen::VectorXd::Zero(load.size())) {
    members_ = Eigen::MatrixXd(s.stiffness);
    for (const YieldingPart& part : s.yielding) {
      rows_.emplace_back(part.deformation);
      stiffness_.push_back(part.stiffness());
      yield_.push_back(part.yield_deformation());
      slip_.push_back(0);
      members_ -= stiffness_.back() * rows_.back() * rows_.back().transpose();
    }
  }

  // Load factor at a displacement close to the previous one.
  double go(double displacement) {
    const auto n = u_.size();
    double factor = factor_;
    for (int iteration = 0; iteration < 60; ++iteration) {
      Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n + 1, n + 1);
      k.topLeftCorner(n, n) = members_;
      Eigen::VectorXd rest = Eigen::VectorXd::Zero(n + 1);
      rest.head(n) = members_ * u_ - factor * load_;
      for (std::size_t j = 0; j < rows_.size(); ++j) {
        const double d = rows_[j].dot(u_), stretch = d - slip_[j], held = std::clamp(stretch, -yield_[j], yield_[j]);
        const double slope = stiffness_[j] * (held == stretch ? 1 : hardening_);
        rest.head(n) += stiffness_[j] * (hardening_ * d + (1 - hardening_) * held) * rows_[j];
        k.topLeftCorner(n, n) += slope * rows_[j] * rows_[j].transpose();
      }
      k.col(n).head(n) = -load_;
      k(n, control_) = 1;
      rest[n] = u_[control_] - displacement;
      const Eigen::VectorXd step = k.partialPivLu().solve(rest);
      u_ -= step.head(n);
      factor -= step[n];
      if (step.head(n).cwiseAbs().maxCoeff() < 1e-15) break;
    }
    for (std::size_t j = 0; j < rows_.size(); ++j) {
      const double d = rows_[j].dot(u_);
      slip_[j] = std::clamp(slip_[j], d - yield_[j], d + yield_[j]);
    }
    return factor_ = factor;
  }

 private:
  Eigen::MatrixXd members_;
  Eigen::VectorXd load_;
  int control_;
  double hardening_, factor_ = 0;
  std::vector<Eigen::VectorXd> rows_;
  std::vector<double> stiffness_, yield_, slip_;
  Eigen::VectorXd u_;
};

double between(const PushPath& path, std::size_t& piece, double displacement, double way) {
  while (way * (path.points[piece + 1].displacement - displacement) < 0) ++piece;
  const PushPoint &a = path.points[piece], &b = path.points[piece + 1];
  return a.factor + (b.factor - a.factor) * (displacement - a.displacement) / (b.displacement - a.displacement);
}

TEST(PushPath, MeetsNewtonsMethodInSmallStepsThroughCycles) {
  HingedFrame frame;
  frame.storeys = 4;
  frame.hardening = 0.02;
  frame.foot_moment = 210e3;
  const Structure s = frame.with_springs();
  Eigen::VectorXd load = frame.triangular(s.size());
  load[0] += 0.3;  // a larger force on one floor: hinges unload along the path
  const std::vector<double> targets{0.08, -0.12, 0.2, -0.05, 0.3};
  const PushPath path = push(s, at(frame.roof(), load, targets));
  SmallSteps other(s, load, frame.roof(), frame.hardening);
  double from = 0, largest = 0, worst = 0;
  std::size_t piece = 0;
  for (const double target : targets) {
    const double way = target > from ? 1 : -1;
    for (int i = 1; i <= 500; ++i) {
      const double displacement = i == 500 ? target : from + i * (target - from) / 500;
      const double factor = other.go(displacement);
      worst = std::max(worst, std::abs(factor - between(path, piece, displacement, way)));
      largest = std::max(largest, std::abs(factor));
    }
    ++piece;
    from = target;
  }
  Book book("cyclic pushover of a frame with hinges", "Newton's method for all unknowns in 2500 steps, in this test",
            "steps with a reversal of a hinge are not exact there");
  book.below("largest difference of the load over its largest value [-]", worst / largest, 1e-9);
  EXPECT_GT(path.events.size(), 40u);
}

// Storeys in series with another hysteretic law.
template <class L>
L storey_law(const Storeys& storeys, std::size_t i) {
  L law;
  law.initial_stiffness = storeys.stiffness[i];
  law.yield_force = storeys.yield[i];
  law.hardening = storeys.hardening;
  return law;
}

template <class L>
Structure storeys_by(const Storeys& storeys) {
  Structure s = storeys.structure();
  for (std::size_t i = 0; i < s.yielding.size(); ++i)
    s.yielding[i] = YieldingPart(s.yielding[i].name, s.yielding[i].deformation, std::string(L::name), {},
                                 std::make_unique<HystereticSpring<L>>(storey_law<L>(storeys, i)));
  return s;
}

double share_above(const Storeys& storeys, std::size_t storey) {
  double share = 0;
  for (std::size_t i = storey; i < storeys.shares.size(); ++i) share += storeys.shares[i];
  return share;
}

TEST(PushPath, MeetsTheTangensHyperbolicusOfBoucAndWen) {
  const Storeys storeys;
  const PushPath path = push(storeys_by<hysteresis::BoucWen>(storeys), at(3, storeys.load(), {0.3}));
  Book book("pushover of storeys that follow Bouc and Wen", "closed form: f = a k d + (1 - a) k dy tanh(d/dy)",
            "Newton's method converged to round-off");
  double worst = 0;
  for (const PushPoint& point : path.points)
    for (std::size_t i = 0; i < 4; ++i) {
      const double k = storeys.stiffness[i], dy = storeys.yield[i] / k,
                   d = point.deformations[static_cast<Eigen::Index>(i)];
      const double force = 0.05 * k * d + 0.95 * k * dy * std::tanh(d / dy);
      worst = std::max(worst, std::abs(force - share_above(storeys, i) * point.factor) / storeys.yield[i]);
    }
  book.below("largest difference of a storey shear over the yield force [-]", worst, 1e-11);
  ASSERT_EQ(path.events.size(), 4u);
  for (const PushEvent& event : path.events) {
    const auto i = static_cast<std::size_t>(event.part);
    EXPECT_TRUE(event.is_first && event.kind == PushEvent::Kind::yields);
    EXPECT_NEAR(path.points[event.point].deformations[event.part] * storeys.stiffness[i] / storeys.yield[i], 1, 1e-7);
  }
}

template <class L>
class PushPathOfLaw : public testing::Test {};
using Laws =
    testing::Types<hysteresis::Bilinear, hysteresis::BoucWen, hysteresis::MenegottoPinto, hysteresis::PeakOriented>;
TYPED_TEST_SUITE(PushPathOfLaw, Laws);

TYPED_TEST(PushPathOfLaw, KeepsEveryStoreyOnItsLawThroughCycles) {
  const Storeys storeys;
  const std::vector<double> targets{0.08, -0.06, 0.12, 0.1, 0.15, -0.2};
  const PushPath path = push(storeys_by<TypeParam>(storeys), at(3, storeys.load(), targets));
  ASSERT_EQ(path.collapse, "");
  for (std::size_t i = 0; i < 4; ++i) {
    const auto law = storey_law<TypeParam>(storeys, i);
    typename TypeParam::State state;
    std::size_t point = 0;
    for (const double target : targets) {
      while (path.points[point].displacement != target) ++point;
      const double d = path.points[point].deformations[static_cast<Eigen::Index>(i)];
      // Storeys in series reverse simultaneously, so that each target ends a branch of the law.
      EXPECT_NEAR(law.respond(state, d).force, share_above(storeys, i) * path.points[point].factor,
                  1e-9 * storeys.yield[i])
          << i << " at " << target;
      state = law.advance(state, d);
    }
  }
}

TEST(PushPath, YieldsOnTheStrongSideWhereThatYields) {
  Storeys storeys;
  Structure s = storeys.structure();
  hysteresis::Bilinear law = storey_law<hysteresis::Bilinear>(storeys, 0);
  law.negative_yield_force = 0.5 * law.yield_force;
  s.yielding[0] = YieldingPart("storey 1", s.yielding[0].deformation, "bilinear", {},
                               std::make_unique<HystereticSpring<hysteresis::Bilinear>>(law));
  const PushPath right = push(s, at(3, storeys.load(), {0.3})), left = push(s, at(3, storeys.load(), {-0.3}));
  EXPECT_NEAR(right.points[right.events.front().point].factor, 1.6e6, 1e-3);
  EXPECT_NEAR(left.points[left.events.front().point].factor, -0.8e6, 1e-3);
  for (const PushEvent& event : right.events) EXPECT_EQ(event.kind, PushEvent::Kind::yields);
  EXPECT_EQ(left.events.front().kind, PushEvent::Kind::yields);
}

}  // namespace push_path_test
}  // namespace pounding
