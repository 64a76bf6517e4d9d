#pragma once
/// Structures that stand beside each other in plan, and links between all of them.

#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Structures farther apart are no neighbours, unless another distance is given: a street between them [m].
inline constexpr double usual_reach = 1;

/// Two structures with a side of the one beside a side of the other.
struct Neighbours {
  int left = 0, right = 0;  ///< their numbers; the first one has less x, or less y where they stand apart along y
  double distance = 0;      ///< between the two sides, in plan [m]
};

/// All neighbours among the structures that have a place in plan, as frames do, in the order of the structures. Two are
/// neighbours where they stand at most `within` [m] apart along x or along y, their sides have a length in common, and
/// no other structure stands between them. Two that meet at a corner are none. Throws ModelError for frames in space
/// that stand on each other.
std::vector<Neighbours> neighbours(const Model& model, double within = usual_reach);

/// Links all neighbours that no link joins yet, each pair as Model::link does it with `options.floors`, which is
/// FacingFloors::all unless given. Floors whose edges pass each other, or that are set back by more than `within` [m],
/// do not meet and get no link. Throws ModelError as Model::link does, for a name, which would be that of many pairs,
/// and where nothing is left to be linked.
void link_neighbours(Model& model, const LinkOptions& options, const ContactLaw& law, double within = usual_reach);

}  // namespace pounding
