#include "words.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/input/keys/studies.hpp>
#include <pounding/laws/compiled.hpp>

namespace pounding::program {
namespace {

std::string integer_range(const Bounds& bounds) {
  if (bounds.has_low() && bounds.has_high()) return fmt::format(" from {:g} to {:g}", bounds.low, bounds.high);
  return bounds.text();
}

std::string in_brackets(const std::string& unit) { return unit.empty() ? "" : fmt::format(" [{}]", unit); }

std::string quantity_text(const keys::Key& spec) {
  if (!spec.noun.empty()) return std::string(spec.noun);
  if (spec.turning) return "a quantity";
  const std::string name = quantity_name(spec.dimension);
  return name.starts_with("a quantity") ? "a quantity" : name;
}

std::string single_text(const keys::Key& spec) {
  using keys::Takes;
  switch (spec.takes) {
    case Takes::nothing: return {};
    case Takes::quantity: return quantity_text(spec) + spec.bounds.text() + in_brackets(spec.unit_text());
    case Takes::integer: return "an integer" + integer_range(spec.bounds);
    case Takes::boolean: return "true or false";
    case Takes::choice:
      return fmt::format("{}{}", spec.choices.size() > 1 ? "one of " : "", fmt::join(spec.choices, ", "));
    case Takes::text: return "a text";
    case Takes::value: return "a number, a quantity or a name";
  }
  return {};
}

std::string or_map(const keys::Key& spec) {
  const std::string single = single_text(spec);
  if (!spec.inside) return single;
  if (spec.inside->keys.empty()) return "an empty map";
  return (single.empty() ? "a map, see " : single + ", or a map, see ") + std::string(spec.inside->name);
}

std::string list_of(const keys::Key& spec) {
  const std::string count = spec.maximum == 0              ? ""
                            : spec.minimum == spec.maximum ? fmt::format(" of {}", spec.minimum)
                                                           : fmt::format(" of {} to {}", spec.minimum, spec.maximum);
  return fmt::format("a list{}, each {}", count, or_map(spec));
}

}  // namespace

std::vector<const keys::Section*> all_sections() {
  const auto tables = keys::sections();
  std::vector<const keys::Section*> all(tables.begin(), tables.end());
  std::ranges::copy(keys::sections_of_studies(), std::back_inserter(all));
  for (const laws::Entry& law : laws::catalogue()) all.push_back(&keys::parameters_of(law));
  return all;
}

std::string taken_text(const keys::Key& spec) {
  using keys::Form;
  const std::string instead = spec.instead.empty() ? "" : fmt::format("{}, or ", fmt::join(spec.instead, ", "));
  switch (spec.form) {
    case Form::one: return instead + or_map(spec);
    case Form::one_or_each: {
      const std::string or_inside = spec.inside ? fmt::format(", or a map, see {}", spec.inside->name) : "";
      return instead + single_text(spec) + ", or a list of them" + or_inside;
    }
    case Form::one_or_list: return instead + or_map(spec) + ", or " + list_of(spec);
    case Form::list: return instead + list_of(spec);
    case Form::lists: return instead + "a list, each " + list_of(spec);
    case Form::by_storey:
      return or_map(spec) +
             "; or a list of them from the ground up, or a map from storeys such as 1-3; each may be a list by line";
    case Form::named: return instead + "a map of names, each " + or_map(spec);
    case Form::named_lists: return instead + "a map of names, each " + list_of(spec);
  }
  return {};
}

std::vector<std::string> keys_with(keys::Need need, const keys::Section& section) {
  std::vector<std::string> keys;
  for (const keys::Key& spec : section.keys)
    if (spec.need == need) keys.emplace_back(spec.key);
  return keys;
}

std::string necessity_text(const keys::Key& spec, const keys::Section& section) {
  using keys::Need;
  switch (spec.need) {
    case Need::optional: return "optional";
    case Need::required: return "required";
    case Need::exactly_one: return fmt::format("one of {}", fmt::join(keys_with(spec.need, section), ", "));
    case Need::at_least_one: return fmt::format("at least one of {}", fmt::join(keys_with(spec.need, section), ", "));
  }
  return {};
}

}  // namespace pounding::program
