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
  for (const std::string_view key : {"yes", "Yes", "YES", "on", "On", "ON", "True", "TRUE"})
    if (text == key) return true;
  for (const std::string_view key : {"no", "No", "NO", "off", "Off", "OFF", "False", "FALSE"})
    if (text == key) return false;
  return node.as_bool();
}

py::object read_single(const Input& node, const keys::Key& key) {
  if (key.inside && (node.is_map() || key.takes == Takes::nothing)) return read_section(node, *key.inside);
  switch (key.takes) {
    case Takes::quantity: return py::float_(node.as_quantity());
    case Takes::integer: return py::int_(node.as_integer());
    case Takes::boolean: return py::bool_(read_flag(node));
    case Takes::choice: return py::str(node.as_choice());
    case Takes::value: return node.is_scalar() ? py::object(py::str(node.as_text())) : plain(node);
    default: return py::str(node.as_text());
  }
}

py::object read_value(const Input& node, const keys::Key& key) {
  if (key.form == Form::named) {
    py::dict named;
    for (const auto& [name, value] : node.entries()) named[py::str(name)] = read_single(value, key);
    return named;
  }
  if (key.form == Form::one || (key.form == Form::one_or_list && !node.is_list())) return read_single(node, key);
  const std::vector<Input> items = node.items();
  const auto count = static_cast<int>(items.size());
  if (count < key.minimum || (key.maximum > 0 && count > key.maximum))
    node.fail(fmt::format("takes a list such as {}; a list of {} was read", key.example, count));
  py::list values;
  for (const Input& item : items) values.append(read_single(item, key));
  return values;
}

/// The default of a key; null if it is only described.
std::optional<py::object> default_of(const keys::Key& key) {
  if (key.form != Form::one) return std::nullopt;
  if (key.takes == Takes::boolean) return py::bool_(key.otherwise == "true");
  if (key.takes == Takes::choice && std::ranges::find(key.choices, key.otherwise) != key.choices.end())
    return py::str(key.otherwise);
  if (const auto value = key.default_quantity()) return py::float_(*value);
  long long number = 0;
  const char* const end = key.otherwise.data() + key.otherwise.size();
  if (key.takes == Takes::integer && std::from_chars(key.otherwise.data(), end, number).ptr == end)
    if (!key.otherwise.empty()) return py::int_(number);
  return std::nullopt;
}

py::object read_section(const Input& node, const keys::Section& section) {
  const Input map = node.in(section);
  map.only_keys();
  py::dict values;
  std::vector<std::string_view> alternatives, given;
  for (const keys::Key& key : section.keys) {
    if (key.need == Need::exactly_one) alternatives.push_back(key.key);
    const auto value = key.need == Need::required ? map.at(key.key) : map.find(key.key);
    if (value && !is_null(*value)) {
      if (key.need == Need::exactly_one) given.push_back(key.key);
      values[py::str(key.key)] = read_value(*value, key);
    } else if (const auto otherwise = default_of(key)) {
      values[py::str(key.key)] = *otherwise;
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

/// The keys of `records:` of a suite; `text` has no other keys.
py::object read_suite(const std::string& text, const std::string& name) {
  const Input file = Input::read_text(text, name).in(keys::suite_file);
  return read_section(file.at("records"), *keys::suite_file.find("records")->inside);
}

py::dict examples() {
  py::dict found;
  for (const keys::Section* section : keys::sections_of_studies()) {
    py::dict typed;
    for (const keys::Key& key : section->keys) typed[py::str(key.key)] = py::str(key.example);
    found[py::str(section->name)] = typed;
  }
  return found;
}

}  // namespace

void bind_study_keys(py::module_& module) {
  module.def("read_study", &read_study, py::arg("text"), py::arg("name"));
  module.def("read_suite", &read_suite, py::arg("text"), py::arg("name"));
  module.def("study_examples", &examples);
}

}  // namespace pounding::python
