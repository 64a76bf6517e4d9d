#pragma once
/// The law of a link in an input file.

#include <string>

#include <pounding/input/input.hpp>
#include <pounding/laws/by_name.hpp>

namespace pounding {

/// The law that the link at this node names, with its parameters. Beside them the link may hold what every link can, and no
/// other key. Throws InputError with the place.
laws::Settings read_law(const Input& node);

/// Location in the link of what its law refuses. The laws know no locations: it is the first of the link's keys that the text names.
Input place_of_law(const std::string& refusal, const Input& node);

}  // namespace pounding
