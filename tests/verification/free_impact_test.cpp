// Every law and formula, restitution 0.1 to 0.9: the time integration of a ball on a wall against the closed form, or
// against the companion's own integrator (another scheme, 1e-10) where the law has none.
//
// Run at tolerance 1e-8, as it comes out of the program: link, events and error control included. Restitution to 1e-6;
// peak force and penetration to 1e-5 of themselves (a maximum between two kept steps is found by a parabola); duration
// to 1e-6 of itself. `exact` gives what is asked to 1e-6.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/error.hpp>
#include <pounding/laws/free_impact.hpp>
#include "support/runs.hpp"

namespace pounding {
namespace {

struct Case {
  std::string law, formula, parameters;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.law << " " << c.formula; }

// Typical values from the laws' own tables.
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const laws::Entry& entry : laws::catalogue()) {
    if (entry.instantaneous) continue;
    std::string parameters;
    for (const laws::ParameterInfo& p : entry.parameters)
      if (p.need == laws::Need::required) parameters += fmt::format(", {}: {}", p.name, p.typical);
    if (entry.formulas.empty()) all.push_back({std::string(entry.name), "", parameters});
    for (const laws::Formula& f : entry.formulas)
      all.push_back({std::string(entry.name), std::string(f.name), parameters});
  }
  return all;
}

// With a yield ratio of 0.1 the unloading branch reaches zero stiffness here: K_t2 = 0 at the design penetration.
constexpr double least_of_bilinear_hertz = 0.354;

class FreeImpact : public testing::TestWithParam<Case> {};

