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

/// A spring between two nodes that acts on the same displacement of both.
struct FrameSpring {
  int start = 0, end = 0;
  Dof dof = Dof::ux;
  double stiffness = 0;  ///< [N/m], [N m]
};

/// Equations of a frame in its n unknowns q, ordered by node: M q'' + C q' + K q = load_at_rest - load ag(t), relative
/// to the ground.
struct AssembledFrame {
  Eigen::SparseMatrix<double> mass, stiffness;  ///< T^T M T and T^T K T, n x n, symmetric
  Eigen::SparseMatrix<double> damping;          ///< n x n, of the dashpots [N s/m]
  Eigen::VectorXd load_at_rest;  ///< n, of the loads, and of the weights if assembled with gravity [N] (down is -z)
  /// T: all displacements of all nodes = T q; one row per node and degree of freedom. Rows are empty for supports, and
  /// for rotations at nodes connected only to trusses.
  Eigen::SparseMatrix<double, Eigen::RowMajor> transform;
  /// Contribution of support displacements: all displacements of all nodes = T q + supported * (all displacements).
  Eigen::SparseMatrix<double, Eigen::RowMajor> supported;
  /// n x 3, for ground motion along x, y, z: 1 for unknowns that are translations in this direction, else 0.
  Eigen::MatrixX3d influence;
  /// n x 3 [kg]: mass * influence, and with consistent masses also the mass coupling of the unknowns to the supports.
  Eigen::MatrixX3d load;
  std::vector<bool>
      massless;  ///< true if the row of the mass matrix is zero; the block of the other unknowns is regular
  std::vector<std::pair<int, Dof>> unknowns;  ///< node and degree of freedom of each unknown
  std::vector<Eigen::Vector3d> positions;     ///< of the nodes, before any shift of the frame [m]
  std::vector<std::string> node_names;        ///< for messages: the given name, or the number
  int dimension = 0;

  /// Number of unknowns.
  int size() const { return static_cast<int>(mass.rows()); }

  /// Row of T for a displacement of a node, or of a point on a rigid arm from the node (global axes [m]); length n. At
  /// the master of a rigid floor with a horizontal arm, ux and uy are those of any point of the floor. Throws
  /// std::invalid_argument for an unknown node or degree of freedom.
  Eigen::SparseVector<double> motion(int node, Dof dof, const Eigen::Vector3d& arm = Eigen::Vector3d::Zero()) const;
};

/// Builder for frames. Nodes and members are numbered from 0 in the order in which they are added.
///
/// All functions throw std::invalid_argument, naming the node or member (by its number if it has no name), for an index
/// out of range, a degree of freedom that a plane frame does not have (it has ux, uz, ry), and an invalid value.
class Frame {
 public:
  /// 2: plane frame in x and z; 3: in space.
  explicit Frame(int dimension);

  /// Numbers of nodes and members.
  int dimension() const { return dimension_; }
  int nodes() const { return static_cast<int>(positions_.size()); }
  int members() const { return static_cast<int>(members_.size()); }
  Eigen::Vector3d position(int node) const { return positions_[checked(node)] + shift_; }
  /// Nodes connected by a member.
  std::array<int, 2> ends(int member) const;
  const Beam& beam(int member) const { return of(member).beam; }
  /// Springs between two nodes, in the order in which they were added.
  const std::vector<FrameSpring>& springs() const { return between_; }
  /// Yielding ends, in the order in which they were added.
  const std::vector<Hinge>& hinges() const { return hinges_; }
  /// "beam x 1.0 start"; in space with the axis: "column 1.0.0 end z".
  std::string hinge_name(int hinge) const;
  /// 6EI/L: moment at this end for a unit rotation of both ends of the whole member, without shear deformation [N
  /// m/rad].
  double bending_stiffness(const Hinge& hinge) const;
  /// Sum of the masses along x added at each node [kg], without those of members.
  std::vector<double> masses_along_x() const;
  /// Nodes with a fixed displacement, followed by those with a spring to the ground, without duplicates.
  std::vector<int> grounded_nodes() const;
  /// True if a load was added at a node or on a member.
  bool is_loaded() const { return is_loaded_; }
  /// Name for messages: the given name, or the number.
  std::string node_name(int node) const;
  std::string member_name(int member) const;

