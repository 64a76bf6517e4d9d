// Published formulas and examples in complete runs, including link, events and error control.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <source_location>
#include <string>

#include <fmt/format.h>

#include <pounding/laws/all.hpp>
#include <pounding/links/gap_link.hpp>
#include "support/book.hpp"
#include "support/jankowski_in_both_phases.hpp"
#include "support/published_tables.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace reference {
void PrintTo(const FormulaRow& row, std::ostream* out) { *out << row.name; }
}  // namespace reference

namespace published_impacts_test {

using reference::requested;

// Comparison of the time integration with a table.
class PrintedBook : public test::Book {
 public:
  explicit PrintedBook(const char* subject)
      : Book(subject, "tables of an independent script: 8th-order Runge-Kutta at 1e-12 and closed forms",
             "half a unit of the last printed digit, plus 1e-6 of the value for the run at tolerance 1e-8") {}

  void printed(const std::string& quantity, double value, double in_table, int decimals,
               std::source_location at = std::source_location::current()) {
    near(quantity, value, in_table, reference::half_unit(decimals) + 1e-6 * std::abs(in_table), at);
  }
};

// A ball of this mass [kg] launched at a wall; `link` is the text after "law: ". The run is long enough for the bodies
// to separate.
std::string ball_on_wall(double mass, double speed, const std::string& link, double duration) {
  return fmt::format(
      "structures:\n  ball: {{body: {{mass: {} kg}}, initial_velocity: {} m/s}}\n  wall: {{wall: {{}}}}\n"
      "links: [{{between: [ball, wall], gap: 5 mm, law: {}}}]\n"
      "analysis: {{duration: {}, tolerance: 1e-8}}\n",
      mass, speed, link, duration);
}

// The only impact of a run; all NaN, with a test failure, unless there is exactly one.
ImpactRow only_impact(const Outcome& run) {
  EXPECT_EQ(run.results.impacts.size(), 1u);
  if (run.results.impacts.size() == 1) return run.results.impacts[0];
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {0, none, none, none, none, none, none, none, none, none, none, none};
}

class PublishedFormula : public testing::TestWithParam<reference::FormulaRow> {};

TEST_P(PublishedFormula, GivesTheRestitutionOfTheReference) {
  PrintedBook book("Published damping formulas in the time integration");
  const reference::FormulaRow& row = GetParam();
  for (const reference::Asking& asking : row.askings)
    for (std::size_t i = 0; i < 9; ++i) {
      SCOPED_TRACE(fmt::format("{} target {}", asking.law, requested(i)));
      double stiffness = asking.stiffness;
      for (const laws::ParameterInfo& p : laws::find_law(asking.law).parameters)
        if (p.name == "stiffness" && stiffness == 0) stiffness = p.typical;
      const std::string damping = asking.ratio
                                      ? fmt::format("damping_ratio: {}", asking.ratio({.restitution = requested(i)}))
                                      : fmt::format("restitution: {}, formula: {}", requested(i), asking.formula);
      const Outcome run = test::run_text(
          ball_on_wall(6e4, asking.speed, fmt::format("{}, stiffness: {}, {}", asking.law, stiffness, damping), 20));
      book.printed(fmt::format("{} by {} [-]", asking.law, row.name), only_impact(run).restitution, row.obtained[i], 4);
    }
}

INSTANTIATE_TEST_SUITE_P(All, PublishedFormula, testing::ValuesIn(reference::formulas), [](const auto& test) {
  const reference::Asking& first = test.param.askings.front();
  const std::string formula = first.ratio ? "damping_ratio" : std::string(first.formula);
  return fmt::format("{:02}__{}__{}", test.index + 1, first.law, formula);
});

// For z >= 1 the bodies never part, so the impact has no end: the ball is still creeping out at the end of the run.
TEST(JankowskiInBothPhases, GivesTheRestitutionOfTheReference) {
  PrintedBook book("Published damping formulas in the time integration");
  const reference::FormulaRow& row = reference::jankowski_in_both_phases;
  const double mass = 6e4, speed = 0.8, stiffness = 2.75e9;
  for (std::size_t i = 0; i < 9; ++i) {
    SCOPED_TRACE(requested(i));
    const double xi = laws::jankowski_2005({.restitution = requested(i)});
    Model model = test::model_of(ball_on_wall(mass, speed, fmt::format("hertz, stiffness: {}", stiffness), 2));
    Link& link = model.links[0];
    link.contact = std::make_shared<const GapContact<reference::JankowskiInBothPhases>>(
        reference::jankowski_in_both_phases_of(xi, stiffness, mass), link.gap);
    const ImpactRow impact = only_impact(run(model));
    if (2 * xi / std::sqrt(5.0) < 1)
      book.printed("restitution by " + std::string(row.name) + " [-]", impact.restitution, row.obtained[i], 4);
    else
      EXPECT_TRUE(std::isnan(impact.t_end));
  }
}

TEST(PaperSection51, OfTheTimeIntegrationAgreesWithTheReference) {
  PrintedBook book("Two floors that collide at 15 m/s, in the time integration");
  using namespace reference::section_5_1;
  const auto collide = [](const std::string& link) {
    return only_impact(
        test::run_text("structures:\n  a: {body: {mass: 100 t}, initial_velocity: 15 m/s}\n  b: {body: {mass: 150 t}}\n"
                       "links: [{between: [a, b], gap: 1 m, stiffness: 22000 kN/m^1.5, law: " +
                       link + "}]\nanalysis: {duration: 1, tolerance: 1e-8}\n"));
  };
  for (const reference::Section51Row& row : rows) {
    SCOPED_TRACE(fmt::format("{} {} {}", row.law, row.formula, row.requested));
    const ImpactRow impact =
        collide(fmt::format("{}, formula: {}, restitution: {}", row.law, row.formula, row.requested));
    book.printed(std::string(row.law) + ": restitution [-]", impact.restitution, row.restitution, 5);
    book.printed(std::string(row.law) + ": largest penetration [m]", impact.peak_penetration, row.penetration, 6);
    book.printed(std::string(row.law) + ": peak force [kN]", impact.peak_force / 1e3, row.force, 2);
    book.printed(std::string(row.law) + ": duration [s]", impact.t_release - impact.t_start, row.duration, 6);
    book.printed(std::string(row.law) + ": energy lost [kJ]", impact.energy_lost / 1e3, row.lost, 3);
    book.printed(std::string(row.law) + ": impulse [kN s]", impact.impulse / 1e3, row.impulse, 3);
  }
  const ImpactRow elastic = collide("hertz");
  book.printed("hertz: largest penetration [m]", elastic.peak_penetration, elastic_penetration, 6);
  book.printed("hertz: peak force [kN]", elastic.peak_force / 1e3, elastic_force, 3);
  book.printed("hertz: duration [s]", elastic.t_end - elastic.t_start, elastic_duration, 6);
}

TEST(KelvinVoigt, OfTheTimeIntegrationAgreesWithTheReferenceWithAndWithoutPull) {
  PrintedBook book("Kelvin-Voigt impact with and without pull, in the time integration");
  using namespace reference::kelvin_voigt;
  for (const reference::KelvinVoigtRow& row : rows) {
    SCOPED_TRACE(row.requested);
    const auto check = [&](const char* law, double restitution, double duration) {
      SCOPED_TRACE(law);
      const ImpactRow impact = only_impact(test::run_text(ball_on_wall(
          mass, speed,
          fmt::format("{}, stiffness: {}, restitution: {}, formula: anagnostopoulos", law, stiffness, row.requested),
          1)));
      book.printed(std::string(law) + ": restitution [-]", impact.restitution, restitution, 6);
      book.printed(std::string(law) + ": duration [s]", impact.t_release - impact.t_start, duration, 8);
      book.printed(std::string(law) + ": largest penetration [m]", impact.peak_penetration, row.penetration, 8);
      book.printed(std::string(law) + ": peak force [N]", impact.peak_force, row.force, 1);
    };
    check("kelvin_voigt", row.restitution_to_zero_penetration, row.duration_to_zero_penetration);
    check("kelvin_voigt_no_tension", row.restitution_to_zero_force, row.duration_to_zero_force);
  }
}

TEST(PaperSection5, OfTheTimeIntegrationAgreesWithTheReference) {
  PrintedBook book("Impact of 755.76 kg at 10 m/s, in the time integration");
  using namespace reference::section_5;
  for (const reference::Section5Row& row : rows) {
    SCOPED_TRACE(row.formula);
    const ImpactRow impact =
        only_impact(test::run_text(ball_on_wall(mass, speed,
                                                fmt::format("hertz_damped, stiffness: {}, restitution: {}, formula: {}",
                                                            stiffness, reference::section_5::requested, row.formula),
                                                1)));
    book.printed("hertz_damped: restitution [-]", impact.restitution, row.restitution, 5);
    book.printed("hertz_damped: largest penetration [m]", impact.peak_penetration, row.penetration, 6);
    book.printed("hertz_damped: peak force [kN]", impact.peak_force / 1e3, row.force, 3);
    book.printed("hertz_damped: energy lost [kJ]", impact.energy_lost / 1e3, row.lost, 5);
  }
}

// The design penetration is 1 m at impact_velocity. The actual speed is that which reaches it along the bilinear curve,
// where the force is the effective stiffness times 1 m.
TEST(BilinearHertz, OfTheTimeIntegrationAtItsDesignPenetrationAgreesWithTheReference) {
  PrintedBook book("Bilinear law at its design penetration, in the time integration");
  using namespace reference::bilinear;
  for (const reference::BilinearRow& row : rows) {
    SCOPED_TRACE(row.requested);
    const ImpactRow impact = only_impact(test::run_text(ball_on_wall(
        mass, reaching_speed(row),
        fmt::format("bilinear_hertz, stiffness: 1, impact_velocity: {}, restitution: {}, formula: muthukumar_desroches",
                    design_speed, row.requested),
        20)));
    book.printed("bilinear_hertz: largest penetration [m]", impact.peak_penetration, 1, 6);
    book.printed("bilinear_hertz: peak force [N]", impact.peak_force, row.stiffness, 6);
    book.printed("bilinear_hertz: energy lost [J]", impact.energy_lost, row.loss, 6);
    book.printed("bilinear_hertz: restitution [-]", impact.restitution, row.restitution, 6);
  }
}

}  // namespace published_impacts_test
}  // namespace pounding
