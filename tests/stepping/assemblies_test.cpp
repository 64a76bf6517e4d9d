// Some structures of a model, integrated without the others.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include "support/direct.hpp"
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding {
namespace assemblies_test {

// Two pairs and a wall; only the structures of a pair may touch.
constexpr const char* yaml =
    "ground_motion: {harmonic: {amplitude: 4, period: 0.6 s, duration: 2 s}}\n"
    "structures:\n"
    "  a: {oscillator: {mass: 100 t, period: 0.8, yield_force: 150 kN}, damping: 5 %}\n"
    "  w: {wall: {}}\n"
    "  b: {oscillator: {mass: 150 t, period: 0.4}, damping: 5 %}\n"
    "  c: {shear_building: {storeys: 2, mass: 100 t, stiffness: 40 MN/m}, damping: 5 %}\n"
    "  d: {oscillator: {mass: 120 t, period: 0.7}, damping: 5 %}\n"
    "links:\n"
    "  - {between: [a, b], gap: 20 mm, law: hertz, stiffness: 2.75e9}\n"
    "  - {between: [w, a], gap: 60 mm, law: hertz, stiffness: 2.75e9}\n"
    "  - {between: [c.1, d], gap: 10 mm, law: linear_spring, stiffness: 90 MN/m}\n"
    "devices:\n  link: {between: [c.1, d], damper: {coefficient: 100 kN s/m}}\n"
    "analysis: {duration: 3, tolerance: 1e-7}\n";

struct Half {
  System system;
  ModalSolver solver;
  Stepper stepper;
  std::vector<double> peaks;

  Half(const Model& model, const Assembly& assembly)
      : system(assemble(model, assembly)),
        solver(system),
        stepper(system, solver, {.tolerance = 1e-7, .max_step = 0.01}) {
    const auto [u, v] = initial_state(model, assembly);
    stepper.start(0, u, v);
    test::march(stepper, 3, 0.01);
    for (const ContactMemory& contact : stepper.view().memory().contacts)
      for (const ImpactRow& row : contact.impacts()) peaks.push_back(row.peak_force);
  }
};

TEST(Assemblies, TwoSteppersOfTwoHalvesMoveAsOne) {
  const Model model = test::model_of(yaml);
  const Half whole(model, {}), first(model, {.structures = {0, 2}}), second(model, {.structures = {3, 4}});
  EXPECT_EQ(first.system.contact_count(), 2);
  EXPECT_EQ(second.system.contact_count(), 1);
  EXPECT_EQ(first.system.size() + second.system.size(), whole.system.size());
  const Eigen::VectorXd& u = whole.stepper.view().state().u;
  const double size = u.cwiseAbs().maxCoeff();
  EXPECT_LT((first.stepper.view().state().u - u.head(2)).cwiseAbs().maxCoeff(), 2e-6 * size);
  EXPECT_LT((second.stepper.view().state().u - u.tail(3)).cwiseAbs().maxCoeff(), 2e-6 * size);
  ASSERT_EQ(first.peaks.size() + second.peaks.size(), whole.peaks.size());
  EXPECT_GT(first.peaks.size(), 0u);
  EXPECT_GT(second.peaks.size(), 0u);
  for (std::size_t i = 0; i < whole.peaks.size(); ++i) {
    const double alone = i < first.peaks.size() ? first.peaks[i] : second.peaks[i - first.peaks.size()];
    EXPECT_NEAR(alone, whole.peaks[i], 1e-5 * whole.peaks[i]);
  }
  const Energies all = whole.stepper.view().energies(), a = first.stepper.view().energies(),
                 b = second.stepper.view().energies();
  EXPECT_NEAR(a.input + b.input, all.input, 1e-5 * all.input);
  EXPECT_NEAR(a.devices + b.devices, all.devices, 1e-5 * all.devices);
}

TEST(Assemblies, RefuseALinkToAStructureThatIsLeftOut) {
  const Model model = test::model_of(yaml);
  const std::string message = test::refusal([&] { assemble(model, Assembly{.structures = {0}}); });
  EXPECT_TRUE(test::mentions(message, {"a-b"})) << message;
}

// A state between two steps is a value.
TEST(StepState, CanBeRestoredAndCompared) {
  const Model model = test::model_of(yaml);
  const System system = assemble(model);
  ModalSolver solver(system), other_solver(system);
  const StepperOptions options{.tolerance = 1e-4, .max_step = 0.01};
  Stepper stepper(system, solver, options), other(system, other_solver, options);
  const auto [u, v] = initial_state(model);
  for (Stepper* each : {&stepper, &other}) each->start(0, u, v);
  test::march_evenly(stepper, 1, 0.01);
  const StepState saved = stepper.save();
  EXPECT_FALSE(saved == other.save());
  other.restore(saved);
  EXPECT_TRUE(saved == other.save());
  test::march_evenly(stepper, 2, 0.01);
  const StepState end = stepper.save();
  test::march_evenly(other, 2, 0.01);
  EXPECT_TRUE(end == other.save());
  stepper.restore(saved);
  test::march_evenly(stepper, 2, 0.01);
  EXPECT_TRUE(end == stepper.save()) << "back to the saved state and forth again";
}

}  // namespace assemblies_test
}  // namespace pounding