TEST_P(FreeImpact, OfTheTimeIntegrationAgreesWithTheCompanion) {
  const Case& c = GetParam();
  const double mass = 6e4, speed = 0.8;
  for (int tenths = 1; tenths <= 9; ++tenths) {
    const double asked = c.formula.empty() ? 1 : tenths / 10.0;
    const std::string damping = c.formula.empty() ? "" : fmt::format(", restitution: {}, formula: {}", asked, c.formula);
    // Eq. 38 at small restitutions all but stops the bodies: they get time to part.
    const std::string yaml = fmt::format("structures:\n  ball: {{body: {{mass: {} kg}}, initial_velocity: {} m/s}}\n"
                                                   "  wall: {{wall: {{}}}}\n"
                                                   "links: [{{between: [ball, wall], gap: 5 mm, law: {}{}{}}}]\n"
                                                   "analysis: {{duration: 4, tolerance: 1e-8}}\n",
                                                   mass, speed, c.law, c.parameters, damping);
    if (c.law == "bilinear_hertz" && c.formula == "exact" && asked < least_of_bilinear_hertz) {
      EXPECT_THROW(test::model_of(yaml), InputError) << "a loop cannot lose more than its own area";
      continue;
    }
    const Outcome run = test::run_text(yaml);
    laws::Settings settings{.law = c.law, .formula = c.formula, .reduced_mass = mass};
    if (!c.formula.empty()) settings.restitution = asked;
    for (const laws::ParameterInfo& p : laws::find_law(c.law).parameters)
      if (p.need == laws::Need::required) settings.values.emplace(p.name, p.typical);
    const laws::FreeImpact expected = laws::free_impact(laws::make_law(settings), mass, speed);

    SCOPED_TRACE(fmt::format("asked {}", asked));
    ASSERT_EQ(run.results.impacts.size(), 1u);
    const ImpactRow& row = run.results.impacts[0];
    EXPECT_NEAR(row.restitution, expected.restitution, 1e-6);
    if (c.formula == "exact") {
      EXPECT_NEAR(row.restitution, asked, 1e-6);
    }
    EXPECT_NEAR(row.peak_force, expected.peak_force, 1e-5 * expected.peak_force);
    EXPECT_NEAR(row.peak_penetration, expected.peak_penetration, 1e-5 * expected.peak_penetration);
    // adams_impact presses again in the last micrometre, with a millionth of its peak force, until the bodies part.
    const double released = c.law == "adams_impact" ? row.t_end : row.t_release;
    EXPECT_NEAR(released - row.t_start, expected.duration, 1e-6 * expected.duration);
    EXPECT_NEAR(row.energy_lost, expected.energy_lost, 1e-6 * 0.5 * mass * speed * speed);
    EXPECT_NEAR(row.impulse, expected.impulse, 1e-6 * mass * speed);
    if (c.formula.empty()) break;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLawAndFormula, FreeImpact, testing::ValuesIn(cases()), [](const auto& test) {
  return test.param.formula.empty() ? test.param.law : test.param.law + "__" + test.param.formula;
});

// The paper's section 5.1: m1 = 100 t, m2 = 150 t (m = 60 t), k = 22000 kN/m^1.5, v = 15 m/s.
// Source: table T5 of the catalogue of laws, by DOP853 at 1e-12 and closed forms; all digits printed there.
struct Row {
  double asked;
  const char *law, *formula;
  double restitution, penetration, force, duration, lost;  // m, kN, s, kJ
};

const Row section_5_1[] = {
    {0.3, "hertz_damped", "exact", 0.30000, 0.592582, 19531.03, 0.226945, 6142.500},
    {0.3, "hertz_damped", "naderpour_2015", 0.25217, 0.562166, 20437.25, 0.240351, 6320.755},
    {0.3, "hertz_damped", "lankarani_nikravesh", 0.68422, 0.778214, 16949.77, 0.185726, 3589.898},
    {0.3, "hertz_damped", "ye_2009", 0.25621, 0.564862, 20350.99, 0.239042, 6306.913},
    {0.3, "jankowski", "jankowski_2005", 0.37652, 0.411679, 19514.75, 0.173432, 5793.074},
    {0.3, "jankowski", "exact", 0.30000, 0.343262, 24635.68, 0.173420, 6142.500},
    {0.5, "hertz_damped", "exact", 0.50000, 0.697520, 17444.15, 0.197608, 5062.500},
    {0.5, "hertz_damped", "naderpour_2015", 0.46783, 0.682228, 17651.28, 0.200678, 5272.651},
    {0.5, "hertz_damped", "lankarani_nikravesh", 0.72524, 0.794958, 16991.26, 0.183960, 3199.671},
    {0.5, "hertz_damped", "ye_2009", 0.47044, 0.683487, 17632.96, 0.200413, 5256.102},
    {0.5, "jankowski", "jankowski_2005", 0.55817, 0.564081, 13766.88, 0.174158, 4647.011},
    {0.5, "jankowski", "exact", 0.50000, 0.516541, 14785.65, 0.173875, 5062.500},
    {0.7, "hertz_damped", "exact", 0.70000, 0.784698, 16959.19, 0.185019, 3442.500},
    {0.7, "hertz_damped", "naderpour_2015", 0.70811, 0.788011, 16967.21, 0.184669, 3365.382},
    {0.7, "jankowski", "jankowski_2005", 0.72710, 0.696950, 14017.88, 0.175054, 3181.491},
    {0.7, "jankowski", "exact", 0.70000, 0.676094, 13762.18, 0.174908, 3442.500},
    {0.9, "hertz_damped", "exact", 0.90000, 0.862713, 17810.41, 0.178520, 1282.500},
    {0.9, "hertz_damped", "naderpour_2015", 0.93071, 0.874108, 18065.72, 0.177825, 903.070},
    {0.9, "jankowski", "jankowski_2005", 0.90369, 0.829364, 16742.22, 0.175985, 1237.536},
    {0.9, "jankowski", "exact", 0.90000, 0.826651, 16670.99, 0.175966, 1282.500},
};

TEST(PaperSection51, ByTheTimeIntegration) {
  for (const Row& expected : section_5_1) {
    SCOPED_TRACE(fmt::format("{} {} {}", expected.law, expected.formula, expected.asked));
    const Outcome run = test::run_text(
        fmt::format("structures:\n  a: {{body: {{mass: 100 t}}, initial_velocity: 15 m/s}}\n  b: {{body: {{mass: 150 t}}}}\n"
                    "links: [{{between: [a, b], gap: 1 m, law: {}, formula: {}, stiffness: 22000 kN/m^1.5, restitution: {}}}]\n"
                    "analysis: {{duration: 1, tolerance: 1e-8}}\n",
                    expected.law, expected.formula, expected.asked));
    ASSERT_EQ(run.results.impacts.size(), 1u);
    const ImpactRow& row = run.results.impacts[0];
    EXPECT_NEAR(row.restitution, expected.restitution, 0.6e-5);
    EXPECT_NEAR(row.peak_penetration, expected.penetration, 0.6e-6);
    EXPECT_NEAR(row.peak_force / 1e3, expected.force, 0.6e-2);
    EXPECT_NEAR(row.t_release - row.t_start, expected.duration, 0.6e-6);
    EXPECT_NEAR(row.energy_lost / 1e3, expected.lost, 0.6e-3 + 1e-6 * 6750);
  }
}

}  // namespace
}  // namespace pounding
