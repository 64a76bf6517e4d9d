#pragma once
/// Springs by the name of their law, for inputs.

#include <memory>
#include <string>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// Creates an undeformed spring with the hysteretic law of the settings. The values include those known from the
/// context: `stiffness` of a storey or a hinge, `weight` on an isolator. SI units. Throws std::invalid_argument for an
/// unknown law or parameter (with the nearest known name), a missing parameter and an invalid value.
std::unique_ptr<Spring> make_spring(const hysteresis::Settings& settings);

/// As make_spring() for a hinge, with moments in parameter names and messages: `yield_moment` for yield_force,
/// `negative_yield_moment`, `cracking_moment`, `yield_rotation` for yield_deformation.
std::unique_ptr<Spring> make_hinge(const hysteresis::Settings& settings);

/// Replaces the parameter names of laws in a text by those of hinges.
std::string in_moments(std::string text);

}  // namespace pounding
