#pragma once
/// Linear frames of beams, springs and masses with exact constraints, plane (x, z) or in space (z up). SI units.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <pounding/beam.hpp>

namespace pounding {

/// The equations of a frame in its unknowns q, n of them, node by node: M q'' + K q = -load ag(t), relative to the ground.
struct AssembledFrame {
  Eigen::SparseMatrix<double> mass, stiffness;  ///< T^T M T and T^T K T, n x n, symmetric
  /// T, all displacements of all nodes = T q; one row a node and degree of freedom, those of supports are empty.
  Eigen::SparseMatrix<double, Eigen::RowMajor> transform;
  /// n x 3, for ground motion along x, y, z: 1 at the unknowns that are translations in this direction, else 0.
  Eigen::MatrixX3d influence;
  /// n x 3 [kg]: mass * influence, and with consistent masses also what couples the unknowns to the supports.
  Eigen::MatrixX3d load;
  std::vector<bool> massless;  ///< the unknown's row of the mass matrix is zero; the block of the others is regular
  std::vector<std::pair<int, Dof>> unknowns;  ///< the node and degree of freedom that each unknown is
  std::vector<Eigen::Vector3d> positions;     ///< of the nodes [m]
  int dimension = 0;

  int size() const { return static_cast<int>(mass.rows()); }

  /// The row of T for a displacement of a node, or for that of a point on a rigid arm from the node (global axes [m]);
  /// length n. At the master of a rigid floor with a horizontal arm, ux and uy are those of any point of the floor.
  /// Throws std::invalid_argument for a node or a degree of freedom that is not there.
  Eigen::SparseVector<double> motion(int node, Dof dof, const Eigen::Vector3d& arm = Eigen::Vector3d::Zero()) const;
};

/// Builds a frame by code. Nodes and members are numbered from 0 in the order they are added.
///
/// Every function throws std::invalid_argument, with the node or member in its text, for an index that is not there, a
/// degree of freedom that a plane frame has not (it has ux, uz, ry), and a value that cannot be.
class Frame {
 public:
  /// 2: plane frame in x and z; 3: in space.
  explicit Frame(int dimension);

  int dimension() const { return dimension_; }
  int nodes() const { return static_cast<int>(positions_.size()); }
  int members() const { return static_cast<int>(members_.size()); }
  const Eigen::Vector3d& position(int node) const { return positions_[checked(node)]; }

  /// Returns the number of the node. y is 0 in a plane frame.
  int add_node(const Eigen::Vector3d& position);
  /// Holds these to the ground.
  void fix(int node, const std::vector<Dof>& dofs);
  /// Holds all of them.
  void fix(int node);
  /// Returns the number of the member. In space torsion, inertia_z and shear must be positive as well; in a plane frame
  /// offsets and releases lie in the plane and there is no reference vector.
  int add_member(int start, int end, const Section& section, const Material& material, const BeamOptions& options = {});
  /// [kg] in every translation.
  void add_mass(int node, double mass);
  /// [kg] or [kg m^2] in one degree of freedom.
  void add_mass(int node, Dof dof, double mass);
  /// To the ground [N/m] or [N m/rad].
  void add_spring(int node, Dof dof, double stiffness);
  /// On the difference of the same displacement of two nodes; without a lever arm when they stand apart.
  void add_spring(int node_a, int node_b, Dof dof, double stiffness);

  // Constraints hold exactly: the displacements of `node` are replaced by those of `master`, which may follow another
  // node in turn. A displacement can follow only once and be fixed or follow, not both.

  /// The same displacement.
  void tie(int master, int node, const std::vector<Dof>& dofs);
  /// All displacements of a rigid body.
  void tie_rigidly(int master, int node);
  /// A floor rigid in its plane: ux, uy, rz of the nodes follow the master's; in a plane frame ux. The master may be any
  /// node of the floor or one more node, whose uz, rx and ry are then to be fixed.
  void tie_floor(int master, const std::vector<int>& nodes);

  /// Throws std::invalid_argument: a node that nothing is connected to, a displacement both fixed and following another,
  /// constraints in a circle, an unknown with neither stiffness nor mass, masses that leave a motion of a rigid body
  /// without inertia.
  AssembledFrame assemble() const;

  /// See Beam::end_forces; q are the unknowns of `assembled`.
  Vector12 end_forces(int member, const AssembledFrame& assembled, const Eigen::VectorXd& q) const;

 private:
  struct Member {
    int start, end;
    Beam beam;
  };
  using Row = std::vector<std::pair<int, double>>;  // displacement and factor

  int dofs() const { return dimension_ == 2 ? 3 : 6; }
  int checked(int node) const;
  int index(int node, Dof dof) const;
  void follow(int node, Dof dof, int master, Row row);
  Eigen::SparseMatrix<double, Eigen::RowMajor> transform(std::vector<std::pair<int, Dof>>& unknowns) const;
  Eigen::SparseMatrix<double> gathered(const std::vector<Eigen::Triplet<double>>& nodal,
                                       Matrix12 (Beam::*of_member)() const) const;

  int dimension_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Member> members_;
  std::vector<Eigen::Triplet<double>> springs_, masses_;
  std::set<int> connected_, fixed_;  // nodes; displacements
  std::map<int, Row> follows_;       // displacement -> displacements of its master
};

/// A regular frame: columns on a grid, beams along x and y at every floor, all feet fixed. SI units.
/// Lists hold one value for all, or one each: storeys and floors from the ground up, bays from the origin on.
struct GridFrame {
  int storeys = 1;
  int bays_x = 1;
  int bays_y = 0;  ///< 0: plane frame
  std::vector<double> storey_height{}, bay_width_x{}, bay_width_y{};  ///< [m]
  Section column, beam;  ///< local z of beams points upwards, local y of columns along global y
  Material material;
  BeamMass mass = BeamMass::lumped;  ///< of the members, when the material has a density
  /// [kg] a floor, shared by the nodes as their half bays on each side of the width; acts in every translation.
  std::vector<double> floor_mass{};
  bool rigid_floors = false;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< foot of the first column

  /// Storey 0 is the ground, i counts columns along x, k along y; all from 0. Throws std::invalid_argument outside the grid.
  int node(int storey, int i, int k = 0) const;
  /// The master of a rigid floor, storey >= 1: in space a node of its own at the centre of the floor's mass, in a plane
  /// frame the floor's first node.
  int floor(int storey) const;
};

/// Throws std::invalid_argument for a grid that cannot be, in the name of its member.
Frame make_frame(const GridFrame& grid);

}  // namespace pounding
