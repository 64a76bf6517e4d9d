/// Free impacts: closed forms against integration, identities, exact calibration, and limits.

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>
#include "support/book.hpp"
#include "support/messages.hpp"

namespace pounding::laws {
namespace free_impact_test {

constexpr double mass = typical_reduced_mass;

AnyLaw law_with(const Entry& entry, std::string_view formula, double restitution) {
  Settings s = typical_settings(entry);
  s.formula = formula;
  s.restitution = restitution;
  return make_law(s);
}

void for_every_law(double restitution, auto&& check) {
  for (const Entry& entry : catalogue()) {
    if (entry.instantaneous) continue;
    SCOPED_TRACE(std::string(entry.name) + " " + std::to_string(restitution));
    if (entry.formulas.empty()) check(entry, make_law(typical_settings(entry)));
    for (const Formula& f : entry.formulas)
      if (restitution > 0.36 || entry.name != "bilinear_hertz") check(entry, law_with(entry, f.name, restitution));
  }
}

// `free_impact` guarantees 1e-10 for an integrated value.
TEST(FreeImpact, ClosedFormsAgreeWithIntegration) {
  int compared = 0;
  for (const double e : {0.15, 0.4, 0.65, 0.89})
    for (const double v : {0.05, 2.0})
      for_every_law(e, [&](const Entry&, const AnyLaw& law) {
        const FreeImpact closed = free_impact(law, mass, v), integrated = integrated_free_impact(law, mass, v);
        const auto same = [&](double a, double b, double size) { EXPECT_NEAR(a, b, 1e-10 * size); };
        same(closed.restitution, integrated.restitution, 1);
        same(closed.peak_force, integrated.peak_force, closed.peak_force);
        same(closed.peak_penetration, integrated.peak_penetration, closed.peak_penetration);
        same(closed.duration, integrated.duration, closed.duration);
        same(closed.energy_lost, integrated.energy_lost, 0.5 * mass * v * v);
        same(closed.impulse, integrated.impulse, mass * v);
        // At a smooth maximum the time is accurate only to the square root of the error of the force.
        EXPECT_NEAR(closed.time_of_peak, integrated.time_of_peak, 1e-8 * closed.duration);
        compared += closed.closed_form.restitution;
      });
  EXPECT_GT(compared, 100);
}

TEST(FreeImpact, EnergyAndImpulseFollowFromTheRestitution) {
  test::Book book("Free impacts: restitution, identities, limits",
                  "momentum and energy: the loss is m v^2 (1 - e^2)/2, the impulse m v (1 + e), for any law",
                  "a tenth of the 1e-10 guaranteed for a single integrated value");
  for_every_law(0.5, [&book](const Entry&, const AnyLaw& law) {
    const double v = 0.8;
    const FreeImpact r = integrated_free_impact(law, mass, v);
    book.near("energy lost over m v^2/2 [-]", r.energy_lost / (0.5 * mass * v * v), 1 - r.restitution * r.restitution,
              1e-11);
    book.near("impulse over m v [-]", r.impulse / (mass * v), 1 + r.restitution, 1e-11);
  });
}

TEST(FreeImpact, ExactCalibrationGivesWhatIsAskedAtEverySpeed) {
  for (const Entry& entry : catalogue()) {
    if (entry.formulas.empty()) continue;
    for (const double e : {0.1, 0.2, 0.3, 0.4, 0.5, 0.65, 0.8, 0.95, 0.9999, 1.0})
      for (const double v : {1e-3, 0.5, 12.0}) {
        if (entry.name == "bilinear_hertz" && e < 0.36) continue;
        SCOPED_TRACE(std::string(entry.name) + " " + std::to_string(e) + " " + std::to_string(v));
        EXPECT_NEAR(free_impact(law_with(entry, "exact", e), mass, v).restitution, e, 1e-12);
      }
  }
}

// A slow impact is far shallower than the depth of full damping and needs a damping 1e12 times larger.
TEST(FreeImpact, ExactImpactFunctionReachesSlowTouches) {
  for (const double speed : {1e-6, 1e-3}) {
    const AdamsImpact law{.stiffness = 4.2e10, .depth = 1.26e-3, .restitution = 0.5, .reduced_mass = 5e4};
    EXPECT_NEAR(free_impact(law, 5e4, speed).restitution, 0.5, 1e-9) << speed;
  }
}

TEST(FreeImpact, ExactFactorReachesExtremeRestitutions) {
  for (const double e : {1e-3, 0.01, 0.02, 0.05, 0.999, 0.999999, 1 - 1e-9})
    EXPECT_NEAR(restitution_of_factor(exact_factor({.restitution = e})), e, 1e-14) << e;
  for (const double e : {1e-6, 1e-3, 0.13, 0.135335283236613, 0.14, 0.3678794411714423, 0.99999, 1 - 1e-9}) {
    EXPECT_NEAR(restitution_of_approach(exact_approach_ratio({.restitution = e})), e, 1e-14) << e;
    EXPECT_NEAR(restitution_to_zero_force(exact_cut_ratio({.restitution = e})), e, 1e-14) << e;
  }
}

TEST(FreeImpact, SpotValuesOfTheClosedForms) {
  test::Book book("Free impacts: restitution, identities, limits",
                  "values of the closed forms, printed to six or ten digits",
                  "half a unit of the last printed digit, or round-off");
  book.near("restitution for a damping factor 0.5 [-]", restitution_of_factor(0.5), 0.7484349316, 0.51e-10);
  book.near("restitution for a damping factor 1 [-]", restitution_of_factor(1.0), 0.5936242600, 0.51e-10);
  book.near("restitution of critical damping, until F = 0: exp(-2) [-]", restitution_to_zero_force(1.0), std::exp(-2),
            1e-15);
  book.near("restitution of critical damping in the approach: exp(-1) [-]", restitution_of_approach(1.0), std::exp(-1),
            1e-15);
  EXPECT_EQ(restitution_to_zero_penetration(1.0), 0);
  const double e = 0.65;
  book.near("exact damping factor for e = 0.65 [-]", exact_factor({.restitution = e}), 0.793101, 0.51e-6);
  book.near("Anagnostopoulos' ratio for e = 0.65 [-]", anagnostopoulos({.restitution = e}), 0.135851, 0.51e-6);
  book.near("exact ratio until F = 0 for e = 0.65 [-]", exact_cut_ratio({.restitution = e}), 0.149939, 0.51e-6);
  book.near("exact ratio of approach damping for e = 0.65 [-]", exact_approach_ratio({.restitution = e}), 0.329294,
            0.51e-6);
  book.near("exact xi of Jankowski for e = 0.65 [-]", exact_jankowski({.restitution = e}), 0.368162, 0.51e-6);
}

TEST(FreeImpact, AngleRatioIsSmoothAcrossCriticalDamping) {
  for (const double h : {1e-3, 1e-6, 1e-9})
    EXPECT_NEAR((angle_ratio(1 + h) - angle_ratio(1 - h)) / (2 * h), -1.0 / 3, 1e-5);
  EXPECT_NEAR(angle_ratio(0.3), std::acos(0.3) / std::sqrt(1 - 0.09), 1e-15);
  EXPECT_NEAR(angle_ratio(3.0), std::acosh(3.0) / std::sqrt(8.0), 1e-15);
}

TEST(FreeImpact, ExactFactorHasTheRightAsymptotes) {
  test::Book book("Free impacts: restitution, identities, limits",
                  "limits: a -> 3(1-e)/2 as e -> 1, a -> 1/e as e -> 0", "the next order of the limit");
  book.near("a over 3(1-e)/2, 1 - e = 1e-6 [-]", exact_factor({.restitution = 1 - 1e-6}) / 1.5e-6, 1, 1e-5);
  book.near("a e, e = 0.03 [-]", exact_factor({.restitution = 0.03}) * 0.03, 1, 1e-12);
  EXPECT_LT(exact_factor({.restitution = 0.1}) * 0.1, 1);
}

TEST(FreeImpact, PublishedFormulasOfFirstOrderMeetTheExactOneNearOne) {
  test::Book book("Free impacts: restitution, identities, limits",
                  "limits of the published formulas over the exact one as e -> 1", "ten times 1 - e = 1e-5");
  const CalibrationTarget q{.restitution = 1 - 1e-5};
  for (const DampingFormula f : {hunt_crossley, herbert_mcwhannell, lankarani_nikravesh, zhiying_qishao, hu_guo})
    book.near("Hunt-Crossley and others of first order over exact [-]", f(q) / exact_factor(q), 1, 1e-4);
  book.near("Lee-Wang over exact: 1/2 [-]", lee_wang(q) / exact_factor(q), 0.5, 1e-4);
  book.near("Gonthier over exact: 4/3 [-]", gonthier(q) / exact_factor(q), 4.0 / 3, 1e-4);
  book.near("Ye over exact: 16/15 [-]", ye_2009(q) / exact_factor(q), 16.0 / 15, 1e-4);
}

TEST(FreeImpact, RestitutionOfProportionalDampingIgnoresStiffnessMassExponentAndSpeed) {
  test::Book book("Free impacts: restitution, identities, limits",
                  "root of a(1+e) = ln[(1+a)/(1-a e)] for a = 1: 0.59362426", "one unit of the last digit");
  for (const double n : {1.0, 1.5, 2.2})
    for (const double k : {1.0, 2.75e9})
      for (const double v : {0.01, 10.0})
        book.near("restitution for any k, m, n, v [-]",
                  integrated_free_impact(HertzDamped{.stiffness = k, .exponent = n, .damping_factor = 1.0}, 5 * k, v)
                      .restitution,
                  0.59362426, 1e-8);
}

TEST(FreeImpact, JankowskiWithBothPhasesWouldBeViscousHertz) {
  // xi and alpha = 2 xi are the same dashpot during approach and give the same maximum penetration.
  const Jankowski approach{.stiffness = 2.75e9, .damping_ratio = 0.3, .reduced_mass = mass};
  const ViscousHertz both{.stiffness = 2.75e9, .damping_ratio = 0.6, .reduced_mass = mass};
  EXPECT_NEAR(integrated_free_impact(approach, mass, 1).peak_penetration /
                  integrated_free_impact(both, mass, 1).peak_penetration,
              1, 1e-12);
}

TEST(FreeImpact, LinearAndHertzFirstFormulasGiveTheSameRestitution) {
  // The ratio sqrt(5)/2 of the first forms for the linear and the Hertz spring cancels exactly.
  for (const double e : {0.2, 0.5, 0.8}) {
    const ModifiedLinearViscoelastic linear{
        .stiffness = 1e8, .restitution = e, .reduced_mass = mass, .formula = simple_approach};
    const Jankowski hertz{.stiffness = 1e9, .restitution = e, .reduced_mass = mass, .formula = jankowski_2005};
    EXPECT_NEAR(free_impact(linear, mass, 1).restitution, free_impact(hertz, mass, 1).restitution, 1e-14);
  }
}

TEST(FreeImpact, GivenCoefficientsMakeTheRestitutionFallWithSpeed) {
  const KuwabaraKono spheres{.stiffness = 2.75e9, .dissipation_time = 2e-3, .reduced_mass = mass};
  const AdamsImpact impact{.stiffness = 2.75e9, .depth = 1e-3, .damping_coefficient = 1e6, .reduced_mass = mass};
  EXPECT_GT(free_impact(spheres, mass, 0.1).restitution, free_impact(spheres, mass, 1.0).restitution + 0.02);
  EXPECT_LT(free_impact(impact, mass, 0.1).restitution, free_impact(impact, mass, 1.0).restitution - 0.02);
}

// To first order in the damping, the loss is the work of the dashpot along the elastic motion. For F = k d^1.5 + (3/2)
// A k d^0.5 d' in units of k = m = v = 1: 1 - e = (3/2) A times the integral of d^0.5 sqrt(1 - (d/d_m)^2.5) over the
// way there and back.
TEST(FreeImpact, KuwabaraKonoHasTheRightLimitOfSmallDamping) {
  test::Book book("Free impacts: restitution, identities, limits",
                  "first order of small damping: work of the dashpot along the elastic motion, by quadrature",
                  "ten times the damping number 1e-5");
  const double number = 1e-5, dm = std::pow(1.25, 0.4);
  double integral = 0;
  constexpr int points = 200000;
  for (int i = 0; i < points; ++i) {
    const double angle = (i + 0.5) / points * std::numbers::pi / 2;  // d = d_m sin^2(angle)
    const double s = std::sin(angle) * std::sin(angle), d = dm * s;
    integral +=
        std::sqrt(d) * std::sqrt(1 - std::pow(s, 2.5)) * dm * std::sin(2 * angle) * std::numbers::pi / 2 / points;
  }
  const KuwabaraKono law{.stiffness = 1, .dissipation_time = number, .reduced_mass = 1};
  book.near("loss of Kuwabara-Kono over first order [-]",
            (1 - free_impact(law, 1, 1).restitution) / (2 * 1.5 * number * integral), 1, 1e-4);
}

TEST(FreeImpact, BilinearLawWithoutYieldIsElastic) {
  const BilinearHertz law{.stiffness = 1, .restitution = 0.6, .impact_velocity = 1, .reduced_mass = 0.8};
  const FreeImpact r = free_impact(law, 0.8, 0.01);
  EXPECT_EQ(r.restitution, 1);
  EXPECT_NEAR(integrated_free_impact(law, 0.8, 0.01).restitution, 1, 1e-11);
}

TEST(FreeImpact, BilinearLawUnloadsSteeplyAndReloadsAlongTheSameLine) {
  const BilinearHertz law{.stiffness = 1, .restitution = 0.6, .impact_velocity = 1, .reduced_mass = 0.8};
  Impact impact = touch(law, 1);
  const auto [k1, k2, yield] = law.curve(impact);
  const auto force_at = [&](double d) {
    keep(law, d, 0, impact);
    return law.respond(d, 0, impact).force;
  };
  const double top = k1 * yield + k2 * (0.6 - yield);
  EXPECT_NEAR(force_at(0.6), top, 1e-14);
  EXPECT_NEAR(force_at(0.6 - yield / 2), top - k1 * yield / 2, 1e-14);
  EXPECT_NEAR(force_at(0.6), top, 1e-14);
  EXPECT_NEAR(force_at(0.3), k2 * 0.3, 1e-14);
  EXPECT_NEAR(force_at(0.3 + yield / 2), k2 * 0.3 + k1 * yield / 2, 1e-14);
}

TEST(FreeImpact, BilinearLawSaysWhichRestitutionItCannotReach) {
  const BilinearHertz law{.stiffness = 1, .restitution = 0.3, .reduced_mass = 1};
  try {
    law.check();
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"bilinear_hertz", "0.3"}));
  }
}

