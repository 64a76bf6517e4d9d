#pragma once
/// The input keys in human-readable form.

#include <span>
#include <string>
#include <vector>

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

}  // namespace pounding::program
