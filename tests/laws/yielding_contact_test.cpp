/// Contact that yields at a force, and contact by a table: closed forms of free impacts, and the memory of later ones.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>
#include "support/book.hpp"

namespace pounding::laws {
namespace yielding_contact_test {

// Loading takes Fy^2/(2 k) + Fy x + a k x^2/2, x beyond yield; unloading returns F_m^2/(2 k), and the plastic work is
// lost. Below yield nothing is lost.
TEST(FreeImpact, ElasticPlasticGapLosesItsPlasticWork) {
  test::Book book("Contact that yields at a force", "closed form of bilinear loading and elastic unloading",
                  "guaranteed tolerance of the integration");
  const double m = 60e3, k = 1e8, fy = 2e6;
  for (const double a : {0.0, 0.02, 0.5})
    for (const double damage : {1.0, 0.0})
      for (const double v : {0.5, 1.0, 2.0}) {
        const ElasticPlasticGap law{.stiffness = k, .yield_force = fy, .hardening = a, .damage = damage};
        const double energy = 0.5 * m * v * v, left = std::max(energy - 0.5 * fy * fy / k, 0.0);
        const double x = 2 * left / (fy + std::sqrt(fy * fy + 2 * a * k * left));
        const double force = left > 0 ? fy + a * k * x : v * std::sqrt(k * m), plastic = (1 - a) * x;
        const FreeImpact found = free_impact(law, m, v);
        book.near("elastic_plastic_gap: restitution [-]", found.restitution, force / std::sqrt(2 * k * energy), 1e-9);
        book.near("elastic_plastic_gap: peak force [N]", found.peak_force, force, 1e-8 * force);
        book.near("elastic_plastic_gap: plastic work [J]", found.energy_lost, 0.5 * (fy + force) * plastic,
                  1e-8 * energy);
        Impact impact = touch(law, v);
        keep(law, found.peak_penetration, 0, impact);
        EXPECT_NEAR(law.indentation(impact), damage * plastic, 1e-10);
        EXPECT_NEAR(law.contact(plastic + 0.5 * force / k, -1, impact).force, 0.5 * force, 1e-3);
        EXPECT_LT(law.contact(0.99 * plastic - 1e-9, -1, impact).force, 0);
      }
}

// Two impacts with damage: the second one yields where the first one ended. Without damage the surface follows the
// body, and the force begins where it reverses.
TEST(FreeImpact, ElasticPlasticGapRemembersAsInOpenSees) {
  ElasticPlasticGap law{.stiffness = 1e8, .yield_force = 2e6, .hardening = 0.1, .damage = 1};
  Impact first = touch(law, 1);
  keep(law, 0.05, 0, first);
  const double p = 0.9 * 0.03;  // (1 - a) (d_m - Fy/k)
  EXPECT_NEAR(law.indentation(first), p, 1e-15);
  const Impact second = touch(law, 1, law.crushed(first));
  EXPECT_NEAR(law.contact(0.01, 1, second).force, 1e6, 1e-6);
  EXPECT_NEAR(law.contact(0.05 - p, 1, second).force, 2e6 + 1e7 * 0.03, 1e-6) << "yields again at d_m";
  EXPECT_NEAR(law.contact(0.06 - p, 1, second).force, 2e6 + 1e7 * 0.04, 1e-6);
  law.damage = 0;
  Impact healing = touch(law, 1);
  keep(law, 0.05, 0, healing);
  EXPECT_NEAR(healing.slip, p, 1e-15);
  keep(law, 0.01, -1, healing);
  EXPECT_EQ(healing.slip, 0.01) << "follows the separating body";
  EXPECT_NEAR(law.contact(0.015, 1, healing).force, 0.005 * 1e8, 1e-6);
  // max = (min - eta gap)/(1 - eta) + fy/E, with the gap as origin (EPPGapMaterial::commitState).
  const double yields_at = 0.01 / 0.9 + 0.02;
  EXPECT_NEAR(law.contact(yields_at, 1, healing).force, 2e6 + 1e7 * (yields_at - 0.02), 1e-6);
  EXPECT_EQ(law.contact(yields_at + 1e-6, 1, healing).by_penetration, 1e7);
  EXPECT_EQ(law.crushed(healing), 0);
}

// Elastic: the energy is the area below the points, and nothing is lost; beyond the last point the slope continues.
TEST(FreeImpact, TabulatedFollowsItsPoints) {
  const Tabulated law{.penetration = {1e-3, 5e-3, 6e-3}, .force = {1e6, 8e6, 8e6}};
  const double m = 60e3, areas[] = {500, 18500, 26500};
  for (const double v : {0.1, 0.5, 0.9}) {
    const double energy = 0.5 * m * v * v;
    double depth = 0;  // of the energy
    if (energy < areas[0])
      depth = std::sqrt(2 * energy / 1e9);
    else if (energy < areas[1])
      depth = 1e-3 + 2 * (energy - 500) / (1e6 + std::sqrt(1e12 + 2 * 1.75e9 * (energy - 500)));
    else
      depth = 5e-3 + (energy - areas[1]) / 8e6;
    const FreeImpact found = free_impact(law, m, v);
    EXPECT_NEAR(found.peak_penetration, depth, 1e-9 * depth);
    EXPECT_NEAR(found.restitution, 1, 1e-9);
    EXPECT_NEAR(found.energy_lost, 0, 1e-9 * energy);
    EXPECT_NEAR(law.stored_energy(depth, {}), energy, 1e-9 * energy);
  }
  EXPECT_EQ(law.contact(7e-3, 0, {}).force, 8e6);
  int turns = 0;  // corner() changes its sign at the two inner points
  for (int i = 1; i < 900; ++i) turns += law.corner(1e-5 * (i + 0.5), 0, {}) * law.corner(1e-5 * (i - 0.5), 0, {}) < 0;
  EXPECT_EQ(turns, 2);
  const Tabulated with_origin{.penetration = {0, 1e-3, 5e-3}, .force = {0, 1e6, 8e6}};
  for (const double d : {-1e-4, 5e-4, 1e-3, 3e-3, 9e-3}) {
    const Tabulated without{.penetration = {1e-3, 5e-3}, .force = {1e6, 8e6}};
    EXPECT_EQ(with_origin.contact(d, 0, {}).force, without.contact(d, 0, {}).force);
    EXPECT_EQ(with_origin.corner(d, 0, {}) > 0, without.corner(d, 0, {}) > 0);
  }
}

}  // namespace yielding_contact_test
}  // namespace pounding::laws
