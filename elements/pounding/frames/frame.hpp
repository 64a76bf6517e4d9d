#pragma once
/// Linear frames of beams, springs and masses with exact constraints, plane (x, z) or in space (z up). SI units.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <pounding/frames/beam.hpp>
#include <pounding/frames/hinge.hpp>

namespace pounding {

/// "ux", "uy" ...
const char* name(Dof dof);
/// Degrees of freedom of a node in the plane (2) or in space (3), in the order of its unknowns.
std::span<const Dof> dofs_of(int dimension);

/// A spring between two nodes, on the same displacement of both.
struct FrameSpring {
  int start = 0, end = 0;
  Dof dof = Dof::ux;
  double stiffness = 0;  ///< [N/m], [N m]
};

/// The equations of a frame in its unknowns q, n of them, node by node: M q'' + C q' + K q = load_at_rest - load ag(t),
/// relative to the ground.
struct AssembledFrame {
  Eigen::SparseMatrix<double> mass, stiffness;  ///< T^T M T and T^T K T, n x n, symmetric
  Eigen::SparseMatrix<double> damping;          ///< n x n, of the dashpots [N s/m]
  Eigen::VectorXd load_at_rest;  ///< n, of the loads, and of the weights when assembled with gravity [N] (down is -z)
  /// T, all displacements of all nodes = T q; one row a node and degree of freedom. Those of supports are empty, and
  /// those of rotations that nothing but trusses meet.
  Eigen::SparseMatrix<double, Eigen::RowMajor> transform;
  /// Part that displacements of the supports add: all displacements of all nodes = T q + supported * (all
  /// displacements).
  Eigen::SparseMatrix<double, Eigen::RowMajor> supported;
  /// n x 3, for ground motion along x, y, z: 1 at the unknowns that are translations in this direction, else 0.
  Eigen::MatrixX3d influence;
  /// n x 3 [kg]: mass * influence, and with consistent masses also what couples the unknowns to the supports.
  Eigen::MatrixX3d load;
  std::vector<bool> massless;  ///< the unknown's row of the mass matrix is zero; the block of the others is regular
  std::vector<std::pair<int, Dof>> unknowns;  ///< the node and degree of freedom that each unknown is
  std::vector<Eigen::Vector3d> positions;     ///< of the nodes, before the frame was moved [m]
  std::vector<std::string> node_names;        ///< as in messages: the name that was given, or the number
  int dimension = 0;

  /// Number of unknowns.
  int size() const { return static_cast<int>(mass.rows()); }

  /// The row of T for a displacement of a node, or for that of a point on a rigid arm from the node (global axes [m]);
  /// length n. At the master of a rigid floor with a horizontal arm, ux and uy are those of any point of the floor.
  /// Throws std::invalid_argument for a node or a degree of freedom that is not there.
  Eigen::SparseVector<double> motion(int node, Dof dof, const Eigen::Vector3d& arm = Eigen::Vector3d::Zero()) const;
};

/// Builds a frame by code. Nodes and members are numbered from 0 in the order they are added.
///
/// Every function throws std::invalid_argument, with the node or member in its text (its name where one was given, else
/// its number), for an index that is not there, a degree of freedom that a plane frame has not (it has ux, uz, ry), and
/// a value that cannot be.
class Frame {
 public:
  /// 2: plane frame in x and z; 3: in space.
  explicit Frame(int dimension);

  /// Nodes and members that have been added so far.
  int dimension() const { return dimension_; }
  int nodes() const { return static_cast<int>(positions_.size()); }
  int members() const { return static_cast<int>(members_.size()); }
  Eigen::Vector3d position(int node) const { return positions_[checked(node)] + shift_; }
  /// The nodes that a member joins.
  std::array<int, 2> ends(int member) const;
  const Beam& beam(int member) const { return of(member).beam; }
  /// Springs between two nodes, in the order they were added.
  const std::vector<FrameSpring>& springs() const { return between_; }
  /// Ends that yield, in the order they were added.
  const std::vector<Hinge>& hinges() const { return hinges_; }
  /// "beam x 1.0 start", in space with the axis: "column 1.0.0 end z".
  std::string hinge_name(int hinge) const;
  /// 6EI/L, the moment at this end by a unit rotation of both ends alike, without shear deformation, of the whole
  /// member [N m/rad].
  double bending_stiffness(const Hinge& hinge) const;
  /// Sum of the masses along x that were added at each node [kg], without those of members.
  std::vector<double> masses_along_x() const;
  /// Nodes with a displacement that is fixed, then those with a spring to the ground, each once.
  std::vector<int> grounded_nodes() const;
  /// Whether a load was added, at a node or on a member.
  bool is_loaded() const { return is_loaded_; }
  /// Name in messages: the one that was given, or the number.
  std::string node_name(int node) const;
  std::string member_name(int member) const;

