#pragma once
/// What a run assumes, as data for reports: masses, periods, damping, loads, contact laws and ground motions.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <pounding/model/model.hpp>

namespace pounding {

/// JSON object in SI units of a complete model: `title`, `project`, `sha256` of the input, `ground`, `structures` by
/// name, `links` and `devices`.
std::string assumptions_json(const Model& model);

/// One link of it: ends, law, gap, reduced mass, parameters and their units.
nlohmann::ordered_json link_json(const Model& model, const Link& link);

}  // namespace pounding