  /// Moves the whole frame. The matrices do not depend on the shift: they are bitwise identical at every position. y
  /// must be 0 in a plane frame.
  void move_by(const Eigen::Vector3d& shift);
  /// Returns the number of the node. y must be 0 in a plane frame.
  int add_node(const Eigen::Vector3d& position, const std::string& name = "");
  /// Fixes these displacements to the ground.
  void fix(int node, const std::vector<Dof>& dofs);
  /// Fixes all displacements.
  void fix(int node);
  /// Returns the number of the member. In space, torsion, inertia_z and shear must be positive as well. In a plane
  /// frame, offsets and releases must be in the plane, and a reference vector is not allowed.
  int add_member(int start, int end, const Section& section, const Material& material, const BeamOptions& options = {});
  /// Adds a truss member: axial force only; it does not connect rotations. Rotations at nodes connected only to
  /// trusses are not unknowns. Uses area and material (young, density).
  int add_truss(int start, int end, double area, const Material& material);
  /// Lets an end of a member yield, and returns the number of the hinge. A spring in series becomes part of the member
  /// immediately. Also throws for a truss, a released end, a second hinge at the same place, and values out of range.
  int add_hinge(const Hinge& hinge);
  /// Name for messages.
  void set_name(int member, const std::string& name);
  /// [kg] in all translations.
  void add_mass(int node, double mass);
  /// [kg] or [kg m^2] in one degree of freedom.
  void add_mass(int node, Dof dof, double mass);
  /// Between the node and the ground [N/m] or [N m/rad].
  void add_spring(int node, Dof dof, double stiffness);
  /// Acts on the relative displacement of two nodes in one degree of freedom, without a lever arm even if they are
  /// apart.
  void add_spring(int node_a, int node_b, Dof dof, double stiffness);

  /// Between the node and the ground [N s/m] or [N m s]. Dashpots require mass at their degrees of freedom.
  void add_dashpot(int node, Dof dof, double coefficient);
  /// Acts on the relative displacement of two nodes in one degree of freedom.
  void add_dashpot(int node_a, int node_b, Dof dof, double coefficient);
  /// Static [N] or [N m].
  void add_load(int node, Dof dof, double force);
  /// Static, per length between the offsets, global axes [N/m]; adds to the loads of the member.
  void add_member_load(int member, const Eigen::Vector3d& per_length);
  /// Axial force of the geometric stiffness of a member, tension > 0 [N]. See BeamOptions.
  void set_axial_force(int member, double force);
  /// P-Delta: iterates the axial forces of all members in the state at rest until convergence (1e-10). Throws, without
  /// modifying the frame, if the frame buckles under its own loads. Between its nodes, a member bends only as its shape
  /// functions allow; buckling of a column within a storey requires intermediate nodes.
  void add_p_delta(bool gravity);

  // Constraints are exact: displacements of `node` are replaced by those of `master`, which may itself follow another
  // node. A displacement can be either fixed or tied once.

  /// Ties these displacements of the nodes.
  void tie(int master, int node, const std::vector<Dof>& dofs);
  /// Ties all displacements, as of a rigid body.
  void tie_rigidly(int master, int node);
  /// Rigid diaphragm: ux, uy, rz of the nodes follow those of the master; ux in a plane frame. The master may be any
  /// node of the floor, or an additional node whose uz, rx and ry are fixed.
  void tie_floor(int master, const std::vector<int>& nodes);

  /// Assembles the equations. With gravity, load_at_rest contains the weight of all masses, g = 9.80665 m/s^2.
  ///
  /// Throws std::invalid_argument for an unconnected node, a displacement that is both fixed and tied, cyclic
  /// constraints, an unknown with neither stiffness nor mass, masses that leave a rigid-body motion without inertia, a
  /// dashpot at a massless unknown, and a moment at a node connected only to trusses.
  AssembledFrame assemble(bool gravity = false) const;

  // The functions below require the unmodified frame from which `assembled` was created; q are its unknowns.

  /// Displacements at rest under load_at_rest: K q = load. Throws std::invalid_argument for a stiffness that is
  /// singular or not positive definite, naming a node and the displacement without stiffness.
  Eigen::VectorXd rest(const AssembledFrame& assembled) const;
  /// Throws like `rest` if the massless unknowns are unsupported for fixed other unknowns, because the accelerations
  /// then do not determine the motion. Required for dynamic analyses: massless mechanisms fail.
  void require_motion(const AssembledFrame& assembled) const;
  /// See Beam::end_forces; excludes the forces of loads between the ends of the member.
  Vector12 end_forces(int member, const AssembledFrame& assembled, const Eigen::VectorXd& q) const;
  /// 12 x n: end forces as factors of q.
  Eigen::SparseMatrix<double, Eigen::RowMajor> end_force_rows(int member, const AssembledFrame& assembled) const;
  /// 12 x 3: end forces for moving supports with the unknowns at rest, see SupportMotion::enforced.
  Eigen::Matrix<double, 12, 3> enforced_end_forces(int member, const Eigen::MatrixX3d& enforced) const;
  /// Fixed-end forces of the member load alone, and with gravity of its weight if its mass is consistent.
  Vector12 fixed_end_forces(int member, bool gravity = false) const;

