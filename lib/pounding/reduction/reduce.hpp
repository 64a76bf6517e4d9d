#pragma once
/// Chooses the groups of a system that are reduced, and makes their modes.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include <pounding/linear/group_modes.hpp>
#include <pounding/model/reducible.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// A reduction for each group of a system; all empty for no reduction at all.
struct ReductionPlan {
  std::vector<std::string> names;  ///< of the structures, for messages
  std::vector<Reduction> groups;
  Eigen::VectorXd u, v;        ///< displacements [m] and velocities [m/s] from which the run starts
  double tolerance = 1e-4;     ///< of the run
  int deeper = 0;              ///< blocks of both chains beside those of the tolerance, where the depth is automatic
  std::string cache_folder{};  ///< folder of modes of earlier runs (CachedModes); empty for none
  bool requested = false;      ///< whether a reduction was asked for, even of structures that cannot be reduced
};

/// By group; nothing for all natural modes.
using ReducedGroups = std::vector<std::optional<ReducedGroup>>;

/// Unknowns with mass of a structure up to which all its modes are taken where they are asked for.
inline constexpr int max_natural_modes = 5000;

/// Unknowns with mass up to which `auto` takes all modes of a structure that it cannot reduce: in space a step by these
/// costs less than one by factors, and their set-up is some seconds.
inline constexpr int max_modes_instead = 2500;

/// The modes of the groups; nothing where the system is to be solved by sparse factors: a large group is not to be
/// reduced, or is automatic and its basis would be larger than half of its unknowns with mass, more than
/// max_modes_instead. Up to these a run that is made again goes over to all modes where its basis would be larger than
/// a third of them. Every process makes all of them, with the same bits.
///
/// Structures with equal masses and stiffness share what depends on these alone, such as factors; asked the same and
/// driven by equal links and grounds they share their modes. Each has the bits that it has by itself.
///
/// Parts that yield have two blocks of their own, and more in a run that is made again: a structure is reduced with up
/// to about a quarter as many of them as unknowns with mass. The shadow of a group is made of all but the last block of
/// the links that brought new directions, all but the last of what yields, and all but the last five of the ground. One
/// block of the links has none, and lowest modes have none.
///
/// Modes that were kept are taken from there, with the bits of those that were made, and new ones are kept.
///
/// Throws InputError, with the name of the structure and what to type, where numbers were given that cannot be kept or
/// all modes are too many; std::invalid_argument as ReducedModes.
std::optional<ReducedGroups> reduced_groups(const System& system, const ReductionPlan& plan);

/// The square of the circular frequency at which a contact of this system bounces, a power of 4 [rad^2/s^2]: of the
/// stiffest contact of a group, its slope at the penetration of an impact with 1 m/s over the masses at its ends. 0
/// where no contact has a slope.
double contact_shift(const System& system, const Group& group);

}  // namespace pounding::petsc
