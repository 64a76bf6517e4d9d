#include "words_schema.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/core/unit_names.hpp>
#include <pounding/core/version.hpp>
#include <pounding/input/words/studies.hpp>
#include <pounding/laws/compiled.hpp>
#include "words_text.hpp"

namespace pounding::program {
namespace {

using Json = nlohmann::ordered_json;

std::string reference_to(const words::Section& section) { return fmt::format("#/$defs/{}", section.name); }

// Where the unit is a product or a quotient, only the reader tells its dimension.
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

// A number alone, or a text with a number and its unit. Of the range a text shows the sign only.
std::vector<Json> quantity_schemas(const words::Word& word) {
  const std::string sign = word.bounds.low >= 0 ? "[+]?" : "[-+]?";
  const auto text = [&](const Dimension& dimension) {
    return Json{{"type", "string"},
                {"pattern",
                 R"(^[ \t]*)" + sign + R"(([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)?)" + unit_pattern(dimension)}};
  };
  std::vector<Json> all{number_schema(word.bounds, "number"), text(word.dimension)};
  if (word.turning) all.push_back(text(*word.turning));
  return all;
}

std::vector<Json> single_schemas(const words::Word& word) {
  std::vector<Json> all;
  using words::Takes;
  switch (word.takes) {
    case Takes::nothing: break;
    case Takes::quantity: all = quantity_schemas(word); break;
    case Takes::integer: all = {number_schema(word.bounds, "integer")}; break;
    case Takes::boolean: all = {Json{{"type", "boolean"}}}; break;
    case Takes::choice: all = {Json{{"enum", word.choices}}}; break;
    case Takes::text:
    case Takes::value: all = {Json{{"type", Json::array({"string", "number", "boolean"})}}}; break;
  }
  if (word.inside) all.push_back(Json{{"$ref", reference_to(*word.inside)}});
  return all;
}

Json any_of(std::vector<Json> alternatives) {
  return alternatives.size() == 1 ? alternatives.front() : Json{{"anyOf", alternatives}};
}

Json list_schema(const words::Word& word) {
  Json list{{"type", "array"}, {"items", any_of(single_schemas(word))}};
  if (word.least > 0) list["minItems"] = word.least;
  if (word.most > 0) list["maxItems"] = word.most;
  return list;
}

std::vector<Json> alternatives_of(const words::Word& word) {
  using words::Form;
  std::vector<Json> all = single_schemas(word);
  switch (word.form) {
    case Form::one: return all;
    case Form::one_or_each:
    case Form::one_or_list: all.push_back(list_schema(word)); return all;
    case Form::list: return {list_schema(word)};
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
    case Form::named: return {Json{{"type", "object"}, {"additionalProperties", any_of(all)}}};
    case Form::named_lists: return {Json{{"type", "object"}, {"additionalProperties", list_schema(word)}}};
  }
  return all;
}

Json word_schema(const words::Word& word, const words::Section& section) {
  Json schema{{"description", fmt::format("{}\n\nTakes {}; {}.{}\nExample: {}: {}", word.meaning, taken_text(word),
                                          necessity_text(word, section),
                                          word.otherwise.empty() ? "" : fmt::format(" Default: {}.", word.otherwise),
                                          word.key, word.example)}};
  std::vector<Json> alternatives = alternatives_of(word);
  if (!word.instead.empty()) alternatives.insert(alternatives.begin(), Json{{"enum", word.instead}});
  schema.update(any_of(alternatives));
  const bool is_single = word.form == words::Form::one && word.takes != words::Takes::nothing;
  if (is_single && word.takes == words::Takes::quantity) schema["examples"] = Json::array({word.example});
  return schema;
}

// Alternatives of which exactly one is given, or at least one.
Json groups_of(const words::Section& section) {
  Json groups = Json::array();
  const auto add = [&](words::Need need, const char* how) {
    Json alternatives = Json::array();
    for (const std::string& key : keys_with(need, section)) alternatives.push_back({{"required", Json::array({key})}});
    if (!alternatives.empty()) groups.push_back({{how, alternatives}});
  };
  add(words::Need::exactly_one, "oneOf");
  add(words::Need::at_least_one, "anyOf");
  return groups;
}

Json section_schema(const words::Section& section) {
  Json schema{{"description", section.meaning}, {"type", "object"}, {"properties", Json::object()}};
  if (section.words.empty()) schema["type"] = Json::array({"object", "null"});
  for (const words::Word& word : section.words)
    schema["properties"][std::string(word.key)] = word_schema(word, section);
  const std::vector<std::string> required = keys_with(words::Need::required, section);
  if (!required.empty()) schema["required"] = required;
  if (const Json groups = groups_of(section); !groups.empty()) schema["allOf"] = groups;
  schema["additionalProperties"] = false;
  return schema;
}

// The law of a link says which other keys it has.
Json links_schema() {
  Json schema = section_schema(words::link);
  schema["allOf"] = Json::array();
  for (const laws::Entry& law : laws::catalogue()) {
    const words::Section& own = words::parameters_of(law);
    Json then = section_schema(own);
    then.erase("type");
    then.erase("description");
    then.erase("additionalProperties");
    Json names = Json::array();
    for (const words::Word& word : words::link.words)
      if (own.find(word.key) || !words::belongs_to_law(word.key)) names.push_back(word.key);
    for (const laws::ParameterInfo& parameter : law.parameters) {
      names.push_back(parameter.name);
      // Completion offers the keys of every law; which of them are allowed the chosen law says.
      schema["properties"].emplace(std::string(parameter.name), Json::object());
    }
    then["propertyNames"] = {{"enum", names}};
    schema["allOf"].push_back(
        {{"if", {{"properties", {{"law", {{"const", law.name}}}}}, {"required", Json::array({"law"})}}},
         {"then", then}});
  }
  return schema;
}

std::string name_of(words::Takes takes) {
  constexpr const char* names[] = {"nothing", "quantity", "integer", "boolean", "choice", "text", "value"};
  return names[static_cast<std::size_t>(takes)];
}

std::string name_of(words::Form form) {
  constexpr const char* names[] = {"one", "one or each", "one or list", "list", "named", "named lists", "by storey"};
  return names[static_cast<std::size_t>(form)];
}

Json word_json(const words::Word& word, const words::Section& section) {
  Json json{{"key", word.key},
            {"meaning", word.meaning},
            {"takes", taken_text(word)},
            {"kind", name_of(word.takes)},
            {"form", name_of(word.form)},
            {"need", necessity_text(word, section)},
            {"since", word.since},
            {"example", word.example}};
  if (word.takes == words::Takes::quantity) json["unit"] = word.unit_text();
  if (word.bounds.has_low()) json["low"] = word.bounds.low;
  if (word.bounds.has_high()) json["high"] = word.bounds.high;
  if (word.inside) json["section"] = word.inside->name;
  if (!word.choices.empty()) json["choices"] = word.choices;
  if (!word.instead.empty()) json["instead"] = word.instead;
  if (!word.otherwise.empty()) json["default"] = word.otherwise;
  return json;
}

}  // namespace

nlohmann::ordered_json section_json(const words::Section& section) {
  Json json{{"name", section.name}, {"place", section.place}, {"meaning", section.meaning}, {"keys", Json::array()}};
  for (const words::Word& word : section.words) json["keys"].push_back(word_json(word, section));
  return json;
}

nlohmann::ordered_json input_schema() {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "Input of pounding " POUNDING_VERSION}};
  schema.update(section_schema(words::model));
  // The file of a study has a model, or names the file of one.
  for (const words::Word& word : words::study_file.words)
    schema["properties"].emplace(std::string(word.key), word_schema(word, words::study_file));
  schema["anyOf"] = {{{"required", schema["required"]}}, {{"required", {"study", "model"}}}};
  schema.erase("required");
  schema["$defs"] = Json::object();
  for (const words::Section* section : words::sections())
    if (section != &words::model && section != &words::link)
      schema["$defs"][std::string(section->name)] = section_schema(*section);
  schema["$defs"][std::string(words::link.name)] = links_schema();
  for (const words::Section* section : words::sections_of_studies())
    schema["$defs"][std::string(section->name)] = section_schema(*section);
  return schema;
}

}  // namespace pounding::program
