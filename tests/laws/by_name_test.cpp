/// Laws by name: construction, error messages, and the properties that a constructed law reports.

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/laws/all.hpp>
#include "support/messages.hpp"

namespace pounding::laws {
namespace by_name_test {

Settings hertz_damped() {
  return {.law = "hertz_damped",
          .formula = {},
          .restitution = 0.65,
          .reduced_mass = 6e4,
          .values = {{"stiffness", 2.75e9}}};
}

std::string refusal(const Settings& s) {
  return test::refusal([&] { make_law(s); });
}

double described(const AnyLaw& law, std::string_view name, double speed = 1) {
  for (const ResolvedValue& v : describe(law, speed))
    if (v.name == name) return v.value;
  ADD_FAILURE() << "no " << name;
  return 0;
}

TEST(LawsByName, EveryLawOfTheDesignIsThere) {
  const std::set<std::string_view> expected{"linear_spring",
                                            "kelvin_voigt",
                                            "kelvin_voigt_no_tension",
                                            "komodromos",
                                            "modified_linear_viscoelastic",
                                            "modified_kelvin",
                                            "hertz",
                                            "hertz_damped",
                                            "jankowski",
                                            "bilinear_hertz",
                                            "viscous_hertz",
                                            "kuwabara_kono",
                                            "adams_impact",
                                            "limited_damper",
                                            "stereomechanical",
                                            "elastoplastic",
                                            "backfill",
                                            "elastic_plastic_gap",
                                            "tabulated"};
  std::set<std::string_view> found;
  for (const Entry& entry : catalogue()) found.insert(entry.name);
  EXPECT_EQ(found, expected);
}

TEST(LawsByName, FormulaIsExactUnlessNamed) {
  EXPECT_EQ(formula_name(make_law(hertz_damped())), "exact");
  Settings s = hertz_damped();
  s.formula = "ye_2009";
  EXPECT_EQ(formula_name(make_law(s)), "ye_2009");
  EXPECT_NEAR(described(make_law(s), "damping_factor"), 1.6 * 0.35 / 0.65, 1e-15);
}

TEST(LawsByName, DampingIsWhatTheEntryNames) {
  for (const Entry& entry : catalogue()) {
    SCOPED_TRACE(entry.name);
    const AnyLaw law = make_law(typical_settings(entry));
    const bool damped = !entry.number.name.empty();
    EXPECT_EQ(damping_number(law, 0.3), damped ? described(law, entry.number.name, 0.3) : 0);
    EXPECT_EQ(damping_coefficient(law, 0.3), damped ? described(law, entry.coefficient.name, 0.3) : 0);
  }
}

TEST(LawsByName, DirectDampingNeedsNoFormula) {
  Settings s = hertz_damped();
  s.restitution.reset();
  s.values["damping_factor"] = 0.5;
  const AnyLaw law = make_law(s);
  EXPECT_EQ(formula_name(law), "");
  EXPECT_EQ(described(law, "damping_factor"), 0.5);
  EXPECT_DOUBLE_EQ(described(law, "damping_coefficient", 2.0), 0.5 * 2.75e9 / 2.0);
  EXPECT_EQ(find_law("hertz_damped").direct_damping(), "damping_factor");
}

TEST(LawsByName, DescriptionHoldsUnitsWithTheExponentFilledIn) {
  Settings s = hertz_damped();
  s.values["exponent"] = 1.2;
  for (const ResolvedValue& v : describe(make_law(s))) {
    if (v.name == "stiffness") {
      EXPECT_EQ(v.unit, "N/m^1.2");
    }
    if (v.name == "damping_coefficient") {
      EXPECT_EQ(v.unit, "N s/m^2.2");
    }
  }
  EXPECT_EQ(resolved_unit("N/m^n", 1), "N/m");
  EXPECT_EQ(resolved_unit("N s/m^((n+1)/2)", 1.5), "N s/m^1.25");
  EXPECT_EQ(resolved_unit("kg", 1.5), "kg");
}

TEST(LawsByName, DescriptionSaysForWhichSpeedItHolds) {
  Settings s = hertz_damped();
  EXPECT_EQ(described(make_law(s), "closing_speed", 0.4), 0.4);
  s.impact_velocity = 0.3;
  const auto values = describe(make_law(s), 0.4);
  EXPECT_EQ(std::ranges::count(values, "closing_speed", &ResolvedValue::name), 0);
  EXPECT_EQ(described(make_law(s), "impact_velocity"), 0.3);
}

TEST(LawsByName, WrongNamesAreRefusedWithTheNearestOne) {
  Settings s = hertz_damped();
  s.law = "hertz_damp";
  EXPECT_TRUE(test::mentions(refusal(s), {"hertz_damp", "hertz_damped"}));
  s.law = "ImpactMaterial";
  EXPECT_TRUE(test::mentions(refusal(s), {"ImpactMaterial", "bilinear_hertz"}));
  s.law = "antypov_elliott";
  EXPECT_TRUE(test::mentions(refusal(s), {"antypov_elliott", "law: viscous_hertz"}));
  s = hertz_damped();
  s.formula = "ye2009";
  EXPECT_TRUE(test::mentions(refusal(s), {"ye2009", "ye_2009", "hertz_damped"}));
  s = hertz_damped();
  s.values["stifness"] = 1;
  EXPECT_TRUE(test::mentions(refusal(s), {"stifness", "stiffness", "hertz_damped"}));
  s = hertz_damped();
  s.values["colour"] = 1;
  EXPECT_TRUE(test::mentions(refusal(s), {"colour", "stiffness", "exponent", "damping_factor", "hertz_damped"}));
  EXPECT_THROW(find_law("hertzz_"), std::invalid_argument);
  s = hertz_damped();
  s.formula = "Ye-2009";
  EXPECT_TRUE(test::mentions(refusal(s), {"Ye-2009", "ye_2009", "hertz_damped"}));
  for (const auto& [read, meant] :
       {std::pair("HERTZ", "hertz"), {"Hertz Damped", "hertz_damped"}, {"jankwoski", "jankowski"}}) {
    s.law = read;
    EXPECT_TRUE(test::mentions(refusal(s), {read, ". Did you mean", meant}));
  }
}

TEST(LawsByName, StiffnessHasNoDefault) {
  Settings s = hertz_damped();
  s.values.clear();
  EXPECT_TRUE(test::mentions(refusal(s), {"hertz_damped"}));
}

TEST(LawsByName, DampingIsGivenExactlyOnce) {
  Settings s = hertz_damped();
  s.values["damping_factor"] = 0.5;
  EXPECT_TRUE(test::mentions(refusal(s), {"hertz_damped", "damping_factor"}));
  s = hertz_damped();
  s.restitution.reset();
  EXPECT_TRUE(test::mentions(refusal(s), {"hertz_damped", "damping_factor", "damping_coefficient"}));
  s.formula = "ye_2009";
  EXPECT_TRUE(test::mentions(refusal(s), {"ye_2009", "hertz_damped"}));
}

TEST(LawsByName, WrongValuesAreRefusedWithWhatIsAllowed) {
  Settings s = hertz_damped();
  s.restitution = 1.2;
  EXPECT_TRUE(test::mentions(refusal(s), {"1.2", "restitution"}));
  s = hertz_damped();
  s.values["stiffness"] = -3;
  EXPECT_TRUE(test::mentions(refusal(s), {"-3", "stiffness"}));
  s = hertz_damped();
  s.values["exponent"] = 0.5;
  EXPECT_TRUE(test::mentions(refusal(s), {"0.5", "exponent"}));
  s = hertz_damped();
  s.formula = "naderpour_2015";
  s.restitution = 0.95;
  EXPECT_TRUE(test::mentions(refusal(s), {"[0.1, 0.9]", "naderpour_2015", "0.95", "2", "restitution"}));
}

TEST(LawsByName, WhatALawCannotUseIsRefused) {
  Settings s{.law = "hertz", .formula = {}, .values = {{"stiffness", 1e9}}};
  EXPECT_EQ(refusal(s), "taken");
  s.restitution = 0.5;
  EXPECT_TRUE(test::mentions(refusal(s), {"hertz"}));
  s.restitution.reset();
  s.formula = "exact";
  EXPECT_TRUE(test::mentions(refusal(s), {"hertz"}));
  s.formula.clear();
  s.impact_velocity = 1;
  EXPECT_TRUE(test::mentions(refusal(s), {"impact_velocity", "hertz"}));
  s = hertz_damped();
  s.restitution.reset();
  s.values["damping_coefficient"] = 1e9;
  s.impact_velocity = 1;
  EXPECT_TRUE(test::mentions(refusal(s), {"impact_velocity", "damping_coefficient"}));
}

TEST(LawsByName, RigidImpactNeedsItsRestitution) {
  Settings s{.law = "stereomechanical", .formula = {}};
  EXPECT_TRUE(test::mentions(refusal(s), {"stereomechanical", "restitution"}));
  s.restitution = 0.7;
  EXPECT_EQ(std::get<Stereomechanical>(make_law(s)).restitution, 0.7);
  EXPECT_TRUE(entry_of(make_law(s)).instantaneous);
}

// The message lists the laws that accept it.
TEST(LawsByName, ZeroRestitutionIsForLawsWithWhichTheBodiesStick) {
  for (const Entry& entry : catalogue()) {
    if (!entry.takes_restitution) continue;
    Settings s = typical_settings(entry);
    s.restitution = 0;
    if (entry.sticks_at_zero)
      EXPECT_EQ(refusal(s), "taken") << entry.name;
    else
      EXPECT_TRUE(test::mentions(refusal(s), {"restitution", "(0, 1]", "stereomechanical", "kelvin_voigt"}));
    s.restitution = 1e-320;
    EXPECT_EQ(bool(test::mentions(refusal(s), {"restitution", "1e-320", "(0, 1]"})), !entry.sticks_at_zero)
        << entry.name;
    // The smallest normal number is either calibrated or rejected by the law.
    s.restitution = std::numeric_limits<double>::min();
    EXPECT_TRUE(refusal(s) == "taken" || refusal(s).find("restitution") == 0) << entry.name << ": " << refusal(s);
  }
  Settings s = typical_settings(find_law("kelvin_voigt"));
  s.restitution = -0.1;
  EXPECT_TRUE(test::mentions(refusal(s), {"[0, 1]", "-0.1", "restitution"}));
  s.restitution = 0;
  for (const std::string_view formula : {"exact", "anagnostopoulos"}) {
    s.formula = formula;
    EXPECT_EQ(described(make_law(s), "damping_ratio"), 1) << formula;
  }
}

Settings bilinear() {
  return {.law = "bilinear_hertz",
          .formula = {},
          .values = {{"initial_stiffness", 4e8}, {"secondary_stiffness", 1e8}, {"yield_penetration", 1e-3}}};
}

TEST(LawsByName, ParametersThatGoTogetherAreAllThatIsGiven) {
  EXPECT_EQ(refusal(bilinear()), "taken") << "neither mass nor restitution";
  const std::vector<ResolvedValue> values = describe(make_law(bilinear()));
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0].name, "initial_stiffness");
  EXPECT_EQ(values[0].unit, "N/m");
  EXPECT_EQ(values[2].value, 1e-3);
  Settings s = bilinear();
  s.values.erase("yield_penetration");
  EXPECT_TRUE(test::mentions(refusal(s), {"bilinear_hertz", "yield_penetration", "d_y"}));
  s = bilinear();
  s.values["stiffness"] = 1e9;
  EXPECT_TRUE(test::mentions(refusal(s), {"initial_stiffness"}));
  s = bilinear();
  s.restitution = 0.5;
  EXPECT_TRUE(
      test::mentions(refusal(s), {"bilinear_hertz", "initial_stiffness", "secondary_stiffness", "yield_penetration"}));
  s = bilinear();
  s.formula = "exact";
  EXPECT_TRUE(test::mentions(refusal(s), {"exact", "bilinear_hertz"}));
  s = bilinear();
  s.impact_velocity = 0.5;
  EXPECT_TRUE(test::mentions(refusal(s), {"bilinear_hertz", "initial_stiffness", "secondary_stiffness",
                                          "yield_penetration", "impact_velocity"}));
  s = bilinear();
  s.values["secondary_stiffness"] = 5e8;
  EXPECT_TRUE(test::mentions(refusal(s), {"secondary_stiffness", "initial_stiffness", "5e+08", "4e+08"}));
  for (const char* name : {"initial_stiffness", "secondary_stiffness", "yield_penetration"})
    for (const double bad : {0.0, -1.0}) {
      s = bilinear();
      s.values[name] = bad;
      EXPECT_TRUE(test::mentions(refusal(s), {std::string(name), number_text(bad)}));
    }
}

