#pragma once
/// Parts of structures that yield in the results file.

#include <hdf5.h>

#include <cstddef>
#include <string>

#include <pounding/results/spring_history.hpp>

namespace pounding {

/// Writes the group `springs` of a structure: histories at the output times, and the run in a few numbers a part under
/// `summary`. Nothing for a structure that stays elastic. Throws std::invalid_argument where a history has not
/// `samples` values a part.
void write_springs(hid_t structure, const std::string& name, const SpringHistory& springs, std::size_t samples);

}  // namespace pounding