// Loading stores k d_m^2/2 and unloading with k2 = k/e^2 returns F_m^2/(2 k2): the spring of Walton & Braun with its
// two stiffnesses.
TEST(FreeImpact, ElastoplasticLawWithALinearSpringIsThatOfWaltonAndBraun) {
  test::Book book("Elastoplastic contact: crushing, memory",
                  "Walton & Braun 1986: k1 loads, k2 unloads, e = sqrt(k1/k2), duration pi/2 (sqrt(m/k1) + "
                  "sqrt(m/k2)), residual d_m (1 - k1/k2)",
                  "guaranteed tolerance of the integration");
  const double k1 = 3e7, k2 = 7.5e7, m = 4e4, v = 0.6, deepest = v * std::sqrt(m / k1);
  const Elastoplastic law{.stiffness = k1, .exponent = 1, .restitution = std::sqrt(k1 / k2)};
  for (const FreeImpact& r : {free_impact(law, m, v), integrated_free_impact(law, m, v)}) {
    book.near("elastoplastic, n = 1: restitution [-]", r.restitution, std::sqrt(k1 / k2), 1e-11);
    book.near("elastoplastic, n = 1: largest penetration [m]", r.peak_penetration, deepest, 1e-11 * deepest);
    book.near("elastoplastic, n = 1: peak force [N]", r.peak_force, v * std::sqrt(k1 * m), 1e-4);
    book.near("elastoplastic, n = 1: duration [s]", r.duration,
              std::numbers::pi / 2 * (std::sqrt(m / k1) + std::sqrt(m / k2)), 1e-11);
  }
  Impact impact = touch(law, v);
  keep(law, deepest, 0, impact);
  book.near("elastoplastic, n = 1: slope of unloading [N/m]", law.contact(0.9 * deepest, -1, impact).by_penetration, k2,
            1e-6);
  book.near("elastoplastic, n = 1: indentation [m]", law.indentation(impact), deepest * (1 - k1 / k2), 1e-16);
}

