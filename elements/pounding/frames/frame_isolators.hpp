#pragma once
/// Isolators of a frame as yielding parts.

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Adds the isolators to an otherwise complete model: each is added to the frame as a spring with the initial stiffness
/// of its law. If a law requires a weight that is not given, it is the load at rest of its node, from the members and
/// weights before p_delta.
///
/// Throws std::invalid_argument, starting with "isolator NAME: ", for invalid parameters of the law, an isolator in
/// tension or without vertical support, a weight that cannot be determined, coupled isolators in space, a corotational
/// frame, and supports with different motions.
void place_isolators(FrameModel& model);

/// Adds the isolators to a structure with known state at rest, internal forces and hinges. Also throws for a massless
/// node and for an isolator that yields at rest.
void let_isolators_yield(const FrameModel& model, const AssembledFrame& frame, const Frame::Reactions& reactions,
                         Structure& s);

}  // namespace pounding
