#pragma once
/// The input keys in machine-readable form.

#include <nlohmann/json.hpp>

#include <pounding/input/keys/sections.hpp>

namespace pounding::program {

/// One section with all properties of its keys.
nlohmann::ordered_json section_json(const keys::Section& section);

/// A JSON schema (draft 2020-12) of the whole input, by which editors complete and check a model. It accepts every
/// input that the reader accepts, and refuses unknown or missing keys, wrong types, choices and ranges; only the reader
/// checks combinations of keys.
nlohmann::ordered_json input_schema();

}  // namespace pounding::program
