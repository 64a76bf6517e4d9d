/// Hysteretic laws in C: the answers of C++, closed forms, refusals, lists.

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <pounding.h>
#include <pounding/hysteresis/all.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace yielding_test {

struct Destroy {
  void operator()(pnd_yielding* law) const { pnd_destroy_yielding(law); }
};
using YieldingInC = std::unique_ptr<pnd_yielding, Destroy>;

/// Null if it is refused.
YieldingInC made_in_c(const hysteresis::Settings& s) {
  std::vector<pnd_value> values;
  std::vector<pnd_word> words;
  for (const auto& [name, value] : s.values) values.push_back({name.c_str(), value});
  for (const auto& [name, word] : s.words) words.push_back({name.c_str(), word.c_str()});
  pnd_yielding* law = nullptr;
  pnd_create_yielding(s.law.c_str(), values.data(), values.size(), words.data(), words.size(), &law);
  return YieldingInC(law);
}

/// Every law with its typical numbers, and with each of its choices.
std::vector<hysteresis::Settings> every_setting() {
  std::vector<hysteresis::Settings> all;
  for (const hysteresis::Entry& entry : hysteresis::catalogue()) {
    all.push_back(hysteresis::typical_settings(entry));
    for (const hysteresis::ChoiceInfo& choice : entry.choices)
      for (const std::string_view word : choice.words) {
        all.push_back(hysteresis::typical_settings(entry));
        all.back().words.emplace(choice.name, word);
      }
  }
  return all;
}

#define EXPECT_REFUSED(call, ...)                                 \
  do {                                                            \
    EXPECT_EQ(call, PND_BAD_ARGUMENT);                            \
    EXPECT_TRUE(test::mentions(pnd_error_text(), {__VA_ARGS__})); \
  } while (false)

TEST(YieldingInC, AnswersAsCppDoesToTheBit) {
  constexpr std::size_t points = 300;
  std::mt19937 random(7);
  for (const hysteresis::Settings& settings : every_setting()) {
    const YieldingInC law = made_in_c(settings);
    ASSERT_TRUE(law) << settings.law << ": " << pnd_error_text();
    std::visit(
        [&]<class L>(const L& chosen) {
          double stiffness = 0, yield = 0;
          EXPECT_EQ(pnd_yielding_start(law.get(), &stiffness, &yield), PND_OK);
          EXPECT_EQ(stiffness, chosen.stiffness());
          EXPECT_EQ(yield, chosen.yield_deformation());
          std::uniform_real_distribution<double> deformation(-5 * yield, 5 * yield);
          std::vector<double> path(points), force(points), tangent(points), lost(points);
          for (double& d : path) d = deformation(random);
          ASSERT_EQ(pnd_follow(law.get(), path.data(), points, force.data(), tangent.data(), lost.data()), PND_OK);
          typename L::State kept;
          double work = 0;
          for (std::size_t i = 0; i < points; ++i) {
            const hysteresis::Answer answer = chosen.respond(kept, path[i]);
            work += chosen.work(kept, path[i]);
            kept = chosen.advance(kept, path[i]);
            EXPECT_EQ(force[i], answer.force) << settings.law << " at point " << i;
            EXPECT_EQ(tangent[i], answer.slope) << settings.law << " at point " << i;
            EXPECT_EQ(lost[i], work - chosen.stored(kept)) << settings.law << " at point " << i;
          }
          EXPECT_EQ(pnd_follow(law.get(), path.data(), points, nullptr, nullptr, nullptr), PND_OK);
        },
        hysteresis::make_law(settings));
  }
}

// One full cycle of a bilinear spring dissipates 4 (1 - a) Fy (dmax - dy), and the quarter before it a quarter of that.
TEST(YieldingInC, BilinearLoopHasItsClosedForm) {
  const double k = 2e7, yield = 1.5e5, a = 0.1, dy = yield / k, far = 4 * dy;
  const YieldingInC law =
      made_in_c({.law = "bilinear", .values = {{"stiffness", k}, {"yield_force", yield}, {"hardening", a}}});
  ASSERT_TRUE(law) << pnd_error_text();
  const std::array path{far, -far, far};
  std::array<double, 3> force{}, tangent{}, lost{};
  ASSERT_EQ(pnd_follow(law.get(), path.data(), path.size(), force.data(), tangent.data(), lost.data()), PND_OK);
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_NEAR(force[i], std::copysign(yield + a * k * (far - dy), path[i]), 1e-9 * yield);
    EXPECT_NEAR(tangent[i], a * k, 1e-9 * k);
  }
  EXPECT_NEAR(lost[0], (1 - a) * yield * (far - dy), 1e-9 * yield * far);
  EXPECT_NEAR(lost[2] - lost[0], 4 * (1 - a) * yield * (far - dy), 1e-9 * yield * far);
}