  /// Forces of the ground on the frame at some nodes, one row per displacement, ordered by node: by_displacements times
  /// all displacements of all nodes, plus at_rest. Zero for displacements that are not supported.
  struct Reactions {
    std::vector<int> nodes;
    Eigen::SparseMatrix<double, Eigen::RowMajor> by_displacements;  ///< of members and springs [N/m], [N]
    Eigen::SparseMatrix<double, Eigen::RowMajor>
        by_forces;            ///< maps nodal forces of members with large rotations to the ground
    Eigen::VectorXd at_rest;  ///< due to loads, with gravity also due to weights [N], [N m]
  };
  /// `with_members` is false for members with large rotations: then only springs contribute.
  Reactions reactions(const std::vector<int>& nodes, const AssembledFrame& assembled, bool gravity,
                      bool with_members) const;
  /// Reactions for unit displacements of the supports along x, y, z with the unknowns at rest, see
  /// SupportMotion::enforced: rows x 3.
  Eigen::MatrixX3d enforced_reactions(const Reactions& reactions, const std::vector<int>& supports,
                                      const Eigen::MatrixX3d& enforced) const;

  /// Motion of a point between the ends of a member, and the effect of a force on it on the ends.
  struct PointOnMember {
    std::array<Eigen::SparseVector<double>, 3> motion;     ///< displacements along global x, y, z as factors of q
    std::array<Eigen::SparseVector<double>, 3> supported;  ///< contribution of SupportMotion::enforced, as factors
    /// Forces on the member ends, local axes, for a unit force along global x, y, z with fixed nodes.
    Eigen::Matrix<double, 12, 3> fixed_ends;
  };
  /// Point on the axis at `along` in [0, 1] between the ends of the offsets, by the shape functions of the member. A
  /// force there loads the unknowns with motion * force. The end forces are then end_force_rows * q + fixed_ends *
  /// force, and the deflection of the point relative to fixed nodes is additional to `motion`.
  PointOnMember point_on_member(int member, double along, const AssembledFrame& assembled) const;

  /// Response of the frame to a motion of some of its supports.
  struct SupportMotion {
    Eigen::MatrixX3d influence;  ///< n x 3: static displacements of the unknowns
    Eigen::MatrixX3d load;      ///< n x 3 [kg]: mass * influence, and the mass coupling of the unknowns to the supports
    Eigen::MatrixX3d enforced;  ///< all displacements of all nodes with the unknowns at rest
  };
  /// Response to a unit displacement, along x, y, z, of the supports at these nodes (fixed translations, and far ends
  /// of springs to the ground), with all others at rest. The sum over all supports is the rigid-body motion and
  /// AssembledFrame::load. Dashpots are not included: with different support motions they act on q', not on the
  /// enforced motion. Throws like `rest`.
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
  const Member& of(int member) const { return members_[checked_member(member)]; }
  Member& of(int member) { return members_[checked_member(member)]; }
  std::size_t checked_member(int member) const;
  std::string nodes_text(int start, int end) const;
  std::string node_text(int node) const { return "node " + node_name(node) + ": "; }
  std::string label(int at) const;  // of a displacement
  void require_not_negative(double value, int node, const char* what) const;
  int add_to_ground(Entries& entries, int node, Dof dof, double value, const char* what);
  void add_between(Entries& entries, int node_a, int node_b, Dof dof, double value, const std::string& what);
  int checked(int node) const;
  int index(int node, Dof dof) const;
  void follow(int node, Dof dof, int master, Row row);
  void follow_rigidly(int node, std::span<const Dof> dofs, int master, const Eigen::Vector3d& arm);
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
  std::set<int> fixed_, engaged_;      // displacements; the latter connected to more than trusses
  std::map<int, Row> follows_;         // displacement -> displacements of its master
};

