#pragma once
/// The static path of a structure with parts that yield, from event to event.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// The load of a structure that is pushed, the displacement that is followed, and how far.
struct PushOptions {
  Eigen::VectorXd load;         ///< p, one value an unknown [N]; the factor of the load multiplies it
  Row control;                  ///< the displacement that is followed, in terms of the unknowns
  std::vector<double> targets;  ///< values of that displacement, reached one after the other [m]
  int smooth_steps = 400;       ///< to the farthest target, where the slope of a law changes everywhere
  Eigen::MatrixXd follow{};     ///< rows of the unknowns, displacements that are kept at every point
};

/// Equilibrium at one displacement.
struct PushPoint {
  double displacement = 0;  ///< [m]
  double factor = 0;        ///< of the load
  /// Of the yielding parts: deformations [m] or [rad], and forces on top of k times these [N] or [N m].
  Eigen::VectorXd deformations, forces;
  Eigen::VectorXd followed;  ///< other displacements that were asked for [m]
};

/// Something that happens to a part at a point of the path.
struct PushEvent {
  /// Change of a part that makes an event.
  enum class Kind {
    softens,  ///< its slope falls before its yield deformation, as where concrete cracks
    yields,
    unloads  ///< it turns back while it yields
  };
  int point = 0;  ///< number of the point
  int part = 0;   ///< number of the part
  Kind kind{};
  bool is_first = false;  ///< it had never yielded before
};

/// The path. Between two of its points it is a straight line where every law is piecewise linear.
struct PushPath {
  std::vector<PushPoint> points;  ///< the first at rest
  std::vector<PushEvent> events;  ///< in their order; of laws without corners only the first yield
  /// The first point after which the load would no longer rise if the parts that yield had no hardening: they, and
  /// joints, make a mechanism. Nothing where that does not come.
  std::optional<int> mechanism;
  std::vector<int> mechanism_parts;  ///< that yield then
  std::string collapse;              ///< why the path ends before the last target; empty where it does not
};

/// Pushes a structure by displacement control. Laws that are piecewise linear are followed exactly, to the next corner
/// of any part at each step; others by Newton's method in short steps, each of which is exact too while no part turns
/// back inside it. A falling load is followed. The path ends where no load holds the structure any more: it falls to
/// zero, or the parts that yield let it move while the displacement stays.
///
/// The springs of the parts start undeformed but for gravity, and are left so. Throws std::invalid_argument for a
/// structure that turns in large rotations, without parts, or one part of which yields under gravity alone, and as
/// StaticYielding; SolverError where no equilibrium is found.
PushPath push(const Structure& structure, const PushOptions& options);

}  // namespace pounding
