/// Refusals of the C interface: their texts, and no side effects.

#include <cstring>
#include <limits>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "made.hpp"
#include "support/messages.hpp"

namespace pounding {
namespace errors_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

test::LawInC hertz_damped() {
  return test::made_in_c(
      {.law = "hertz_damped", .formula = {}, .restitution = 0.65, .values = {{"stiffness", 2.75e9}}});
}

#define EXPECT_REFUSED(call, ...)                                 \
  do {                                                            \
    EXPECT_EQ(call, PND_BAD_ARGUMENT);                            \
    EXPECT_TRUE(test::mentions(pnd_error_text(), {__VA_ARGS__})); \
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
  EXPECT_REFUSED(pnd_create("hertz_damp", "", stiff, 2, &law), "hertz_damp", "hertz_damped");
  EXPECT_EQ(law, nullptr);
  EXPECT_REFUSED(pnd_create("HERTZ", "", stiff, 1, &law), "HERTZ", "hertz");
  EXPECT_REFUSED(pnd_create("hertz_damped", "ye2009", stiff, 2, &law), "ye2009", "ye_2009", "hertz_damped");
  EXPECT_REFUSED(pnd_create("hertz_damped", "", soft, 2, &law), "-1", "stiffness");
  EXPECT_REFUSED(pnd_create("hertz_damped", nullptr, stiff, 1, &law), "hertz_damped", "damping_factor",
                 "damping_coefficient");
  EXPECT_REFUSED(pnd_create("hertz", "", twice, 2, &law), "stiffness");
  EXPECT_REFUSED(pnd_create("hertz", "", nameless, 1, &law), "name");
  EXPECT_REFUSED(pnd_create("hertz", "", nullptr, 0, &law), "hertz");
}

TEST(CInterfaceErrors, AMassThatIsNoMassIsRefused) {
  pnd_law* law = nullptr;
  for (const char* name : {"kelvin_voigt", "kelvin_voigt_no_tension", "komodromos", "modified_linear_viscoelastic"})
    for (const double mass : {-1.0, nan, std::numeric_limits<double>::infinity()}) {
      const pnd_value values[] = {{"stiffness", 1e8}, {"damping_coefficient", 2e5}, {"reduced_mass", mass}};
      EXPECT_EQ(pnd_create(name, "", values, 3, &law), PND_BAD_ARGUMENT) << name << ' ' << mass;
      EXPECT_TRUE(test::mentions(pnd_error_text(), {"reduced_mass"}));
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
  EXPECT_TRUE(test::mentions(pnd_error_text(), {R"("her\x1b[31m\ntz")"}));
  const pnd_value twice[] = {{letters.c_str(), 1}, {letters.c_str(), 2}};
  EXPECT_REFUSED(pnd_create("hertz", "", twice, 2, &law), letters.substr(0, 400) + "...");
}

TEST(CInterfaceErrors, NullPointersAreErrors) {
  const test::LawInC law = hertz_damped();
  pnd_contact contact{};
  pnd_response response{};
  pnd_free_impact result{};
  size_t index = 0;
  pnd_law* made = nullptr;
  EXPECT_REFUSED(pnd_create(nullptr, "", nullptr, 0, &made), "law");
  EXPECT_REFUSED(pnd_create("hertz", "", nullptr, 1, &made), "values");
  EXPECT_REFUSED(pnd_create("hertz", "", nullptr, 0, nullptr), "made");
  EXPECT_REFUSED(pnd_touch(nullptr, 1, &contact), "law");
  EXPECT_REFUSED(pnd_touch(law.get(), 1, nullptr), "contact");
  EXPECT_REFUSED(pnd_respond(nullptr, &contact, 0, 0, &response), "law");
  EXPECT_REFUSED(pnd_respond(law.get(), nullptr, 0, 0, &response), "contact");
  EXPECT_REFUSED(pnd_respond(law.get(), &contact, 0, 0, nullptr), "response");
  EXPECT_REFUSED(pnd_accept(nullptr, 0, 0, &contact), "law");
  EXPECT_REFUSED(pnd_accept(law.get(), 0, 0, nullptr), "contact");
  EXPECT_REFUSED(pnd_separate(nullptr, 0, &contact), "law");
  EXPECT_REFUSED(pnd_separate(law.get(), 0, nullptr), "contact");
  EXPECT_REFUSED(pnd_collide(nullptr, 1, 1, &result), "law");
  EXPECT_REFUSED(pnd_collide(law.get(), 1, 1, nullptr), "result");
  EXPECT_REFUSED(pnd_find_law(nullptr, &index), "name");
  EXPECT_REFUSED(pnd_find_law("hertz", nullptr), "law");
  EXPECT_REFUSED(pnd_describe_law(0, nullptr), "info");
  EXPECT_REFUSED(pnd_describe_parameter(0, 0, nullptr), "info");
  EXPECT_REFUSED(pnd_describe_formula(0, 0, nullptr), "info");
  pnd_destroy(nullptr);
}

TEST(CInterfaceErrors, ValuesThatAreNoNumbersChangeNothing) {
  const test::LawInC law = hertz_damped();
  pnd_contact contact{};
  ASSERT_EQ(pnd_touch(law.get(), 0.5, &contact), PND_OK);
  const pnd_contact before = contact;
  pnd_response response{7, 8, 9};
  EXPECT_REFUSED(pnd_respond(law.get(), &contact, nan, 0, &response), "penetration");
  EXPECT_REFUSED(pnd_respond(law.get(), &contact, 0, nan, &response), "rate");
  EXPECT_EQ(response.force, 7);
  EXPECT_REFUSED(pnd_accept(law.get(), nan, 0, &contact), "penetration");
  EXPECT_REFUSED(pnd_accept(law.get(), 0, nan, &contact), "rate");
  EXPECT_REFUSED(pnd_separate(law.get(), nan, &contact), "penetration");
  EXPECT_EQ(std::memcmp(&contact, &before, sizeof before), 0);
}

TEST(CInterfaceErrors, ImpactsBeginAndEndInTurn) {
  const test::LawInC law = hertz_damped();
  pnd_contact contact{};
  EXPECT_REFUSED(pnd_separate(law.get(), 0, &contact), "pnd_touch", "pnd_accept");
  EXPECT_REFUSED(pnd_touch(law.get(), -0.5, &contact), "closing_speed", "-0.5");
  EXPECT_EQ(contact.touching, 0);
  ASSERT_EQ(pnd_touch(law.get(), 0.5, &contact), PND_OK);
  EXPECT_REFUSED(pnd_touch(law.get(), 0.5, &contact), "pnd_separate");
}

TEST(CInterfaceErrors, FreeImpactsNeedAMassAndASpeed) {
  const test::LawInC law = hertz_damped();
  pnd_free_impact result{};
  EXPECT_REFUSED(pnd_collide(law.get(), 0, 1, &result), "reduced_mass", "0");
  EXPECT_REFUSED(pnd_collide(law.get(), 1, nan, &result), "closing_speed");
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
