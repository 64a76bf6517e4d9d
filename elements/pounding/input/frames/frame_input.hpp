#pragma once
/// The input of a frame, as it stands under `frame:`.

#include <string>
#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// A frame as it was read, and where its nodes, members, hinges and isolators stand in the file.
struct FrameInput {
  FrameModel model;
  std::vector<Input> node_locations, member_locations, hinge_locations, isolator_locations;
};

/// Reads and checks everything that needs no matrices. Throws InputError at the place of what is wrong.
///
/// Loads act whenever they are given; `gravity` says whether the weights act too. The origin is added to the elevations
/// of floors as well.
FrameInput read_frame(const Input& body);

/// Reads a frame and makes its structure. Throws InputError at the place of what is wrong: of a node, a member or a
/// hinge where the frame names one, else at the frame.
Structure read_frame_structure(const Input& body);

}  // namespace pounding
