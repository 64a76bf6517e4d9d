#pragma once
/// The input of a frame, as it stands under `frame:`.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <pounding/frames/frame.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// One floor of the input: its label and its nodes.
struct FrameFloor {
  std::string label;
  std::vector<int> nodes;
  double elevation = 0;  ///< [m]
  int master = -1;       ///< of a rigid floor: a node of its own in space, the floor's first node in the plane
};

/// Supports that the ground moves alike.
struct FrameSupport {
  std::string name;  ///< the key of the input; empty for those without a motion of their own
  std::vector<int> nodes;
  double delay = 0;  ///< [s]
  std::optional<GroundComponents> motion{};
};

/// Between two nodes, on the same displacement of both.
struct FrameSpring {
  int start = 0, end = 0;
  Dof dof = Dof::ux;
  double stiffness = 0;  ///< [N/m], [N m]
};

/// A frame and what its input says about it.
struct FrameModel {
  Frame frame{2};
  int given_nodes = 0;  ///< the nodes from this one on are masters that a rigid floor in space has added
  std::vector<std::array<Eigen::Vector3d, 2>> offsets;  ///< of the members, see BeamOptions [m]
  std::vector<FrameSpring> springs;
  std::vector<FrameFloor> floors;      ///< from the ground up
  std::vector<FrameSupport> supports;  ///< one at least; first those without a motion of their own
  std::vector<int> reported_nodes, reported_members;
  bool gravity = false;  ///< the weights of the masses act
  bool loads = false;    ///< anything acts at rest: weights or loads
  bool p_delta = false;
  bool corotational = false;  ///< members turn by large angles
  /// Where the nodes and the members stand in the file, for messages.
  std::vector<Input> node_places, member_places;
};

/// Reads and checks everything that needs no matrices. Throws InputError at the place of what is wrong.
///
/// Loads act whenever they are given; `gravity` says whether the weights act too. The origin is added to the elevations
/// of floors as well. A rigid floor in space gets a master at the centre of its nodes' masses.
FrameModel read_frame(const Input& body);

/// Throws InputError for what the frame has refused, at the place of the node or member that the text begins with, else
/// at the frame.
[[noreturn]] void fail_at_part(const std::string& refusal, const FrameModel& model, const Input& body);

}  // namespace pounding
