/// Single impacts with units against reference tables: closed forms and integration.

#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <pounding/laws/free_impact.hpp>
#include "support/book.hpp"
#include "support/published_tables.hpp"

namespace pounding::laws {
namespace single_impact_test {

using reference::half_unit;
constexpr double kilonewton = 1000;
constexpr const char* source = "tables of an independent 8th-order integration (rtol 1e-12)";
constexpr const char* reason = "half a unit of the last printed digit, three to eight decimals";

TEST(SingleImpact, ExampleOfSection51GivesTheReferenceHistory) {
  test::Book book("Two floors that collide at 15 m/s (section 5.1 of the paper)", source, reason);
  using namespace reference::section_5_1;
  for (const reference::Section51Row& row : rows) {
    SCOPED_TRACE(std::string(row.law) + ' ' + std::string(row.formula) + ' ' + std::to_string(row.requested));
    const AnyLaw law = make_law({.law = std::string(row.law),
                                 .formula = std::string(row.formula),
                                 .restitution = row.requested,
                                 .reduced_mass = mass,
                                 .values = {{"stiffness", stiffness}}});
    book.near(std::string(row.law) + ": damping number [-]", damping_number(law, speed), row.damping, half_unit(5));
    for (const FreeImpact& r : {free_impact(law, mass, speed), integrated_free_impact(law, mass, speed)}) {
      book.near(std::string(row.law) + ": restitution [-]", r.restitution, row.restitution, half_unit(5));
      book.near(std::string(row.law) + ": largest penetration [m]", r.peak_penetration, row.penetration, half_unit(6));
      book.near(std::string(row.law) + ": peak force [kN]", r.peak_force / kilonewton, row.force, half_unit(2));
      book.near(std::string(row.law) + ": duration [s]", r.duration, row.duration, half_unit(6));
      book.near(std::string(row.law) + ": energy lost [kJ]", r.energy_lost / kilonewton, row.lost, half_unit(3));
      book.near(std::string(row.law) + ": impulse [kN s]", r.impulse / kilonewton, row.impulse, half_unit(3));
    }
  }
}

TEST(SingleImpact, HertzSpringGivesTheReferenceHistory) {
  test::Book book("Two floors that collide at 15 m/s (section 5.1 of the paper)", source, reason);
  using namespace reference::section_5_1;
  const Hertz law{.stiffness = stiffness};
  for (const FreeImpact& r : {free_impact(law, mass, speed), integrated_free_impact(law, mass, speed)}) {
    book.near("hertz: largest penetration [m]", r.peak_penetration, elastic_penetration, half_unit(6));
    book.near("hertz: peak force [kN]", r.peak_force / kilonewton, elastic_force, half_unit(3));
    book.near("hertz: duration [s]", r.duration, elastic_duration, half_unit(6));
    book.near("hertz: closing energy [kJ]", r.impulse * speed / 4 / kilonewton, energy,
              half_unit(3));  // 2 m v; the energy is m v^2/2
  }
  // m = k = v = 1.
  const FreeImpact unit = free_impact(Hertz{.stiffness = 1}, 1, 1);
  book.near("hertz, m = k = v = 1: largest penetration [-]", unit.peak_penetration, 1.0933621, half_unit(7));
  book.near("hertz, m = k = v = 1: peak force [-]", unit.peak_force, 1.1432626, half_unit(7));
  book.near("hertz, m = k = v = 1: duration [-]", unit.duration, 3.2180655, half_unit(7));
}

TEST(SingleImpact, KelvinVoigtGivesTheReferenceHistoryWithAndWithoutPull) {
  test::Book book("Kelvin-Voigt impact with and without pull", source, reason);
  using namespace reference::kelvin_voigt;
  for (const reference::KelvinVoigtRow& row : rows) {
    SCOPED_TRACE(row.requested);
    const KelvinVoigt pulls{.stiffness = stiffness, .restitution = row.requested, .reduced_mass = mass};
    const KelvinVoigtNoTension cut{
        .stiffness = stiffness, .restitution = row.requested, .reduced_mass = mass, .formula = anagnostopoulos};
    book.near("kelvin_voigt: damping ratio [-]", pulls.damping_number(speed), row.ratio, half_unit(6));
    book.near("kelvin_voigt: dashpot coefficient [N s/m]", pulls.damping_for(speed), row.coefficient, half_unit(1));
    EXPECT_EQ(cut.damping_for(speed), pulls.damping_for(speed));
    const auto check = [&](const auto& law, const FreeImpact& r, double restitution, double duration) {
      book.near(std::string(law.name) + ": restitution [-]", r.restitution, restitution, half_unit(6));
      book.near(std::string(law.name) + ": duration [s]", r.duration, duration, half_unit(8));
      book.near(std::string(law.name) + ": largest penetration [m]", r.peak_penetration, row.penetration, half_unit(8));
      book.near(std::string(law.name) + ": peak force [N]", r.peak_force, row.force, half_unit(1));
      book.near(std::string(law.name) + ": force at the largest penetration [N]",
                law.respond(r.peak_penetration, 0, touch(law, speed)).force, row.force_at_penetration, half_unit(1));
    };
    const auto both_ways = [&](const auto& law, double restitution, double duration) {
      check(law, free_impact(law, mass, speed), restitution, duration);
      check(law, integrated_free_impact(law, mass, speed), restitution, duration);
    };
    both_ways(pulls, row.restitution_to_zero_penetration, row.duration_to_zero_penetration);
    both_ways(cut, row.restitution_to_zero_force, row.duration_to_zero_force);
  }
}

TEST(SingleImpact, ExampleOfSection5GivesTheReferenceValues) {
  test::Book book("Impact of 755.76 kg at 10 m/s (section 5 of the paper)", source, reason);
  using namespace reference::section_5;
  for (const reference::Section5Row& row : rows) {
    SCOPED_TRACE(row.formula);
    const AnyLaw law = make_law({.law = "hertz_damped",
                                 .formula = std::string(row.formula),
                                 .restitution = requested,
                                 .values = {{"stiffness", stiffness}}});
    book.near("hertz_damped: damping factor [-]", damping_number(law, speed), row.factor, half_unit(6));
    book.near("hertz_damped: damping coefficient [kN s/m^2.5]",
              std::get<HertzDamped>(law).damping_for(speed) / kilonewton, row.damping, half_unit(3));
    for (const FreeImpact& r : {free_impact(law, mass, speed), integrated_free_impact(law, mass, speed)}) {
      book.near("hertz_damped: restitution [-]", r.restitution, row.restitution, half_unit(5));
      book.near("hertz_damped: largest penetration [m]", r.peak_penetration, row.penetration, half_unit(6));
      book.near("hertz_damped: peak force [kN]", r.peak_force / kilonewton, row.force, half_unit(3));
      book.near("hertz_damped: energy lost [kJ]", r.energy_lost / kilonewton, row.lost, half_unit(5));
    }
    book.near("hertz_damped: energy lost for the target e (Eq. 18) [kJ]",
              0.5 * mass * speed * speed * (1 - requested * requested) / kilonewton, row.lost_if_as_requested,
              half_unit(5));
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

}  // namespace single_impact_test
}  // namespace pounding::laws
