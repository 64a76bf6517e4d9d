// Steps of one length through yielding and reversals: the schemes keep their orders, because steps end at the corners of the force.

#include <gtest/gtest.h>

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

// 100 t, 0.5 s, 5 %, Fy = 0.15 of the weight, hardening 5 %, under a sine of 3 m/s^2 and 0.6 s; displacement at 3 s [m] by DOP853, restarted
// at every yield and reversal, tolerance 1e-13.
struct Case {
  const char *name, *spring;
  double end;
  double order = 3.5;  // of ESDIRK4, at least
};
constexpr double scale = 0.04;  // of its largest displacement [m]

constexpr Case cases[] = {
    {"bilinear", "{bilinear: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.0201000705717963},
    {"menegotto_pinto", "{menegotto_pinto: {yield_force: 147.09975 kN, hardening: 5 %, memory: last}}", 0.016508374693477594},
    {"bouc_wen", "{bouc_wen: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.01997692930908247,
     3.0},  // where z changes its sign the slope has a kink, which nothing locates
    {"peak_oriented", "{peak_oriented: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.011872721192803607}};

double error_after(const Case& c, const Scheme& scheme, int steps) {
  const Model model = test::model_of(fmt::format(
      "ground_motion: {{harmonic: {{amplitude: 3, period: 0.6, duration: 10}}}}\n"
      "structures: {{a: {{oscillator: {{mass: 100 t, period: 0.5 s, damping: 5 %, spring: {}}}}}}}\nanalysis: {{duration: 3}}\n",
      c.spring));
  const System system = assemble(model);
  ModalSolver solver(system);
  const double h = 3.0 / steps;
  Stepper stepper(system, solver, {.tolerance = 1e-3, .scheme = scheme, .max_step = h});
  const auto [u, v] = initial_state(model, true);
  stepper.start(0, u, v);
  test::march_evenly(stepper, 3.0, h);
  return std::abs(stepper.state().u[0] - c.end) / scale;
}

// Errors of neighbouring lengths vary with the places of the corners; means over an octave do not.
double order(const std::vector<double>& errors) {
  return std::log2((errors[0] + errors[1]) / (errors[2] + errors[3])) / 2;
}

class ThroughCorners : public testing::TestWithParam<Case> {};

TEST_P(ThroughCorners, TheSchemesKeepTheirOrders) {
  test::Book book("Laws of yielding: orders of the schemes with steps of one length",
                  "independent integration by DOP853, restarted at every yield and reversal",
                  "half an order, for bouc_wen one; where nothing is located ESDIRK4 has order 1");
  std::vector<double> fourth, second;
  for (const int steps : {300, 600, 1200, 2400}) {
    fourth.push_back(error_after(GetParam(), {.kind = Scheme::Kind::esdirk4}, steps));
    second.push_back(error_after(GetParam(), {.kind = Scheme::Kind::generalized_alpha, .spectral_radius = 1}, steps));
  }
  book.below(fmt::format("{}: 4 - order of ESDIRK4 [-]", GetParam().name), 4 - order(fourth), 4 - GetParam().order);
  book.below(fmt::format("{}: ESDIRK4, error at 2400 steps over the peak [-]", GetParam().name), fourth.back(), 1e-9);
  book.near(fmt::format("{}: order of generalized-alpha [-]", GetParam().name), order(second), 2.0, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Law, ThroughCorners, testing::ValuesIn(cases), [](const auto& test) { return test.param.name; });

}  // namespace yielding_order_test
}  // namespace pounding