TEST(LawsByName, DashpotCoefficientNeedsNoMass) {
  for (const char* name : {"kelvin_voigt", "kelvin_voigt_no_tension", "komodromos", "modified_linear_viscoelastic"}) {
    Settings s{.law = name, .formula = {}, .values = {{"stiffness", 1e8}, {"damping_coefficient", 2e5}}};
    ASSERT_EQ(refusal(s), "taken") << name;
    EXPECT_EQ(damping_coefficient(make_law(s), 1), 2e5);
    s.reduced_mass = 4e4;
    EXPECT_DOUBLE_EQ(described(make_law(s), "damping_ratio"), 2e5 / (2 * std::sqrt(1e8 * 4e4))) << name;
    s.restitution = 0.5;
    EXPECT_TRUE(test::mentions(refusal(s), {std::string(name), "damping_coefficient"}));
  }
}

// Explicit damping needs no mass; a mass that is given must still be valid.
TEST(LawsByName, AMassThatIsNoMassIsRefusedBesideAnyDamping) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const Entry& entry : catalogue())
    for (const Need need : {Need::damping, Need::together}) {
      Settings s{.law = std::string(entry.name), .formula = {}, .reduced_mass = typical_reduced_mass};
      for (const ParameterInfo& p : entry.parameters)
        if (p.need == need || (p.need == Need::required && need == Need::damping)) s.values.emplace(p.name, p.typical);
      if (refusal(s) != "taken") continue;
      for (const double bad : {nan, infinite, -1.0}) {
        s.reduced_mass = bad;
        EXPECT_TRUE(test::mentions(refusal(s), {"reduced_mass"})) << entry.name << ' ' << bad;
      }
    }
}

