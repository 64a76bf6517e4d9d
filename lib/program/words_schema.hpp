#pragma once
/// The words of the input for other programs.

#include <nlohmann/json.hpp>

#include <pounding/input/keys/sections.hpp>

namespace pounding::program {

/// One section with all facts of its keys.
nlohmann::ordered_json section_json(const keys::Section& section);

/// A JSON schema (draft 2020-12) of the whole input, by which editors complete and check a model. It takes every input
/// that the reader takes, and refuses unknown keys, missing keys, other types, choices and ranges; what several keys
/// say together, only the reader knows.
nlohmann::ordered_json input_schema();

}  // namespace pounding::program
