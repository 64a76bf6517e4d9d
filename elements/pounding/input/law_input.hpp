#pragma once
/// The law of a link in an input file.

#include <optional>
#include <string>

#include <pounding/input/input.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/model/contact_stiffness.hpp>

namespace pounding {

/// The law of a link as typed.
struct LawInput {
  laws::Settings settings;
  std::optional<StiffnessEstimate> stiffness;  ///< set if the settings have no stiffness
};

/// Throws InputError at the first key of a link that is neither a key of links nor of its law. An unknown
/// law is not an error here.
void refuse_unknown_keys(const Input& link);

/// Reads the law of a link with its parameters. Rejects keys that neither the law nor links in general allow. Throws
/// InputError with the location.
LawInput read_law(const Input& node);

/// Location in the link of an error of its law: the first key of the link that the text mentions.
Input location_of_law(const std::string& refusal, const Input& node);

}  // namespace pounding
