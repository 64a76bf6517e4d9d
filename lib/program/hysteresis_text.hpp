#pragma once
/// Laws of yielding as text and JSON, and their loops, for `pounding laws`.

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <pounding/hysteresis/entry.hpp>

namespace pounding::program {

/// The law in JSON, as `pounding laws NAME --json` prints it.
nlohmann::json law_json(const hysteresis::Entry& entry);
/// The law in words.
void print_law(const hysteresis::Entry& entry);
/// Turning points in yield deformations, from "0, 3, -3, 1". Throws std::invalid_argument for what is no list of
/// numbers.
std::vector<double> read_path(const std::string& text);
/// Deformation, force, work and state of the law with typical parameters at each turning point, and at `between` - 1
/// points on the way.
void print_loop(const hysteresis::Entry& entry, const std::vector<double>& path, int between, bool json);

}  // namespace pounding::program
