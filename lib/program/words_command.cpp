#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/base/nearest_name.hpp>
#include <pounding/core/error.hpp>
#include <pounding/input/keys/studies.hpp>
#include <pounding/laws/compiled.hpp>
#include "commands.hpp"
#include "words.hpp"

namespace pounding::program {
namespace {

/// A key and the section that contains it.
struct FoundKey {
  const keys::Section* section;
  const keys::Key* spec;
};

std::string place_of(const FoundKey& found) {
  const std::string_view place = found.section->place;
  return place.empty() ? std::string(found.spec->key) : fmt::format("{}.{}", place, found.spec->key);
}

std::vector<FoundKey> keys_named(std::string_view key) {
  std::vector<FoundKey> found;
  for (const keys::Section* section : all_sections())
    if (const keys::Key* spec = section->find(key)) found.push_back({section, spec});
  return found;
}

std::vector<const keys::Section*> sections_named(std::string_view name) {
  std::vector<const keys::Section*> found;
  for (const keys::Section* section : all_sections())
    if (section->name == name) found.push_back(section);
  return found;
}

/// Similar names in descending order of similarity.
std::vector<std::string_view> resembling(std::string_view name) {
  std::set<std::string_view> known;
  for (const keys::Section* section : all_sections()) {
    known.insert(section->name);
    for (const keys::Key& spec : section->keys) known.insert(spec.key);
  }
  const std::vector<std::string_view> all(known.begin(), known.end());
  std::vector<std::string_view> near;
  if (const std::string_view nearest = nearest_name(name, all); !nearest.empty()) near.push_back(nearest);
  for (const std::string_view each : all) {
    const bool holds =
        name.size() > 2 && (each.find(name) != each.npos || (each.size() > 2 && name.find(each) != name.npos));
    if (holds && std::ranges::find(near, each) == near.end()) near.push_back(each);
  }
  std::stable_partition(near.begin(), near.end(), [&](std::string_view each) { return each.starts_with(name); });
  return near;
}

[[noreturn]] void refuse(std::string_view name) {
  const std::vector<std::string_view> near = resembling(name);
  const std::string hint = near.empty() ? "" : fmt::format(" Did you mean {}?", fmt::join(near, ", "));
  throw InputError(fmt::format("unknown key \"{}\" of the input.{} Type pounding words for a list of all keys.",
                               excerpt(name), hint));
}

void print_key(const FoundKey& found) {
  const keys::Key& spec = *found.spec;
  fmt::print("{}\n  {}\n", place_of(found), spec.meaning);
  const auto line = [](std::string_view name, std::string_view text) { fmt::print("  {:<10}{}\n", name, text); };
  line("takes", taken_text(spec));
  line("needed", necessity_text(spec, *found.section));
  if (!spec.otherwise.empty()) line("default", spec.otherwise);
  line("since", spec.since);
  line("example", fmt::format("{}: {}", spec.key, spec.example));
}

void print_line(const keys::Key& spec, std::size_t depth) {
  constexpr std::size_t width = 28;
  const std::string mark = spec.need == keys::Need::required ? " *" : spec.need == keys::Need::optional ? "" : " (*)";
  const std::string name = fmt::format("{}{}{}", std::string(2 * depth, ' '), spec.key, mark);
  const std::size_t choices = spec.choices.size();
  const bool is_long = choices > 8;
  fmt::print("{:<{}} {}\n", name, width,
             is_long ? fmt::format("one of {}, see pounding words {}", choices, spec.key) : taken_text(spec));
}

void print_section(const keys::Section& section) {
  fmt::print("{}\n  {}\n", section.place.empty() ? "the whole file" : section.place, section.meaning);
  for (const keys::Key& spec : section.keys) print_line(spec, 1);
}

// Sections that occur in several places are shown at the first one.
void print_tree(const keys::Section& section, std::size_t depth, std::set<const keys::Section*>& shown) {
  for (const keys::Key& spec : section.keys) {
    print_line(spec, depth);
    if (spec.inside && shown.insert(spec.inside).second) print_tree(*spec.inside, depth + 1, shown);
  }
}

void print_everything() {
  std::set<const keys::Section*> shown;
  print_tree(keys::model, 0, shown);
  fmt::print("\nParameters of the laws, in addition to law in links:\n");
  for (const laws::Entry& law : laws::catalogue()) {
    std::vector<std::string_view> names;
    for (const keys::Key& spec : keys::parameters_of(law).keys) names.push_back(spec.key);
    fmt::print("  {:<30}{}\n", law.name, fmt::join(names, ", "));
  }
  for (const keys::Section* section : keys::sections())
    if (section != &keys::model && shown.insert(section).second) {
      fmt::print("\n");
      print_section(*section);
    }
  fmt::print("\nA study:\n");
  print_tree(keys::study_file, 0, shown);
  fmt::print("\nA suite of records:\n");
  print_tree(keys::suite_file, 0, shown);
  fmt::print("\n* required, (*) one of several. pounding words NAME shows one key, a section or a law.\n");
}

void print_named(std::string_view name) {
  const std::vector<FoundKey> found = keys_named(name);
  const std::vector<const keys::Section*> sections = sections_named(name);
  if (found.empty() && sections.empty()) refuse(name);
  const char* between = "";
  for (const FoundKey& each : found) {
    fmt::print("{}", between);
    print_key(each);
    between = "\n";
  }
  for (const keys::Section* section : sections) {
    fmt::print("{}", between);
    print_section(*section);
    between = "\n";
  }
}

nlohmann::ordered_json json_of(std::string_view name) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const keys::Section* section : all_sections())
    if (name.empty() || section->name == name) {
      json.push_back(section_json(*section));
    } else if (const keys::Key* spec = section->find(name)) {
      json.push_back(section_json({section->name, section->place, section->meaning, {spec, 1}}));
    }
  if (json.empty()) refuse(name);
  return json;
}

}  // namespace

void add_arguments(CLI::App& app) {
  struct Arguments {
    std::string name;
    bool json = false, schema = false;
  };
  const auto given = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("words", "Keys of the input: type, unit, range, default and an example of each");
  command->add_option("NAME", given->name, "A key, a section or a law");
  CLI::Option* json = command->add_flag("--json", given->json, "Print JSON");
  command->add_flag("--schema", given->schema, "Print the JSON schema that lets editors complete and check a model")
      ->excludes(json);
  command->callback([given] {
    if (given->schema && !given->name.empty())
      throw InputError("--schema applies to the whole input; type pounding words --schema");
    if (given->schema) return fmt::print("{}\n", input_schema().dump(2));
    if (given->json) return fmt::print("{}\n", json_of(given->name).dump(2));
    if (given->name.empty()) return print_everything();
    print_named(given->name);
  });
}

}  // namespace pounding::program
