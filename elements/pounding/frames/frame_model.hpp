#pragma once
/// A frame with its floors, supports and reported quantities: the input of a structure. SI units.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pounding/frames/frame.hpp>
#include <pounding/ground/components.hpp>
#include <pounding/structures/isolators.hpp>

namespace pounding {

namespace sections {
class FibreSection;
}
struct FibreMemberOptions;

/// A floor: the nodes that links and reports refer to by its number.
struct FrameFloor {
  std::string label;
  std::vector<int> nodes;
  double elevation = 0;  ///< above the common datum [m]
  int master =
      -1;  ///< of a rigid floor: a separate node in space, the first node of the floor in the plane; -1: not rigid
};

/// Supports with a common ground motion.
struct FrameSupport {
  std::string name{};  ///< for messages; empty for those with the common motion
  std::vector<int> nodes{};
  double delay = 0;                          ///< delay of the ground motion [s]
  std::optional<GroundComponents> motion{};  ///< separate motion, instead of that of the model
};

/// An isolator between the ground and a node, along x, and y in space. The other displacements of the node need
/// ordinary supports.
struct FrameIsolator {
  int node = 0;
  IsolatorOptions options{};
};

/// A spring between the ground and a node along uz that acts in compression only.
struct FrameUplift {
  int node = 0;
  double stiffness = 0;  ///< > 0 [N/m]
};

/// A member that yields along its length. Its section is of fibres (Section::fibres).
struct FrameFibres {
  int member = 0;
  std::shared_ptr<const FibreMemberOptions> options{};
};

/// Effect of the displacements of a frame on its stiffness.
enum class FrameGeometry {
  linear,       ///< none
  p_delta,      ///< by the constant axial forces of its members at rest
  corotational  ///< large rotations of members
};

/// A frame and its properties other than members.
struct FrameModel {
  Frame frame{2};
  std::vector<FrameFloor> floors{};  ///< from the ground up
  /// Supports with a delay or a separate motion. All other nodes with a fixed displacement or a spring to the ground
  /// move together; they may be given here as well, as the first item without a name.
  std::vector<FrameSupport> supports{};
  std::vector<FrameIsolator> isolators{};
  std::vector<FrameUplift> uplifts{};
  std::vector<FrameFibres> fibres{};
  std::optional<std::vector<int>> reported_nodes{};  ///< default: all nodes of a frame with at most 100 nodes
  std::vector<int> reported_members{};
  FrameGeometry geometry = FrameGeometry::linear;
  /// True if the weights of the masses act. Default: true with loads and for p_delta.
  std::optional<bool> gravity{};
  /// True for a frame without supports, which may move as a rigid body. Loads and corotational geometry are not
  /// allowed.
  bool is_free = false;
  /// Number of the first master added by make_floor_rigid in space; -1 if there are none.
  int first_master = -1;

  /// Key that makes the forces of members nonlinear: "geometry: corotational" or "fibres"; empty if they are linear.
  std::string nonlinear_key() const {
    if (!fibres.empty()) return "fibres";
    return geometry == FrameGeometry::corotational ? "geometry: corotational" : "";
  }
  /// True if the forces of its members are linear in the displacements, apart from hinges.
  bool is_linear() const { return nonlinear_key().empty(); }

  /// Moves the whole frame including its floors; see Frame::move_by.
  void move_by(const Eigen::Vector3d& shift);
  /// Number of nodes without the masters of rigid floors in space.
  int given_nodes() const { return first_master < 0 ? frame.nodes() : first_master; }
  /// Supported nodes among them, in the order of reactions.
  std::vector<int> held_nodes() const;
  bool has_gravity() const;
  /// True if weights or loads act at rest.
  bool is_loaded() const;
  /// Throws std::invalid_argument for p_delta without loads at rest.
  void check_geometry() const;
};

/// Rigid diaphragm constraint for a floor. In space, its nodes follow a master that is added at the centre of
/// their masses along x. If these are zero, `weights` are used, one per node, equal by default. Requires that all
/// masses and all other nodes have been added. Throws std::invalid_argument for a floor that is not level, and like
/// Frame::tie_floor.
void make_floor_rigid(FrameModel& model, int floor, const std::vector<double>& weights = {});

/// Data of a grid that add_grid leaves to the caller.
struct GridParts {
  std::vector<int> feet;              ///< nodes on the ground, to be supported
  std::vector<double> weights;        ///< of the nodes of every floor: their fractions of its mass
  std::vector<double> loaded_mass{};  ///< per node: mass whose weight the beam load contains [kg]; empty if none
};

/// Prevents that the weight of masses from loads acts twice: adds the opposite forces, if the weights of masses act.
/// Call it once the gravity of the model is known.
void balance_loaded_mass(FrameModel& model, const GridParts& parts);

/// Adds nodes, members, masses and floors of a grid to a model, without supports and without rigid floors. A caller
/// that adds more nodes sets the origin to 0 and moves the whole model at the end, so that its matrices are free of the
/// round-off of coordinates. Throws std::invalid_argument like make_frame.
GridParts add_grid(FrameModel& model, const GridFrame& grid);

/// A grid with fixed bases and its floors, rigid if requested. Throws std::invalid_argument like make_frame.
FrameModel make_frame_model(const GridFrame& grid);

}  // namespace pounding