// Loading takes K/c [x - log(1 + c x)/c] with c = K Rf/Fu, and unloading returns F^2/(2 K_ur). Both are closed forms;
// the depth follows by bisection.
TEST(FreeImpact, BackfillLosesWhatItsHyperbolaTakes) {
  test::Book book("Wall with backfill", "closed form of the area below the hyperbola less F^2/(2 K_ur)",
                  "guaranteed tolerance of the integration");
  const Backfill law{.stiffness = 250e6, .unloading = 500e6, .failure_ratio = 0.75, .strength = 6e6};
  const double m = 250e3, c = 250e6 * 0.75 / 6e6;
  for (const double v : {0.05, 0.5, 1.5}) {
    const auto taken = [&](double x) { return 250e6 / c * (x - std::log1p(c * x) / c); };
    double low = 0, high = 1;
    while (high - low > 1e-16) (taken(0.5 * (low + high)) < 0.5 * m * v * v ? low : high) = 0.5 * (low + high);
    const double force = high / (1 / 250e6 + 0.75 * high / 6e6), back = force * force / (2 * 500e6);
    const FreeImpact found = free_impact(law, m, v);
    book.near("backfill: largest penetration [m]", found.peak_penetration, high, 1e-9 * high);
    book.near("backfill: peak force [N]", found.peak_force, force, 1e-9 * force);
    book.near("backfill: restitution [-]", found.restitution, std::sqrt(back / (0.5 * m * v * v)), 1e-8);
  }
}

