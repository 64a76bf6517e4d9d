/// Laws by name: what is made, what is refused with which words, and what a made law says of itself.

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
  try {
    make_law(s);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
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
                                            "backfill"};
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
  EXPECT_EQ(refusal(s), R"(unknown law "hertz_damp". Did you mean "hertz_damped"?)");
  s.law = "ImpactMaterial";
  EXPECT_EQ(refusal(s), R"(unknown law "ImpactMaterial". Did you mean "bilinear_hertz"?)");
  s.law = "antypov_elliott";
  EXPECT_EQ(refusal(s),
            "unknown law \"antypov_elliott\". \"antypov_elliott\" is a formula for the damping of a law; type law: "
            "viscous_hertz, "
            "formula: antypov_elliott.");
  s = hertz_damped();
  s.formula = "ye2009";
  EXPECT_EQ(refusal(s), R"(hertz_damped has no formula "ye2009". Did you mean "ye_2009"?)");
  s = hertz_damped();
  s.values["stifness"] = 1;
  EXPECT_EQ(refusal(s), R"(hertz_damped has no parameter "stifness". Did you mean "stiffness"?)");
  s = hertz_damped();
  s.values["colour"] = 1;
  EXPECT_EQ(
      refusal(s),
      R"(hertz_damped has no parameter "colour". Allowed: stiffness, exponent, damping_factor, damping_coefficient.)");
  EXPECT_THROW(find_law("hertzz_"), std::invalid_argument);
  s = hertz_damped();
  s.formula = "Ye-2009";
  EXPECT_EQ(refusal(s), R"(hertz_damped has no formula "Ye-2009". Did you mean "ye_2009"?)");
  for (const auto& [read, meant] :
       {std::pair("HERTZ", "hertz"), {"Hertz Damped", "hertz_damped"}, {"jankwoski", "jankowski"}}) {
    s.law = read;
    EXPECT_EQ(refusal(s), std::string("unknown law \"") + read + "\". Did you mean \"" + meant + "\"?");
  }
}

TEST(LawsByName, StiffnessHasNoDefault) {
  Settings s = hertz_damped();
  s.values.clear();
  EXPECT_EQ(refusal(s), "hertz_damped needs stiffness (contact stiffness k)");
}

TEST(LawsByName, DampingIsGivenExactlyOnce) {
  Settings s = hertz_damped();
  s.values["damping_factor"] = 0.5;
  EXPECT_EQ(refusal(s),
            "hertz_damped takes its damping once, but restitution and damping_factor are given; keep one of them");
  s = hertz_damped();
  s.restitution.reset();
  EXPECT_EQ(refusal(s), "hertz_damped needs its damping: give restitution or damping_factor or damping_coefficient");
  s.formula = "ye_2009";
  EXPECT_EQ(refusal(s), R"(formula "ye_2009" needs a restitution to find the damping of hertz_damped)");
}

TEST(LawsByName, WrongValuesAreRefusedWithWhatIsAllowed) {
  Settings s = hertz_damped();
  s.restitution = 1.2;
  EXPECT_EQ(refusal(s), "restitution is 1.2, but must be in (0, 1]");
  s = hertz_damped();
  s.values["stiffness"] = -3;
  EXPECT_EQ(refusal(s), "stiffness is -3, but must be finite and positive");
  s = hertz_damped();
  s.values["exponent"] = 0.5;
  EXPECT_EQ(refusal(s), "exponent is 0.5, but must be finite and at least 1");
  s = hertz_damped();
  s.formula = "naderpour_2015";
  s.restitution = 0.95;
  EXPECT_EQ(refusal(s), "restitution is 0.95, but must be in [0.1, 0.9] for naderpour_2015, the range of its Table 2");
}

TEST(LawsByName, WhatALawCannotUseIsRefused) {
  Settings s{.law = "hertz", .formula = {}, .values = {{"stiffness", 1e9}}};
  EXPECT_EQ(refusal(s), "accepted");
  s.restitution = 0.5;
  EXPECT_EQ(refusal(s), "hertz takes no restitution: it loses no energy");
  s.restitution.reset();
  s.formula = "exact";
  EXPECT_EQ(refusal(s), "hertz takes no formula: it has no damping to calibrate");
  s.formula.clear();
  s.impact_velocity = 1;
  EXPECT_EQ(refusal(s), "hertz takes no impact_velocity: nothing in it depends on one");
  s = hertz_damped();
  s.restitution.reset();
  s.values["damping_coefficient"] = 1e9;
  s.impact_velocity = 1;
  EXPECT_EQ(refusal(s), "impact_velocity has no effect beside damping_coefficient; leave one of them out");
}

TEST(LawsByName, RigidImpactNeedsItsRestitution) {
  Settings s{.law = "stereomechanical", .formula = {}};
  EXPECT_EQ(refusal(s), "stereomechanical needs restitution");
  s.restitution = 0.7;
  EXPECT_EQ(std::get<Stereomechanical>(make_law(s)).restitution, 0.7);
  EXPECT_TRUE(entry_of(make_law(s)).instantaneous);
}

