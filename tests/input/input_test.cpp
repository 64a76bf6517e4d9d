#include <pounding/input/input.hpp>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include <pounding/core/error.hpp>
#include <pounding/input/keys/key.hpp>
#include "support/messages.hpp"

namespace pounding {
namespace input_test {

std::string error_of(const std::function<void()>& action) {
  return test::refusal<InputError>([&] { action(); });
}

// Keys of these tests.
constexpr std::string_view laws[] = {"hertz", "hertz_damped"};
constexpr keys::Key quantity(std::string_view key, const Dimension& dimension, const Bounds& allowed = bounds::any) {
  return {key, keys::quantity(dimension, allowed)};
}
constexpr keys::Key integer(std::string_view key, const Bounds& allowed = bounds::any) {
  return {key, keys::integer(allowed)};
}
constexpr keys::Key quantities[] = {quantity("gap", dimension::length),
                                    quantity("ratio", dimension::none),
                                    quantity("stiffness", dimension::stiffness),
                                    quantity("hertz", dimension::hertz_stiffness),
                                    quantity("period", dimension::time),
                                    quantity("v", dimension::velocity),
                                    {"mass", keys::quantity(dimension::mass), keys::optional, "", "100 t"},
                                    {"start", keys::quantity(dimension::time), keys::otherwise("7 ms")},
                                    {"end", keys::quantity(dimension::time), keys::otherwise("never")}};
const keys::Section test_section{"test", "", "", quantities};

Input model(const std::string& text) { return Input::read_text(text, "model.yaml"); }
// Reads a text with the keys of this table.
Input model(const std::string& text, std::span<const keys::Key> table) {
  static std::vector<std::unique_ptr<keys::Section>> sections;
  sections.push_back(std::make_unique<keys::Section>(keys::Section{"test", "", "", table}));
  return model(text).in(*sections.back());
}

std::string error_in(const std::string& text) {
  return error_of([&] { model(text); });
}

TEST(Input, RecursiveAliasIsRejected) {
  EXPECT_THROW(Input::read_text("structures: &x\n  a: *x\n", "m.yaml"), InputError);
}

TEST(Input, MissingFileIsNamed) {
  EXPECT_TRUE(test::mentions(error_of([] { Input::read_file("no/such.yaml"); }), {"no/such.yaml"}));
}

TEST(Input, FolderIsNotAFile) {
  const std::string folder = std::filesystem::temp_directory_path().string();
  EXPECT_TRUE(test::mentions(error_of([&] { Input::read_file(folder); }), {folder, "YAML"}));
}

TEST(Input, FileKeepsItsTextNameAndFolder) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "input_test_model.yaml";
  const std::string text = "# two towers\ntitle: Towers  # kept\n";
  std::ofstream(file, std::ios::binary) << text;
  const Input input = Input::read_file(file.string());
  EXPECT_EQ(input.text(), text);
  EXPECT_EQ(input.at("title").text(), text);
  EXPECT_EQ(input.file(), file.string());
  EXPECT_EQ(input.directory(), file.parent_path());
  std::filesystem::remove(file);
}

TEST(Input, ResultsAreNotAModel) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / fmt::format("{}_results.h5", getpid());
  std::ofstream(file) << "results";
  try {
    Input::read_file(file.string());
    ADD_FAILURE() << "a results file was read as a model";
  } catch (const InputError& error) {
    EXPECT_TRUE(test::mentions(error.what(), {"--resume"}));
  }
  std::filesystem::remove(file);
}

TEST(Input, BadYamlIsReportedWithLineAndColumn) {
  EXPECT_TRUE(test::mentions(error_in("title: a\nlinks: [1, 2\n"), {"model.yaml:3:1", "[", "]", "YAML"}));
  EXPECT_TRUE(test::mentions(error_in("a: {b: 1\nc: 2\n"), {"model.yaml:2:2", "{", "}", "YAML"}));
  EXPECT_TRUE(test::mentions(error_in("title: Case 2: soft soil\n"), {"model.yaml:1:14", "Case 2: soft soil", "YAML"}));
  EXPECT_TRUE(test::mentions(error_in("a: 1\n\tb: 2\n").substr(0, 31), {"model.yaml:2:1"}));
}

