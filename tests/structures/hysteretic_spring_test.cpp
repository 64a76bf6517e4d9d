// Springs with hysteretic laws, by name, with the test as integrator.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pounding/hysteresis/all.hpp>
#include <pounding/structures/make_spring.hpp>
#include <pounding/structures/structure.hpp>
#include "support/messages.hpp"

#include "support/bilinear_spring.hpp"

namespace pounding {
namespace hysteretic_spring_test {

using Loaded = test::Loaded<Spring>;

Loaded load(const hysteresis::Settings& settings) { return Loaded(make_spring(settings)); }

LinkStep step(const LinkMotion& begin, const LinkMotion& end) {
  return {.begin = 0, .end = 0.01, .motion_begin = begin, .motion_middle = {}, .motion_end = end};
}

/// Some decaying harmonics about a drift, over the yield deformation.
LinkMotion motion(double t, double dy) {
  const double u = 2.5 * std::sin(7 * t) + 1.2 * std::sin(23 * t + 0.4) - 1.2 * std::sin(0.4),
               v = 17.5 * std::cos(7 * t) + 27.6 * std::cos(23 * t + 0.4);
  return {dy * u, dy * v};
}

// The original formulas of the return mapping, which results of runs match bitwise.
TEST(HystereticSpring, ABilinearOneHasTheBitsOfItsReturnMapping) {
  const double k = 1.7e6, fy = 2.3e4, a = 0.07, yielding = (1 - a) * k, yield = fy / k;
  double slip = 0, kept = 0, lost = 0;
  test::LoadedBilinear spring(BilinearSpring::Parameters{.stiffness = k, .yield_force = fy, .hardening = a});
  const auto follow = [&](double d) {
    const double next = std::clamp(slip, d - yield, d + yield);
    lost += yielding * yield * std::abs(next - slip);
    slip = next;
    kept = d;
  };
  int yielded = 0;
  for (int i = 0; i < 1000; ++i) {
    const LinkMotion begin = motion(0.01 * i, yield), end = motion(0.01 * (i + 1), yield);
    for (const double d : {begin.penetration, end.penetration, 2 * end.penetration}) {
      const double stretch = d - slip;
      const bool is_elastic = std::abs(stretch) <= yield;
      const laws::Response r = spring.evaluate({d, 0});
      EXPECT_EQ(r.force, is_elastic ? -yielding * slip : yielding * (std::copysign(yield, stretch) - d));
      EXPECT_EQ(r.by_penetration, is_elastic ? 0 : -yielding);
      yielded += !is_elastic;
    }
    if (begin.rate * end.rate < 0) {
      const CubicPenetration between(begin, end, 0.01);
      if (const double s = between.turn(); s > 0 && s < 1) follow(between.at(s));
    }
    follow(end.penetration);
    spring.accept(step(begin, end));
    ASSERT_EQ(spring.slip(), slip);
    ASSERT_EQ(spring.lost(), lost);
    ASSERT_EQ(spring.stored_correction(), yielding * slip * (0.5 * slip - kept));
  }
  EXPECT_GT(yielded, 300);
}

// Work by the trapezoidal rule on a fine path; the spring takes each of its steps.
TEST(HystereticSpring, StoresAndLosesTheWorkDoneOnItByEveryLaw) {
  for (const hysteresis::Entry& entry : hysteresis::catalogue()) {
    Loaded spring = load(hysteresis::typical_settings(entry));
    const double dy = spring.yield_deformation(), k = spring.stiffness();
    double work = 0;
    LinkMotion last = motion(0, dy);
    for (int i = 1; i <= 20000; ++i) {
      const LinkMotion next = motion(1e-4 * i, dy);
      const auto force = [&](double d) { return k * d + spring.evaluate({d, 0}).force; };
      const double before = force(last.penetration), after = force(next.penetration);
      spring.accept({.begin = 0, .end = 1e-4, .motion_begin = last, .motion_middle = {}, .motion_end = next});
      work += 0.5 * (before + after) * (next.penetration - last.penetration);
      last = next;
    }
    const double stored = 0.5 * k * last.penetration * last.penetration + spring.stored_correction();
    EXPECT_NEAR(stored + spring.lost(), work, 1e-4 * work) << entry.name;
    const bool is_elastic = entry.name == "multilinear_elastic" || entry.name == "uplift";
    EXPECT_EQ(spring.lost() > 0.05 * k * dy * dy, !is_elastic) << entry.name;
  }
}

TEST(HystereticSpring, GoesOnFromItsArchiveWithTheSameBitsByEveryLaw) {
  for (const hysteresis::Entry& entry : hysteresis::catalogue()) {
    const hysteresis::Settings settings = hysteresis::typical_settings(entry);
    Loaded spring = load(settings), copy = load(settings);
    const double dy = spring.yield_deformation();
    const auto drive = [dy](Loaded& s, int from, int to) {
      for (int i = from; i < to; ++i) s.accept(step(motion(0.01 * i, dy), motion(0.01 * (i + 1), dy)));
    };
    drive(spring, 0, 137);
    Archive written;
    spring.archive(written);
    Archive read(written.bytes());
    copy.archive(read);
    read.expect_end();
    drive(spring, 137, 300);
    drive(copy, 137, 300);
    const auto bits = [dy](const Loaded& s) {
      return std::vector<double>{s.lost(), s.stored_correction(), s.evaluate({3 * dy, 0}).force,
                                 s.evaluate({-2 * dy, 0}).by_penetration};
    };
    EXPECT_EQ(std::memcmp(bits(spring).data(), bits(copy).data(), 4 * sizeof(double)), 0) << entry.name;
  }
}

// Compared with differences of the force before and after the reversal, which a copy of the spring retains.
TEST(HystereticSpring, SaysHowTheSlopeJumpsWhereItTurnsByEveryLaw) {
  std::vector<hysteresis::Settings> all;
  for (const hysteresis::Entry& entry : hysteresis::catalogue()) all.push_back(hysteresis::typical_settings(entry));
  all.push_back({.law = "bouc_wen", .values = {{"stiffness", 1e7}, {"yield_force", 1e5}}});
  for (const hysteresis::Settings& settings : all) {
    Loaded spring = load(settings), turned = load(settings);
    const double dy = spring.yield_deformation(), k = spring.stiffness(), way = 1e-5 * dy;
    int jumps = 0, compared = 0;
    for (int i = 0; i < 300; ++i) {
      const LinkMotion begin = motion(0.01 * i, dy), end = motion(0.01 * (i + 1), dy);
      const double d = end.penetration;
      turned.accept(step(begin, end));
      if (begin.rate * end.rate > 0 && std::abs(d - begin.penetration) > 10 * way) {
        const double direction = std::copysign(1, d - begin.penetration);
        const auto slope = [&](const Loaded& of, double from, double to) {
          return (of.evaluate({to, 0}).force - of.evaluate({from, 0}).force) / (to - from);
        };
        // The force of a law may drop where it turns, so the slope behind starts a little later.
        const double before = slope(spring, d - direction * way, d),
                     behind = slope(turned, d - 1e-3 * direction * way, d - direction * way);
        const double earlier = slope(spring, d - 2 * direction * way, d - direction * way);
        // Without a corner.
        if (std::abs(before - earlier) < 1e-4 * k) {
          EXPECT_NEAR(spring.slope_lost(d), behind - before, 2e-4 * k) << settings.law << " step " << i;
          ++compared;
          jumps += std::abs(behind - before) > 0.01 * k;
        }
      }
      spring.accept(step(begin, end));
    }
    EXPECT_GT(compared, 200) << settings.law;
    EXPECT_EQ(jumps > 10, settings.law != "multilinear_elastic" && settings.law != "uplift")
        << settings.law << " " << jumps;
  }
}

// After elastic unloading to half of its force, the stiffness of a Bouc-Wen spring drops immediately on reloading.
TEST(HystereticSpring, ASmallExcursionOfBoucWenTurnsSharplyTwice) {
  const double k = 1e7, fy = 1e5;
  Loaded spring = load({.law = "bouc_wen", .values = {{"stiffness", k}, {"yield_force", fy}, {"hardening", 0}}});
  const double yielding = 2 * fy / k, y = std::tanh(2);
  spring.accept(step({0, 1}, {yielding, 1}));
  EXPECT_NEAR(spring.slope_lost(yielding + 1e-12) / k, y * y, 1e-6) << "it unloads with k";
  const double back = yielding - 0.3 * fy / k;
  EXPECT_NEAR(spring.slope_lost(back) / k, -(y - 0.3) * (y - 0.3), 1e-6) << "it had unloaded with k";
}

TEST(HystereticSpring, BeginsWhereTheRunDoesWithoutALoss) {
  Loaded spring = load({.law = "bouc_wen", .values = {{"stiffness", 1e6}, {"yield_force", 1e4}}});
  spring.start({0.005, 0});
  EXPECT_EQ(spring.lost(), 0);
  EXPECT_NEAR(0.5 * 1e6 * 0.005 * 0.005 + spring.stored_correction(), 0.5 * 1e6 * std::pow(0.01 * std::tanh(0.5), 2),
              1e-9);
}

TEST(MakeSpring, TakesALawOrItsName) {
  const Loaded spring(
      make_spring(hysteresis::Bilinear{.initial_stiffness = 4e7, .yield_force = 2e5, .negative_yield_force = 1e5}));
  EXPECT_EQ(spring.stiffness(), 4e7);
  EXPECT_NEAR(4e7 * 0.1 + spring.evaluate({0.1, 0}).force, 2e5, 1e-6);
  EXPECT_NEAR(-4e7 * 0.1 + spring.evaluate({-0.1, 0}).force, -1e5, 1e-6);
  EXPECT_TRUE(test::mentions(test::refusal([] { make_spring({.law = "takeda", .values = {}}); }),
                             {"takeda", "bilinear", "menegotto_pinto", "bouc_wen"}));
}

}  // namespace hysteretic_spring_test
}  // namespace pounding
