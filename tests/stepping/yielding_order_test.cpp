// Equal steps through yielding and reversals: the schemes keep their orders because steps end at the corners of the
// force.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/model/model.hpp>
#include <pounding/stepping/stepper.hpp>

#include "support/book.hpp"
#include "support/direct.hpp"
#include "support/models.hpp"

namespace pounding {
namespace yielding_order_test {

// 100 t, 0.5 s, 5 %, Fy = 0.15 of the weight, hardening 5 %, under a sine of 3 m/s^2 and 0.6 s; displacement at 3 s [m]
// by DOP853, restarted at every yield and reversal, tolerance 1e-13.
struct Case {
  const char *name, *spring;
  double end;
  double order = 3.5;  // minimum for ESDIRK4
};
constexpr double scale = 0.04;  // its peak displacement [m]

constexpr Case cases[] = {
    {"bilinear", "{bilinear: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.0201000705717963},
    {"menegotto_pinto", "{menegotto_pinto: {yield_force: 147.09975 kN, hardening: 5 %, memory: last}}",
     0.016508374693477594},
    {"bouc_wen", "{bouc_wen: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.01997692930908247,
     3.0},  // the slope has a kink, which is not located, where z changes sign
    {"peak_oriented", "{peak_oriented: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.011872721192803607}};

// Steps also end at the corners and reversals of the force, or only at their own ends.
enum class Ends { at_corners, alone };

double error_after(const Case& c, const Scheme& scheme, int steps, Ends ends = Ends::at_corners) {
  const Model model =
      test::model_of(fmt::format("ground_motion: {{harmonic: {{amplitude: 3, period: 0.6, duration: 10}}}}\n"
                                 "structures: {{a: {{oscillator: {{mass: 100 t, period: 0.5 s, damping: 5 %, spring: "
                                 "{}}}}}}}\nanalysis: {{duration: 3}}\n",
                                 c.spring));
  const System system = assemble(model);
  ModalSolver solver(system);
  const double h = 3.0 / steps;
  Stepper stepper(system, solver, {.tolerance = 1e-3, .scheme = scheme, .max_step = h});
  const auto [u, v] = initial_state(model, true);
  stepper.start(0, u, v);
  if (ends == Ends::at_corners)
    test::march_evenly(stepper, 3.0, h);
  else
    for (int i = 0; i < steps; ++i) {
      EXPECT_TRUE(stepper.try_step(h));
      stepper.accept();
    }
  return std::abs(stepper.view().state().u[0] - c.end) / scale;
}

// Errors of neighbouring lengths depend on the locations of the corners; means over an octave do not.
double order(const std::vector<double>& errors) {
  return std::log2((errors[0] + errors[1]) / (errors[2] + errors[3])) / 2;
}

class ThroughCorners : public testing::TestWithParam<Case> {};

TEST_P(ThroughCorners, TheSchemesKeepTheirOrders) {
  test::Book book("Hysteretic laws: orders of the schemes with equal steps",
                  "independent integration by DOP853, restarted at every yield and reversal",
                  "half an order, for bouc_wen one; without event location ESDIRK4 has order 1");
  std::vector<double> fourth, second;
  for (const int steps : {300, 600, 1200, 2400}) {
    fourth.push_back(error_after(GetParam(), {.kind = Scheme::Kind::esdirk4}, steps));
    second.push_back(error_after(GetParam(), {.kind = Scheme::Kind::generalized_alpha, .spectral_radius = 1}, steps));
  }
  book.below(fmt::format("{}: 4 - order of ESDIRK4 [-]", GetParam().name), std::max(4 - order(fourth), 0.0),
             4 - GetParam().order);
  book.below(fmt::format("{}: ESDIRK4, error at 2400 steps over the peak [-]", GetParam().name), fourth.back(), 1e-9);
  book.near(fmt::format("{}: order of generalized-alpha [-]", GetParam().name), order(second), 2.0, 0.5);
}

// Errors, relative to the peak, of a prototype that is independent of this project, at 600 and 2400 steps: average
// acceleration and ESDIRK4.
struct Prototype {
  const char* name;
  double second[2], fourth[2];
};
constexpr Prototype prototypes[] = {{"bilinear", {1.968e-4, 1.283e-5}, {7.073e-9, 2.828e-11}},
                                    {"menegotto_pinto", {1.992e-4, 1.258e-5}, {2.764e-10, 1.985e-11}}};

TEST(OverCorners, TheSchemesHaveTheErrorsOfAPrototype) {
  test::Book book("Hysteretic laws: errors of the schemes with equal steps", "a prototype of both schemes in Python",
                  "a twentieth for average acceleration; for ESDIRK4 the order of magnitude, as its constants depend "
                  "on the locations of the corners");
  const Scheme second{.kind = Scheme::Kind::generalized_alpha, .spectral_radius = 1},
      fourth{.kind = Scheme::Kind::esdirk4};
  for (const Prototype& of : prototypes) {
    const Case& c = *std::ranges::find(cases, std::string(of.name), &Case::name);
    for (int i = 0; i < 2; ++i) {
      const int steps = i == 0 ? 600 : 2400;
      const double error = error_after(c, second, steps);
      book.near(fmt::format("{}: generalized-alpha, error over the peak [-]", of.name), error, of.second[i],
                0.05 * of.second[i]);
      book.below(fmt::format("{}: ESDIRK4, error over the peak [-]", of.name), error_after(c, fourth, steps),
                 2 * of.fourth[i]);
    }
    // Steps across the corners reduce the order.
    EXPECT_GT(error_after(c, fourth, 2400, Ends::alone), 1e3 * error_after(c, fourth, 2400)) << of.name;
  }
  // The prototype has this error if it ends steps at reversals but not at yields: an accepted step follows the
  // reversals inside it.
  book.near("bilinear: ESDIRK4 over corners, error over the peak [-]", error_after(cases[0], fourth, 2400, Ends::alone),
            1.6087e-5, 0.05 * 1.6087e-5);
}

INSTANTIATE_TEST_SUITE_P(Law, ThroughCorners, testing::ValuesIn(cases),
                         [](const auto& test) { return test.param.name; });

}  // namespace yielding_order_test
}  // namespace pounding
