#pragma once
/// Parts that would yield before a run starts.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/structures/isolators.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Magnitude of the deformation at which an undeformed part yields on the way to this deformation; nullopt if it
/// stays elastic. If it yields at different magnitudes in the two directions, that of this direction.
inline std::optional<double> yields_before(const YieldingPart& part, double deformation) {
  const double weaker = part.yield_deformation();
  if (!(std::abs(deformation) > weaker)) return {};
  if (!part.has_spring() || !part.spring().has_corners()) return weaker;
  const std::optional<double> corner = LoadedSpring(part.spring()).corner(deformation);
  return corner ? std::optional(std::max(weaker, std::abs(*corner))) : std::nullopt;
}

/// Drift of a storey, an isolator or a support, "12 mm", or rotation in a frame, "0.0012 rad".
inline std::string deformation_text(const Structure& s, const YieldingPart& part, double deformation) {
  return s.dimension == 1 || part.kind != YieldingPart::Kind::hinge ? format_quantity(deformation, dimension::length)
                                                                    : fmt::format("{:.4g} rad", deformation);
}

}  // namespace pounding
