#pragma once
/// Springs by the name of their law, for inputs.

#include <memory>
#include <string>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// A spring that follows the law of yielding that the settings name, undeformed. What a storey, a hinge or a device
/// knows itself stands among the values: `stiffness` of a storey or a hinge, `weight` on an isolator. SI units. Throws
/// std::invalid_argument for an unknown law or parameter (with the nearest known name), a missing one and a wrong
/// value.
std::unique_ptr<Spring> make_spring(const hysteresis::Settings& settings);

/// Likewise for a hinge, whose words and messages have moments: `yield_moment` for yield_force,
/// `negative_yield_moment`, `cracking_moment`, `yield_rotation` for yield_deformation.
std::unique_ptr<Spring> make_hinge(const hysteresis::Settings& settings);

/// A text about a law, or one of its words, with the words of hinges in it.
std::string in_moments(std::string text);

}  // namespace pounding
