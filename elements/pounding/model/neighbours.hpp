#pragma once
/// Neighbouring structures in plan, and links between all of them.

#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Default maximum distance between neighbours; farther structures are separated by a street [m].
inline constexpr double usual_reach = 1;

/// Two structures with facing sides.
struct Neighbours {
  int left = 0, right = 0;  ///< indices; the first has smaller x, or smaller y if the two are apart along y
  double distance = 0;      ///< between the two sides, in plan [m]
};

/// All neighbours among the structures with a position in plan, such as frames, in the order of the structures. Two
/// structures are neighbours if they are at most `within` [m] apart along x or y, their sides overlap in a length, and
/// no other structure is between them. Two that meet at a corner are not. Throws ModelError for frames in space that
/// overlap in plan.
std::vector<Neighbours> neighbours(const Model& model, double within = usual_reach);

/// Links all neighbours that are not linked yet, each pair like Model::link with `options.floors`, by default
/// FacingFloors::all. Floors whose edges do not overlap, or that are set back by more than `within` [m], get no link.
/// Throws ModelError like Model::link, for a given name, which would be shared by many pairs, and if there is nothing
/// to link.
void link_neighbours(Model& model, const LinkOptions& options, const ContactLaw& law, double within = usual_reach);

}  // namespace pounding
