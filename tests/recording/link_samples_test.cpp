// Samples of an impact: both sides of a jump, and at most as many as the memory allows.

#include <gtest/gtest.h>

#include <algorithm>

#include <fmt/format.h>

#include <pounding/recording/link_samples.hpp>
#include "support/runs.hpp"

namespace pounding {
namespace link_samples_test {

LinkSample sample(double time) {
  return {.time = time,
          .penetration = 1e-3 * time,
          .velocity = 0.5,
          .force = 100 + time,
          .energy = 2 * time,
          .friction = {7, 8}};
}

TEST(ImpactSamples, BeginWithZeroForceAtTheTouch) {
  ImpactSamples samples;
  samples.add(sample(1));
  samples.add(sample(2));
  LinkHistory history;
  history.tangents = 2;
  samples.finish(history);
  EXPECT_EQ(history.time, (std::vector<double>{1, 1, 2}));
  EXPECT_EQ(history.force, (std::vector<double>{0, 101, 102}));
  EXPECT_EQ(history.friction, (std::vector<double>{0, 0, 7, 8, 7, 8}));
  samples.finish(history);
  EXPECT_EQ(history.time.size(), 3u) << "a finished impact has no more samples";
}

TEST(ImpactSamples, OfALongImpactStayBoundedAndKeepBothEnds) {
  constexpr int count = 100'000;
  ImpactSamples samples;
  for (int i = 1; i <= count; ++i) samples.add(sample(i));
  LinkHistory history;
  samples.finish(history);
  EXPECT_LE(history.time.size(), ImpactSamples::max_count + 1);
  EXPECT_GE(history.time.size(), ImpactSamples::max_count / 2);
  EXPECT_EQ(history.time[0], 1);
  EXPECT_EQ(history.time[1], 1);
  EXPECT_EQ(history.force[0], 0);
  EXPECT_EQ(history.time.back(), count);
  EXPECT_TRUE(std::ranges::is_sorted(history.time));
  // Even spacing: no gap is much longer than another.
  double longest = 0;
  for (std::size_t i = 2; i < history.time.size(); ++i)
    longest = std::max(longest, history.time[i] - history.time[i - 1]);
  EXPECT_LE(longest, 2.0 * count / (ImpactSamples::max_count / 2));
}

TEST(ImpactSamples, AreShownWithoutBeingFinished) {
  ImpactSamples samples;
  samples.add(sample(1));
  LinkHistory shown, finished;
  samples.show(shown);
  samples.add(sample(2));
  samples.finish(finished);
  EXPECT_EQ(shown.time, (std::vector<double>{1, 1}));
  EXPECT_EQ(finished.time, (std::vector<double>{1, 1, 2}));
}

TEST(ImpactSamples, GoOnAlikeFromAnArchive) {
  ImpactSamples samples, restored;
  for (int i = 1; i <= 5000; ++i) samples.add(sample(i));
  Archive state;
  samples.archive(state);
  Archive saved(state.bytes());
  restored.archive(saved);
  for (int i = 5001; i <= 6000; ++i) {
    samples.add(sample(i));
    restored.add(sample(i));
  }
  LinkHistory whole, continued;
  samples.finish(whole);
  restored.finish(continued);
  EXPECT_EQ(whole.time, continued.time);
  EXPECT_EQ(whole.force, continued.force);
}

// Bodies that hardly move at the start of a ground motion: between the ends of a first step the path of the contact is
// so flat that the formula of the law gives a pull of 0.5 % of the maximum force until then.
TEST(LinkSamples, InsideAStepShowNoPullOfALawThatNeverPulls) {
  for (const double restitution : {0.05, 0.1, 0.5}) {
    const Outcome run = test::run_text(fmt::format(
        "ground_motion: {{pulse: {{shape: half_sine, amplitude: -4.6, duration: 2.5}}}}\n"
        "structures:\n  a: {{body: {{mass: 3500}}}}\n  b: {{body: {{mass: 2200}}}}\n  w: {{wall: {{}}}}\n"
        "links:\n  - {{between: [a, b], gap: 0, law: kelvin_voigt_no_tension, stiffness: 4.7e5, restitution: {}}}\n"
        "  - {{between: [b, w], gap: 0, law: viscous_hertz, stiffness: 2.5e9, restitution: 0.1}}\n"
        "analysis: {{duration: 1, tolerance: 1e-3}}\n",
        restitution));
    for (const LinkHistory& link : run.results.links) {
      ASSERT_GT(link.force.size(), 20u);
      EXPECT_GE(*std::ranges::min_element(link.force), 0) << link.name << ", restitution " << restitution;
    }
  }
}

}  // namespace link_samples_test
}  // namespace pounding
