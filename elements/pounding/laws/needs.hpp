#pragma once
/// Required and mutually exclusive parameters of a law.

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>

#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// True if a parameter is required; `has(name)` is true for the given ones.
template <class Has>
bool must_be_given(std::span<const ParameterInfo> parameters, const ParameterInfo& parameter, Has&& has) {
  const bool together =
      std::ranges::any_of(parameters, [&](const ParameterInfo& p) { return p.need == Need::together && has(p.name); });
  return parameter.need == (together ? Need::together : Need::required);
}

/// Throws std::invalid_argument for a parameter that has no effect together with parameters of kind `together`; `has`
/// as above.
template <class Has>
void refuse_beside_together(std::span<const ParameterInfo> parameters, Has&& has) {
  const auto other =
      std::ranges::find_if(parameters, [&](const ParameterInfo& p) { return p.need != Need::together && has(p.name); });
  const auto first =
      std::ranges::find_if(parameters, [&](const ParameterInfo& p) { return p.need == Need::together && has(p.name); });
  if (first != parameters.end() && other != parameters.end())
    throw std::invalid_argument(std::string(other->name) + " has no effect together with " + std::string(first->name) +
                                "; remove one of them");
}

}  // namespace pounding::laws
