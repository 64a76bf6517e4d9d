#pragma once
/// Softening of a cross-section, with which results of a member depend on the length over which it softens.

#include <cstddef>
#include <optional>

#include <pounding/sections/fibre_section.hpp>

namespace pounding::sections {

/// A material whose stress falls in compression, or in tension if it resists tension, on a monotonic path.
struct Softening {
  std::size_t material = 0;       ///< index in the materials of the section
  double strength = 0, rest = 0;  ///< largest stress, and stress at large strains; compression negative [Pa]
};

/// The first material with which the resistance of a section falls: one that resists tension, such as steel that
/// ruptures; or a concrete, if all concretes of the section soften in compression. `nullopt` if there is none: the
/// cover of a core that does not soften may spall. Tension that is below half the compressive strength is neglected.
std::optional<Softening> find_softening(const FibreSection& section);

}  // namespace pounding::sections
