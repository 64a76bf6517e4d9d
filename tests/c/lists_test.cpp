/// Texts for user interfaces: every law, parameter and formula, with correctly terminated strings.

#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "made.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace lists_test {

// A literal's view ends at its terminating zero.
void expect_ends(std::string_view view) { EXPECT_EQ(std::strlen(view.data()), view.size()) << view; }

TEST(CInterfaceLists, TextsOfTheTablesEndWithAZero) {
  for (const laws::Entry& e : laws::catalogue()) {
    for (const std::string_view text : {e.name, e.shape, e.summary, e.source}) expect_ends(text);
    for (const laws::ParameterInfo& p : e.parameters)
      for (const std::string_view text : {p.name, p.unit, p.meaning}) expect_ends(text);
    for (const laws::Formula& f : e.formulas)
      for (const std::string_view text : {f.name, f.source, f.note}) expect_ends(text);
  }
}

TEST(CInterfaceLists, LawsAreThoseOfTheCatalogue) {
  ASSERT_EQ(pnd_law_count(), laws::catalogue().size());
  for (size_t i = 0; i < pnd_law_count(); ++i) {
    const laws::Entry& e = laws::catalogue()[i];
    pnd_law_info info{};
    ASSERT_EQ(pnd_describe_law(i, &info), PND_OK);
    EXPECT_EQ(info.name, e.name);
    EXPECT_EQ(info.force, e.shape);
    EXPECT_EQ(info.summary, e.summary);
    EXPECT_EQ(info.source, e.source);
    EXPECT_EQ(info.may_pull, e.may_pull);
    EXPECT_EQ(info.leaves_indentation, e.leaves_indentation);
    EXPECT_EQ(info.instantaneous, e.instantaneous);
    size_t found = 99;
    EXPECT_EQ(pnd_find_law(info.name, &found), PND_OK);
    EXPECT_EQ(found, i);
    ASSERT_EQ(info.formulas, e.formulas.size());
    for (size_t k = 0; k < info.formulas; ++k) {
      pnd_formula_info f{};
      ASSERT_EQ(pnd_describe_formula(i, k, &f), PND_OK);
      EXPECT_EQ(f.name, e.formulas[k].name);
      EXPECT_EQ(f.source, e.formulas[k].source);
      EXPECT_EQ(f.note, e.formulas[k].note);
    }
  }
}

// The first set of damping parameters, at typical values without options; then each other set.
TEST(CInterfaceLists, ParametersListedAreThoseThatCreateTakes) {
  for (size_t i = 0; i < pnd_law_count(); ++i) {
    pnd_law_info info{};
    ASSERT_EQ(pnd_describe_law(i, &info), PND_OK);
    SCOPED_TRACE(info.name);
    std::vector<pnd_value> needed;
    std::vector<pnd_value> dampings;
    for (size_t k = 0; k < info.parameters; ++k) {
      pnd_parameter_info p{};
      ASSERT_EQ(pnd_describe_parameter(i, k, &p), PND_OK);
      EXPECT_STRNE(p.meaning, "");
      if (p.need == PND_REQUIRED) needed.push_back({p.name, p.typical});
      if (p.need == PND_DAMPING) dampings.push_back({p.name, p.typical});
    }
    const auto taken = [&](std::vector<pnd_value> values) {
      pnd_law* law = nullptr;
      const int status = pnd_create(info.name, "", values.data(), values.size(), &law);
      pnd_destroy(law);
      return status == PND_OK;
    };
    EXPECT_EQ(taken(needed), dampings.empty()) << pnd_error_text();
    for (const pnd_value& damping : dampings) {
      std::vector<pnd_value> values = needed;
      values.push_back(damping);
      EXPECT_TRUE(taken(values)) << pnd_error_text();
    }
    for (size_t left_out = 0; left_out < needed.size(); ++left_out) {
      std::vector<pnd_value> values = needed;
      values.erase(values.begin() + static_cast<std::ptrdiff_t>(left_out));
      if (!dampings.empty()) values.push_back(dampings[0]);
      EXPECT_FALSE(taken(values)) << needed[left_out].name;
    }
  }
}

TEST(CInterfaceLists, WhatDoesNotExistIsRefused) {
  size_t index = 0;
  pnd_law_info law{};
  pnd_parameter_info parameter{};
  pnd_formula_info formula{};
  EXPECT_EQ(pnd_find_law("hertz_damp", &index), PND_BAD_ARGUMENT);
  EXPECT_TRUE(test::mentions(pnd_error_text(), {"hertz_damp", "hertz_damped"}));
  EXPECT_EQ(pnd_describe_law(99, &law), PND_BAD_ARGUMENT);
  EXPECT_TRUE(test::mentions(pnd_error_text(), {"99", std::to_string(pnd_law_count())}));
  EXPECT_EQ(pnd_describe_parameter(0, 9, &parameter), PND_BAD_ARGUMENT);
  EXPECT_TRUE(test::mentions(pnd_error_text(), {"linear_spring", "9"}));
  EXPECT_EQ(pnd_describe_formula(0, 0, &formula), PND_BAD_ARGUMENT);
  EXPECT_TRUE(test::mentions(pnd_error_text(), {"linear_spring"}));
}

TEST(CInterfaceLists, VersionsAreThoseOfTheLibrary) {
  EXPECT_EQ(pnd_interface(), PND_INTERFACE);
  EXPECT_STREQ(pnd_version(), POUNDING_TEST_VERSION);
}

}  // namespace lists_test
}  // namespace pounding