TEST(LawsByName, LawsThatNeedTheMassRefuseNone) {
  for (const Entry& entry : catalogue()) {
    Settings s = typical_settings(entry);
    s.reduced_mass = 0;
    EXPECT_EQ(bool(test::mentions(refusal(s), {"reduced_mass"})), entry.takes_reduced_mass) << refusal(s);
  }
}

TEST(LawsByName, ListsAreGivenItemByItem) {
  Settings s{.law = "tabulated",
             .formula = {},
             .values = {{"penetration[1]", 1e-3}, {"penetration[2]", 5e-3}, {"force[1]", 1e6}, {"force[2]", 8e6}}};
  const Tabulated law = std::get<Tabulated>(make_law(s));
  EXPECT_EQ(law.penetration, (std::vector{1e-3, 5e-3}));
  EXPECT_EQ(law.force, (std::vector{1e6, 8e6}));
  EXPECT_EQ(described(make_law(s), "force[2]"), 8e6);
  const auto refused = [&](const std::map<std::string, double>& changes, const test::Facts& facts) {
    Settings changed = s;
    for (const auto& [name, value] : changes) changed.values[name] = value;
    EXPECT_TRUE(test::mentions(refusal(changed), facts)) << refusal(changed);
  };
  refused({{"penetration[2]", 1e-3}}, {"penetration[2]", "0.001"});
  refused({{"force[2]", 9e5}}, {"force[2]", "1e+06"});
  refused({{"force[1]", 0}}, {"force[1]", "above 0"});
  refused({{"penetration[1]", -1e-3}}, {"penetration[1]", "-0.001"});
  refused({{"force[3]", 9e6}}, {"force", "3", "2"});
  refused({{"force[4]", 9e6}, {"penetration[3]", 1}, {"penetration[4]", 2}}, {"force[3]", "finite"});
  refused({{"force[0]", 1}}, {"force[0]", "tabulated"});
  refused({{"force[1001]", 1}}, {"force[1001]", "tabulated"});
  s.values = {{"penetration", 1e-3}, {"force", 2e5}};
  EXPECT_EQ(std::get<Tabulated>(make_law(s)).contact(5e-3, 0, {}).force, 1e6) << "one point: a linear spring";
  s.values = {{"penetration[1]", 0}, {"penetration[2]", 1e-3}, {"force[1]", 5}, {"force[2]", 2e5}};
  EXPECT_TRUE(test::mentions(refusal(s), {"force[1]", "5", "0"})) << "begins at the origin";
  s.values.erase("force[1]"), s.values.erase("force[2]");
  EXPECT_TRUE(test::mentions(refusal(s), {"tabulated", "force"}));
}