// The path law of hysteresis/ and the contact law agree for two impacts, the second one deeper.
TEST(FreeImpact, BackfillReloadsAlongItsUnloadingUpToTheDeepest) {
  const Backfill law{.stiffness = 250e6, .unloading = 500e6, .failure_ratio = 0.75, .strength = 6e6};
  const Hyperbola soil = law.soil();
  Impact impact = touch(law, 1);
  keep(law, 0.03, 0, impact);
  const double top = soil.force(0.03), left = 0.03 - top / 500e6;
  EXPECT_DOUBLE_EQ(law.contact(0.03, -1, impact).force, top);
  EXPECT_NEAR(law.contact(0.5 * (0.03 + left), -1, impact).force, 0.5 * top, 1e-9 * top);
  EXPECT_EQ(law.respond(left * 0.999, -1, impact).force, 0);
  EXPECT_DOUBLE_EQ(law.indentation(impact), left);
  Impact second{.closing_speed = 1, .crushed = law.crushed(impact)};
  keep(law, 0.5 * (0.03 - left), 0, second);
  EXPECT_EQ(law.indentation(second), 0) << "no deeper than before";
  EXPECT_NEAR(law.contact(0.5 * (0.03 - left), 1, second).force, 0.5 * top, 1e-9 * top);
  EXPECT_NEAR(law.contact(0.04 - left, 1, second).force, soil.force(0.04), 1e-9 * top);
  keep(law, 0.04 - left, 0, second);
  EXPECT_NEAR(law.indentation(second), 0.04 - soil.force(0.04) / 500e6 - left, 1e-15);
}

