#pragma once
/// A free impact of two bodies by every damping formula of a law: what `pounding calibrate` and Python's calibrate()
/// tell.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pounding/laws/compiled.hpp>

namespace pounding {

/// A collision as a user says it: numbers in SI or with their units; empty for what was not said.
struct CollisionInput {
  std::string law, restitution, m1, m2 = "wall", stiffness, velocity, exponent;
  std::vector<std::pair<std::string, std::string>> parameters = {};  ///< other parameters of the law: name, value
  std::string_view before_names = {};  ///< what stands before a name when it is typed, "--" on a command line
};

/// A collision in SI units, and which of its values are only typical ones.
struct Collision {
  const laws::Entry& law;
  laws::Settings settings;
  double velocity = laws::typical_closing_speed;  ///< closing speed [m/s]
  double exponent = 1;
  std::vector<std::string> assumed;
};

/// One formula at work.
struct CalibratedRow {
  std::string_view formula;
  double number = 0, coefficient = 0;  ///< of the damping, see laws::Entry
  laws::FreeImpact impact;
  std::string refused;  ///< why the formula has no value here
};

/// What a row says of an impact that "has no number" or "does not end". Throws InputError, which begins with `before`,
/// where no other formula could answer: for the exact one, and for a law without formulas.
std::string refused_impact(std::string_view before, std::string_view formula, std::string_view why);

/// Throws InputError for a value that is missing or wrong, std::invalid_argument for an unknown law.
Collision read_collision(const CollisionInput& keys);

/// One row a formula; one without a name for a law that has none. Throws std::invalid_argument for a value or a
/// parameter that the law refuses whatever the formula.
std::vector<CalibratedRow> calibrate(const Collision& collision);

}  // namespace pounding
