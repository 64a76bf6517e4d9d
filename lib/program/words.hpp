#pragma once
/// The keys of the input as text and as a JSON schema.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/input/keys/sections.hpp>

namespace pounding::program {

/// Every section in reading order; the parameters of each law follow at the end, one section per law.
std::vector<const keys::Section*> all_sections();

/// Values that a key accepts: "a length >= 0 [m], or a list of them", "one of firm, medium, soft", "a map, see
/// harmonic".
std::string taken_text(const keys::Key& spec);

/// "required", "optional", "one of period, stiffness", "at least one of grid, nodes".
std::string necessity_text(const keys::Key& spec, const keys::Section& section);

/// The keys of a section with this need, in its order.
std::vector<std::string> keys_with(keys::Need need, const keys::Section& section);

/// One section with all facts of its keys.
nlohmann::ordered_json section_json(const keys::Section& section);

/// A JSON schema (draft 2020-12) of the whole input, by which editors complete and check a model. It takes every input
/// that the reader takes, and refuses unknown keys, missing keys, other types, choices and ranges; what several keys
/// say together, only the reader knows.
nlohmann::ordered_json input_schema();

}  // namespace pounding::program