TEST(FreeImpact, CrushedSurfacesUnloadAndReloadAlongTheSameCurve) {
  const Elastoplastic law{.stiffness = 2e9, .restitution = 0.6};
  Impact impact = touch(law, 1);
  const auto force_at = [&](double d) {
    keep(law, d, 0, impact);
    return law.respond(d, 0, impact).force;
  };
  const double top = force_at(5e-3), left = 0.64 * 5e-3, middle = left + 0.5 * (5e-3 - left);
  EXPECT_NEAR(top, 2e9 * std::pow(5e-3, 1.5), 1e-9 * top);
  EXPECT_NEAR(force_at(middle), top * std::pow(0.5, 1.5), 1e-12 * top);
  EXPECT_EQ(force_at(left * 0.999), 0);
  EXPECT_NEAR(force_at(middle), top * std::pow(0.5, 1.5), 1e-12 * top);
  EXPECT_NEAR(force_at(5e-3), top, 1e-12 * top);
  EXPECT_NEAR(force_at(6e-3), 2e9 * std::pow(6e-3, 1.5), 1e-9 * top);
  // Slope of unloading in a crushed state, by central differences.
  const double h = 1e-7;
  const auto force = [&](double d) { return law.contact(d, 0, impact).force; };
  EXPECT_NEAR(law.contact(5.5e-3, 0, impact).by_penetration, (force(5.5e-3 + h) - force(5.5e-3 - h)) / (2 * h), 1e2);
  EXPECT_NEAR(law.contact(5.9e-3, 0, impact).by_penetration / (1.5 * 2e9 * std::sqrt(6e-3)), 1 / 0.36, 0.2)
      << "steeper by 1/e^2 at the top";
  EXPECT_LT(force(0.64 * 6e-3 - h), 0) << "the formula continues below the end of the force";
}

