// The hinge with interaction of axial force and moment: contract, closed forms, an independent return mapping.

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include <pounding/structures/axial_moment_hinge.hpp>
#include "support/axial_moment_references.hpp"
#include "support/book.hpp"
#include "support/elements.hpp"

namespace pounding {
namespace axial_moment_hinge_test {

using test::ElementRun;
using test::Vector2;
using Surface = AxialMomentLaw::Surface;

AxialMomentLaw law(Surface surface, double balanced = 0, double hardening = 0.03) {
  return {.surface = surface,
          .axial_stiffness = 5e8,
          .rotational_stiffness = 2e7,
          .axial_capacity = 1e6,
          .plastic_moment = 1.5e5,
          .balanced_force = balanced,
          .hardening = hardening};
}

const AxialMomentHinge hinges[] = {AxialMomentHinge(law(Surface::parabola)), AxialMomentHinge(law(Surface::ellipse)),
                                   AxialMomentHinge(law(Surface::ellipse, -3e5, 0))};

TEST(AxialMomentHinge, SlopesAreDerivatives) {
  for (const AxialMomentHinge& hinge : hinges) test::expect_slopes_are_derivatives(hinge, 0, 2e-5);
}

TEST(AxialMomentHinge, StraightPathsCanBeDivided) {
  for (const AxialMomentHinge& hinge : hinges) test::expect_straight_paths_can_be_divided(hinge, 1e-8);
}

TEST(AxialMomentHinge, EnergiesBalance) {
  for (const AxialMomentHinge& hinge : hinges) test::expect_energies_balance(hinge, 1e-4);
}

TEST(AxialMomentHinge, IsExactlyLinearWithinTheSurface) {
  ElementRun run(hinges[0]);
  run.go({0.004, 0.03});
  const Vector2 before = {run.at(run.d()).force[0], run.at(run.d()).force[1]};
  const ElementResponse unloaded = run.at({0.0038, 0.028});
  EXPECT_EQ(unloaded.force[0], before[0]);
  EXPECT_EQ(unloaded.force[1], before[1]);
  EXPECT_EQ(unloaded.by_deformation[0][0], 0);
  EXPECT_EQ(unloaded.by_deformation[1][0], 0);
}

// Rotates the hinge at a constant axial force, with the elongation by Newton's method.
double moment_at(const AxialMomentHinge& hinge, double axial_force, double rotation) {
  ElementRun run(hinge);
  double elongation = axial_force / hinge.stiffness(0);
  run.go({elongation, 0});
  const int steps = 400;
  for (int step = 1; step <= steps; ++step) {
    const double r = rotation * step / steps;
    for (int i = 0; i < 50; ++i) {
      const double slope = hinge.stiffness(0) + run.at({elongation, r}).by_deformation[0][0];
      const double change = (axial_force - run.force({elongation, r})[0]) / slope;
      elongation += change;
      if (std::abs(change) < 1e-14) break;
    }
    run.go({elongation, r});
  }
  EXPECT_NEAR(run.force(run.d())[0], axial_force, 1e-6 * std::abs(axial_force));
  return run.force(run.d())[1];
}

TEST(AxialMomentHinge, HasThePlasticMomentOfARectangle) {
  test::Book book("Plastic moment of a rectangle under axial force", "closed form M = Mp (1 - (N/Np)^2)",
                  "1e-6 of Mp, the limit of the iteration for N");
  const AxialMomentHinge hinge(law(Surface::parabola, 0, 0));
  for (const double n : {0.2, 0.4, 0.6}) {
    book.near("M at N/Np = 0.2, 0.4, 0.6 [N m]", moment_at(hinge, -n * 1e6, 0.1), 1.5e5 * (1 - n * n), 1e-6 * 1.5e5);
    EXPECT_NEAR(moment_at(hinge, n * 1e6, -0.1), -1.5e5 * (1 - n * n), 1e-6 * 1.5e5);
  }
}

TEST(AxialMomentHinge, EllipseHasItsLargestMomentAtTheBalancedForce) {
  const AxialMomentHinge hinge(law(Surface::ellipse, -3e5, 0));
  EXPECT_NEAR(moment_at(hinge, -3e5, 0.1), 1.5e5, 1e-6 * 1.5e5);
  EXPECT_NEAR(moment_at(hinge, 3e5, 0.1), 1.5e5 * 0.8, 1e-6 * 1.5e5);
}

TEST(AxialMomentHinge, FarPathsEndAtTheFullyPlasticFibres) {
  // Fibres of a rectangle of depth 4 Mp/Np under the same plastic strains.
  const AxialMomentHinge hinge(law(Surface::parabola, 0, 0));
  const double depth = 4 * 1.5e5 / 1e6;
  const int fibres = 4000;
  for (const double centre : {0.05, 0.2, 0.28}) {
    const Vector2 direction{centre, 1};
    double axial = 0, moment = 0;
    for (int i = 0; i < fibres; ++i) {
      const double y = depth * ((i + 0.5) / fibres - 0.5);
      const double stress = direction[0] + y * direction[1] > 0 ? 1 : -1;
      axial += 1e6 / fibres * stress;
      moment += 1e6 / fibres * stress * y;
    }
    ElementRun run(hinge);
    run.go({0.5 * direction[0], 0.5 * direction[1]});
    const Vector2 force = run.force(run.d());
    EXPECT_NEAR(force[0], axial, 1e-3 * 1e6);
    EXPECT_NEAR(force[1], moment, 1e-3 * 1.5e5);
  }
}

TEST(AxialMomentHinge, StaysAtTheCornerOfTheParabolaUnderTension) {
  const AxialMomentHinge hinge(law(Surface::parabola, 0, 0));
  ElementRun run(hinge);
  run.go({0.02, 0.001});
  EXPECT_NEAR(run.force(run.d())[0], 1e6, 1e-3);
  EXPECT_NEAR(run.force(run.d())[1], 0, 1e-3);
  EXPECT_NEAR(run.lost(), 1e6 * (0.02 - 0.002) + 0, 0.02 * 1e6 * 0.02);
}

TEST(AxialMomentHinge, FollowsACyclicPathComputedIndependently) {
  test::Book book("Hinges with axial force and moment on a cyclic path",
                  "elastic-plastic flow in Cartesian coordinates by DOP853 (tests/verification/axial_moment_paths.py)",
                  "1e-7 of the capacities: the hinge integrates to about 1e-9 per step");
  const AxialMomentHinge with_hardening[] = {AxialMomentHinge(law(Surface::parabola)),
                                             AxialMomentHinge(law(Surface::ellipse)),
                                             AxialMomentHinge(law(Surface::ellipse, -3e5))};
  const test::AxialMomentPath* expected[] = {&test::parabola_forces, &test::ellipse_forces, &test::offset_forces};
  const char* names[] = {"parabola, N and M / capacity [-]", "ellipse, N and M / capacity [-]",
                         "ellipse with N0 = -0.3 Np, N and M / capacity [-]"};
  for (int k = 0; k < 3; ++k) {
    ElementRun run(with_hardening[k]);
    double worst = 0;
    for (std::size_t i = 0; i < expected[k]->points.size(); ++i) {
      const Vector2 at = test::axial_moment_path.points[i];
      run.go({at[0] * 1e6 / 5e8, at[1] * 1.5e5 / 2e7});
      const Vector2 force = run.force(run.d());
      worst = std::max({worst, std::abs(force[0] - expected[k]->points[i][0]) / 1e6,
                        std::abs(force[1] - expected[k]->points[i][1]) / 1.5e5});
    }
    book.below(names[k], worst, 1e-7);
  }
}

TEST(AxialMomentHinge, RejectsWrongParameters) {
  EXPECT_THROW(AxialMomentHinge(law(Surface::parabola, 1e5)), std::invalid_argument);
  EXPECT_THROW(AxialMomentHinge(law(Surface::ellipse, -1e6)), std::invalid_argument);
  EXPECT_THROW(AxialMomentHinge(law(Surface::ellipse, 0, 1)), std::invalid_argument);
}

}  // namespace axial_moment_hinge_test
}  // namespace pounding
