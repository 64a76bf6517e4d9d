// Two oscillators under a harmonic motion, seven laws. The digits are those of a table: displacements to 1e-6 m, forces
// to 0.1 N, times to 1e-6 s, velocities to 1e-6 m/s.

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include <fmt/format.h>

#include "support/book.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace two_oscillators_test {

struct Impact {
  double time, approach, force;
};

struct Reference {
  const char* name;
  const char* law;
  double u1, u2, force;
  std::size_t impacts;
  Impact first;
  double separation;
  Impact second;
};

std::ostream& operator<<(std::ostream& out, const Reference& r) { return out << r.law; }

const Reference references[] = {
    {"linear",
     "linear_spring, stiffness: 9.35e7",
     0.246706,
     0.083934,
     6574989.3,
     5,
     {0.548291, 0.987919, 2368315.8},
     0.943624,
     {1.130894, 1.764368, 4269969.3}},
    {"kelvin",
     "kelvin_voigt_no_tension, stiffness: 9.35e7, restitution: 0.65, formula: anagnostopoulos",
     0.169883,
     0.059078,
     4333124.1,
     5,
     {0.548291, 0.987919, 2032181.3},
     0.613938,
     {1.135934, 1.662724, 3392156.6}},
    {"approach",
     "modified_linear_viscoelastic, stiffness: 9.35e7, restitution: 0.65, formula: exact",
     0.158841,
     0.057684,
     3983752.8,
     5,
     {0.548291, 0.987919, 1956671.6},
     0.592926,
     {1.134934, 1.649093, 3244819.7}},
    {"hertz",
     "hertz, stiffness: 2.75e9",
     0.171017,
     0.075361,
     12342170.1,
     5,
     {0.548291, 0.987919, 5043600.8},
     0.956386,
     {1.123021, 1.724222, 9859902.1}},
    {"hertz_damped",
     "hertz_damped, stiffness: 2.75e9, restitution: 0.65, formula: exact",
     0.130228,
     0.055682,
     9154322.9,
     5,
     {0.548291, 0.987919, 4556463.9},
     0.595075,
     {1.131587, 1.617332, 8147237.8}},
    {"lankarani_nikravesh",
     "hertz_damped, stiffness: 2.75e9, restitution: 0.65, formula: lankarani_nikravesh",
     0.142193,
     0.062000,
     9880213.0,
     5,
     {0.548291, 0.987919, 4598691.0},
     0.724217,
     {1.128407, 1.656247, 8496292.8}},
    {"jankowski",
     "jankowski, stiffness: 2.75e9, restitution: 0.65, formula: exact",
     0.128115,
     0.055571,
     7178400.0,
     5,
     {0.548291, 0.987919, 3619597.2},
     0.603336,
     {1.130971, 1.613933, 6460768.8}},
};

constexpr const char* source =
    "DOP853 (scipy) at relative tolerance 1e-11 with located events, confirmed by a fixed-step Runge-Kutta program at "
    "2e-7 s";

// "hertz_damped exact: "
std::string law_and_formula(const Reference& reference) {
  const std::string text = reference.law, formula = ", formula: ";
  const std::size_t at = text.find(formula);
  if (at == text.npos) return fmt::format("{}: ", test::law_of(text));
  return fmt::format("{} {}: ", test::law_of(text), text.substr(at + formula.size()));
}

class TwoOscillators : public testing::TestWithParam<Reference> {};

