/// Keys of `study:` from the tables of the input: checked, with values in SI and with their defaults.

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <pounding/input/input.hpp>
#include <pounding/input/keys/studies.hpp>

#include "bindings.hpp"

namespace py = pybind11;

namespace pounding::python {
namespace {

using keys::Form;
using keys::Need;
using keys::Takes;

py::object read_section(const Input& node, const keys::Section& section);

bool is_null(const Input& node) { return !node.is_map() && !node.is_list() && !node.is_scalar(); }

// YAML 1.1 also has yes, no, on and off.
bool read_flag(const Input& node) {
  const std::string text = node.is_scalar() ? node.as_text() : "";
  for (const std::string_view word : {"yes", "Yes", "YES", "on", "On", "ON", "True", "TRUE"})
    if (text == word) return true;
  for (const std::string_view word : {"no", "No", "NO", "off", "Off", "OFF", "False", "FALSE"})
    if (text == word) return false;
  return node.as_bool();
}

py::object read_single(const Input& node, const keys::Key& word) {
  if (word.inside && (node.is_map() || word.takes == Takes::nothing)) return read_section(node, *word.inside);
  switch (word.takes) {
    case Takes::quantity: return py::float_(node.as_quantity());
    case Takes::integer: return py::int_(node.as_integer());
    case Takes::boolean: return py::bool_(read_flag(node));
    case Takes::choice: return py::str(node.as_choice());
    default: return py::str(node.as_text());
  }
}

py::object read_value(const Input& node, const keys::Key& word) {
  if (word.form == Form::named) {
    py::dict named;
    for (const auto& [name, value] : node.entries()) named[py::str(name)] = read_single(value, word);
    return named;
  }
  if (word.form == Form::one || (word.form == Form::one_or_list && !node.is_list())) return read_single(node, word);
  const std::vector<Input> items = node.items();
  const auto count = static_cast<int>(items.size());
  if (count < word.minimum || (word.maximum > 0 && count > word.maximum))
    node.fail(fmt::format("takes a list such as {}; a list of {} was read", word.example, count));
  py::list values;
  for (const Input& item : items) values.append(read_single(item, word));
  return values;
}

/// The default of a key; null if it is only described.
std::optional<py::object> default_of(const keys::Key& word) {
  if (word.form != Form::one) return std::nullopt;
  if (word.takes == Takes::boolean) return py::bool_(word.otherwise == "true");
  if (word.takes == Takes::choice && std::ranges::find(word.choices, word.otherwise) != word.choices.end())
    return py::str(word.otherwise);
  if (const auto value = word.default_quantity()) return py::float_(*value);
  long long number = 0;
  const char* const end = word.otherwise.data() + word.otherwise.size();
  if (word.takes == Takes::integer && std::from_chars(word.otherwise.data(), end, number).ptr == end)
    if (!word.otherwise.empty()) return py::int_(number);
  return std::nullopt;
}

py::object read_section(const Input& node, const keys::Section& section) {
  const Input map = node.in(section);
  map.only_keys();
  py::dict values;
  std::vector<std::string_view> alternatives, given;
  for (const keys::Key& word : section.words) {
    if (word.need == Need::exactly_one) alternatives.push_back(word.key);
    const auto value = word.need == Need::required ? map.at(word.key) : map.find(word.key);
    if (value && !is_null(*value)) {
      if (word.need == Need::exactly_one) given.push_back(word.key);
      values[py::str(word.key)] = read_value(*value, word);
    } else if (const auto otherwise = default_of(word)) {
      values[py::str(word.key)] = *otherwise;
    }
  }
  if (!alternatives.empty() && given.size() != 1)
    map.fail(fmt::format("takes one of {}; {} was read", fmt::join(alternatives, ", "),
                         given.empty() ? "none" : fmt::format("{}", fmt::join(given, " and "))));
  return values;
}

/// The keys of `study:` in a text; models in the same file are not read.
py::object read_study(const std::string& text, const std::string& name) {
  const keys::Section& file = *keys::sections_of_studies().front();
  const auto study = Input::read_text(text, name).in(file).find("study");
  const keys::Section& inside = *file.find("study")->inside;
  if (study && !is_null(*study)) return read_section(*study, inside);
  return read_section(Input::read_text("study: {}", name).in(file).at("study"), inside);
}

py::dict examples() {
  py::dict found;
  for (const keys::Section* section : keys::sections_of_studies()) {
    py::dict keys;
    for (const keys::Key& word : section->words) keys[py::str(word.key)] = py::str(word.example);
    found[py::str(section->name)] = keys;
  }
  return found;
}

}  // namespace

void bind_study_keys(py::module_& module) {
  module.def("read_study", &read_study, py::arg("text"), py::arg("name"));
  module.def("study_examples", &examples);
}

}  // namespace pounding::python
