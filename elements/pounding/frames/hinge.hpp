#pragma once
/// Ends of members at which bending yields. SI units.

#include <optional>

#include <pounding/hysteresis/entry.hpp>

namespace pounding {

/// Which end of a member.
enum class MemberEnd { start, end };
/// The local axis that a member bends about; in the plane it is y.
enum class BendingAxis { y, z };

/// One end of a member that yields in bending about one of its local axes; two axes of one end do not know of each
/// other. The moment is the end moment that InternalForces reports, with its sign: `yield_moment` where the member sags
/// there, with tension on the side that its local z (about y) or y (about z) leaves; `hogging_moment` where it hogs.
///
/// `hardening` a is the ratio of the member end in every form: a member that yields at both ends in double curvature
/// keeps this fraction of its stiffness.
///
/// Rigid-plastic, with neither stiffness nor stiffness_factor: no rotation below the yield moment, and above it the
/// moment rises by h = a 6EI/L/(1 - a) [N m/rad] with the plastic rotation. It adds nothing to the stiffness of the
/// frame (force analogy: Wong & Yang 1999).
///
/// A spring in series with the member, with a stiffness or a stiffness_factor: the moment follows its law, and its
/// first stiffness k makes the member softer. The spring keeps the fraction b = a/(1 + n (1 - a)) of k with n = k L/6EI
/// (Ibarra & Krawinkler 2005), or `spring_hardening` = b is given instead.
struct Hinge {
  int member = 0;
  MemberEnd at = MemberEnd::start;
  BendingAxis about = BendingAxis::y;
  double yield_moment = 0;                    ///< > 0, unless there is a law [N m]
  std::optional<double> hogging_moment{};     ///< > 0; the same unless given [N m]
  double hardening = 0;                       ///< a in [0, 1) [-]
  std::optional<double> ultimate_rotation{};  ///< plastic rotation that it can bear, for reports [rad]
  double stiffness = 0;                       ///< of a spring in series [N m/rad]
  double stiffness_factor = 0;                ///< or as a multiple of 6EI/L [-]
  /// L of the member that this one is a part of, where it was cut; 0: its own length [m].
  double member_length = 0;
  std::optional<double> spring_hardening{};  ///< b in [0, 1) of a spring in series, instead of hardening [-]
  /// Law of a spring in series instead of a bilinear one, in the words of make_hinge() and without its stiffness; with
  /// `hardening` or `spring_hardening`. Its yield_moment is that of sagging if there is a negative_yield_moment, too.
  std::optional<hysteresis::Settings> law{};

  /// Whether it has no stiffness of its own.
  bool is_rigid_plastic() const { return stiffness == 0 && stiffness_factor == 0; }
  /// Place of its moment among the twelve end forces of a member.
  int place() const { return (at == MemberEnd::start ? 0 : 6) + (about == BendingAxis::y ? 4 : 5); }
  /// Whether sagging is a positive moment on this end.
  bool sags_positive() const { return (at == MemberEnd::start) == (about == BendingAxis::y); }
};

}  // namespace pounding
