#pragma once
/// Springs of hinges by the name of their law.

#include <memory>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/spring.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {

/// As make_spring() for a hinge, whose words and messages have moments: `yield_moment` for yield_force, `negative_yield_moment`,
/// `cracking_moment`, `yield_rotation` for yield_deformation.
std::unique_ptr<Spring> make_hinge(const hysteresis::Settings& settings);

}  // namespace pounding