TEST(YieldingInC, EveryPathBeginsUndeformed) {
  const YieldingInC law = made_in_c({.law = "bouc_wen", .values = {{"stiffness", 2e7}, {"yield_force", 1.5e5}}});
  const std::array path{0.03, -0.02};
  std::array<double, 2> once{}, again{};
  ASSERT_EQ(pnd_follow(law.get(), path.data(), 2, once.data(), nullptr, nullptr), PND_OK);
  ASSERT_EQ(pnd_follow(law.get(), path.data(), 2, again.data(), nullptr, nullptr), PND_OK);
  EXPECT_EQ(once, again);
}

TEST(YieldingInC, RefusalsSayWhatIsAllowed) {
  pnd_yielding* law = nullptr;
  const std::array steel{pnd_value{"stiffness", 2e7}, pnd_value{"yield_force", 1.5e5}};
  EXPECT_REFUSED(pnd_create_yielding("bouc_wenn", steel.data(), 2, nullptr, 0, &law), "bouc_wenn", "bouc_wen");
  EXPECT_REFUSED(pnd_create_yielding("bilinear", steel.data(), 1, nullptr, 0, &law), "yield_force");
  const std::array twice{steel[0], steel[0]};
  EXPECT_REFUSED(pnd_create_yielding("bilinear", twice.data(), 2, nullptr, 0, &law), "stiffness");
  const std::array negative{steel[0], pnd_value{"yield_force", -1}};
  EXPECT_REFUSED(pnd_create_yielding("bilinear", negative.data(), 2, nullptr, 0, &law), "yield_force", "-1");
  const pnd_word wrong{"memory", "lost"};
  EXPECT_REFUSED(pnd_create_yielding("menegotto_pinto", steel.data(), 2, &wrong, 1, &law), "lost", "last",
                 "menegotto_pinto");
  EXPECT_EQ(law, nullptr);
  EXPECT_REFUSED(pnd_create_yielding("bilinear", nullptr, 2, nullptr, 0, &law), "values");
  EXPECT_REFUSED(pnd_create_yielding(nullptr, nullptr, 0, nullptr, 0, &law), "law");
  const YieldingInC made = made_in_c({.law = "bilinear", .values = {{"stiffness", 2e7}, {"yield_force", 1.5e5}}});
  const std::array path{0.01, std::numeric_limits<double>::quiet_NaN()};
  std::array<double, 2> force{7, 7};
  EXPECT_REFUSED(pnd_follow(made.get(), path.data(), 2, force.data(), nullptr, nullptr), "[1]");
  EXPECT_EQ(force, (std::array<double, 2>{7, 7})) << "nothing is changed";
  EXPECT_REFUSED(pnd_follow(nullptr, path.data(), 1, force.data(), nullptr, nullptr), "law");
  EXPECT_EQ(pnd_follow(made.get(), nullptr, 0, nullptr, nullptr, nullptr), PND_OK);
  pnd_destroy_yielding(nullptr);
}

TEST(YieldingInC, ListsAreThoseOfTheLibrary) {
  ASSERT_EQ(pnd_yielding_count(), hysteresis::catalogue().size());
  for (std::size_t i = 0; i < pnd_yielding_count(); ++i) {
    const hysteresis::Entry& entry = hysteresis::catalogue()[i];
    pnd_yielding_info info{};
    ASSERT_EQ(pnd_describe_yielding(i, &info), PND_OK);
    EXPECT_EQ(info.name, entry.name);
    EXPECT_EQ(info.force, entry.shape);
    ASSERT_EQ(info.parameters, entry.parameters.size());
    for (std::size_t j = 0; j < info.parameters; ++j) {
      pnd_parameter_info parameter{};
      ASSERT_EQ(pnd_describe_yielding_parameter(i, j, &parameter), PND_OK);
      EXPECT_EQ(parameter.name, entry.parameters[j].name);
      EXPECT_EQ(parameter.unit, entry.parameters[j].unit);
      EXPECT_EQ(parameter.need, entry.parameters[j].need == hysteresis::Need::required ? PND_REQUIRED : PND_OPTIONAL);
    }
    ASSERT_EQ(info.choices, entry.choices.size());
    for (std::size_t j = 0; j < info.choices; ++j)
      for (std::size_t word = 0; word < entry.choices[j].words.size(); ++word) {
        pnd_choice_info choice{};
        ASSERT_EQ(pnd_describe_yielding_choice(i, j, word, &choice), PND_OK);
        EXPECT_EQ(choice.name, entry.choices[j].name);
        EXPECT_EQ(choice.word, entry.choices[j].words[word]);
        EXPECT_EQ(choice.words, entry.choices[j].words.size());
      }
  }
  pnd_yielding_info info{};
  const std::string count = std::to_string(pnd_yielding_count());
  EXPECT_REFUSED(pnd_describe_yielding(99, &info), "99", count.c_str());
  pnd_parameter_info parameter{};
  EXPECT_REFUSED(pnd_describe_yielding_parameter(0, 99, &parameter), "99", "4");
}

}  // namespace yielding_test
}  // namespace pounding