  /// Moves the whole frame. Frames that are built alike and then moved have equal matrices, to the last bit, wherever
  /// they stand. y is 0 in a plane frame.
  void move_by(const Eigen::Vector3d& shift);
  /// Returns the number of the node. y is 0 in a plane frame.
  int add_node(const Eigen::Vector3d& position, const std::string& name = "");
  /// Holds these to the ground.
  void fix(int node, const std::vector<Dof>& dofs);
  /// Holds all of them.
  void fix(int node);
  /// Returns the number of the member. In space torsion, inertia_z and shear must be positive as well; in a plane frame
  /// offsets and releases lie in the plane and there is no reference vector.
  int add_member(int start, int end, const Section& section, const Material& material, const BeamOptions& options = {});
  /// Carries axial force only; no rotation is connected by it, and a rotation that nothing else is connected to is no
  /// unknown. Takes area and material (young, density).
  int add_truss(int start, int end, double area, const Material& material);
  /// Lets an end of a member yield, and returns the number of the hinge. A spring in series becomes a part of the
  /// member at once. Throws also for a truss, an end that transmits no moment, a second hinge at one place, and numbers
  /// out of their range.
  int add_hinge(const Hinge& hinge);
  /// For messages.
  void set_name(int member, const std::string& name);
  /// [kg] in every translation.
  void add_mass(int node, double mass);
  /// [kg] or [kg m^2] in one degree of freedom.
  void add_mass(int node, Dof dof, double mass);
  /// To the ground [N/m] or [N m/rad].
  void add_spring(int node, Dof dof, double stiffness);
  /// On the difference of the same displacement of two nodes; without a lever arm when they stand apart.
  void add_spring(int node_a, int node_b, Dof dof, double stiffness);

  /// To the ground [N s/m] or [N m s]. Dashpots need mass where they act.
  void add_dashpot(int node, Dof dof, double coefficient);
  /// On the difference of the same displacement of two nodes.
  void add_dashpot(int node_a, int node_b, Dof dof, double coefficient);
  /// Static [N] or [N m].
  void add_load(int node, Dof dof, double force);
  /// Static, per length between the offsets, global axes [N/m]; adds to what the member carries.
  void add_member_load(int member, const Eigen::Vector3d& per_length);
  /// Axial force that the geometric stiffness of a member is made with from now on, tension > 0 [N]. See BeamOptions.
  void set_axial_force(int member, double force);
  /// P-Delta: sets the axial forces of all members from the state at rest until they do not change (1e-10). Throws, and
  /// changes nothing, when the frame buckles under its own loads. A column of one member bows between its nodes by its
  /// shape functions only; its own buckling between floors needs nodes there.
  void add_p_delta(bool gravity);

  // Constraints hold exactly: the displacements of `node` are replaced by those of `master`, which may follow another
  // node in turn. A displacement can follow only once and be fixed or follow, not both.

  /// Both nodes share these displacements.
  void tie(int master, int node, const std::vector<Dof>& dofs);
  /// All displacements of a rigid body.
  void tie_rigidly(int master, int node);
  /// A floor rigid in its plane: ux, uy, rz of the nodes follow the master's; in a plane frame ux. The master may be
  /// any node of the floor or one more node, whose uz, rx and ry are then to be fixed.
  void tie_floor(int master, const std::vector<int>& nodes);

  /// With gravity, load_at_rest has the weight of all masses, g = 9.80665 m/s^2.
  ///
  /// Throws std::invalid_argument: a node that nothing is connected to, a displacement both fixed and following
  /// another, constraints in a circle, an unknown with neither stiffness nor mass, masses that leave a motion of a
  /// rigid body without inertia, a dashpot at an unknown without mass, a moment where only trusses meet.
  AssembledFrame assemble(bool gravity = false) const;

  // All functions below are asked of the frame that `assembled` was made of, unchanged since; q are its unknowns.

  /// Displacements at rest under load_at_rest: K q = load. Throws std::invalid_argument for a stiffness that is
  /// singular or not positive, with a node and its displacement that give way.
  Eigen::VectorXd rest(const AssembledFrame& assembled) const;
  /// Throws as `rest` when the unknowns without mass are not held while the others rest: then the accelerations do not
  /// determine the motion. A frame that is to move is checked by this; one that hangs in a massless mechanism fails.
  void require_motion(const AssembledFrame& assembled) const;
  /// See Beam::end_forces; without the forces of the member's own load between its ends.
  Vector12 end_forces(int member, const AssembledFrame& assembled, const Eigen::VectorXd& q) const;
  /// 12 x n: the same as factors of q.
  Eigen::SparseMatrix<double, Eigen::RowMajor> end_force_rows(int member, const AssembledFrame& assembled) const;
  /// 12 x 3: the same when the supports move and the unknowns rest, see SupportMotion::enforced.
  Eigen::Matrix<double, 12, 3> enforced_end_forces(int member, const Eigen::MatrixX3d& enforced) const;
  /// End forces of the member's load alone with the nodes held, and of its weight with gravity, when its mass is
  /// consistent.
  Vector12 fixed_end_forces(int member, bool gravity = false) const;

