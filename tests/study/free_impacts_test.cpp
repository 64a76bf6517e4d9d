// Two free bodies that collide once, with every penalty law, against the free impact of the integrator of the laws.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <pounding/laws/compiled.hpp>
#include <pounding/study/kernel.hpp>

#include "support/book.hpp"

namespace pounding::study {
namespace free_impacts_test {

class FreeBodies : public testing::TestWithParam<std::string> {
 protected:
  static constexpr double m1 = 1e5, m2 = 1.5e5, m = m1 * m2 / (m1 + m2), v = 0.5;

  static laws::AnyLaw law() {
    laws::Settings settings = laws::typical_settings(laws::find_law(GetParam()));
    settings.reduced_mass = m;
    return laws::make_law(settings);
  }

  // The left body moves and the right one is at rest, 100 mm apart.
  static LinearModel bodies() {
    LinearModel model;
    const double r1 = std::sqrt(m1), r2 = std::sqrt(m2);
    model.stiffness = model.damping = model.load = {0, 0};
    model.velocity = {v * r1, 0};
    model.links.push_back({.gap = 0.1, .closing = {1 / r1, -1 / r2}, .law = law()});
    model.outputs.push_back({.kind = Output::Kind::acceleration, .factors = {1 / r1, 0}});
    return model;
  }
};

TEST_P(FreeBodies, MeetAsTheFreeImpactOfTheLaw) {
  test::Book book("The kernel of studies", "free impacts in closed form or integrated to 1e-10, every penalty law",
                  "tolerance 1e-8 per step, about 50 steps: 1e-6");
  const std::vector<double> still(60, 0.0);
  const Peaks found = run(bodies(), {.accelerations = still, .step = 0.01}, {.tolerance = 1e-8});
  const laws::FreeImpact expected = laws::free_impact(law(), m, v);
  ASSERT_EQ(found.links[0].impacts, 1);
  const double loss = 0.5 * m * v * v * (1 - expected.restitution * expected.restitution);
  book.near("peak force of a free impact [N]", found.links[0].peak_force, expected.peak_force,
            1e-6 * expected.peak_force);
  book.near("peak penetration of a free impact [m]", found.links[0].peak_penetration, expected.peak_penetration,
            1e-6 * expected.peak_penetration);
  book.near("impulse of a free impact [N s]", found.links[0].impulse, m * v * (1 + expected.restitution), 1e-6 * m * v);
  book.near("energy lost in a free impact [J]", found.links[0].energy_lost, loss, 1e-6 * 0.5 * m * v * v);
  // Only the contact accelerates the body.
  EXPECT_NEAR(found.outputs[0], found.links[0].peak_force / m1, 1e-5 * found.outputs[0]);
}

TEST_P(FreeBodies, KeepTheEnergyOfAContactThatStillPresses) {
  const std::vector<double> still(60, 0.0);
  LinearModel model = bodies();
  const laws::FreeImpact whole = laws::free_impact(law(), m, v);
  const double end = 0.1 / v + 0.3 * whole.duration;
  const Peaks found = run(model, {.accelerations = still, .step = 0.01}, {.duration = end, .tolerance = 1e-8});
  EXPECT_EQ(found.links[0].impacts, 1);
  EXPECT_GE(found.links[0].energy_lost, -1e-9 * m * v * v);
  EXPECT_LT(found.links[0].energy_lost, 0.5 * m * v * v);
}

std::vector<std::string> penalty_laws() {
  std::vector<std::string> names;
  for (const laws::Entry& entry : laws::catalogue())
    if (!entry.instantaneous) names.emplace_back(entry.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(EveryPenaltyLaw, FreeBodies, testing::ValuesIn(penalty_laws()),
                         [](const auto& test) { return test.param; });

}  // namespace free_impacts_test
}  // namespace pounding::study