TEST(LawsByName, DamageIsTrueOrFalse) {
  Settings s{.law = "elastic_plastic_gap",
             .formula = {},
             .values = {{"stiffness", 1e8}, {"yield_force", 2e6}, {"hardening", 0}, {"damage", 1}}};
  EXPECT_EQ(refusal(s), "taken");
  s.values["damage"] = 0.5;
  EXPECT_TRUE(test::mentions(refusal(s), {"damage", "0.5", "true", "false"}));
  s.values.erase("damage");
  EXPECT_TRUE(test::mentions(refusal(s), {"damage", "elastic_plastic_gap"}));
  s.values["damage"] = 0;
  s.values["hardening"] = 1;
  EXPECT_TRUE(test::mentions(refusal(s), {"hardening", "[0, 1)"}));
  s.restitution = 0.5;
  EXPECT_TRUE(test::mentions(refusal(s), {"restitution", "curves"}));
}

TEST(LawsByName, TraitsAreThoseOfTheLaws) {
  for (const Entry& entry : catalogue()) {
    EXPECT_EQ(entry.may_pull, entry.name == "kelvin_voigt");
    EXPECT_EQ(entry.leaves_indentation, entry.name == "komodromos" || entry.name == "elastoplastic" ||
                                            entry.name == "backfill" || entry.name == "elastic_plastic_gap");
    EXPECT_EQ(entry.sticks_at_zero, entry.name == "stereomechanical" || entry.name == "kelvin_voigt");
    EXPECT_EQ(entry.instantaneous, entry.name == "stereomechanical");
  }
}

}  // namespace by_name_test
}  // namespace pounding::laws
