/// Single impacts with dimensions, against reference tables of an independent 8th-order integration (rtol 1e-12), printed
/// to five to nine digits: hence the tolerances of half a unit of the last digit printed.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>

namespace pounding::laws {
namespace {

constexpr double tonne = 1000, kilonewton = 1000;  // SI
constexpr double mass = 60 * tonne, stiffness = 22000 * kilonewton, speed = 15;

struct Expected {
  double restitution, damping, obtained, penetration, force, time, energy, impulse;  // m, kN, s, kJ, kN s
};

void expect_impact(const FreeImpact& r, const Expected& x) {
  EXPECT_NEAR(r.restitution, x.obtained, 0.51e-5);
  EXPECT_NEAR(r.peak_penetration, x.penetration, 0.51e-6);
  EXPECT_NEAR(r.peak_force / kilonewton, x.force, 0.0051);
  EXPECT_NEAR(r.duration, x.time, 0.51e-6);
  EXPECT_NEAR(r.energy_lost / kilonewton, x.energy, 0.00051);
  EXPECT_NEAR(r.impulse / kilonewton, x.impulse, 0.00051);
}

void expect_both_ways(const auto& law, double m, double v, const Expected& x) {
  EXPECT_NEAR(law.damping_number(v), x.damping, 0.51e-5);
  expect_impact(free_impact(law, m, v), x);
  expect_impact(integrated_free_impact(law, m, v), x);
}

// Masses of 100 t and 150 t, k = 22000 kN/m^1.5, v = 15 m/s: the example of Naderpour, Barros & Khatami 2015, section 5.1.
TEST(SingleImpact, HertzDampedGivesTheReferenceHistory) {
  const auto check = [](DampingFormula formula, const Expected& x) {
    SCOPED_TRACE(x.restitution);
    expect_both_ways(HertzDamped{.stiffness = stiffness, .restitution = x.restitution, .formula = formula}, mass, speed, x);
  };
  check(exact_factor, {0.3, 3.08708, 0.30000, 0.592582, 19531.03, 0.226945, 6142.500, 1170.000});
  check(exact_factor, {0.5, 1.43275, 0.50000, 0.697520, 17444.15, 0.197608, 5062.500, 1350.000});
  check(exact_factor, {0.7, 0.63483, 0.70000, 0.784698, 16959.19, 0.185019, 3442.500, 1530.000});
  check(exact_factor, {0.9, 0.16648, 0.90000, 0.862713, 17810.41, 0.178520, 1282.500, 1710.000});
  check(naderpour_2015, {0.3, 3.80263, 0.25217, 0.562166, 20437.25, 0.240351, 6320.755, 1126.957});
  check(naderpour_2015, {0.5, 1.61566, 0.46783, 0.682228, 17651.28, 0.200678, 5272.651, 1321.049});
  check(naderpour_2015, {0.7, 0.61106, 0.70811, 0.788011, 16967.21, 0.184669, 3365.382, 1537.302});
  check(naderpour_2015, {0.9, 0.11162, 0.93071, 0.874108, 18065.72, 0.177825, 903.070, 1737.635});
  check(lankarani_nikravesh, {0.3, 0.68250, 0.68422, 0.778214, 16949.77, 0.185726, 3589.898, 1515.802});
  check(lankarani_nikravesh, {0.5, 0.56250, 0.72524, 0.794958, 16991.26, 0.183960, 3199.671, 1552.717});
  check(lankarani_nikravesh, {0.7, 0.38250, 0.79597, 0.823026, 17194.87, 0.181405, 2473.386, 1616.375});
  check(lankarani_nikravesh, {0.9, 0.14250, 0.91318, 0.867620, 17915.86, 0.178214, 1121.231, 1721.859});
  check(ye_2009, {0.3, 3.73333, 0.25621, 0.564862, 20350.99, 0.239042, 6306.913, 1130.587});
  check(ye_2009, {0.5, 1.60000, 0.47044, 0.683487, 17632.96, 0.200413, 5256.102, 1323.400});
  check(ye_2009, {0.7, 0.68571, 0.68318, 0.777785, 16949.43, 0.185774, 3599.501, 1514.866});
  check(ye_2009, {0.9, 0.17778, 0.89392, 0.860440, 17763.85, 0.178665, 1356.114, 1704.529});
}

TEST(SingleImpact, JankowskiGivesTheReferenceHistory) {
  const auto check = [](DampingFormula formula, const Expected& x) {
    SCOPED_TRACE(x.restitution);
    expect_both_ways(
        Jankowski{.stiffness = stiffness, .restitution = x.restitution, .reduced_mass = mass, .formula = formula}, mass, speed, x);
  };
  check(jankowski_2005, {0.3, 1.07951, 0.37652, 0.411679, 19514.75, 0.173432, 5793.074, 1238.867});
  check(jankowski_2005, {0.5, 0.53382, 0.55817, 0.564081, 13766.88, 0.174158, 4647.011, 1402.353});
  check(jankowski_2005, {0.7, 0.25928, 0.72710, 0.696950, 14017.88, 0.175054, 3181.491, 1554.386});
  check(jankowski_2005, {0.9, 0.07513, 0.90369, 0.829364, 16742.22, 0.175985, 1237.536, 1713.324});
  check(exact_jankowski, {0.3, 1.49372, 0.30000, 0.343262, 24635.68, 0.173420, 6142.500, 1170.000});
  check(exact_jankowski, {0.5, 0.66785, 0.50000, 0.516541, 14785.65, 0.173875, 5062.500, 1350.000});
  check(exact_jankowski, {0.7, 0.29503, 0.70000, 0.676094, 13762.18, 0.174908, 3442.500, 1530.000});
  check(exact_jankowski, {0.9, 0.07830, 0.90000, 0.826651, 16670.99, 0.175966, 1282.500, 1710.000});
}

TEST(SingleImpact, HertzSpringGivesTheReferenceHistory) {
  const Hertz law{.stiffness = stiffness};
  for (const FreeImpact& r : {free_impact(law, mass, speed), integrated_free_impact(law, mass, speed)}) {
    EXPECT_NEAR(r.peak_penetration, 0.899349, 0.51e-6);
    EXPECT_NEAR(r.peak_force / kilonewton, 18763.564, 0.00051);
    EXPECT_NEAR(r.duration, 0.176469, 0.51e-6);
  }
  // m = k = v = 1.
  const FreeImpact unit = free_impact(Hertz{.stiffness = 1}, 1, 1);
  EXPECT_NEAR(unit.peak_penetration, 1.0933621, 0.51e-7);
  EXPECT_NEAR(unit.peak_force, 1.1432626, 0.51e-7);
  EXPECT_NEAR(unit.duration, 3.2180655, 0.51e-7);
}

// Reduced mass 1e5 kg, k = 9.35e7 N/m, v = 0.5 m/s.
TEST(SingleImpact, KelvinVoigtGivesTheReferenceHistoryWithAndWithoutPull) {
  struct Case {
    double e, zeta, c, e_zero_penetration, e_zero_force, penetration, force, t_zero_penetration, t_zero_force;
  };
  const double m = 1e5, k = 9.35e7, v = 0.5;
  for (const Case& x : {Case{0.4, 0.279998, 1712342.8, 0.4, 0.472014, 0.01123419, 1239504.5, 0.10702188, 0.08768649},
                        Case{0.5, 0.215454, 1317619.1, 0.5, 0.550283, 0.01212990, 1248202.8, 0.10521207, 0.09066691},
                        Case{0.65, 0.135851, 830805.5, 0.65, 0.674751, 0.01343186, 1303701.6, 0.10370247, 0.09470588},
                        Case{0.8, 0.070850, 433288.8, 0.8, 0.808099, 0.01469930, 1388298.8, 0.10299991, 0.09835023},
                        Case{1.0, 0, 0, 1, 1, 0.01635175, 1528888.5, 0.10274107, 0.10274107}}) {
    SCOPED_TRACE(x.e);
    const KelvinVoigt pulls{.stiffness = k, .restitution = x.e, .reduced_mass = m};
    const KelvinVoigtNoTension cut{.stiffness = k, .restitution = x.e, .reduced_mass = m, .formula = anagnostopoulos};
    EXPECT_NEAR(pulls.damping_number(v), x.zeta, 0.51e-6);
    EXPECT_NEAR(pulls.damping_for(v), x.c, 0.051);
    EXPECT_EQ(cut.damping_for(v), pulls.damping_for(v));
    const auto same = [&](const FreeImpact& r, double e, double t) {
      EXPECT_NEAR(r.restitution, e, 0.51e-6);
      EXPECT_NEAR(r.duration, t, 0.51e-8);
      EXPECT_NEAR(r.peak_penetration, x.penetration, 0.51e-8);
      EXPECT_NEAR(r.peak_force, x.force, 0.051);
    };
    same(free_impact(pulls, m, v), x.e_zero_penetration, x.t_zero_penetration);
    same(integrated_free_impact(pulls, m, v), x.e_zero_penetration, x.t_zero_penetration);
    same(free_impact(cut, m, v), x.e_zero_force, x.t_zero_force);
    same(integrated_free_impact(cut, m, v), x.e_zero_force, x.t_zero_force);
  }
}

// m = 755.76 kg, k = 30000 kN/m^1.5, v = 10 m/s, restitution 0.7: the example of the paper's section 5.
TEST(SingleImpact, PaperExampleGivesTheReferenceValues) {
  struct Case {
    DampingFormula formula;
    double a, zeta, obtained, penetration, force, energy;
  };
  const double m = 755.76, k = 3e7, v = 10;
  for (const Case& x : {Case{lankarani_nikravesh, 0.382500, 1147.500, 0.79597, 0.091360, 867.178, 13.84657},
                        Case{hu_guo, 0.642857, 1928.571, 0.69730, 0.086982, 855.182, 19.41460},
                        Case{ye_2009, 0.685714, 2057.143, 0.68318, 0.086338, 854.800, 20.15080},
                        Case{naderpour_2015, 0.601304, 1803.912, 0.71150, 0.087626, 855.897, 18.65871},
                        Case{exact_factor, 0.634828, 1904.485, 0.70000, 0.087105, 855.292, 19.27188}}) {
    const HertzDamped law{.stiffness = k, .restitution = 0.7, .formula = x.formula};
    const FreeImpact r = free_impact(law, m, v);
    EXPECT_NEAR(law.damping_number(v), x.a, 0.51e-6);
    EXPECT_NEAR(law.damping_for(v) / kilonewton, x.zeta, 0.00051);
    EXPECT_NEAR(r.restitution, x.obtained, 0.51e-5);
    EXPECT_NEAR(r.peak_penetration, x.penetration, 0.51e-6);
    EXPECT_NEAR(r.peak_force / kilonewton, x.force, 0.00051);
    EXPECT_NEAR(r.energy_lost / kilonewton, x.energy, 0.51e-5);
  }
}

TEST(SingleImpact, RigidImpactIsAVelocityJump) {
  const FreeImpact r = free_impact(Stereomechanical{.restitution = 0.6}, 2.0, 3.0);
  EXPECT_EQ(r.restitution, 0.6);
  EXPECT_EQ(r.duration, 0);
  EXPECT_EQ(r.peak_force, std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(r.impulse, 2 * 3 * 1.6);
  EXPECT_DOUBLE_EQ(r.energy_lost, 0.5 * 2 * 9 * (1 - 0.36));
  EXPECT_THROW(integrated_free_impact(AnyLaw(Stereomechanical{.restitution = 0.6}), 2, 3), std::invalid_argument);
}

}  // namespace
}  // namespace pounding::laws