TEST_P(TwoOscillators, AgreeWithAnIndependentIntegrator) {
  test::Book book("Two oscillators under a harmonic motion, seven laws", source,
                  "run at tolerance 1e-6: displacements and velocities to 1e-5, forces to 1e-4, times to 1e-6 s, "
                  "plus half a unit of the last printed digit");
  const Reference& expected = GetParam();
  const std::string law = law_and_formula(expected);
  const Outcome run = test::run_text(test::two_oscillators(expected.law, 1e-6));
  const double digit = 0.5e-6;
  const double u1 = run.summary.structures[0].peak_displacement[0], u2 = run.summary.structures[1].peak_displacement[0];
  book.near(law + "peak displacement, left [m]", u1, expected.u1, 1e-5 * expected.u1 + digit);
  book.near(law + "peak displacement, right [m]", u2, expected.u2, 1e-5 * expected.u2 + digit);
  book.near(law + "peak force [N]", run.summary.links[0].peak_force, expected.force, 1e-4 * expected.force);
  ASSERT_EQ(run.results.impacts.size(), expected.impacts);
  book.equal(law + "impacts", static_cast<double>(run.results.impacts.size()), static_cast<double>(expected.impacts));
  const Impact impacts[] = {expected.first, expected.second};
  for (int i = 0; i < 2; ++i) {
    const ImpactRow& row = run.results.impacts[i];
    book.near(law + "touch of the first two impacts [s]", row.t_start, impacts[i].time, 1e-6 + digit);
    book.near(law + "approach of the first two impacts [m/s]", row.v_approach, impacts[i].approach, 1e-5 + digit);
    book.near(law + "peak force of the first two impacts [N]", row.peak_force, impacts[i].force,
              1e-4 * impacts[i].force);
  }
  book.near(law + "first separation [m/s]", run.results.impacts[0].v_separation, expected.separation, 1e-5 + digit);
}

INSTANTIATE_TEST_SUITE_P(SevenLaws, TwoOscillators, testing::ValuesIn(references),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(TwoOscillators, KeepTheDefaultTolerance) {
  test::Book book("Two oscillators under a harmonic motion, seven laws", source,
                  "the tolerance is satisfied: results at the default 1e-4 are within 1e-4 of the converged ones");
  const Reference& expected = GetParam();
  const Outcome run = test::run_text(test::two_oscillators(expected.law, 1e-4));
  book.near("peak displacement, left [m]", run.summary.structures[0].peak_displacement[0], expected.u1,
            1e-4 * expected.u1);
  book.near("peak displacement, right [m]", run.summary.structures[1].peak_displacement[0], expected.u2,
            1e-4 * expected.u2);
  book.near("peak force [N]", run.summary.links[0].peak_force, expected.force, 1e-4 * expected.force);
}

// Steps are so long that accelerations have extremes inside them.
TEST_P(TwoOscillators, KeepTheToleranceOfPeakAccelerations) {
  test::Book book("Two oscillators under a harmonic motion, seven laws", "the same program at a tolerance of 1e-8",
                  "peak accelerations, which occur inside steps, are within 1.5 times the tolerance");
  const Reference& expected = GetParam();
  const Outcome fine = test::run_text(test::two_oscillators(expected.law, 1e-8));
  for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
    const Outcome run = test::run_text(test::two_oscillators(expected.law, tolerance));
    for (int k = 0; k < 2; ++k) {
      const double peak = fine.summary.structures[k].peak_acceleration[0];
      book.near(fmt::format("tolerance {:g}: peak acceleration, {} [m/s^2]", tolerance, k == 0 ? "left" : "right"),
                run.summary.structures[k].peak_acceleration[0], peak, 1.5 * tolerance * peak);
    }
  }
}

TEST(TwoOscillators, HaveThePeakAccelerationsOfEitherScheme) {
  const std::string long_steps = test::two_oscillators("hertz_damped, stiffness: 2.75e9, restitution: 0.65", 1e-6);
  std::string short_steps = test::two_oscillators("hertz_damped, stiffness: 2.75e9, restitution: 0.65", 1e-7);
  short_steps.replace(short_steps.rfind('}'), 1, ", integrator: generalized_alpha}");
  const Outcome expected = test::run_text(short_steps), obtained = test::run_text(long_steps);
  for (int k = 0; k < 2; ++k) {
    const double peak = expected.summary.structures[k].peak_acceleration[0];
    EXPECT_NEAR(obtained.summary.structures[k].peak_acceleration[0], peak, 5e-6 * peak);
  }
}

}  // namespace two_oscillators_test
}  // namespace pounding
