/// Refusals of the C interface: their texts, and that they change nothing.

#include <cstring>
#include <limits>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "made.hpp"

namespace pounding {
namespace errors_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

test::LawInC hertz_damped() {
  return test::made_in_c(
      {.law = "hertz_damped", .formula = {}, .restitution = 0.65, .values = {{"stiffness", 2.75e9}}});
}

#define EXPECT_REFUSED(call, words)        \
  do {                                     \
    EXPECT_EQ(call, PND_BAD_ARGUMENT);     \
    EXPECT_STREQ(pnd_error_text(), words); \
  } while (false)

TEST(CInterfaceErrors, TextIsEmptyBeforeTheFirst) {
  std::string text = "unread";
  std::thread([&] { text = pnd_error_text(); }).join();
  EXPECT_EQ(text, "");
}

TEST(CInterfaceErrors, WrongNamesAndValuesAreRefusedWithTheWordsOfTheLaws) {
  const pnd_value stiff[] = {{"stiffness", 2.75e9}, {"restitution", 0.65}};
  const pnd_value soft[] = {{"stiffness", -1}, {"restitution", 0.65}};
  const pnd_value twice[] = {{"stiffness", 1}, {"stiffness", 2}}, nameless[] = {{nullptr, 1}};
  pnd_law* law = reinterpret_cast<pnd_law*>(&law);
  EXPECT_REFUSED(pnd_create("hertz_damp", "", stiff, 2, &law),
                 R"(unknown law "hertz_damp". Did you mean "hertz_damped"?)");
  EXPECT_EQ(law, nullptr);
  EXPECT_REFUSED(pnd_create("HERTZ", "", stiff, 1, &law), R"(unknown law "HERTZ". Did you mean "hertz"?)");
  EXPECT_REFUSED(pnd_create("hertz_damped", "ye2009", stiff, 2, &law),
                 R"(hertz_damped has no formula "ye2009". Did you mean "ye_2009"?)");
  EXPECT_REFUSED(pnd_create("hertz_damped", "", soft, 2, &law), "stiffness is -1, but must be finite and positive");
  EXPECT_REFUSED(pnd_create("hertz_damped", nullptr, stiff, 1, &law),
                 "hertz_damped needs its damping: give restitution or damping_factor or damping_coefficient");
  EXPECT_REFUSED(pnd_create("hertz", "", twice, 2, &law), "stiffness is given twice");
  EXPECT_REFUSED(pnd_create("hertz", "", nameless, 1, &law), "name of a value is a null pointer");
  EXPECT_REFUSED(pnd_create("hertz", "", nullptr, 0, &law), "hertz needs stiffness (contact stiffness k)");
}

TEST(CInterfaceErrors, AMassThatIsNoMassIsRefused) {
  pnd_law* law = nullptr;
  for (const char* name : {"kelvin_voigt", "kelvin_voigt_no_tension", "komodromos", "modified_linear_viscoelastic"})
    for (const double mass : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
      const pnd_value values[] = {{"stiffness", 1e8}, {"damping_coefficient", 2e5}, {"reduced_mass", mass}};
      EXPECT_EQ(pnd_create(name, "", values, 3, &law), PND_BAD_ARGUMENT) << name << ' ' << mass;
      EXPECT_EQ(std::string(pnd_error_text()).substr(0, 13), "reduced_mass ");
    }
}

TEST(CInterfaceErrors, TextsOfTheCallerAreQuotedShortAndPrintable) {
  pnd_law* law = nullptr;
  std::string letters;
  for (int i = 0; i < 5'000'000; ++i) letters += "\u00e4";
  EXPECT_EQ(pnd_create(letters.c_str(), "", nullptr, 0, &law), PND_BAD_ARGUMENT);
  const std::string text = pnd_error_text();
  EXPECT_EQ(text.substr(0, 417), "unknown law \"" + letters.substr(0, 400) + "...\"");
  size_t index = 0;
  EXPECT_EQ(pnd_find_law("her\x1b[31m\ntz", &index), PND_BAD_ARGUMENT);
  EXPECT_EQ(std::string(pnd_error_text()).substr(0, 33), R"(unknown law "her\x1b[31m\ntz". Al)");
  const pnd_value twice[] = {{letters.c_str(), 1}, {letters.c_str(), 2}};
  EXPECT_REFUSED(pnd_create("hertz", "", twice, 2, &law), (letters.substr(0, 400) + "... is given twice").c_str());
}

TEST(CInterfaceErrors, NullPointersAreErrors) {
  const test::LawInC law = hertz_damped();
  pnd_contact contact{};
  pnd_response response{};
  pnd_free_impact result{};
  size_t index = 0;
  pnd_law* made = nullptr;
  EXPECT_REFUSED(pnd_create(nullptr, "", nullptr, 0, &made), "law is a null pointer");
  EXPECT_REFUSED(pnd_create("hertz", "", nullptr, 1, &made), "values is a null pointer");
  EXPECT_REFUSED(pnd_create("hertz", "", nullptr, 0, nullptr), "made is a null pointer");
  EXPECT_REFUSED(pnd_touch(nullptr, 1, &contact), "law is a null pointer");
  EXPECT_REFUSED(pnd_touch(law.get(), 1, nullptr), "contact is a null pointer");
  EXPECT_REFUSED(pnd_respond(nullptr, &contact, 0, 0, &response), "law is a null pointer");
  EXPECT_REFUSED(pnd_respond(law.get(), nullptr, 0, 0, &response), "contact is a null pointer");
  EXPECT_REFUSED(pnd_respond(law.get(), &contact, 0, 0, nullptr), "response is a null pointer");
  EXPECT_REFUSED(pnd_accept(nullptr, 0, 0, &contact), "law is a null pointer");
  EXPECT_REFUSED(pnd_accept(law.get(), 0, 0, nullptr), "contact is a null pointer");
  EXPECT_REFUSED(pnd_separate(nullptr, 0, &contact), "law is a null pointer");
  EXPECT_REFUSED(pnd_separate(law.get(), 0, nullptr), "contact is a null pointer");
  EXPECT_REFUSED(pnd_collide(nullptr, 1, 1, &result), "law is a null pointer");
  EXPECT_REFUSED(pnd_collide(law.get(), 1, 1, nullptr), "result is a null pointer");
  EXPECT_REFUSED(pnd_find_law(nullptr, &index), "name is a null pointer");
  EXPECT_REFUSED(pnd_find_law("hertz", nullptr), "law is a null pointer");
  EXPECT_REFUSED(pnd_describe_law(0, nullptr), "info is a null pointer");
  EXPECT_REFUSED(pnd_describe_parameter(0, 0, nullptr), "info is a null pointer");
  EXPECT_REFUSED(pnd_describe_formula(0, 0, nullptr), "info is a null pointer");
  pnd_destroy(nullptr);
}

TEST(CInterfaceErrors, ValuesThatAreNoNumbersChangeNothing) {
  const test::LawInC law = hertz_damped();
  pnd_contact contact{};
  ASSERT_EQ(pnd_touch(law.get(), 0.5, &contact), PND_OK);
  const pnd_contact before = contact;
  pnd_response response{7, 8, 9};
  EXPECT_REFUSED(pnd_respond(law.get(), &contact, nan, 0, &response), "penetration is nan, but must be finite");
  EXPECT_REFUSED(pnd_respond(law.get(), &contact, 0, nan, &response), "rate is nan, but must be finite");
  EXPECT_EQ(response.force, 7);
  EXPECT_REFUSED(pnd_accept(law.get(), nan, 0, &contact), "penetration is nan, but must be finite");
  EXPECT_REFUSED(pnd_accept(law.get(), 0, nan, &contact), "rate is nan, but must be finite");
  EXPECT_REFUSED(pnd_separate(law.get(), nan, &contact), "penetration is nan, but must be finite");
  EXPECT_EQ(std::memcmp(&contact, &before, sizeof before), 0);
}

TEST(CInterfaceErrors, ImpactsBeginAndEndInTurn) {
  const test::LawInC law = hertz_damped();
  pnd_contact contact{};
  EXPECT_REFUSED(pnd_separate(law.get(), 0, &contact), "there is no impact to end: pnd_touch or pnd_accept begins one");
  EXPECT_REFUSED(pnd_touch(law.get(), -0.5, &contact), "closing_speed is -0.5, but must be finite and not negative");
  EXPECT_EQ(contact.touching, 0);
  ASSERT_EQ(pnd_touch(law.get(), 0.5, &contact), PND_OK);
  EXPECT_REFUSED(pnd_touch(law.get(), 0.5, &contact), "the impact before has not ended: pnd_separate ends it");
}

TEST(CInterfaceErrors, FreeImpactsNeedAMassAndASpeed) {
  const test::LawInC law = hertz_damped();
  pnd_free_impact result{};
  EXPECT_REFUSED(pnd_collide(law.get(), 0, 1, &result), "reduced_mass is 0, but must be finite and positive");
  EXPECT_REFUSED(pnd_collide(law.get(), 1, nan, &result), "closing_speed is nan, but must be finite and positive");
}

TEST(CInterfaceErrors, LongTextIsCutAndEndsWithAZero) {
  pnd_law* law = nullptr;
  std::string name;
  for (int i = 0; i < 150; ++i) name += "\U0001F3E0";  // four bytes
  EXPECT_EQ(pnd_create(name.c_str(), "", nullptr, 0, &law), PND_BAD_ARGUMENT);
  EXPECT_EQ(std::string(pnd_error_text()), "unknown law \"" + name.substr(0, (511 - 13) / 4 * 4))
      << "a letter is not cut";
}

}  // namespace errors_test
}  // namespace pounding