TEST(FreeImpact, OverdampedKelvinVoigtNeverParts) {
  const KelvinVoigt law{.stiffness = 1, .damping_ratio = 1.5, .reduced_mass = 1};
  const FreeImpact r = free_impact(law, 1, 1);
  EXPECT_EQ(r.restitution, 0);
  EXPECT_TRUE(std::isinf(r.duration));
  const KelvinVoigt requested{.stiffness = 1, .restitution = 0, .reduced_mass = 1};
  EXPECT_EQ(requested.damping_number(1), 1);
  EXPECT_EQ(free_impact(requested, 1, 1).restitution, 0);
  // In the integration the bodies creep back until round-off separates them.
  EXPECT_NEAR(integrated_free_impact(law, 1, 1).restitution, 0, 1e-12);
}

/// A law outside the library.
struct Cubic {
  static constexpr std::string_view name = "cubic";
  void check() const {}
  Response contact(double d, double, const Impact&) const noexcept { return {d * d * d, 3 * d * d, 0}; }
  Response respond(double d, double v, const Impact& i) const noexcept { return pressed(*this, d, v, i); }
};

// A strong damper releases the force just before the depth at which it weakens, and the force returns behind it.
// Reference restitutions: Runge-Kutta of order four with fixed steps of 1e-5 and 2.5e-6, which agree to 5e-12.
TEST(FreeImpact, ReleaseShortlyBeforeACornerIsFound) {
  AdamsImpact law{
      .stiffness = 1, .exponent = 1, .depth = 0.15, .damping_coefficient = 0.20135496083667953, .reduced_mass = 1};
  EXPECT_NEAR(integrated_free_impact(law, 1, 1).restitution, 0.754775780971, 1e-10);
  law.damping_coefficient = 0.209;
  EXPECT_NEAR(integrated_free_impact(law, 1, 1).restitution, 0.747180132586, 1e-10);
}

TEST(FreeImpact, UserLawsAreIntegrated) {
  test::Book book("Free impacts: restitution, identities, limits", "F = d^3, m = 2, v = 3: d_max^4 = 36, no loss",
                  "guaranteed tolerance of the integration");
  const FreeImpact r = free_impact(Cubic{}, 2, 3);
  book.near("restitution of a user's law [-]", r.restitution, 1, 1e-11);
  book.near("largest penetration of a user's law [m]", r.peak_penetration, std::pow(36, 0.25), 1e-10);
}

TEST(FreeImpact, RefusesNoMassAndNoSpeed) {
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(free_impact(Hertz{.stiffness = 1}, bad, 1), std::invalid_argument);
    EXPECT_THROW(free_impact(Hertz{.stiffness = 1}, 1, bad), std::invalid_argument);
    EXPECT_THROW(integrated_free_impact(Hertz{.stiffness = 1}, 1, bad), std::invalid_argument);
  }
}

TEST(Extrapolation, ErrorFallsWithTheThirteenthPowerOfTheStep) {
  test::Book book("Free impacts: restitution, identities, limits", "order of the extrapolation method",
                  "the next order of the error");
  const auto f = [](double x, const std::array<double, 1>& y) { return std::array<double, 1>{y[0] * std::cos(x)}; };
  const auto error = [&](double h) {
    return std::abs(extrapolated_step<1>(f, 0, {1}, h, 1).state[0] - std::exp(std::sin(h)));
  };
  book.near("observed order of the extrapolation [-]", std::log2(error(2.0) / error(1.0)), 13, 1.5);
}

TEST(FindRoot, FindsRootsAndRefusesBracketsWithoutOne) {
  const auto f = [](double x) { return x * x - 2; };
  EXPECT_NEAR(find_root(f, 0, -2, 2, 2), std::numbers::sqrt2, 4e-16);
  const auto steep = [](double x) { return x < 0.3 ? -1.0 : 1e6; };
  EXPECT_NEAR(find_root(steep, 0, -1, 1, 1e6), 0.3, 1e-15);
  EXPECT_THROW(find_root(f, 2, 2, 3, 7), std::domain_error);
}

}  // namespace free_impact_test
}  // namespace pounding::laws
