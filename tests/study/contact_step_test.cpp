// Steps in contact after touch, where a Hertz force grows as d^1.5: their order with steps in time and in a root of
// time.

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/laws/compiled.hpp>
#include <pounding/study/contact_step.hpp>
#include <pounding/study/series_step.hpp>

namespace pounding::study {
namespace contact_step_test {

/// Error of the rate after a fraction of an impact of unit mass, speed and stiffness, in `count` equal steps in t or in
/// a root of t.
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

  /// Observed order of the error from 32 to 64 steps.
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

TEST(AStepInContact, GoesExactlyOverABendOfTheGround) {
  LinearModel model;
  model.stiffness = model.damping = {0}, model.load = {1};
  model.links.push_back({.gap = 1e3, .closing = {1}, .law = laws::Hertz{.stiffness = 1}});
  const Structures<1, 1> structures(model);
  ContactStep<laws::Hertz, 1, 1> step(structures);
  std::vector<LinkContact<laws::Hertz>> links;
  links.emplace_back(laws::Hertz{.stiffness = 1}, 1e3);
  auto begin = step.moment(), end = begin;
  const Ground ground{.at = 2, .slope = -3, .corner = 0.37, .bend = 50};
  step.complete(links, ground, begin);
  const double u = 1 - 0.37, error = step.take(links, ground, Clock(), begin, 0, 1, 1, 1, end);
  // q'' = -a g; the step detects no missed event.
  EXPECT_NEAR(end.v[0], -(2 - 3 / 2.0 + 50 * u * u / 2), 1e-13);
  EXPECT_NEAR(end.q[0], -(2 / 2.0 - 3 / 6.0 + 50 * u * u * u / 6), 1e-13);
  EXPECT_NEAR(end.a[0], -(2 - 3 + 50 * u), 1e-13);
  EXPECT_LT(error, 1e-24);
}

TEST(TheFirstStepsOfAnImpact, HaveOrderTwoAndAHalfByTimeAndFiveByItsRoot) {
  const Impact impact(laws::Hertz{.stiffness = 1});
  // The force is smooth except for t^1.5 at the touch: its integral over a first step h has an error of h^2.5.
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

/// A free body of unit mass that hits a wall with a linear law at unit speed, integrated by the series of its motion in
/// equal steps.
template <class Law>
LinkPeaks series_impact(const Law& law, double end, int count, double& d, double& rate, double tolerance) {
  LinearModel model;
  model.stiffness = model.damping = model.load = {0};
  model.links.push_back({.gap = 0, .closing = {1}, .law = law});
  const Structures<1, 1> structures(model);
  SeriesStep<Law, 1, 1> step(structures);
  std::vector<LinkContact<Law>> links;
  links.emplace_back(law, 0.0);
  links[0].apply(LinkEvent::touch, 0, 1);
  auto begin = step.moment(), after = begin;
  begin.v[0] = 1;
  step.complete(links, {}, begin);
  for (int i = 0; i < count; ++i) {
    step.begin(links, {}, begin, tolerance);
    EXPECT_LE(end / count, step.longest() * (1 + 1e-12));
    step.take(links, {}, Clock(), begin, 0, 0, end * (i + 1) / count, 1, after);
    step.push(0, links[0]);
    std::swap(begin, after);
  }
  d = begin.q[0], rate = begin.v[0];
  return links[0].peaks();
}

TEST(TheSeriesOfALinearLaw, IsTheDampedVibration) {
  const double c = 0.3, w = std::sqrt(1 - c * c / 4);
  for (const auto& [tolerance, longest, bound] :
       {std::tuple{1e-5, 1.75, 3e-8}, {1e-7, 1.25, 3e-10}, {1e-9, 0.9, 3e-12}}) {
    double d = 0, rate = 0;
    const double end = 2 * longest;
    const LinkPeaks peaks =
        series_impact(laws::KelvinVoigt{.stiffness = 1, .damping_coefficient = c}, end, 2, d, rate, tolerance);
    const double expected = std::exp(-c / 2 * end) * std::sin(w * end) / w;
    const double expected_rate = std::exp(-c / 2 * end) * (std::cos(w * end) - c / 2 * std::sin(w * end) / w);
    EXPECT_NEAR(d, expected, 10 * bound);
    EXPECT_NEAR(rate, expected_rate, 10 * bound);
    // The link takes the momentum and energy of the body.
    EXPECT_NEAR(peaks.impulse, 1 - expected_rate, 10 * bound);
    EXPECT_NEAR(peaks.energy_lost, 0.5 * (1 - expected_rate * expected_rate), 1e-7);
  }
}

/// True if the force is k d + c d' with constant coefficients at all penetrations and rates of one sign.
template <class Law>
bool looks_linear() {
  const auto law = std::get<Law>(laws::make_law([] {
    laws::Settings settings = laws::typical_settings(laws::find_law(Law::name));
    settings.reduced_mass = 1e5;
    return settings;
  }()));
  const laws::Impact impact = laws::touch(law, 0.5);
  for (const double sign : {1.0, -1.0}) {
    const laws::Response one = law.contact(1, sign, impact);
    for (const double d : {1e-5, 1e-3, 0.3})
      for (const double rate : {1e-4, 0.1, 2.0}) {
        const laws::Response r = law.contact(d, sign * rate, impact);
        const double force = one.by_penetration * d + one.by_rate * sign * rate;
        if (r.by_penetration != one.by_penetration || r.by_rate != one.by_rate ||
            std::abs(r.force - force) > 1e-12 * std::abs(r.force))
          return false;
      }
  }
  return true;
}

template <std::size_t I = 0>
void compare_linear_laws() {
  if constexpr (I < std::variant_size_v<laws::AnyLaw>) {
    using Law = std::variant_alternative_t<I, laws::AnyLaw>;
    if constexpr (!laws::instantaneous<Law>) {
      EXPECT_EQ(laws::is_linear<Law>, looks_linear<Law>()) << Law::name;
    }
    compare_linear_laws<I + 1>();
  }
}

TEST(TheLawsThatTakeASeries, AreThoseWithAForceThatIsLinear) { compare_linear_laws(); }

TEST(TheTermsOfAFlight, AreAsManyAsTheErrorWants) {
  for (const double reach : {0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
    const int order = taylor_order_for(reach);
    const Jet jet = motion(order, 1, 0, 1, 0, 0, 0).at(reach);
    EXPECT_NEAR(jet.x, std::cos(reach), 1e-12) << reach;
    EXPECT_NEAR(jet.v, -std::sin(reach), 2e-11) << reach;
    EXPECT_TRUE(order == 4 || std::pow(reach, order) / std::tgamma(order + 1) > 1e-13) << reach << ": unexpected terms";
  }
  EXPECT_EQ(taylor_order_for(1), taylor_order);
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
