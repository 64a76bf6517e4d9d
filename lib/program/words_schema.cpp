#include "words.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/core/unit_reader.hpp>
#include <pounding/core/version.hpp>
#include <pounding/input/keys/studies.hpp>
#include <pounding/laws/compiled.hpp>

namespace pounding::program {
namespace {

using Json = nlohmann::ordered_json;

std::string reference_to(const keys::Section& section) { return fmt::format("#/$defs/{}", section.name); }

// For products and quotients of units, only the reader checks the dimension.
std::string unit_pattern(const Dimension& dimension) {
  std::vector<std::string_view> names = unit_names(dimension);
  const std::string alone = names.empty() ? "" : fmt::format("{}|", fmt::join(names, "|"));
  return fmt::format(R"([ \t]*({}1/.*|[^ \t0-9,.]+[-/^*() \t0-9].*)?[ \t]*$)", alone);
}

Json number_schema(const Bounds& bounds, std::string_view type) {
  Json number{{"type", type}};
  if (bounds.has_low()) number[bounds.without_low ? "exclusiveMinimum" : "minimum"] = bounds.low;
  if (bounds.has_high()) number[bounds.without_high ? "exclusiveMaximum" : "maximum"] = bounds.high;
  return number;
}

// A number, or a text with a number and its unit. Of the range, a text pattern checks only the sign.
std::vector<Json> quantity_schemas(const keys::Key& spec) {
  const std::string sign = spec.bounds.low >= 0 ? "[+]?" : "[-+]?";
  const auto text = [&](const Dimension& dimension) {
    return Json{{"type", "string"},
                {"pattern",
                 R"(^[ \t]*)" + sign + R"(([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?)" + unit_pattern(dimension)}};
  };
  std::vector<Json> all{number_schema(spec.bounds, "number"), text(spec.dimension)};
  if (spec.turning) all.push_back(text(*spec.turning));
  return all;
}

std::vector<Json> single_schemas(const keys::Key& spec) {
  std::vector<Json> all;
  using keys::Takes;
  switch (spec.takes) {
    case Takes::nothing: break;
    case Takes::quantity: all = quantity_schemas(spec); break;
    case Takes::integer: all = {number_schema(spec.bounds, "integer")}; break;
    case Takes::boolean: all = {Json{{"type", "boolean"}}}; break;
    case Takes::choice: all = {Json{{"enum", spec.choices}}}; break;
    case Takes::text:
    case Takes::value: all = {Json{{"type", Json::array({"string", "number", "boolean"})}}}; break;
  }
  if (spec.inside) all.push_back(Json{{"$ref", reference_to(*spec.inside)}});
  return all;
}

Json any_of(std::vector<Json> alternatives) {
  return alternatives.size() == 1 ? alternatives.front() : Json{{"anyOf", alternatives}};
}

Json list_schema(const keys::Key& spec) {
  Json list{{"type", "array"}, {"items", any_of(single_schemas(spec))}};
  if (spec.minimum > 0) list["minItems"] = spec.minimum;
  if (spec.maximum > 0) list["maxItems"] = spec.maximum;
  return list;
}

std::vector<Json> alternatives_of(const keys::Key& spec) {
  using keys::Form;
  std::vector<Json> all = single_schemas(spec);
  switch (spec.form) {
    case Form::one: return all;
    case Form::one_or_each:
    case Form::one_or_list: all.push_back(list_schema(spec)); return all;
    case Form::list: return {list_schema(spec)};
    case Form::lists: return {Json{{"type", "array"}, {"items", list_schema(spec)}}};
    case Form::by_storey: {
      const Json of_line{{"type", "array"}, {"items", any_of(all)}, {"minItems", 1}};
      std::vector<Json> of_storey = all;
      of_storey.push_back(of_line);
      all.push_back(Json{{"type", "array"}, {"items", any_of(of_storey)}, {"minItems", 1}});
      all.push_back(Json{{"type", "object"},
                         {"patternProperties", {{"^[1-9][0-9]*(-[1-9][0-9]*)?$", any_of(of_storey)}}},
                         {"additionalProperties", false},
                         {"minProperties", 1}});
      return all;
    }
    case Form::named:
      // Maps of the model, whose kind the path of the factor decides.
      if (spec.key == "alternatives") return {Json{{"type", "object"}, {"additionalProperties", {{"type", "object"}}}}};
      return {Json{{"type", "object"}, {"additionalProperties", any_of(all)}}};
    case Form::named_lists: return {Json{{"type", "object"}, {"additionalProperties", list_schema(spec)}}};
  }
  return all;
}

Json key_schema(const keys::Key& spec, const keys::Section& section) {
  Json schema{{"description", fmt::format("{}\n\nTakes {}; {}.{}\nExample: {}: {}", spec.meaning, taken_text(spec),
                                          necessity_text(spec, section),
                                          spec.otherwise.empty() ? "" : fmt::format(" Default: {}.", spec.otherwise),
                                          spec.key, spec.example)}};
  std::vector<Json> alternatives = alternatives_of(spec);
  if (!spec.instead.empty()) alternatives.insert(alternatives.begin(), Json{{"enum", spec.instead}});
  schema.update(any_of(alternatives));
  const bool is_single = spec.form == keys::Form::one && spec.takes != keys::Takes::nothing;
  if (is_single && spec.takes == keys::Takes::quantity) schema["examples"] = Json::array({spec.example});
  return schema;
}

// Alternatives of which exactly one, or at least one, is given.
Json groups_of(const keys::Section& section) {
  Json groups = Json::array();
  const auto add = [&](keys::Need need, const char* how) {
    Json alternatives = Json::array();
    for (const std::string& key : keys_with(need, section)) alternatives.push_back({{"required", Json::array({key})}});
    if (!alternatives.empty()) groups.push_back({{how, alternatives}});
  };
  add(keys::Need::exactly_one, "oneOf");
  add(keys::Need::at_least_one, "anyOf");
  return groups;
}

Json section_schema(const keys::Section& section) {
  Json schema{{"description", section.meaning}, {"type", "object"}, {"properties", Json::object()}};
  if (section.keys.empty()) schema["type"] = Json::array({"object", "null"});
  for (const keys::Key& spec : section.keys) schema["properties"][std::string(spec.key)] = key_schema(spec, section);
  const std::vector<std::string> required = keys_with(keys::Need::required, section);
  if (!required.empty()) schema["required"] = required;
  if (const Json groups = groups_of(section); !groups.empty()) schema["allOf"] = groups;
  schema["additionalProperties"] = false;
  return schema;
}

// The law of a link determines its other keys.
Json links_schema() {
  Json schema = section_schema(keys::link);
  schema["allOf"] = Json::array();
  for (const laws::Entry& law : laws::catalogue()) {
    const keys::Section& own = keys::parameters_of(law);
    Json then = section_schema(own);
    then.erase("type");
    then.erase("description");
    then.erase("additionalProperties");
    Json names = Json::array();
    for (const keys::Key& spec : keys::link.keys)
      if (own.find(spec.key) || !keys::belongs_to_law(spec.key)) names.push_back(spec.key);
    for (const laws::ParameterInfo& parameter : law.parameters) {
      names.push_back(parameter.name);
      // Completion offers the keys of every law; the chosen law determines which are allowed.
      schema["properties"].emplace(std::string(parameter.name), Json::object());
    }
    then["propertyNames"] = {{"enum", names}};
    schema["allOf"].push_back(
        {{"if", {{"properties", {{"law", {{"const", law.name}}}}}, {"required", Json::array({"law"})}}},
         {"then", then}});
  }
  return schema;
}

std::string name_of(keys::Takes takes) {
  constexpr const char* names[] = {"nothing", "quantity", "integer", "boolean", "choice", "text", "value"};
  return names[static_cast<std::size_t>(takes)];
}

std::string name_of(keys::Form form) {
  constexpr const char* names[] = {"one",   "one or each", "one or list", "list",
                                   "lists", "named",       "named lists", "by storey"};
  return names[static_cast<std::size_t>(form)];
}

Json key_json(const keys::Key& spec, const keys::Section& section) {
  Json json{{"key", spec.key},
            {"meaning", spec.meaning},
            {"takes", taken_text(spec)},
            {"kind", name_of(spec.takes)},
            {"form", name_of(spec.form)},
            {"need", necessity_text(spec, section)},
            {"since", spec.since},
            {"example", spec.example}};
  if (spec.takes == keys::Takes::quantity) json["unit"] = spec.unit_text();
  if (spec.bounds.has_low()) json["low"] = spec.bounds.low;
  if (spec.bounds.has_high()) json["high"] = spec.bounds.high;
  if (spec.inside) json["section"] = spec.inside->name;
  if (!spec.choices.empty()) json["choices"] = spec.choices;
  if (!spec.instead.empty()) json["instead"] = spec.instead;
  if (!spec.otherwise.empty()) json["default"] = spec.otherwise;
  return json;
}

}  // namespace

nlohmann::ordered_json section_json(const keys::Section& section) {
  Json json{{"name", section.name}, {"place", section.place}, {"meaning", section.meaning}, {"keys", Json::array()}};
  for (const keys::Key& spec : section.keys) json["keys"].push_back(key_json(spec, section));
  return json;
}

nlohmann::ordered_json input_schema() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "Input of pounding " POUNDING_VERSION}};
  schema.update(section_schema(keys::model));
  // In a study file, the model is included or given by its file name.
  for (const keys::Key& spec : keys::study_file.keys)
    schema["properties"].emplace(std::string(spec.key), key_schema(spec, keys::study_file));
  for (const keys::Key& spec : keys::suite_file.keys)
    schema["properties"].emplace(std::string(spec.key), key_schema(spec, keys::suite_file));
  schema["anyOf"] = {{{"required", schema["required"]}}, {{"required", {"study", "model"}}}};
  schema.erase("required");
  schema["$defs"] = Json::object();
  for (const keys::Section* section : keys::sections())
    if (section != &keys::model && section != &keys::link)
      schema["$defs"][std::string(section->name)] = section_schema(*section);
  schema["$defs"][std::string(keys::link.name)] = links_schema();
  for (const keys::Section* section : keys::sections_of_studies())
    schema["$defs"][std::string(section->name)] = section_schema(*section);
  return schema;
}

}  // namespace pounding::program