TEST(Input, EmptyFileAndSecondDocumentAreRefused) {
  EXPECT_TRUE(test::mentions(error_in(""), {"model.yaml:1:1"}));
  EXPECT_TRUE(test::mentions(error_in("# nothing\n"), {"model.yaml:1:1"}));
  EXPECT_TRUE(test::mentions(error_in("a: 1\n---\nb: 2\n"), {"model.yaml:2:1", "YAML"}));
}

TEST(Input, DuplicateKeyIsReportedAtTheSecondLocation) {
  EXPECT_TRUE(test::mentions(error_in("links:\n  - gap: 1\n    law: hertz\n    gap: 2\n"),
                             {"model.yaml:4:5", "links[0]", "gap"}));
  EXPECT_TRUE(test::mentions(error_in("a: {b: 1, b: 1}"), {"model.yaml:1:11", "a", "b"}));
}

TEST(Input, UnknownKeyIsReportedWithTheNearestKnown) {
  const Input link = model("links:\n  - law: hertz\n    gpa: 2\n").at("links").items().at(0);
  EXPECT_TRUE(
      test::mentions(error_of([&] { link.only_keys({"gap", "law"}); }), {"model.yaml:3:5", "links[0]", "gpa", "gap"}));
  EXPECT_TRUE(test::mentions(error_of([&] { link.only_keys({"law", "stiffness"}); }),
                             {"model.yaml:3:5", "links[0]", "gpa", "law", "stiffness"}));
  EXPECT_NO_THROW(link.only_keys({"gpa", "law", "name"}));
}

TEST(Input, MissingKeySaysWhatToType) {
  const Input input = model("left:\n  period: 1 s\n");
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("left").in(test_section).quantity("mass"); }),
                             {"model.yaml:2:3", "left", "mass: 100 t"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("right"); }), {"model.yaml:1:1", "right"}));
  EXPECT_FALSE(input.has("right"));
  EXPECT_TRUE(input.has("left"));
}

TEST(Input, QuantitiesAreConverted) {
  const Input input = model("{gap: 20 mm, ratio: 5 %, hertz: 2.75e9, period: '0.8 s'}").in(test_section);
  EXPECT_DOUBLE_EQ(input.quantity("gap"), 0.02);
  EXPECT_DOUBLE_EQ(input.at("ratio").as_quantity(), 0.05);
  EXPECT_DOUBLE_EQ(input.quantity("hertz"), 2.75e9);
  EXPECT_DOUBLE_EQ(input.quantity("period"), 0.8);
}

TEST(Input, AbsentQuantityHasTheDefaultOfItsKey) {
  const Input input = model("gap: 20 mm").in(test_section);
  EXPECT_DOUBLE_EQ(input.quantity("start"), 0.007);
  EXPECT_DOUBLE_EQ(*input.find_quantity("gap"), 0.02);
  EXPECT_EQ(input.find_quantity("start"), std::nullopt);
  EXPECT_TRUE(test::mentions(error_of([&] { input.quantity("end"); }), {"model.yaml:1:1", "end"}));
}

TEST(Input, OnlyKeysOfTheSectionAreRead) {
  const Input input = model("{gap: 20 mm, gpa: 3}").in(test_section);
  EXPECT_THROW(input.find("gpa"), std::logic_error);
  EXPECT_THROW(input.has("gpa"), std::logic_error);
  EXPECT_THROW(input.at("gpa"), std::logic_error);
  EXPECT_TRUE(input.knows("gap"));
  EXPECT_FALSE(input.knows("gpa"));
  EXPECT_THROW(model("gap: 20 mm").at("gap").as_quantity(), std::logic_error);
  EXPECT_THROW(model("gap: 20 mm").only_keys(), std::logic_error);
  EXPECT_TRUE(test::mentions(error_of([&] { input.only_keys(); }), {"model.yaml:1:14", "gpa", "gap"}));
}

