#pragma once
/// A frame with its floors, its supports and what is reported of it: all that a structure is made of. SI units.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <pounding/frames/frame.hpp>
#include <pounding/ground/components.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {

/// One floor: the nodes that links and reports mean by its number.
struct FrameFloor {
  std::string label;
  std::vector<int> nodes;
  double elevation = 0;  ///< above the common datum [m]
  int master =
      -1;  ///< of a rigid floor: a node of its own in space, the floor's first node in the plane; -1: not rigid
};

/// Supports that the ground moves alike.
struct FrameSupport {
  std::string name{};  ///< for messages; empty for those without a motion of their own
  std::vector<int> nodes{};
  double delay = 0;                          ///< the ground moves later here [s]
  std::optional<GroundComponents> motion{};  ///< of its own instead of the model's
};

/// An isolator between the ground and a node, along one horizontal axis. Its other displacements are held as by any
/// support.
struct FrameIsolator {
  int node = 0;
  Dof along = Dof::ux;  ///< ux, or uy in space
  IsolatorOptions options{};
};

/// How the displacements of a frame change its stiffness.
enum class FrameGeometry {
  linear,       ///< not at all
  p_delta,      ///< by the constant forces that its members carry at rest
  corotational  ///< members turn by large angles
};

/// A frame and what is said about it beside its members.
struct FrameModel {
  Frame frame{2};
  std::vector<FrameFloor> floors{};  ///< from the ground up
  /// Supports with a delay or a motion of their own. All other nodes that the ground holds, by a fixed displacement or
  /// a spring, move together; they may be given here too, without a name, as the first.
  std::vector<FrameSupport> supports{};
  std::vector<FrameIsolator> isolators{};
  std::optional<std::vector<int>> reported_nodes{};  ///< all of a frame of at most 100 nodes where nothing is said
  std::vector<int> reported_members{};
  FrameGeometry geometry = FrameGeometry::linear;
  /// Whether the weights of the masses act; where nothing is said they do beside loads, and for p_delta.
  std::optional<bool> gravity{};
  /// Nothing holds it to the ground, and it may move as a rigid body. It takes no loads, and nothing turns by large
  /// angles.
  bool is_free = false;
  /// The nodes from this one on are masters that make_floor_rigid has added in space; -1 for none.
  int first_master = -1;

  /// Moves the whole frame, floors and all; see Frame::move_by.
  void move_by(const Eigen::Vector3d& shift);
  /// Number of nodes without the masters of rigid floors in space.
  int given_nodes() const { return first_master < 0 ? frame.nodes() : first_master; }
  /// The nodes among them that the ground holds, in the order of reactions.
  std::vector<int> held_nodes() const;
  bool has_gravity() const;
  /// Whether weights or loads act at rest.
  bool is_loaded() const;
  /// Throws std::invalid_argument for p_delta where nothing acts at rest.
  void check_geometry() const;
};

/// Lets the nodes of a floor keep their distances in its plane. In space they follow a master that is added at the
/// centre of their masses along x; where these are zero, of `weights`, one a node, equal ones unless given. To be
/// called when all masses and all other nodes are there. Throws std::invalid_argument for a floor that is not level,
/// and as Frame::tie_floor does.
void make_floor_rigid(FrameModel& model, int floor, const std::vector<double>& weights = {});

/// Parts of a grid that add_grid leaves to its caller.
struct GridParts {
  std::vector<int> feet;        ///< nodes on the ground, to be held
  std::vector<double> weights;  ///< of the nodes of every floor: their shares of its mass
};

/// Adds nodes, members, masses and floors of a grid to a model, whose feet still stand free and whose floors are not
/// rigid yet. A caller that adds more nodes leaves the origin at 0 and moves the whole model at last, so that its
/// matrices have no rounding of places. Throws std::invalid_argument as make_frame does.
GridParts add_grid(FrameModel& model, const GridFrame& grid);

/// A grid with fixed feet and its floors, rigid ones where the grid says so. Throws std::invalid_argument as make_frame
/// does.
FrameModel make_frame_model(const GridFrame& grid);

}  // namespace pounding
