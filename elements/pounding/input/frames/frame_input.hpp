#pragma once
/// The `frame:` section of an input file.

#include <string>
#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// A frame as read, with the locations of its nodes, members, hinges and isolators in the file.
struct FrameInput {
  FrameModel model;
  std::vector<Input> node_locations, member_locations, hinge_locations, isolator_locations, uplift_locations;
};

/// Reads and checks everything that does not need matrices. Throws InputError with the location.
///
/// Loads always act; `gravity` adds the weights. The origin is also added to the elevations of floors.
FrameInput read_frame(const Input& body);

/// Reads the frame and creates its structure. Throws InputError at the node, member, hinge or isolator of the error,
/// else at the frame.
Structure read_frame_structure(const Input& body);

}  // namespace pounding