TEST(Input, ListsAndNamesKeepTheirKey) {
  constexpr keys::Key table[] = {{"pair", keys::quantity(dimension::length).list()},
                                 {"masses", keys::quantity(dimension::mass).or_map(test_section).named()}};
  const Input input = model("{pair: [1 mm, 2 mm], masses: {gap: 3 t, b: {mass: 4 t}}}", table);
  EXPECT_DOUBLE_EQ(input.at("pair").items()[1].as_quantity(), 0.002);
  const auto masses = input.at("masses").entries();
  EXPECT_DOUBLE_EQ(masses[0].second.as_quantity(), 3000) << "a user-defined name is not a key, even if it equals one";
  EXPECT_DOUBLE_EQ(masses[1].second.quantity("mass"), 4000);
}

TEST(Input, WrongQuantityNamesLocationKeyValueAndExample) {
  const Input link = model("links:\n  - {law: hertz, gap: 20 kN, mass: [1], stiffness: , v: nan}\n")
                         .at("links")
                         .items()[0]
                         .in(test_section);
  EXPECT_TRUE(
      test::mentions(error_of([&] { link.quantity("gap"); }), {"model.yaml:2:23", "links[0].gap", "20 mm", "20 kN"}));
  EXPECT_TRUE(test::mentions(error_of([&] { link.quantity("mass"); }), {"model.yaml:2:36", "links[0].mass", "100 t"}));
  EXPECT_TRUE(test::mentions(error_of([&] { link.quantity("stiffness"); }),
                             {"model.yaml:2:41", "links[0].stiffness", "93500 kN/m"}));
  EXPECT_TRUE(
      test::mentions(error_of([&] { link.quantity("v"); }), {"model.yaml:2:57", "links[0].v", "0.3 m/s", "nan"}));
}

TEST(Input, ValueOutsideItsBoundsIsRefused) {
  const std::string text = "gap: -5 mm\nzero: 0\none: 1\n";
  const auto read = [&](const std::string& key, const Dimension& dimension, const Bounds& allowed) {
    return model(text).at(key).as_quantity(dimension, allowed);
  };
  const auto error = [&](const std::string& key, const Dimension& dimension, const Bounds& allowed) {
    return error_of([&] { read(key, dimension, allowed); });
  };
  EXPECT_TRUE(test::mentions(error("gap", dimension::length, bounds::non_negative),
                             {"model.yaml:1:6", "gap", "20 mm", "-5 mm"}));
  EXPECT_TRUE(
      test::mentions(error("zero", dimension::mass, bounds::positive), {"model.yaml:2:7", "zero", "100 t", "0"}));
  EXPECT_TRUE(
      test::mentions(error("zero", dimension::none, bounds::above_0_to_1), {"model.yaml:2:7", "zero", "5 %", "0"}));
  EXPECT_TRUE(test::mentions(error("one", dimension::none, bounds::from_0_below_1),
                             {"model.yaml:3:6", "one", "5 %", "[0, 1)"}));
  EXPECT_TRUE(
      test::mentions(error("one", dimension::none, {.high = 0.5}), {"model.yaml:3:6", "one", "5 %", "1", "0.5"}));
  EXPECT_EQ(read("one", dimension::none, bounds::above_0_to_1), 1);
  EXPECT_EQ(read("zero", dimension::none, bounds::from_0_below_1), 0);
  EXPECT_EQ(read("zero", dimension::none, bounds::non_negative), 0);
  constexpr keys::Key table[] = {quantity("zero", dimension::mass, bounds::positive)};
  EXPECT_TRUE(test::mentions(error_of([&] { model("zero: 0", table).quantity("zero"); }),
                             {"model.yaml:1:7", "zero", "100 t", "0"}));
}

TEST(Input, OneValueOrAListFromTheGroundUp) {
  constexpr keys::Key table[] = {quantity("one", dimension::mass), quantity("three", dimension::mass, bounds::positive),
                                 quantity("bad", dimension::mass)};
  const Input input = model("one: 250 t\nthree: [1 t, 2 t, 3]\nbad: [1 t, 2 mm, 3 t]\n", table);
  EXPECT_EQ(input.at("one").as_quantities(3), (std::vector<double>{250e3, 250e3, 250e3}));
  EXPECT_EQ(input.at("three").as_quantities(3), (std::vector<double>{1e3, 2e3, 3}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("three").as_quantities(4); }),
                             {"model.yaml:2:8", "three", "100 t", "4", "3"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("one").as_quantities(3, {.high = 1e3}); }),
                             {"model.yaml:1:6", "one", "100 t", "250 t", "1000"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("bad").as_quantities(3); }),
                             {"model.yaml:3:12", "bad[1]", "100 t", "2 mm"}));
}

