// The tables of keys agree with the reader: every example can be read, every key is used, and no other key is read.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
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
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/read_model.hpp>
#include <pounding/laws/compiled.hpp>
#include "input/minimal_models.hpp"

namespace pounding {
namespace keys_test {

using keys::Key;
using keys::Need;
using keys::Section;
using test::Keys;
using test::keys_around;
using test::map_of;
using test::with_key;
using test::with_keys;

/// Models are in the folder of the records that the examples refer to.
/// Each test has its own folder: tests of this file run at the same time.
std::string folder() {
  return testing::TempDir() + "keys_" + testing::UnitTest::GetInstance()->current_test_info()->name() + "/";
}

Model read(const std::string& text) { return read_model(Input::read_text(text, folder() + "model.yaml")); }

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Calls a function for every key of every section.
void for_each_key(const std::function<void(const Section&, const Key&)>& act) {
  for (const Section* s : keys::sections())
    for (const Key& spec : s->keys) act(*s, spec);
}

class Words : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder());
    test::write_records(folder());
  }
};

TEST_F(Words, EachExampleIsRead) {
  for_each_key([](const Section& s, const Key& spec) {
    const std::string text = with_key(s, spec, std::string(spec.example));
    EXPECT_EQ(refusal(text), "") << text;
  });
}

// No key takes a list of lists of empty maps.
TEST_F(Words, EachKeyIsUsed) {
  for_each_key([](const Section& s, const Key& spec) {
    const std::string text = with_key(s, spec, "[[[{}]]]");
    EXPECT_NE(refusal(text), "") << s.place << "." << spec.key << " is accepted and never read:\n" << text;
  });
}

TEST_F(Words, EachKeyThatIsReadIsInATable) {
  std::set<std::string> known{"no_such_key"};
  for_each_key([&](const Section&, const Key& spec) { known.emplace(spec.key); });
  for (const laws::Entry& law : laws::catalogue())
    for (const Key& spec : keys::parameters_of(law).keys) known.emplace(spec.key);
  for (const Section* s : keys::sections())
    for (const std::string& key : known) {
      const Key requested(key, keys::text());
      const std::vector<const char*> values = s->find(key) ? std::vector{"1", "{a: 1}", "[1, 2]"} : std::vector{"1"};
      for (const char* value : values) {
        const Keys keys = keys_around(*s, s->find(key) ? *s->find(key) : requested, value);
        std::string message;
        // Any error other than InputError is a programming error.
        ASSERT_NO_THROW(message = refusal(with_keys(*s, keys))) << s->place << "." << key;
        if (s->find(key) || s == &keys::link || s == &keys::wall) continue;
        EXPECT_TRUE(message.find("unknown key") != message.npos ||
                    message.find("unknown displacement") != message.npos ||
                    message.find("belongs to a record") != message.npos)
            << s->place << "." << key << ": " << message;
      }
    }
}

TEST_F(Words, EachParameterOfEachLawIsRead) {
  for (const laws::Entry& law : laws::catalogue()) {
    for (const Key& spec : keys::parameters_of(law).keys) {
      Keys keys = test::keys_of_law(law, spec);
      EXPECT_EQ(refusal(with_keys(keys::link, keys)), "") << map_of(keys);
      keys[std::string(spec.key)] = "[[[{}]]]";
      EXPECT_NE(refusal(with_keys(keys::link, keys)), "") << map_of(keys);
    }
  }
}

TEST_F(Words, AreCompletelyDescribed) {
  std::set<std::string_view> names;
  std::vector<const Section*> all(keys::sections().begin(), keys::sections().end());
  for (const laws::Entry& law : laws::catalogue()) all.push_back(&keys::parameters_of(law));
  for (const Section* s : all) {
    EXPECT_TRUE(names.insert(s->name).second) << s->name;
    EXPECT_FALSE(s->meaning.empty()) << s->name;
    std::set<std::string_view> keys;
    for (const Key& spec : s->keys) {
      SCOPED_TRACE(fmt::format("{}.{}", s->name, spec.key));
      EXPECT_TRUE(keys.insert(spec.key).second);
      EXPECT_FALSE(spec.meaning.empty());
      EXPECT_FALSE(spec.example.empty());
      EXPECT_TRUE(spec.takes != keys::Takes::nothing || spec.inside);
      EXPECT_EQ(spec.takes == keys::Takes::choice, !spec.choices.empty());
      EXPECT_LE(spec.minimum, spec.maximum == 0 ? spec.minimum : spec.maximum);
      EXPECT_TRUE(spec.need != Need::required || spec.otherwise.empty());
      const auto value = spec.default_quantity();
      EXPECT_TRUE(!value || spec.bounds.contain(*value));
      const bool has_default_choice = spec.takes == keys::Takes::choice && spec.form == keys::Form::one &&
                                      !spec.otherwise.empty() && spec.otherwise.find(' ') == spec.otherwise.npos;
      EXPECT_TRUE(!has_default_choice || std::ranges::find(spec.choices, spec.otherwise) != spec.choices.end());
    }
  }
}

TEST_F(Words, DefaultsAreThoseOfTheLibrary) {
  const auto otherwise = [](const Section& s, std::string_view key) { return s.find(key)->default_quantity().value(); };
  const SyntheticOptions synthetic;
  EXPECT_EQ(otherwise(keys::analysis, "tolerance"), AnalysisSettings{}.tolerance);
  EXPECT_EQ(otherwise(keys::analysis, "spectral_radius"), Scheme{}.spectral_radius);
  EXPECT_EQ(keys::analysis.find("integrator")->otherwise, Scheme{}.name());
  EXPECT_EQ(otherwise(keys::synthetic, "step"), synthetic.step);
  EXPECT_EQ(otherwise(keys::synthetic, "rise"), synthetic.rise);
  EXPECT_EQ(otherwise(keys::synthetic, "strong_until"), synthetic.strong_until);
  EXPECT_EQ(otherwise(keys::pulse, "start"), Pulse{}.start);
  EXPECT_EQ(otherwise(keys::structure, "delay"), StructureOptions{}.delay);
  const Material usual = isotropic(1, otherwise(keys::material, "density"), otherwise(keys::material, "poisson"));
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

}  // namespace keys_test
}  // namespace pounding