/// Values of the columns or beams of a grid: one for all, one per storey from the ground up, or one per storey and
/// line.
template <class Value>
class ByStorey {
 public:
  ByStorey() : ByStorey(Value{}) {}
  ByStorey(const Value& all) : values_(1, std::vector<Value>(1, all)) {}
  ByStorey(const std::vector<Value>& by_storey) {
    for (const Value& value : by_storey) values_.emplace_back(1, value);
  }
  ByStorey(std::vector<std::vector<Value>> by_storey_and_line) : values_(std::move(by_storey_and_line)) {}

  /// Value in a storey (from 1) on a line (from 0).
  const Value& at(int storey, int line) const {
    const std::vector<Value>& of_storey = values_[values_.size() == 1 ? 0 : storey - 1];
    return of_storey[of_storey.size() == 1 ? 0 : line];
  }
  /// As given: [storey or 1][line or 1].
  const std::vector<std::vector<Value>>& values() const { return values_; }
  /// Throws std::invalid_argument for lists whose length is neither one nor the number of storeys and lines.
  void check(int storeys, int lines, const std::string& name) const;

 private:
  std::vector<std::vector<Value>> values_;
};

using GridSections = ByStorey<Section>;  ///< cross-sections of a grid
/// A member that may be subdivided into equal parts, with nodes between them at which it can bend and be hit.
struct CutMember {
  Section section;
  Material material;
  BeamOptions options{};                           ///< releases and offsets apply to the two outer ends
  Eigen::Vector3d load = Eigen::Vector3d::Zero();  ///< static, per length, global axes [N/m]
  int parts = 1;                                   ///< 1 to 100
};

/// Adds the parts of a member and the nodes between them, and returns the members. Several parts are named "name/1",
/// "name/2" ... from the start; each node has the name of the part that ends there. Throws std::invalid_argument like
/// Frame::add_member.
std::vector<int> add_member_in_parts(Frame& frame, const std::string& name, int start, int end,
                                     const CutMember& member);

/// A member of a grid that differs from the others.
struct GridMember {
  std::optional<Section> section{};
  std::optional<Material> material{};
  std::optional<BeamOptions> options{};            ///< releases, offsets and type of mass
  Eigen::Vector3d load = Eigen::Vector3d::Zero();  ///< static, per length, global axes [N/m]
  int parts = 1;                                   ///< see CutMember
};

/// A regular frame: columns on a grid, beams along x and y at every floor, fixed bases. SI units. Lists contain one
/// value for all, or one per item: storeys and floors from the ground up, bays from the origin. Nodes are named "S.I",
/// in space "S.I.K"; members "column S.I", "beam x S.I" and "beam y S.I.K" with the numbers of their upper or first
/// node; masters of rigid floors in space "floor S". Lines of columns are numbered along x, then along y; lines of
/// beams are those of their first columns.
struct GridFrame {
  int storeys = 1;
  int bays_x = 1;
  int bays_y = 0;                                                     ///< 0: plane frame
  std::vector<double> storey_height{}, bay_width_x{}, bay_width_y{};  ///< [m]
  GridSections column, beam;  ///< local z of beams points upwards, local y of columns along global y
  Material material;
  BeamMass mass = BeamMass::lumped;  ///< of the members, if the material has a density
  /// [kg] per floor, distributed to the nodes in proportion to their tributary widths; acts in all translations.
  std::vector<double> floor_mass{};
  ByStorey<double> beam_load{};  ///< vertical load on the beams, positive upwards [N/m]
  /// True if the beam load is the weight of a mass, which is added at the two nodes of each beam, in all translations.
  bool mass_from_loads = false;
  bool rigid_floors = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< base of the first column
  std::map<std::string, GridMember> members{};       ///< members that differ, by name

  /// Storey 0 is the ground; i numbers columns along x, k along y, all from 0. Throws std::invalid_argument outside the
  /// grid.
  int node(int storey, int i, int k = 0) const;
  /// Master of a rigid floor, storey >= 1: in space a separate node at the centre of mass of the floor, in a plane
  /// frame the first node of the floor.
  int floor(int storey) const;
  /// Numbers in the name of a node: "2.1", in space "2.1.0".
  std::string place(int storey, int i, int k = 0) const;
  /// Names of its members, in the order in which they are created.
  std::vector<std::string> member_names() const;
  /// Throws std::invalid_argument for more nodes than limits.hpp allows, or more than fit into memory.
  void require_affordable() const;
};

/// Throws std::invalid_argument for an invalid grid, naming the member.
Frame make_frame(const GridFrame& grid);

}  // namespace pounding
