#pragma once
/// Text and JSON descriptions of hysteretic laws, and their loops, for `pounding laws`.

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/hysteresis/entry.hpp>

namespace pounding::program {

std::string_view need_text(laws::Need need);

/// Typical value as typed in a model: a number, a list, or true or false.
nlohmann::json typical_json(const laws::ParameterInfo& parameter);
/// The same as text.
std::string typical_text(const laws::ParameterInfo& parameter);

/// Texts and parameters of a contact law or a hysteretic law.
template <class Entry>
nlohmann::json table_json(const Entry& entry) {
  nlohmann::json law{{"name", entry.name},       {"force", entry.shape},
                     {"summary", entry.summary}, {"source", entry.source},
                     {"symbols", entry.symbols}, {"range", entry.range},
                     {"beware", entry.beware},   {"parameters", nlohmann::json::array()}};
  for (const laws::ParameterInfo& p : entry.parameters)
    law["parameters"].push_back({{"name", p.name},
                                 {"unit", p.unit},
                                 {"meaning", p.meaning},
                                 {"typical", typical_json(p)},
                                 {"need", need_text(p.need)}});
  return law;
}

/// The law in JSON, as `pounding laws NAME --json` prints it.
nlohmann::json law_json(const hysteresis::Entry& entry);
/// Prints the law as text.
void print_law(const hysteresis::Entry& entry);
/// Turning points in yield deformations, from "0, 3, -3, 1". Throws std::invalid_argument for anything else.
std::vector<double> read_path(const std::string& text);
/// Prints deformation, force, work and state of the law with typical parameters at each turning point, and at `between`
/// - 1 points on the path to it.
void print_loop(const hysteresis::Entry& entry, const std::vector<double>& path, int between, bool json);

}  // namespace pounding::program
