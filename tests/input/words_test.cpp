// The catalogue of the input and the reader are the same: every example is read, every word is used, no other key is
// asked for.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/frames/sections.hpp>
#include <pounding/ground/synthetic.hpp>
#include <pounding/input/input.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/input/words/sections.hpp>
#include <pounding/laws/compiled.hpp>
#include "input/minimal_models.hpp"

namespace pounding {
namespace words_test {

using test::Keys;
using test::keys_around;
using test::map_of;
using test::with_keys;
using test::with_word;
using words::Need;
using words::Section;
using words::Word;

/// Models stand beside the records that the examples name.
Model read(const std::string& text) { return read_model(Input::read_text(text, testing::TempDir() + "words.yaml")); }

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Calls this for every word of every section.
void for_each_word(const std::function<void(const Section&, const Word&)>& act) {
  for (const Section* s : words::sections())
    for (const Word& word : s->words) act(*s, word);
}

class Words : public testing::Test {
 protected:
  void SetUp() override { test::write_records(testing::TempDir()); }
};

TEST_F(Words, EachExampleIsRead) {
  for_each_word([](const Section& s, const Word& word) {
    const std::string text = with_word(s, word, std::string(word.example));
    EXPECT_EQ(refusal(text), "") << text;
  });
}

// Nothing takes a list of lists of empty maps.
TEST_F(Words, EachWordIsUsed) {
  for_each_word([](const Section& s, const Word& word) {
    const std::string text = with_word(s, word, "[[[{}]]]");
    EXPECT_NE(refusal(text), "") << s.place << "." << word.key << " is taken and never read:\n" << text;
  });
}

TEST_F(Words, EachKeyThatIsReadHasAWord) {
  std::set<std::string> known{"no_such_key"};
  for_each_word([&](const Section&, const Word& word) { known.emplace(word.key); });
  for (const laws::Entry& law : laws::catalogue())
    for (const Word& word : words::parameters_of(law).words) known.emplace(word.key);
  for (const Section* s : words::sections())
    for (const std::string& key : known) {
      const Word asked{.key = key};
      const std::vector<const char*> values = s->find(key) ? std::vector{"1", "{a: 1}", "[1, 2]"} : std::vector{"1"};
      for (const char* value : values) {
        const Keys keys = keys_around(*s, s->find(key) ? *s->find(key) : asked, value);
        std::string message;
        // Another error than InputError is one of the program.
        ASSERT_NO_THROW(message = refusal(with_keys(*s, keys))) << s->place << "." << key;
        if (s->find(key) || s == &words::link || s == &words::wall) continue;
        EXPECT_TRUE(message.find("unknown key") != message.npos ||
                    message.find("unknown displacement") != message.npos ||
                    message.find("belongs to a record") != message.npos)
            << s->place << "." << key << ": " << message;
      }
    }
}

TEST_F(Words, EachParameterOfEachLawIsRead) {
  for (const laws::Entry& law : laws::catalogue()) {
    for (const Word& word : words::parameters_of(law).words) {
      Keys keys = test::keys_of_law(law, word);
      EXPECT_EQ(refusal(with_keys(words::link, keys)), "") << map_of(keys);
      keys[std::string(word.key)] = "[[[{}]]]";
      EXPECT_NE(refusal(with_keys(words::link, keys)), "") << map_of(keys);
    }
  }
}

TEST_F(Words, SayEverythingThatAPageShows) {
  std::set<std::string_view> names;
  std::vector<const Section*> all(words::sections().begin(), words::sections().end());
  for (const laws::Entry& law : laws::catalogue()) all.push_back(&words::parameters_of(law));
  for (const Section* s : all) {
    EXPECT_TRUE(names.insert(s->name).second) << s->name;
    EXPECT_FALSE(s->meaning.empty()) << s->name;
    std::set<std::string_view> keys;
    for (const Word& word : s->words) {
      SCOPED_TRACE(fmt::format("{}.{}", s->name, word.key));
      EXPECT_TRUE(keys.insert(word.key).second);
      EXPECT_FALSE(word.meaning.empty());
      EXPECT_FALSE(word.example.empty());
      EXPECT_TRUE(word.takes != words::Takes::nothing || word.inside);
      EXPECT_EQ(word.takes == words::Takes::choice, !word.choices.empty());
      EXPECT_LE(word.least, word.most == 0 ? word.least : word.most);
      EXPECT_TRUE(word.need != Need::required || word.otherwise.empty());
      const auto value = word.default_quantity();
      EXPECT_TRUE(!value || word.bounds.contain(*value));
      const bool has_default_choice = word.takes == words::Takes::choice && word.form == words::Form::one &&
                                      !word.otherwise.empty() && word.otherwise.find(' ') == word.otherwise.npos;
      EXPECT_TRUE(!has_default_choice || std::ranges::find(word.choices, word.otherwise) != word.choices.end());
    }
  }
}

TEST_F(Words, DefaultsAreThoseOfTheLibrary) {
  const auto otherwise = [](const Section& s, std::string_view key) { return s.find(key)->default_quantity().value(); };
  const SyntheticOptions synthetic;
  EXPECT_EQ(otherwise(words::analysis, "tolerance"), AnalysisSettings{}.tolerance);
  EXPECT_EQ(otherwise(words::analysis, "spectral_radius"), Scheme{}.spectral_radius);
  EXPECT_EQ(words::analysis.find("integrator")->otherwise, Scheme{}.name());
  EXPECT_EQ(otherwise(words::synthetic, "step"), synthetic.step);
  EXPECT_EQ(otherwise(words::synthetic, "rise"), synthetic.rise);
  EXPECT_EQ(otherwise(words::synthetic, "strong_until"), synthetic.strong_until);
  EXPECT_EQ(otherwise(words::pulse, "start"), Pulse{}.start);
  EXPECT_EQ(otherwise(words::structure, "delay"), StructureOptions{}.delay);
  const Material usual = isotropic(1, otherwise(words::material, "density"), otherwise(words::material, "poisson"));
  EXPECT_EQ(usual.shear, isotropic(1).shear);
  EXPECT_EQ(usual.density, isotropic(1).density);
  for (const laws::Entry& law : laws::catalogue()) {
    laws::Settings settings = laws::typical_settings(law);
    const auto described = laws::describe(laws::make_law(settings), 1);
    for (const laws::ParameterInfo& parameter : law.parameters) {
      if (parameter.need != laws::Need::optional) continue;
      settings.values.erase(std::string(parameter.name));
      const auto without = laws::describe(laws::make_law(settings), 1);
      const auto same = [&](const laws::ResolvedValue& value) { return value.name == parameter.name; };
      EXPECT_EQ(std::ranges::find_if(without, same)->value, std::ranges::find_if(described, same)->value)
          << law.name << "." << parameter.name;
    }
  }
}

}  // namespace words_test
}  // namespace pounding
