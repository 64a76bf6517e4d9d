#pragma once
/// Arrival times of a travelling wave at structures without a position in plan.

#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Derives positions in plan for structures without one, from their links and devices to drawn frames, so that a wave
/// along `direction` reaches them there. A wall is the ground at each of its links: it gets a support per arrival time.
/// Bodies, oscillators and shear buildings get the position of the face that they meet, possibly through others of
/// their kind. Structures with their own ground motion are unchanged (`on_wave` false). Throws ModelError for a
/// structure along x that frames link to different arrival times.
void place_by_links(std::vector<Structure>& structures, std::vector<Link>& links, std::vector<Device>& devices,
                    const std::vector<bool>& on_wave, const Eigen::Vector3d& direction);

}  // namespace pounding
