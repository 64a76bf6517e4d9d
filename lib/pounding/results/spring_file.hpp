#pragma once
/// Yielding parts of structures in the results file.

#include <hdf5.h>

#include <cstddef>
#include <string>

#include <pounding/results/spring_history.hpp>

namespace pounding {

/// Writes the group `springs` of a structure: histories at the output times, and a few numbers per part under
/// `summary`. Returns immediately for an elastic structure. Throws std::invalid_argument if a history does not have
/// `samples` values per part.
void write_springs(hid_t structure, const std::string& name, const SpringHistory& springs, std::size_t samples);

}  // namespace pounding