  /// Forces that the ground exerts on the frame at some nodes, one row a displacement, node by node: by_displacements
  /// times all displacements of all nodes + at_rest. 0 at displacements that it does not hold.
  struct Reactions {
    std::vector<int> nodes;
    Eigen::SparseMatrix<double, Eigen::RowMajor> by_displacements;  ///< of members and springs [N/m], [N]
    Eigen::SparseMatrix<double, Eigen::RowMajor>
        by_forces;            ///< what members that turn pass on, from the nodes to the ground
    Eigen::VectorXd at_rest;  ///< by loads, with gravity also by weights [N], [N m]
  };
  /// Without `with_members` springs alone act, as where members turn.
  Reactions reactions(const std::vector<int>& nodes, const AssembledFrame& assembled, bool gravity,
                      bool with_members) const;
  /// Reactions when supports move by one along x, y, z and the unknowns rest, see SupportMotion::enforced: rows x 3.
  Eigen::MatrixX3d enforced_reactions(const Reactions& reactions, const std::vector<int>& supports,
                                      const Eigen::MatrixX3d& enforced) const;

  /// How a point between the ends of a member moves, and what a force on it does to the ends.
  struct PointOnMember {
    std::array<Eigen::SparseVector<double>, 3> motion;     ///< displacements along global x, y, z as factors of q
    std::array<Eigen::SparseVector<double>, 3> supported;  ///< and as factors of what SupportMotion::enforced adds to q
    /// Forces on the member's ends, local axes, of a unit force along global x, y, z with the nodes held.
    Eigen::Matrix<double, 12, 3> fixed_ends;
  };
  /// The point of the axis at `along` in [0, 1] between the ends of the offsets, by the member's own shape functions. A
  /// force there loads the unknowns with motion * force; then the end forces are end_force_rows * q + fixed_ends *
  /// force, and the point moves by what bends the member with its nodes held on top of `motion`.
  PointOnMember point_on_member(int member, double along, const AssembledFrame& assembled) const;

  /// Response of the frame to a motion of some of its supports.
  struct SupportMotion {
    Eigen::MatrixX3d influence;  ///< n x 3: where the unknowns go statically
    Eigen::MatrixX3d load;       ///< n x 3 [kg]: mass * influence, and what couples the unknowns to the supports
    Eigen::MatrixX3d enforced;   ///< all displacements of all nodes while the unknowns rest
  };
  /// When the supports at these nodes (fixed translations, and far ends of springs to the ground) move by one along x,
  /// y, z and all others rest. Summed over all supports they are the motion as a rigid body and AssembledFrame::load.
  /// Dashpots have no part in it: where supports differ they damp q', not the motion that the supports enforce. Throws
  /// as `rest`.
  SupportMotion support_motion(const std::vector<int>& nodes, const AssembledFrame& assembled) const;

 private:
  struct Member {
    int start, end;
    Beam beam;
    std::string name;
    Eigen::Vector3d load = Eigen::Vector3d::Zero();  // per length
  };
  using Row = std::vector<std::pair<int, double>>;  // displacement and factor

  using Entries = std::vector<Eigen::Triplet<double>>;

  int dofs() const { return dimension_ == 2 ? 3 : 6; }
  const Member& of(int member) const;
  Member& of(int member) { return const_cast<Member&>(std::as_const(*this).of(member)); }
  std::string nodes_text(int start, int end) const;
  std::string node_text(int node) const;
  std::string label(int at) const;  // of a displacement
  void require_not_negative(double value, int node, const char* what) const;
  void add_between(Entries& entries, int node_a, int node_b, Dof dof, double value);
  int checked(int node) const;
  int index(int node, Dof dof) const;
  void follow(int node, Dof dof, int master, Row row);
  bool is_loose(int at) const;
  void trace(AssembledFrame& frame) const;
  Eigen::SparseMatrix<double> gathered(const Entries& nodal, Matrix12 (Beam::*of_member)() const) const;
  Eigen::VectorXd loads() const;
  void check(const AssembledFrame& frame) const;
  std::string spring_against(const Eigen::VectorXd& displacements) const;
  [[noreturn]] void refuse_to_hold(const Eigen::VectorXd& mode, bool buckles, const AssembledFrame& frame) const;
  Eigen::SparseMatrix<double, Eigen::RowMajor> member_motion(
      int member, const Eigen::SparseMatrix<double, Eigen::RowMajor>& of_all) const;

