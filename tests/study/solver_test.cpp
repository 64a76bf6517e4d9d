// The kernel against the solver of runs: random rows with every penalty law, buildings, rows, walls and frames.

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "study/random_rows.hpp"
#include "support/messages.hpp"
#include "support/models.hpp"

namespace pounding::study {
namespace solver_test {

/// A number that an environment variable may replace.
int requested(const char* name, int usual) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : usual;
}

TEST(TheKernel, AgreesWithTheSolverOnRandomPairsByEveryPenaltyLaw) {
  const auto count = static_cast<unsigned>(requested("POUNDING_STUDY_ROWS", 192)),
             seed = static_cast<unsigned>(requested("POUNDING_STUDY_SEED", 7));
  std::vector<Differences> rows;
  for (unsigned number = 0; number < count; ++number) {
    const RandomRow row(seed, number);
    const Model model = row.model(1e-6);
    rows.push_back(differences(by_kernel(model, 1e-7), by_solver(model)));
    if (const Differences& d = rows.back(); d.worst() > 1e-3)
      std::cout << fmt::format(
          "{} {}: displacement {:.1e} force {:.1e} impulse {:.1e} energy {:.1e} acceleration {:.1e}, {} impacts, {} "
          "differ\n",
          number, row.law(), d.displacement, d.force, d.impulse, d.energy, d.acceleration, d.impacts, d.more_impacts);
  }
  const auto show = [&](const char* name, double Differences::* part) {
    std::vector<double> values;
    for (const Differences& row : rows) values.push_back(row.*part);
    std::cout << fmt::format("{:12s} 50 % {:.1e}  90 % {:.1e}  95 % {:.1e}  99 % {:.1e}  all {:.1e}\n", name,
                             quantile(values, 0.5), quantile(values, 0.9), quantile(values, 0.95),
                             quantile(values, 0.99), quantile(values, 1));
    return values;
  };
  std::cout << rows.size() << " rows\n";
  const auto displacement = show("displacement", &Differences::displacement);
  const auto force = show("force", &Differences::force);
  const auto impulse = show("impulse", &Differences::impulse);
  const auto energy = show("energy", &Differences::energy);
  const auto acceleration = show("acceleration", &Differences::acceleration);
  // The solver's error at 1e-6, amplified by the impacts. About one row in a few hundred depends on a contact that
  // barely happens or not, and the limited damper has a corner at its peak force.
  for (const auto& values : {displacement, force, impulse, energy, acceleration}) {
    EXPECT_LT(quantile(values, 0.5), 1e-5);
    EXPECT_LT(quantile(values, 0.95), 1e-4);
  }
}

/// Expects both to give the same results for a model.
void expect_alike(Model& model, double bound) {
  model.complete();
  const Differences row = differences(by_kernel(model, 1e-7), by_solver(model));
  EXPECT_GT(row.impacts, 3);
  EXPECT_EQ(row.more_impacts, 0);
  EXPECT_LT(row.displacement, bound);
  EXPECT_LT(row.force, bound);
  EXPECT_LT(row.impulse, bound);
  EXPECT_LT(row.energy, bound);
  EXPECT_LT(row.acceleration, bound);
}

TEST(TheKernel, AgreesWithTheSolverOnShearBuildings) {
  Model model;
  const auto left = model.add("left", make_shear_building({.storeys = 5, .mass = 2e5, .stiffness = 3e8}),
                              {.damping = ModalDamping{0.05}});
  const auto right = model.add("right", make_shear_building({.storeys = 3, .mass = 3e5, .stiffness = 9e8}),
                               {.damping = Damping(0.05)});
  model.link(left, right, {.gap = 0.02, .floors = FacingFloors::level},
             laws::HertzDamped{.stiffness = 2.75e9, .restitution = 0.65});
  model.ground = GroundMotion(shaking(1));
  model.analysis = {.duration = 10, .tolerance = 1e-7};
  expect_alike(model, 1e-3);
}

TEST(TheKernel, AgreesWithTheSolverOnARowBetweenWalls) {
  Model model;
  const auto wall = model.add("wall", make_wall());
  const auto a = model.add("a", make_oscillator({.mass = 1e5, .period = 0.7, .damping_ratio = 0.05}));
  const auto b = model.add("b", make_oscillator({.mass = 2e5, .period = 0.4, .damping_ratio = 0.05}));
  const auto c = model.add("c", make_oscillator({.mass = 1e5, .period = 0.9, .damping_ratio = 0.05}));
  const laws::Jankowski law{.stiffness = 2.75e9, .restitution = 0.65};
  model.link(wall, a.floor(1), {.gap = 0.03}, law);
  model.link(a.floor(1), b.floor(1), {.gap = 0.01}, law);
  model.link(b.floor(1), c.floor(1), {.gap = 0.02}, law);
  model.ground = GroundMotion(shaking(2));
  model.analysis = {.duration = 4, .tolerance = 1e-7};
  expect_alike(model, 1e-3);
}

TEST(TheKernel, NamesWhatTakesTheSolver) {
  const auto why = [](const std::string& structures, const std::string& link) {
    Model model = test::model_of(
        "ground_motion: {harmonic: {amplitude: 3.0, period: 0.6, duration: 3.0}}\nstructures:\n" + structures +
        "links:\n  - {between: [a, b], gap: 20 mm, law: " + link + "}\nanalysis: {duration: 1}\n");
    model.complete();
    return needs_solver(model);
  };
  const std::string a = "  a: {oscillator: {mass: 100 t, period: 0.8, damping: 5 %}}\n",
                    b = "  b: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}}\n";
  EXPECT_EQ(why(a + b, "hertz, stiffness: 2e9"), "");
  EXPECT_TRUE(test::mentions(why(a + b, "stereomechanical, restitution: 0.6"), {"a-b"}));
  EXPECT_EQ(why(a + "  b: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %, yield_force: 100 kN}}\n",
                "hertz, stiffness: 2e9"),
            "b yields");
  EXPECT_TRUE(test::mentions(
      why(a + "  b: {oscillator: {mass: 150 t, period: 0.4, damping: 5 %}, delay: 0.1}\n", "hertz, stiffness: 2e9"),
      {"ground"}));
}

}  // namespace solver_test
}  // namespace pounding::study