TEST(Input, IntegersAreWholeAndInRange) {
  constexpr keys::Key table[] = {
      integer("n"), integer("real", {.low = 1}), integer("text"), integer("low"), integer("list"), integer("none")};
  const Input input = model("{n: 8, real: 8.0, text: eight, low: -1, list: [1], none: }", table);
  EXPECT_EQ(input.at("n").as_integer(), 8);
  EXPECT_EQ(input.at("low").as_integer(), -1);
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("real").as_integer(); }), {"model.yaml:1:14", "real", "8.0"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("text").as_integer(); }), {"model.yaml:1:25", "text", "eight"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("low").as_integer({.low = 0, .high = 9}); }),
                             {"model.yaml:1:37", "low", "-1", "9"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("n").as_integer({.low = -9, .high = 7}); }),
                             {"model.yaml:1:5", "n", "8", "-9", "7"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("list").as_integer(); }), {"model.yaml:1:47", "list"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("none").as_integer(); }), {"model.yaml:1:52", "none"}));
}

TEST(Input, BooleansAreTrueOrFalse) {
  const Input input = model("{a: true, b: false, c: yes}");
  EXPECT_TRUE(input.at("a").as_bool());
  EXPECT_FALSE(input.at("b").as_bool());
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("c").as_bool(); }), {"model.yaml:1:24", "c", "yes"}));
}

TEST(Input, ChoiceOffersTheNearestName) {
  constexpr keys::Key table[] = {{"law", keys::choice(laws, "contact law")}, {"other", keys::choice(laws)}};
  const Input input = model("law: hertz_damp\nother: hertz_damp\n", table);
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("law").as_choice(); }),
                             {"model.yaml:1:6", "law", "hertz_damp", "hertz_damped"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("other").as_choice(); }),
                             {"model.yaml:2:8", "other", "hertz_damp", "hertz_damped"}));
  constexpr std::string_view requested[] = {"hertz_damp"};
  EXPECT_EQ(input.at("law").as_choice("law", requested), "hertz_damp");
}

TEST(Input, WrongKindOfNodeIsRefused) {
  const Input input = model("a: 1\nb: [1]\nc: {d: 1}\ne:\n");
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("a").items(); }), {"model.yaml:1:4", "a", "[a, b]"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("a").find("x"); }), {"model.yaml:1:4", "a", "{key: value}"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("b").entries(); }), {"model.yaml:2:4", "b", "{key: value}"}));
  EXPECT_TRUE(
      test::mentions(error_of([&] { input.at("e").only_keys({"x"}); }), {"model.yaml:4:1", "e", "{key: value}"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("c").as_text(); }), {"model.yaml:3:4", "c"}));
  EXPECT_TRUE(test::mentions(error_of([&] { input.at("e").as_text(); }), {"model.yaml:4:1", "e"}));
}

TEST(Input, EntriesKeepTheOrderOfTheFile) {
  constexpr keys::Key table[] = {integer("m")};
  const auto entries = model("z: 1\na: 2\nm: 3\n", table).entries();
  ASSERT_EQ(entries.size(), 3u);
  EXPECT_EQ(entries[0].first, "z");
  EXPECT_EQ(entries[1].first, "a");
  EXPECT_EQ(entries[2].second.as_integer(), 3);
  EXPECT_EQ(entries[2].second.key(), "m");
}

TEST(Input, KeyErrorIsReportedAtTheKey) {
  const Input input = model("ground_motion:\n  scale: 2\n");
  const Input scale = input.at("ground_motion").at("scale");
  EXPECT_EQ(error_of([&] { scale.fail_at_key("no"); }), "model.yaml:2:3: ground_motion.scale: no");
  EXPECT_EQ(error_of([&] { scale.fail("no"); }), "model.yaml:2:10: ground_motion.scale: no");
}

TEST(Input, KeyMustBeAName) { EXPECT_TRUE(test::mentions(error_in("? [a, b]\n: 1\n"), {"model.yaml:1:3"})); }

}  // namespace input_test
}  // namespace pounding
