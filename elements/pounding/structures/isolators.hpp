#pragma once
/// Isolators between the ground and a structure: yielding parts that are exempt from some forms of damping.

#include <optional>
#include <string>
#include <vector>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// One isolator, or all isolators combined, with a hysteretic law: `{.law = {.law = "lead_rubber", .values =
/// {{"strength", 375e3}, {"post_yield_stiffness", 3.5e6}, {"yield_displacement", 12e-3}}}}`. SI units.
struct IsolatorOptions {
  /// Law and parameters. The parameter `weight`, if the law takes it, defaults to the load at rest.
  hysteresis::Settings law;
  std::optional<double> capacity{};  ///< deformation capacity, for reports [m]
  /// For a friction_pendulum: coefficient of slow sliding, and rate of the transition to that of the law [s/m], see
  /// SlidingFriction.
  struct Velocity {
    double slow_friction = 0, rate = 0;
  };
  std::optional<Velocity> velocity{};
  bool is_coupled = true;  ///< in space: true if a circle limits the force, false for independent laws along x and y
};

/// True if the law takes a weight and none is given. False for an unknown law.
bool needs_weight(const IsolatorOptions& isolator);

/// Creates the parts of an isolator from its deformations along x, and y in space, as factors of the unknowns, and its
/// weight [N]. In space their names end in " x" and " y"; coupled ones share an element, see CoupledPendulum and
/// CoupledBoucWen. Throws std::invalid_argument like make_spring(), for a capacity that is not positive, and in space
/// for a law that cannot be coupled.
std::vector<YieldingPart> make_isolator(const std::string& name, const std::vector<Row>& deformations,
                                        const IsolatorOptions& isolator, double weight);

/// True for an isolator: a part between the ground and a structure that is exempt from damping by ratios. Its parameter
/// `capacity` is the deformation capacity [m], infinite if not given.
inline bool isolates(const YieldingPart& part) { return part.kind == YieldingPart::Kind::isolator; }

/// True if a structure has isolators.
bool is_isolated(const Structure& s);

/// Contribution of the isolators to K, n x n [N/m].
SparseMatrix stiffness_of_isolators(const Structure& s);

/// T, n x (n - isolators): maps reduced unknowns to all motions in which no isolator deforms. T^T K T is the stiffness
/// of the structure on a fixed base. Throws std::invalid_argument if no other motion is possible.
SparseMatrix motions_on_fixed_base(const Structure& s);

/// Period of the structure as a rigid body on its isolators after yield, along x: 2 pi sqrt(m/sum k2) [s]; infinite if
/// they do not harden.
double isolated_period(const Structure& s);

}  // namespace pounding
