#pragma once
/// Yielding member ends in bending. SI units.

#include <optional>
#include <variant>

#include <pounding/hysteresis/all.hpp>

namespace pounding {

/// End of a member.
enum class MemberEnd { start, end };
/// Local axis of bending; y in the plane.
enum class BendingAxis { y, z };

/// One end of a member that yields in bending about one of its local axes; the two axes of an end are independent. The
/// moment is the end moment reported by InternalForces, with its sign: `yield_moment` applies to sagging, with tension
/// on the side opposite to local z (bending about y) or y (about z); `hogging_moment` applies to hogging.
///
/// `hardening` a is always the ratio at the member end: a member that yields at both ends in double curvature retains
/// this fraction of its stiffness.
///
/// Rigid-plastic, without stiffness and stiffness_factor: no rotation below the yield moment; above it the moment
/// increases by h = a 6EI/L/(1 - a) [N m/rad] with the plastic rotation. The stiffness of the frame does not change
/// (force analogy: Wong & Yang 1999).
///
/// A spring in series with the member, with a stiffness or a stiffness_factor: the moment follows `law`, and its
/// initial stiffness k makes the member more flexible. The spring retains the fraction b = a/(1 + n (1 - a)) of k, n =
/// k L/6EI (Ibarra & Krawinkler 2005), or b is given as `spring_hardening`, or by the backbone of `law`.
struct Hinge {
  int member = 0;
  MemberEnd at = MemberEnd::start;
  BendingAxis about = BendingAxis::y;
  double yield_moment = 0;                    ///< > 0 [N m]
  std::optional<double> hogging_moment{};     ///< > 0, of a law that takes two; default: yield_moment [N m]
  double hardening = 0;                       ///< a in [0, 1) [-]
  std::optional<double> ultimate_rotation{};  ///< plastic rotation capacity, for reports [rad]
  double stiffness = 0;                       ///< of a spring in series [N m/rad]
  double stiffness_factor = 0;                ///< or as a multiple of 6EI/L [-]
  /// L of the whole member if this is a part of a subdivided one; 0: its own length [m].
  double member_length = 0;
  std::optional<double> spring_hardening{};  ///< b in [0, 1) of a spring in series, instead of hardening [-]
  /// Law of a spring in series; a rigid-plastic hinge is bilinear. The hinge sets its stiffness, its yield force and
  /// its hardening, which must be unset here: `{.yield_moment = 2e5, .law = hysteresis::BoucWen{.exponent = 1}}`.
  hysteresis::HingeLaw law = hysteresis::Bilinear{};

  /// True without a spring in series.
  bool is_rigid_plastic() const { return stiffness == 0 && stiffness_factor == 0; }
  /// True if sagging and hogging can have different yield moments.
  bool takes_two_moments() const {
    return std::visit([]<class L>(const L&) { return requires { &L::negative_yield_force; } || requires { &L::s1n; }; },
                      law);
  }
  /// True if the points of a backbone define the hardening, so that the hinge has none. p is sagging, n hogging.
  bool has_backbone() const {
    return std::visit([]<class L>(const L&) { return requires { &L::s1n; }; }, law);
  }
  /// Index of its moment among the twelve end forces of a member.
  int place() const { return (at == MemberEnd::start ? 0 : 6) + (about == BendingAxis::y ? 4 : 5); }
  /// True if sagging is a positive moment at this end.
  bool sags_positive() const { return (at == MemberEnd::start) == (about == BendingAxis::y); }
};

}  // namespace pounding
