#pragma once
/// Springs of hysteretic laws.

#include <memory>

#include <pounding/hysteresis/all.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// Creates an undeformed spring. Throws std::invalid_argument for a parameter out of range.
std::unique_ptr<Spring> make_spring(const hysteresis::AnyLaw& law);

/// Creates an undeformed spring with the hysteretic law of the settings. The values include those known from the
/// context: `stiffness` of a storey, `weight` on an isolator. SI units. Throws std::invalid_argument for an unknown law
/// or parameter (with the nearest known name), a missing parameter and an invalid value.
std::unique_ptr<Spring> make_spring(const hysteresis::Settings& settings);

}  // namespace pounding
