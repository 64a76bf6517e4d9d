#pragma once
/// The law of a link in an input file.

#include <optional>
#include <string>

#include <pounding/input/input.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/model/contact_stiffness.hpp>

namespace pounding {

/// The law of a link as it is typed.
struct LawInput {
  laws::Settings settings;
  std::optional<StiffnessEstimate> stiffness;  ///< where the settings have none
};

/// The law that a link names, with its parameters. Beside them the link may hold what every link can, and no other key.
/// Throws InputError with the place.
LawInput read_law(const Input& node);

/// Location in the link of what its law refuses. The laws know no locations: it is the first of the link's keys that
/// the text names.
Input location_of_law(const std::string& refusal, const Input& node);

}  // namespace pounding
