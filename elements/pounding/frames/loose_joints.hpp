#pragma once
/// Joints of frames that become mechanisms once all member ends connected to them have yielded.

#include <vector>

#include <pounding/frames/frame.hpp>

namespace pounding {

/// Fraction of its elastic stiffness that a hinge without hardening retains at such a joint, which would otherwise
/// rotate freely. Moments increase by this fraction of the ductility.
inline constexpr double min_hardening = 1e-8;

/// For each hinge, true if its joint can rotate and all member ends there are released or have hinges about all axes
/// without post-yield stiffness, as given by `keeps_nothing` per hinge.
std::vector<bool> at_loose_joints(const Frame& frame, const AssembledFrame& assembled,
                                  const std::vector<bool>& keeps_nothing);

}  // namespace pounding
