// The Bouc-Wen law that couples two directions: contract, agreement with the law of one direction, OpenSees.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <pounding/structures/coupled_bouc_wen.hpp>
#include "support/bearing_references.hpp"
#include "support/book.hpp"
#include "support/elements.hpp"

namespace pounding {
namespace coupled_bouc_wen_test {

using test::ElementRun;
using test::Vector2;

const hysteresis::BoucWen laws[] = {
    {.initial_stiffness = 1e7, .yield_force = 1.5e5, .hardening = 0.05},
    {.initial_stiffness = 1e7, .yield_force = 1.5e5, .gamma_share = 0.2},
    {.initial_stiffness = 1e7, .yield_force = 1.5e5, .exponent = 1},
    {.initial_stiffness = 1e7, .yield_force = 1.5e5, .exponent = 3.5, .gamma_share = 0}};

TEST(CoupledBoucWen, SlopesAreDerivatives) {
  for (const auto& law : laws)
    test::expect_slopes_are_derivatives(CoupledBoucWen(law), 0, 2e-5, law.exponent == 2 ? 10000 : 1000);
}

TEST(CoupledBoucWen, StraightPathsCanBeDivided) {
  for (const auto& law : laws) test::expect_straight_paths_can_be_divided(CoupledBoucWen(law), 1e-8);
}

TEST(CoupledBoucWen, EnergiesBalance) {
  for (const auto& law : laws) test::expect_energies_balance(CoupledBoucWen(law), 1e-7);
}

TEST(CoupledBoucWen, IsTheLawOfOneDirectionOnALine) {
  for (const auto& law : laws) {
    const CoupledBoucWen element(law);
    for (const double angle : {0.0, std::numbers::pi / 2, 2.2}) {
      ElementRun run(element);
      hysteresis::BoucWen::State kept;
      double lost = 0;
      for (const double s : {0.01, 0.05, -0.04, -0.035, 0.03, 0.028, -0.2, 0.001}) {
        const Vector2 d{s * std::cos(angle), s * std::sin(angle)};
        const auto expected = law.respond(kept, s);
        const Vector2 force = run.force(d);
        EXPECT_NEAR(force[0], expected.force * std::cos(angle), 1e-8 * law.yield_force);
        EXPECT_NEAR(force[1], expected.force * std::sin(angle), 1e-8 * law.yield_force);
        lost += hysteresis::lost(law, kept, s);
        kept = law.advance(kept, s);
        run.go(d);
        EXPECT_NEAR(run.lost(), lost, 1e-8 * law.yield_force * law.yield_deformation());
      }
    }
  }
}

TEST(CoupledBoucWen, TheForceFollowsACircle) {
  const hysteresis::BoucWen law{.initial_stiffness = 1e7, .yield_force = 1.5e5};
  const CoupledBoucWen element(law);
  const double b = 5 * law.yield_deformation();
  ElementRun run(element);
  const int steps = 4000;
  for (int i = 0; i <= 3 * steps; ++i) {
    const double angle = 2 * std::numbers::pi * i / steps;
    run.go({b * std::cos(angle), b * std::sin(angle)});
  }
  const Vector2 force = run.force(run.d());
  EXPECT_NEAR(std::hypot(force[0], force[1]), law.yield_force, 1e-5 * law.yield_force);
  // z rotates with the path, |z| = dy, and lags the path, which points to +y, by the angle A with sin A = dy/b.
  EXPECT_NEAR(force[0] / law.yield_force, 1.0 / 5, 1e-3);
}

TEST(CoupledBoucWen, RejectsWrongParameters) {
  EXPECT_THROW(CoupledBoucWen({.initial_stiffness = 1e7, .yield_force = -1}), std::invalid_argument);
}

TEST(CoupledBoucWen, AgreesWithOpenSeesInTheElCentroEarthquake) {
  const double weight = 1e5 * 9.80665, k2 = 0.6e6, dy = 8e-3, k = 0.05 * weight / dy + k2;
  hysteresis::BoucWen law{.initial_stiffness = k, .yield_force = k * dy, .hardening = k2 / k};
  test::Book book("Mass on an isolator in two directions, both components of El Centro 1940",
                  "OpenSees, refined steps (tests/verification/opensees/bearings.py)",
                  "1e-4 of the peak; the reference is converged to 1e-5");
  book.below("elastomericBearingBoucWen, displacements / peak [-]",
             test::difference(test::ride(CoupledBoucWen(law), 1e5, 1e-3, 1e-4), test::bouc_wen), 1e-4);
  law.exponent = 3.5;
  law.gamma_share = 0.2;
  book.below("elastomericBearingBoucWen with eta = 3.5, displacements / peak [-]",
             test::difference(test::ride(CoupledBoucWen(law), 1e5, 1e-3, 1e-4), test::bouc_wen_sharp), 1e-4);
}

}  // namespace coupled_bouc_wen_test
}  // namespace pounding
