#pragma once
/// The `structures:` section of an input file.

#include <string>

#include <pounding/model/model.hpp>

namespace pounding {

/// Reads one structure: its kind, damping, initial motion, the ground under it, where a wave may run. Throws InputError with
/// the place.
Structure read_structure(const std::string& name, const Input& place, const Kinds& kinds, const ModeSolver& modes,
                         const std::optional<TravellingWave>& wave);

}  // namespace pounding
