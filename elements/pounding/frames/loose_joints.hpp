#pragma once
/// Joints of frames that nothing holds once all ends of members that meet there have yielded.

#include <vector>

#include <pounding/frames/frame.hpp>

namespace pounding {

/// Part of its elastic stiffness that a hinge keeps at such a joint where it was given none: the joint would turn
/// without end and without a moment. Moments grow by this part of the ductility.
inline constexpr double least_hardening = 1e-8;

/// For each hinge, whether it acts at a joint that can turn and that no end of a member holds any more: each one there
/// is released, or its hinges about all axes keep nothing after they yield, as `keeps_nothing` says of each hinge.
std::vector<bool> at_loose_joints(const Frame& frame, const AssembledFrame& assembled,
                                  const std::vector<bool>& keeps_nothing);

}  // namespace pounding
