#pragma once
/// Isolators under the feet of a frame, as parts of its structure that yield.

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Adds the isolators to a model that is complete otherwise: each becomes a spring of the frame with the first
/// stiffness of its law. A law that takes a weight and has none gets the load at rest of its foot, from the members and
/// weights as they are before p_delta.
///
/// Throws std::invalid_argument, beginning with "isolator NAME: ", for what the law refuses, a foot that is pulled up
/// or that nothing holds up, a weight that nothing tells, isolators in space that do not ask for each axis by itself,
/// members that turn by large angles, and supports that move differently.
void place_isolators(FrameModel& model);

/// Adds the isolators to a structure that has its state at rest, its internal forces and its hinges. Throws likewise
/// for a foot without mass and for an isolator that yields at rest.
void let_isolators_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                         Structure& s);

}  // namespace pounding
