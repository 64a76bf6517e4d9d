#pragma once
/// Selects the groups of a system to reduce, and computes their modes.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include <pounding/linear/group_modes.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// A reduction for each group of a system; all empty for no reduction.
struct ReductionPlan {
  std::vector<std::string> names;  ///< of the structures, for messages
  std::vector<Reduction> groups;
  Eigen::VectorXd u, v;        ///< initial displacements [m] and velocities [m/s]
  double tolerance = 1e-4;     ///< tolerance of the run
  int deeper = 0;              ///< extra blocks of both chains relative to the tolerance, if the depth is automatic
  std::string cache_folder{};  ///< directory of CachedModes; empty for none
  bool requested = false;      ///< true if a reduction was requested, even of structures that cannot be reduced
};

/// Maximum number of dynamic degrees of freedom of a structure for which all modes may be requested.
inline constexpr int max_natural_modes = 5000;

/// Maximum number of dynamic degrees of freedom up to which `auto` uses all modes of a structure that it cannot reduce.
/// In space, a step in these modes costs less than one with sparse factors, and setup takes a few seconds.
inline constexpr int max_modes_instead = 2500;

/// The modes of the groups, or nullopt if the system needs sparse factors. That is the case for a large group that is
/// not reduced, and for an automatic one with more than max_modes_instead dynamic degrees of freedom whose basis would
/// exceed half of them. Below that limit, a repeated run switches to all modes if its basis would exceed a third of
/// them. Every process computes all modes, bitwise identically.
///
/// Structures with equal masses and stiffness share results that depend on these only, such as factors. With equal
/// options, links and ground motions they share their modes. The result is bitwise identical to that of each structure
/// alone.
///
/// Yielding parts get two blocks, and more if the run is repeated. A structure is reduced if the number of yielding
/// parts is at most about a quarter of the number of dynamic degrees of freedom. The shadow of a group omits the last
/// block of the links that added directions, the last block of yielding parts, and the last five blocks of the ground.
/// A shadow is not computed with a single block of the links, or for lowest modes.
///
/// Cached modes are reused, bitwise identical to computed ones; new ones are stored.
///
/// Throws InputError, with the name of the structure and what to type, if given numbers cannot be satisfied or all
/// modes are too many; std::invalid_argument as ReducedModes.
std::optional<ReducedGroups> reduced_groups(const System& system, const ReductionPlan& plan);

/// Square of the circular frequency of bouncing contacts, a power of 4 [rad^2/s^2]. It follows from the stiffest
/// contact of the group: its slope at the penetration of a 1 m/s impact, divided by the masses at its ends. Zero if no
/// contact has a slope.
double contact_shift(const System& system, const Group& group);

}  // namespace pounding::petsc
