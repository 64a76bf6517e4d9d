#pragma once
/// Free impact of two bodies with every damping formula of a law, for `pounding calibrate` and calibrate() in Python.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <pounding/laws/compiled.hpp>

namespace pounding {

/// A collision as typed: numbers in SI units or with a unit; empty if not given.
struct CollisionInput {
  std::string law, restitution, m1, m2 = "wall", stiffness, velocity, exponent;
  std::vector<std::pair<std::string, std::string>> parameters = {};  ///< other parameters of the law: name and value
  std::string_view before_names = {};  ///< prefix of names in messages, "--" on the command line
};

/// A collision in SI units, with the list of values that are assumed.
struct Collision {
  const laws::Entry& law;
  laws::Settings settings;
  double velocity = laws::typical_closing_speed;  ///< closing speed [m/s]
  double exponent = 1;
  std::vector<std::string> assumed;
};

/// Result of one formula.
struct CalibratedRow {
  std::string_view formula;
  double number = 0, coefficient = 0;  ///< of the damping, see laws::Entry
  laws::FreeImpact impact;
  std::string refused;  ///< reason why the formula has no value here
};

/// Text of a row for an impact that "has no number" or "does not end". For the exact formula, or a law without
/// formulas, throws InputError with `before` as a prefix, since no other row can succeed.
std::string refused_impact(std::string_view before, std::string_view formula, std::string_view why);

/// Throws InputError for a missing or invalid value, std::invalid_argument for an unknown law.
Collision read_collision(const CollisionInput& keys);

/// One row per formula, or one without a name if the law has no formulas. Throws std::invalid_argument for a value that
/// the law rejects with every formula.
std::vector<CalibratedRow> calibrate(const Collision& collision);

}  // namespace pounding
