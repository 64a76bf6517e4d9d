#pragma once
/// The law of a link in an input file.

#include <span>
#include <string>
#include <string_view>

#include <pounding/input/input.hpp>
#include <pounding/laws/by_name.hpp>

namespace pounding {

/// The law that a link names, with its parameters. The link may hold `link_keys` beside them and no other key. Throws InputError
/// with the place.
laws::Settings read_law(const Input& link, std::span<const std::string_view> link_keys);

/// Location in the link of what its law refuses. The laws know no locations: it is the first of the link's keys that the text names.
Input place_of_law(const std::string& refusal, const Input& link);

}  // namespace pounding
