#pragma once
/// Static path of a structure with yielding parts, from event to event.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// Load, controlled displacement and targets of a pushed structure.
struct PushOptions {
  Eigen::VectorXd load;         ///< p, one value per unknown [N]; multiplied by the load factor
  Row control;                  ///< controlled displacement, in terms of the unknowns
  std::vector<double> targets;  ///< successive values of that displacement [m]
  int smooth_steps = 400;       ///< to the farthest target, for laws that are not piecewise linear
  Eigen::MatrixXd follow{};     ///< rows of the unknowns, displacements recorded at each point
};

/// Equilibrium at one displacement.
struct PushPoint {
  double displacement = 0;  ///< [m]
  double factor = 0;        ///< load factor
  /// Of the yielding parts: deformations [m] or [rad], and forces in addition to k times these [N] or [N m].
  Eigen::VectorXd deformations, forces;
  Eigen::VectorXd followed;  ///< other requested displacements [m]
};

/// Event of a part at a point of the path.
struct PushEvent {
  /// Change of a part that is an event.
  enum class Kind {
    softens,  ///< its slope decreases before its yield deformation, as at cracking of concrete
    yields,
    unloads  ///< reversal while it yields
  };
  int point = 0;  ///< index of the point
  int part = 0;   ///< index of the part
  Kind kind{};
  bool is_first = false;  ///< first yield of the part
};

/// A path, straight between two points if all laws are piecewise linear.
struct PushPath {
  std::vector<PushPoint> points;  ///< the first is at rest
  std::vector<PushEvent> events;  ///< in order; for laws without corners only the first yield
  /// First point after which the load would no longer increase if the yielding parts had no hardening: together with
  /// joints they form a mechanism. nullopt if there is none.
  std::optional<int> mechanism;
  std::vector<int> mechanism_parts;  ///< parts that yield then
  std::string collapse;              ///< reason why the path ends before the last target; empty if it does not
};

/// Pushover analysis under displacement control. Piecewise linear laws are followed exactly, each step ending at the
/// next corner of any part. Other laws use Newton's method in short steps, each of which is also exact unless a part
/// reverses within it. A falling load is followed. The path ends when the structure cannot carry any load: the load
/// falls to zero, or the yielding parts form a mechanism at constant displacement.
///
/// The springs of the parts start undeformed except for gravity, and are restored. Throws std::invalid_argument for a
/// structure with large rotations, without yielding parts, or with a part that yields under gravity alone, and like
/// StaticYielding; SolverError if no equilibrium is found.
PushPath push(const Structure& structure, const PushOptions& options);

}  // namespace pounding
