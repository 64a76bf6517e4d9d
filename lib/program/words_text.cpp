#include "words_text.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/input/words/studies.hpp>
#include <pounding/laws/compiled.hpp>

namespace pounding::program {
namespace {

std::string integer_range(const Bounds& bounds) {
  if (bounds.has_low() && bounds.has_high()) return fmt::format(" from {:g} to {:g}", bounds.low, bounds.high);
  return bounds.text();
}

std::string in_brackets(const std::string& unit) { return unit.empty() ? "" : fmt::format(" [{}]", unit); }

std::string quantity_text(const words::Word& word) {
  if (!word.noun.empty()) return std::string(word.noun);
  if (word.turning) return "a quantity";
  const std::string name = quantity_name(word.dimension);
  return name.starts_with("a quantity") ? "a quantity" : name;
}

std::string single_text(const words::Word& word) {
  using words::Takes;
  switch (word.takes) {
    case Takes::nothing: return {};
    case Takes::quantity: return quantity_text(word) + word.bounds.text() + in_brackets(word.unit_text());
    case Takes::integer: return "an integer" + integer_range(word.bounds);
    case Takes::boolean: return "true or false";
    case Takes::choice:
      return fmt::format("{}{}", word.choices.size() > 1 ? "one of " : "", fmt::join(word.choices, ", "));
    case Takes::text: return "a text";
    case Takes::value: return "a number, a quantity or a name";
  }
  return {};
}

std::string or_map(const words::Word& word) {
  const std::string single = single_text(word);
  if (!word.inside) return single;
  if (word.inside->words.empty()) return "an empty map";
  return (single.empty() ? "a map, see " : single + ", or a map, see ") + std::string(word.inside->name);
}

std::string list_of(const words::Word& word) {
  const std::string count = word.most == 0            ? ""
                            : word.least == word.most ? fmt::format(" of {}", word.least)
                                                      : fmt::format(" of {} to {}", word.least, word.most);
  return fmt::format("a list{}, each {}", count, or_map(word));
}

}  // namespace

std::vector<const words::Section*> all_sections() {
  const auto tables = words::sections();
  std::vector<const words::Section*> all(tables.begin(), tables.end());
  std::ranges::copy(words::sections_of_studies(), std::back_inserter(all));
  for (const laws::Entry& law : laws::catalogue()) all.push_back(&words::parameters_of(law));
  return all;
}

std::string taken_text(const words::Word& word) {
  using words::Form;
  const std::string instead = word.instead.empty() ? "" : fmt::format("{}, or ", fmt::join(word.instead, ", "));
  switch (word.form) {
    case Form::one: return instead + or_map(word);
    case Form::one_or_each: {
      const std::string or_inside = word.inside ? fmt::format(", or a map, see {}", word.inside->name) : "";
      return instead + single_text(word) + ", or a list of them" + or_inside;
    }
    case Form::one_or_list: return instead + or_map(word) + ", or " + list_of(word);
    case Form::list: return instead + list_of(word);
    case Form::by_storey:
      return or_map(word) +
             "; or a list of them from the ground up, or a map from storeys such as 1-3; each may be a list by line";
    case Form::named: return instead + "a map of names, each " + or_map(word);
    case Form::named_lists: return instead + "a map of names, each " + list_of(word);
  }
  return {};
}

std::vector<std::string> keys_with(words::Need need, const words::Section& section) {
  std::vector<std::string> keys;
  for (const words::Word& word : section.words)
    if (word.need == need) keys.emplace_back(word.key);
  return keys;
}

std::string necessity_text(const words::Word& word, const words::Section& section) {
  using words::Need;
  switch (word.need) {
    case Need::optional: return "optional";
    case Need::required: return "required";
    case Need::exactly_one: return fmt::format("one of {}", fmt::join(keys_with(word.need, section), ", "));
    case Need::at_least_one: return fmt::format("at least one of {}", fmt::join(keys_with(word.need, section), ", "));
  }
  return {};
}

}  // namespace pounding::program