  int dimension_;
  std::vector<Eigen::Vector3d> positions_;
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();
  std::vector<Member> members_;
  std::vector<Hinge> hinges_;
  std::vector<std::string> names_;  // of the nodes, empty for none
  Entries springs_, masses_, dashpots_;
  std::vector<FrameSpring> between_;
  std::vector<std::pair<int, double>> ground_springs_, loads_;  // at displacements
  bool is_loaded_ = false;
  std::set<int> connected_, trussed_;  // nodes
  std::set<int> fixed_, engaged_;      // displacements; that more than a truss acts on
  std::map<int, Row> follows_;         // displacement -> displacements of its master
};

/// Cross-sections of the columns or the beams of a grid: one for all, one for each storey from the ground up, or, for
/// each storey, one for each line.
class GridSections {
 public:
  GridSections() : GridSections(Section{}) {}
  GridSections(const Section& all) : sections_(1, std::vector<Section>(1, all)) {}
  GridSections(const std::vector<Section>& by_storey) {
    for (const Section& section : by_storey) sections_.emplace_back(1, section);
  }
  GridSections(std::vector<std::vector<Section>> by_storey_and_line) : sections_(std::move(by_storey_and_line)) {}

  /// That of a storey, from 1, on a line, from 0.
  const Section& at(int storey, int line) const;
  /// Throws std::invalid_argument for lists that are neither one long nor as long as there are storeys and lines.
  void check(int storeys, int lines, const std::string& name) const;

 private:
  std::vector<std::vector<Section>> sections_;  // [storey or 1][line or 1]
};

/// A member that may be cut into equal parts, with nodes between them: there it can bow, and a contact can hit it.
struct CutMember {
  Section section;
  Material material;
  BeamOptions options{};                           ///< releases and offsets are those of the two outer ends
  Eigen::Vector3d load = Eigen::Vector3d::Zero();  ///< static, per length, global axes [N/m]
  int parts = 1;                                   ///< 1 to 100
};

/// Adds the parts of a member and the nodes between them, and returns the members. Several parts are named "name/1",
/// "name/2" ... from the start on, and each node as the part that ends there. Throws std::invalid_argument as
/// Frame::add_member does.
std::vector<int> add_member_in_parts(Frame& frame, const std::string& name, int start, int end,
                                     const CutMember& member);

/// A member of a grid that differs from the others.
struct GridMember {
  std::optional<Section> section{};
  std::optional<Material> material{};
  std::optional<BeamOptions> options{};            ///< releases, offsets and kind of mass
  Eigen::Vector3d load = Eigen::Vector3d::Zero();  ///< static, per length, global axes [N/m]
  int parts = 1;                                   ///< see CutMember
};

/// A regular frame: columns on a grid, beams along x and y at every floor, all feet fixed. SI units.
/// Lists hold one value for all, or one each: storeys and floors from the ground up, bays from the origin on.
/// Its nodes are named "S.I", in space "S.I.K", its members "column S.I", "beam x S.I" and "beam y S.I.K" with the
/// numbers of their upper or first node, and the masters of rigid floors in space "floor S". Lines of columns are
/// counted along x, then along y; lines of beams along x are those of their first columns, and so are those along y.
struct GridFrame {
  int storeys = 1;
  int bays_x = 1;
  int bays_y = 0;                                                     ///< 0: plane frame
  std::vector<double> storey_height{}, bay_width_x{}, bay_width_y{};  ///< [m]
  GridSections column, beam;  ///< local z of beams points upwards, local y of columns along global y
  Material material;
  BeamMass mass = BeamMass::lumped;  ///< of the members, when the material has a density
  /// [kg] a floor, shared by the nodes as their half bays on each side of the width; acts in every translation.
  std::vector<double> floor_mass{};
  bool rigid_floors = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< foot of the first column
  std::map<std::string, GridMember> members{};       ///< those that differ, by their names

  /// Storey 0 is the ground, i counts columns along x, k along y; all from 0. Throws std::invalid_argument outside the
  /// grid.
  int node(int storey, int i, int k = 0) const;
  /// The master of a rigid floor, storey >= 1: in space a node of its own at the centre of the floor's mass, in a plane
  /// frame the floor's first node.
  int floor(int storey) const;
  /// Numbers in the name of a node: "2.1", in space "2.1.0".
  std::string place(int storey, int i, int k = 0) const;
  /// The names of its members, in the order in which they are made.
  std::vector<std::string> member_names() const;
  /// Throws std::invalid_argument for more nodes than limits.hpp allows, or than the machine has memory for.
  void require_affordable() const;
};

/// Throws std::invalid_argument for a grid that cannot be, in the name of its member.
Frame make_frame(const GridFrame& grid);

}  // namespace pounding
