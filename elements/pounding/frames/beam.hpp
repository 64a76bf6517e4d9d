#pragma once
/// A straight beam-column: stiffness, mass and geometric stiffness in closed form. SI units.
///
/// Three-dimensional throughout, z up. Forces and displacements of one node stand in the order of Dof; a member has
/// the six of its start, then the six of its end. A plane frame lies in x and z and keeps ux, uz, ry of each node: its
/// members bend about their local y only, and `in_plane` picks their rows out.

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace pounding {

/// Translations [m] and rotations [rad] of a node, rotations by the right-hand rule (a positive ry turns z into x).
enum class Dof : int { ux, uy, uz, rx, ry, rz };

/// Over the twelve displacements of a member, those of its start node first, each in the order of Dof; Matrix6 in the
/// plane.
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Cross-section in the local axes of the member, x along it. An infinite shear area means no shear deformation
/// (Euler-Bernoulli), a finite one Timoshenko's beam.
struct Section {
  double area = 0;       ///< [m^2]
  double inertia_y = 0;  ///< for bending about local y, the only bending in a plane frame [m^4]
  double inertia_z = 0;  ///< for bending about local z [m^4]
  double torsion = 0;    ///< St Venant's constant [m^4]
  double shear_area_y = std::numeric_limits<double>::infinity();  ///< for shear along local y [m^2]
  double shear_area_z = std::numeric_limits<double>::infinity();  ///< for shear along local z [m^2]
  double width = 0, depth = 0;  ///< outer dimensions along local y and z [m]; 0 for a section given by numbers
  bool is_round = false;

  bool has_size() const { return depth > 0; }  ///< whether its outer dimensions are known
};

/// Linear elastic.
struct Material {
  double young = 0;    ///< [Pa]
  double shear = 0;    ///< shear modulus [Pa]; unused in a plane frame without shear deformation
  double density = 0;  ///< [kg/m^3]; 0 when the masses are given at the nodes
};

/// lumped: half the mass to the translations of each node, rotations massless, offsets and releases without influence.
/// consistent: by the shape functions of the stiffness; turning of the section in bending carries no inertia, twisting
/// carries density (inertia_y + inertia_z).
enum class BeamMass { lumped, consistent };

/// How a member stands between its nodes, and what it lets go.
struct BeamOptions {
  /// A vector that local z leans to: local y is reference x local x, local z is local x x local y. By default global z,
  /// so that local y is horizontal and local z points upwards; for vertical members (to 1e-6) global -x, so that local
  /// y of a member going up is global y.
  std::optional<Eigen::Vector3d> reference{};
  /// From the node to the end of the member, rigid, global axes [m].
  Eigen::Vector3d start_offset = Eigen::Vector3d::Zero(), end_offset = Eigen::Vector3d::Zero();
  /// Forces that an end does not transmit, in local axes: {Dof::ry, Dof::rz} is a ball joint without the twist.
  std::vector<Dof> start_releases{}, end_releases{};
  /// Tension > 0 [N]. Not 0 adds the geometric stiffness of this constant force: the P-Delta effect with the bow of the
  /// member itself, without that of rigid offsets and without the change of its torsional stiffness.
  double axial_force = 0;
  BeamMass mass = BeamMass::lumped;
};

/// Local matrices (12 x 12, symmetric) of a member of this length [m]; exact for loads at the nodes. Shape functions
/// with phi = 12 EI/(G As L^2), zero for an infinite shear area; Przemieniecki, Theory of Matrix Structural Analysis,
/// 1968.
Matrix12 beam_stiffness(const Section& section, const Material& material, double length);
Matrix12 beam_mass(const Section& section, const Material& material, double length);
/// Geometric stiffness of a unit tensile force [1/m, 1, m].
Matrix12 beam_geometric_stiffness(const Section& section, const Material& material, double length);

/// The rows and columns ux, uz, ry of both ends.
Matrix6 in_plane(const Matrix12& matrix);

/// The local axes of a member in this direction as the rows of a rotation: local = axes * global. See BeamOptions.
/// Throws std::invalid_argument for a reference along the member.
Eigen::Matrix3d beam_axes(const Eigen::Vector3d& direction, const std::optional<Eigen::Vector3d>& reference = {});

/// A member between two nodes: its matrices in global axes and at the nodes.
class Beam {
 public:
  /// Throws std::invalid_argument: no length, a section or material that cannot carry (area, inertia_y and young must
  /// be positive, nothing negative), releases that leave a mechanism, an axial force under which the released ends
  /// buckle.
  Beam(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, const Section& section,
       const Material& material, const BeamOptions& options = {});
  /// A bar that carries axial force only, hinged at both ends even in twist, its mass lumped. Under tension it holds
  /// its ends across as a string does, N/L. Area and young must be positive.
  static Beam truss(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, double area,
                    const Material& material);

  /// Kind, section, material and options that the member was made with.
  bool is_truss() const { return is_truss_; }
  const Section& section() const { return section_; }
  const Material& material() const { return material_; }
  const BeamOptions& options() const { return options_; }
  /// See BeamOptions; throws std::invalid_argument as the constructor does.
  void set_axial_force(double force);
  double axial_force() const { return options_.axial_force; }
  /// Puts a spring between an end of the member and its node, on a rotation that is one of the places 4, 5 (start) and
  /// 10, 11 (end) among the twelve displacements [N m/rad]. It becomes a part of the member. Throws
  /// std::invalid_argument for another place, an end that does not transmit the moment, and an axial force under which
  /// the member buckles.
  void set_end_spring(int place, double stiffness);
  /// Whether this displacement of its ends, of twelve, transmits no force.
  bool is_released(int place) const;

  /// Between the ends of the offsets [m].
  double length() const { return length_; }
  const Eigen::Matrix3d& axes() const { return axes_; }
  /// Mass of the part between the offsets [kg].
  double total_mass() const { return material_.density * section_.area * length_; }

  /// With the geometric stiffness of the axial force, and the releases and springs of the ends condensed.
  Matrix12 stiffness() const;
  Matrix12 mass() const;
  /// Forces [N] and moments [N m] on the two ends of the member in local axes, from the displacements of its nodes in
  /// global axes.
  Vector12 end_forces(const Vector12& displacements) const;
  Matrix12 end_force_matrix() const;
  /// In local axes at the ends of the member, with releases and springs condensed.
  const Matrix12& local_stiffness() const { return local_stiffness_; }

  // Loads between the ends; the shape functions are exact for a member without axial force.

  /// Forces and moments on the two ends, local axes, of a load per length (global axes [N/m]) with the nodes held.
  Vector12 fixed_end_forces(const Eigen::Vector3d& per_length) const;
  /// Fixed-end forces of its own weight per unit of gravity [kg], [kg m], for a consistent mass; a lumped one hangs at
  /// the nodes.
  Vector12 fixed_end_forces_of_weight() const;
  /// Displacements of the point of the axis at `along` in [0, 1], global axes, from those of the nodes, the member
  /// without load between its ends.
  Eigen::Matrix<double, 3, 12> motion_at(double along) const;
  /// Forces and moments on the two ends, local axes, of a unit force along global x, y, z at that point, the nodes
  /// held.
  Eigen::Matrix<double, 12, 3> fixed_end_forces_at(double along) const;
  /// Forces on the nodes, global axes, that are equivalent to forces on the ends, local axes.
  Vector12 at_nodes(const Vector12& on_ends) const;

 private:
  Beam(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, const Section& section,
       const Material& material, const BeamOptions& options, bool is_truss);

  Eigen::Matrix<double, 3, 12> shape_at(double along) const;
  void condense(double axial_force);

  Section section_;
  Material material_;
  BeamOptions options_;
  bool is_truss_;
  double length_;
  Eigen::Matrix3d axes_;
  std::vector<std::pair<int, double>> end_springs_;  // place and stiffness
  Matrix12 follow_;           // displacements of all ends from those that are not released, through the springs
  Matrix12 local_stiffness_;  // releases and springs condensed
  Matrix12 to_local_;         // displacements of the nodes, global -> of the member's ends, local
};

}  // namespace pounding
