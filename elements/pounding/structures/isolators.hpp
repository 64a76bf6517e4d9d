#pragma once
/// Isolators between the ground and a structure: parts that yield by a law, and what they are left out of.

#include <optional>
#include <string>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// One isolator, or all of them together, by its law: `{.law = {.law = "lead_rubber", .values = {{"strength", 375e3},
/// {"post_yield_stiffness", 3.5e6}, {"yield_displacement", 12e-3}}}}`. SI units.
struct IsolatorOptions {
  /// Law and numbers. A `weight` that the law takes is the load at rest unless it is given.
  hysteresis::Settings law;
  std::optional<double> capacity{};  ///< deformation that it can bear, for reports [m]
  /// Of a friction_pendulum: its coefficient when it slides slowly, and how fast it comes to that of the law [s/m], see
  /// SlidingFriction.
  struct Velocity {
    double slow_friction = 0, rate = 0;
  };
  std::optional<Velocity> velocity{};
  bool is_coupled = true;  ///< in space each axis by itself asks for false: laws of two axes in one are not there yet
};

/// Whether the law takes a weight and none is given. False for an unknown law.
bool needs_weight(const IsolatorOptions& isolator);

/// An isolator with this deformation as factors of the unknowns, under this weight [N]. Throws std::invalid_argument,
/// in the words of the law, for what make_spring() refuses, and for a capacity that is not positive.
YieldingPart make_isolator(std::string name, Row deformation, const IsolatorOptions& isolator, double weight);

/// Whether a part is an isolator: a length between the ground and a structure, which damping by ratios leaves out. Its
/// parameter `capacity` is the deformation that it can bear [m], infinite where nothing is said of it.
inline bool isolates(const YieldingPart& part) { return part.kind == YieldingPart::Kind::isolator; }

/// Whether a structure stands on isolators.
bool is_isolated(const Structure& s);

/// The part of K that is that of the isolators, n x n [N/m].
SparseMatrix stiffness_of_isolators(const Structure& s);

/// T, n x (n - isolators): all motions in which no isolator deforms are T times its columns' unknowns. T^T K T is the
/// structure on its fixed base. Throws std::invalid_argument where nothing else can move.
SparseMatrix motions_on_fixed_base(const Structure& s);

/// Period of the structure as one body on its isolators after the yield, along x: 2 pi sqrt(m/sum k2) [s]; infinite
/// where they do not harden.
double isolated_period(const Structure& s);

}  // namespace pounding
