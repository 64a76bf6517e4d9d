/// Damping values and the resulting restitution against reference tables. tests/verification compares the time
/// integration with the same tables.

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>
#include "support/book.hpp"
#include "support/jankowski_in_both_phases.hpp"
#include "support/published_tables.hpp"

namespace pounding::laws {
namespace published_values_test {

using reference::half_unit;
using reference::requested;

constexpr const char* subject = "Published damping formulas: the damping and the restitution they give";
constexpr const char* source =
    "tables of an independent script: closed forms, confirmed by an 8th-order Runge-Kutta integration to 1e-11";
constexpr const char* reason = "half a unit of the last printed digit";

struct ExactRow {
  std::string_view law, formula;
  reference::Nine values;
};

// Table of exact damping, six digits.
const std::vector<ExactRow> exact_damping{
    {"hertz_damped",
     "exact",
     {9.998159, 4.919167, 3.087082, 2.082498, 1.432751, 0.974872, 0.634828, 0.373146, 0.166482}},
    {"modified_kelvin",
     "exact",
     {9.998159, 4.919167, 3.087082, 2.082498, 1.432751, 0.974872, 0.634828, 0.373146, 0.166482}},
    {"kelvin_voigt",
     "exact",
     {0.591155, 0.455950, 0.357857, 0.279998, 0.215454, 0.160493, 0.112808, 0.070850, 0.033518}},
    {"kelvin_voigt",
     "anagnostopoulos",
     {0.591155, 0.455950, 0.357857, 0.279998, 0.215454, 0.160493, 0.112808, 0.070850, 0.033518}},
    {"kelvin_voigt_no_tension",
     "exact",
     {1.243188, 0.731247, 0.497239, 0.354508, 0.255276, 0.180858, 0.122215, 0.074355, 0.034265}},
    {"komodromos", "exact", {1.243188, 0.731247, 0.497239, 0.354508, 0.255276, 0.180858, 0.122215, 0.074355, 0.034265}},
    {"modified_linear_viscoelastic",
     "exact",
     {4.806942, 2.223955, 1.336027, 0.879039, 0.597342, 0.404744, 0.263878, 0.155848, 0.070035}},
    {"jankowski", "exact", {5.374324, 2.486457, 1.493724, 0.982795, 0.667849, 0.452518, 0.295025, 0.174243, 0.078302}}};

AnyLaw law_with(const reference::Asking& asking, double restitution) {
  Settings s = typical_settings(find_law(asking.law));
  if (asking.stiffness > 0) s.values["stiffness"] = asking.stiffness;
  if (asking.ratio) {
    s.restitution.reset();
    s.values["damping_ratio"] = asking.ratio({.restitution = restitution});
  } else {
    s.formula = asking.formula;
    s.restitution = restitution;
  }
  return make_law(s);
}

// Calls check(row, index of the formula, i, law) for every published formula, every law that offers it and every target
// restitution.
template <class Check>
void for_each_published(Check&& check) {
  for (const reference::FormulaRow& row : reference::formulas)
    for (const reference::Asking& asking : row.askings)
      for (std::size_t i = 0; i < 9; ++i) {
        SCOPED_TRACE(std::string(row.name) + ", " + std::string(asking.law) + ", target " +
                     std::to_string(requested(i)));
        check(row, asking, i, law_with(asking, requested(i)));
      }
}

TEST(PublishedValues, ExactDampingAgreesWithTheReference) {
  test::Book book(subject, source, reason);
  for (const ExactRow& row : exact_damping)
    for (std::size_t i = 0; i < 9; ++i)
      book.near("damping number of " + std::string(row.law) + ", " + std::string(row.formula) + " [-]",
                damping_number(law_with({row.law, row.formula}, requested(i)), 1), row.values[i], half_unit(6));
}

TEST(PublishedValues, EveryPublishedFormulaGivesItsValues) {
  test::Book book(subject, source, reason);
  for_each_published([&book](const auto& row, const auto& asking, std::size_t i, const AnyLaw& law) {
    if (row.damping) {
      book.near("damping number of " + std::string(asking.law) + " by published formulas [-]",
                damping_number(law, asking.speed), (*row.damping)[i], half_unit(5));
    }
  });
}

TEST(PublishedValues, ObtainedRestitutionIsThatOfTheReference) {
  test::Book book(subject, source, reason);
  for_each_published([&book](const auto& row, const auto& asking, std::size_t i, const AnyLaw& law) {
    book.near(std::string(asking.law) + " by " + std::string(row.name) + " [-]",
              free_impact(law, typical_reduced_mass, asking.speed).restitution, row.obtained[i], half_unit(4));
  });
}

TEST(PublishedValues, ErrorInPercentIsThatOfTheReference) {
  test::Book book(subject, source, reason);
  for_each_published([&book](const auto& row, const auto& asking, std::size_t i, const AnyLaw& law) {
    const double e = free_impact(law, typical_reduced_mass, asking.speed).restitution;
    book.near("obtained over target restitution, less one [%]", 100 * (e / requested(i) - 1), row.percent[i],
              half_unit(2));
  });
}

// Above z = 1 the bodies creep back indefinitely.
TEST(PublishedValues, JankowskiDashpotInBothPhasesGivesTheReference) {
  test::Book book(subject, source, reason);
  const reference::FormulaRow& row = reference::jankowski_in_both_phases;
  const double stiffness = 2.75e9, mass = typical_reduced_mass;
  for (std::size_t i = 0; i < 9; ++i) {
    const double xi = jankowski_2005({.restitution = requested(i)}), z = 2 * xi / std::sqrt(5.0);
    const auto law = reference::jankowski_in_both_phases_of(xi, stiffness, mass);
    const double e = z < 1 ? integrated_free_impact(law, mass, 0.8).restitution : 0;
    book.near("restitution of Jankowski's dashpot active in both phases [-]", e, row.obtained[i], half_unit(4));
    book.near("the same over target restitution, less one [%]", 100 * (e / requested(i) - 1), row.percent[i],
              half_unit(2));
    EXPECT_NEAR(e, restitution_to_zero_penetration(z), 1e-9) << requested(i);
  }
}

TEST(PublishedValues, Eq38GivesTheSameRatioToBothLawsThatOfferIt) {
  for (std::size_t i = 0; i < 9; ++i) {
    const AnyLaw linear = law_with({"modified_linear_viscoelastic", "naderpour_2015_eq38"}, requested(i));
    EXPECT_EQ(damping_number(law_with({"jankowski", "naderpour_2015_eq38"}, requested(i)), 1),
              damping_number(linear, 1));
  }
}

// Both exponents are linear between two rows of Table 2 of the paper.
TEST(PublishedValues, NaderpourFormulaIsLinearBetweenTheRowsOfItsTable) {
  test::Book book("Published damping formulas: the damping and the restitution they give",
                  "Naderpour, Barros & Khatami 2015, Eqs. 15-17, between two rows of its Table 2", "rounding");
  const double e = 0.65, N = 0.5 * (0.9973 + 0.9775), M = 0.5 * (0.9754 + 0.9668);
  const HertzDamped law{.stiffness = 3e7, .restitution = e, .formula = naderpour_2015};
  book.near("hertz_damped: damping factor for e = 0.65 [-]", law.damping_number(10),
            std::pow(3000, N - 1) * (1 - e * e) / std::pow(e, M), 1e-13);
}

TEST(PublishedValues, NaderpourFormulaIsRefusedOutsideItsTable) {
  for (const double e : {0.099, 0.901, 1.0}) {
    const HertzDamped law{.stiffness = 3e7, .restitution = e, .formula = naderpour_2015};
    EXPECT_THROW(law.check(), std::invalid_argument) << e;
  }
}

// Restitution if the design penetration is reached exactly: sqrt(1 - loss/energy under the loading curve).
TEST(PublishedValues, BilinearCurveAgreesWithTheReference) {
  test::Book book(subject, source, reason);
  using namespace reference::bilinear;
  for (const reference::BilinearRow& row : rows) {
    SCOPED_TRACE(row.requested);
    const BilinearHertz law{.stiffness = 1,
                            .restitution = row.requested,
                            .impact_velocity = design_speed,
                            .reduced_mass = mass,
                            .formula = muthukumar_desroches};
    const double reaching = reaching_speed(row);
    const auto curve = law.curve(touch(law, reaching));
    book.near("bilinear_hertz: loss at the design penetration [J]",
              law.damping_number(reaching) * 0.5 * mass * design_speed * design_speed, row.loss, half_unit(6));
    book.near("bilinear_hertz: K1 [N/m]", curve.k1, row.stiffness_1, half_unit(6));
    book.near("bilinear_hertz: K2 [N/m]", curve.k2, row.stiffness_2, half_unit(6));
    book.near("bilinear_hertz: yield penetration [m]", curve.yield, row.yield, half_unit(6));
    for (const FreeImpact& r : {free_impact(law, mass, reaching), integrated_free_impact(law, mass, reaching)}) {
      book.near("bilinear_hertz: largest penetration [m]", r.peak_penetration, 1, half_unit(6));
      book.near("bilinear_hertz: largest force [N]", r.peak_force, row.stiffness, half_unit(6));
      book.near("bilinear_hertz: energy lost [J]", r.energy_lost, row.loss, half_unit(6));
      book.near("bilinear_hertz: restitution [-]", r.restitution, row.restitution, half_unit(6));
    }
  }
}

// The curve given by its two stiffnesses and yield, as in ImpactMaterial of OpenSees: no mass, no design speed.
TEST(PublishedValues, BilinearCurveGivenByItsStiffnessesAgreesWithTheReference) {
  test::Book book(subject, source, reason);
  using namespace reference::bilinear;
  for (const reference::BilinearRow& row : rows) {
    SCOPED_TRACE(row.requested);
    const AnyLaw law = make_law({.law = "bilinear_hertz",
                                 .formula = {},
                                 .values = {{"initial_stiffness", row.stiffness_1},
                                            {"secondary_stiffness", row.stiffness_2},
                                            {"yield_penetration", row.yield}}});
    // K1 and K2 of the table are rounded to six decimals; the energy under the curve amplifies the error by less than
    // ten.
    for (const FreeImpact& r :
         {free_impact(law, mass, reaching_speed(row)), integrated_free_impact(law, mass, reaching_speed(row))}) {
      book.near("bilinear_hertz by K1, K2, d_y: largest penetration [m]", r.peak_penetration, 1, 10 * half_unit(6));
      book.near("bilinear_hertz by K1, K2, d_y: largest force [N]", r.peak_force, row.stiffness, 10 * half_unit(6));
      book.near("bilinear_hertz by K1, K2, d_y: energy lost [J]", r.energy_lost, row.loss, 10 * half_unit(6));
      book.near("bilinear_hertz by K1, K2, d_y: restitution [-]", r.restitution, row.restitution, 10 * half_unit(6));
    }
  }
}

}  // namespace published_values_test
}  // namespace pounding::laws