// The refusal names the laws that take it.
TEST(LawsByName, ZeroRestitutionIsForLawsWithWhichTheBodiesStick) {
  for (const Entry& entry : catalogue()) {
    if (!entry.takes_restitution) continue;
    Settings s = typical_settings(entry);
    s.restitution = 0;
    EXPECT_EQ(refusal(s), entry.sticks_at_zero
                              ? "accepted"
                              : "restitution is 0, but must be in (0, 1]: no damping of this law stops the bodies; "
                                "with stereomechanical and kelvin_voigt they stick at 0")
        << entry.name;
    s.restitution = 1e-320;
    EXPECT_EQ(refusal(s).find("restitution is 1e-320, but must be in (0, 1]: no damping") == 0, !entry.sticks_at_zero)
        << entry.name;
    // The least number with all its digits is calibrated, or refused by the law.
    s.restitution = std::numeric_limits<double>::min();
    EXPECT_TRUE(refusal(s) == "accepted" || refusal(s).find("restitution") == 0) << entry.name << ": " << refusal(s);
  }
  Settings s = typical_settings(find_law("kelvin_voigt"));
  s.restitution = -0.1;
  EXPECT_EQ(refusal(s), "restitution is -0.1, but must be in [0, 1]");
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
  EXPECT_EQ(refusal(bilinear()), "accepted") << "neither mass nor restitution";
  const std::vector<ResolvedValue> values = describe(make_law(bilinear()));
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0].name, "initial_stiffness");
  EXPECT_EQ(values[0].unit, "N/m");
  EXPECT_EQ(values[2].value, 1e-3);
  Settings s = bilinear();
  s.values.erase("yield_penetration");
  EXPECT_EQ(refusal(s), "bilinear_hertz needs yield_penetration (penetration d_y at the yield)");
  s = bilinear();
  s.values["stiffness"] = 1e9;
  EXPECT_EQ(refusal(s), "stiffness has no effect beside initial_stiffness; leave one of them out");
  s = bilinear();
  s.restitution = 0.5;
  EXPECT_EQ(refusal(s),
            "bilinear_hertz takes initial_stiffness, secondary_stiffness and yield_penetration without restitution, "
            "which would have no effect");
  s = bilinear();
  s.formula = "exact";
  EXPECT_EQ(refusal(s), R"(formula "exact" needs a restitution to find the damping of bilinear_hertz)");
  s = bilinear();
  s.impact_velocity = 0.5;
  EXPECT_EQ(
      refusal(s),
      "bilinear_hertz takes initial_stiffness, secondary_stiffness and yield_penetration without impact_velocity, "
      "which would have no effect");
  s = bilinear();
  s.values["secondary_stiffness"] = 5e8;
  EXPECT_EQ(refusal(s), "secondary_stiffness is 5e+08, but must be at most the initial_stiffness, 4e+08");
  for (const char* name : {"initial_stiffness", "secondary_stiffness", "yield_penetration"})
    for (const double bad : {0.0, -1.0}) {
      s = bilinear();
      s.values[name] = bad;
      EXPECT_EQ(refusal(s), std::string(name) + " is " + number_text(bad) + ", but must be finite and positive");
    }
}

TEST(LawsByName, DashpotCoefficientNeedsNoMass) {
  for (const char* name : {"kelvin_voigt", "kelvin_voigt_no_tension", "komodromos", "modified_linear_viscoelastic"}) {
    Settings s{.law = name, .formula = {}, .values = {{"stiffness", 1e8}, {"damping_coefficient", 2e5}}};
    ASSERT_EQ(refusal(s), "accepted") << name;
    EXPECT_EQ(damping_coefficient(make_law(s), 1), 2e5);
    s.reduced_mass = 4e4;
    EXPECT_DOUBLE_EQ(described(make_law(s), "damping_ratio"), 2e5 / (2 * std::sqrt(1e8 * 4e4))) << name;
    s.restitution = 0.5;
    EXPECT_EQ(refusal(s),
              std::string(name) +
                  " takes its damping once, but restitution and damping_coefficient are given; keep one of them");
  }
}

// Damping that is given directly needs no mass; one that is given must be one all the same.
TEST(LawsByName, AMassThatIsNoMassIsRefusedBesideAnyDamping) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const Entry& entry : catalogue())
    for (const Need need : {Need::damping, Need::together}) {
      Settings s{.law = std::string(entry.name), .formula = {}, .reduced_mass = typical_reduced_mass};
      for (const ParameterInfo& p : entry.parameters)
        if (p.need == need || (p.need == Need::required && need == Need::damping)) s.values.emplace(p.name, p.typical);
      if (refusal(s) != "accepted") continue;
      for (const double bad : {nan, infinite, -1.0}) {
        s.reduced_mass = bad;
        EXPECT_EQ(refusal(s).substr(0, 13), "reduced_mass ") << entry.name << ' ' << bad;
      }
    }
}

TEST(LawsByName, LawsThatNeedTheMassRefuseNone) {
  for (const Entry& entry : catalogue()) {
    Settings s = typical_settings(entry);
    s.reduced_mass = 0;
    EXPECT_EQ(refusal(s), entry.takes_reduced_mass ? "reduced_mass is 0, but must be finite and positive" : "accepted")
        << entry.name;
  }
}

TEST(LawsByName, TraitsAreThoseOfTheLaws) {
  for (const Entry& entry : catalogue()) {
    EXPECT_EQ(entry.may_pull, entry.name == "kelvin_voigt");
    EXPECT_EQ(entry.leaves_indentation,
              entry.name == "komodromos" || entry.name == "elastoplastic" || entry.name == "backfill");
    EXPECT_EQ(entry.sticks_at_zero, entry.name == "stereomechanical" || entry.name == "kelvin_voigt");
    EXPECT_EQ(entry.instantaneous, entry.name == "stereomechanical");
  }
}

}  // namespace by_name_test
}  // namespace pounding::laws
