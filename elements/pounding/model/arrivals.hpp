#pragma once
/// Arrivals of a travelling wave at structures without a place in plan.

#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Places what has no place in plan where it meets drawn frames, by its links and devices, so that a wave along
/// `direction` reaches it there. A wall is the ground at each of its links: it gets a support for each arrival. Bodies,
/// oscillators and shear buildings get the position of the face that they meet, also through others of their kind.
/// Structures with a ground motion of their own stay as they are (`on_wave` false). Throws ModelError for a structure
/// along x that frames link to different arrivals.
void place_by_links(std::vector<Structure>& structures, std::vector<Link>& links, std::vector<Device>& devices,
                    const std::vector<bool>& on_wave, const Eigen::Vector3d& direction);

}  // namespace pounding
