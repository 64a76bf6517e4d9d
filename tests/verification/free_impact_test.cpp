// Every law and formula, restitution 0.1 to 0.9: a ball on a wall in complete runs, including link, events and error
// control.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/laws/free_impact.hpp>
#include "support/book.hpp"
#include "support/runs.hpp"
#include "support/typical.hpp"

namespace pounding {
namespace free_impact_test {

struct Case {
  std::string law, formula, parameters;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.law << " " << c.formula; }

// Typical values from the parameter tables of the laws.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const laws::Entry& entry : laws::catalogue()) {
    if (entry.instantaneous) continue;
    std::string parameters;
    for (const laws::ParameterInfo& p : entry.parameters)
      if (p.need == laws::Need::required) parameters += fmt::format(", {}: {}", p.name, test::typical_yaml(p));
    if (entry.formulas.empty()) all.push_back({std::string(entry.name), "", parameters});
    for (const laws::Formula& f : entry.formulas)
      all.push_back({std::string(entry.name), std::string(f.name), parameters});
  }
  return all;
}

// With a yield ratio of 0.1 the unloading branch reaches zero stiffness here: K_t2 = 0 at the design penetration.
constexpr double min_of_bilinear_hertz = 0.354;

class FreeImpact : public testing::TestWithParam<Case> {};

TEST_P(FreeImpact, OfTheTimeIntegrationAgreesWithTheCompanion) {
  test::Book book("A ball on a wall: the time integration with every law and formula",
                  "closed form of the impact, or where the law has none the free impact's own integrator "
                  "(extrapolation to 1e-10)",
                  "run at tolerance 1e-8: 1e-6 of restitution, duration, energy and impulse; 1e-5 of peak force and "
                  "penetration, of which a maximum between two accepted steps is found by a parabola");
  const Case& c = GetParam();
  const double mass = 6e4, speed = 0.8;
  for (int tenths = 1; tenths <= 9; ++tenths) {
    const double requested = c.formula.empty() ? 1 : tenths / 10.0;
    const std::string damping =
        c.formula.empty() ? "" : fmt::format(", restitution: {}, formula: {}", requested, c.formula);
    // Eq. 38 almost stops the bodies at small restitutions: the run must be long enough for them to separate.
    const std::string yaml = fmt::format(
        "structures:\n  ball: {{body: {{mass: {} kg}}, initial_velocity: {} m/s}}\n"
        "  wall: {{wall: {{}}}}\n"
        "links: [{{between: [ball, wall], gap: 5 mm, law: {}{}{}}}]\n"
        "analysis: {{duration: 4, tolerance: 1e-8}}\n",
        mass, speed, c.law, c.parameters, damping);
    if (c.law == "bilinear_hertz" && c.formula == "exact" && requested < min_of_bilinear_hertz) {
      EXPECT_THROW(test::model_of(yaml), InputError) << "a loop cannot lose more than its own area";
      continue;
    }
    const Outcome run = test::run_text(yaml);
    laws::Settings settings = laws::typical_settings(laws::find_law(c.law));
    settings.formula = c.formula;
    settings.reduced_mass = mass;
    settings.restitution = c.formula.empty() ? std::nullopt : std::optional(requested);
    const laws::FreeImpact expected = laws::free_impact(laws::make_law(settings), mass, speed);

    SCOPED_TRACE(fmt::format("target {}", requested));
    ASSERT_EQ(run.results.impacts.size(), 1u);
    const ImpactRow& row = run.results.impacts[0];
    book.near(c.law + ": restitution [-]", row.restitution, expected.restitution, 1e-6);
    if (c.formula == "exact") {
      book.near(c.law + ": restitution of exact against its target [-]", row.restitution, requested, 1e-6);
    }
    book.near(c.law + ": peak force [N]", row.peak_force, expected.peak_force, 1e-5 * expected.peak_force);
    book.near(c.law + ": largest penetration [m]", row.peak_penetration, expected.peak_penetration,
              1e-5 * expected.peak_penetration);
    // adams_impact presses again in the last micrometre, with 1e-6 of its peak force, until the bodies part.
    const double released = c.law == "adams_impact" ? row.t_end : row.t_release;
    book.near(c.law + ": duration [s]", released - row.t_start, expected.duration, 1e-6 * expected.duration);
    book.near(c.law + ": energy lost [J]", row.energy_lost, expected.energy_lost, 1e-6 * 0.5 * mass * speed * speed);
    book.near(c.law + ": impulse [N s]", row.impulse, expected.impulse, 1e-6 * mass * speed);
    if (c.formula.empty()) break;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLawAndFormula, FreeImpact, testing::ValuesIn(cases()), [](const auto& test) {
  return test.param.formula.empty() ? test.param.law : test.param.law + "__" + test.param.formula;
});

}  // namespace free_impact_test
}  // namespace pounding
