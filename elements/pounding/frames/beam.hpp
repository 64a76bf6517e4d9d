#pragma once
/// A straight beam-column: stiffness, mass and geometric stiffness in closed form. SI units.
///
/// Three-dimensional throughout, z up. Forces and displacements of a node are in the order of Dof; those of a member
/// are the six of its start, then the six of its end. A plane frame is in the x-z plane and uses ux, uz, ry of each
/// node: its members bend only about their local y, and `in_plane` extracts the corresponding rows and columns.

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pounding {

struct SectionFibres;

/// Translations [m] and rotations [rad] of a node, rotations by the right-hand rule (a positive ry rotates z towards
/// x).
enum class Dof : int { ux, uy, uz, rx, ry, rz };

/// Matrices of the twelve displacements of a member, start node first, each in the order of Dof; Matrix6 in the plane.
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Cross-section in the local axes of the member, with x along it. An infinite shear area neglects shear deformation
/// (Euler-Bernoulli beam); a finite one includes it (Timoshenko beam).
struct Section {
  double area = 0;       ///< [m^2]
  double inertia_y = 0;  ///< for bending about local y, the only bending in a plane frame [m^4]
  double inertia_z = 0;  ///< for bending about local z [m^4]
  double torsion = 0;    ///< St Venant's constant [m^4]
  double shear_area_y = std::numeric_limits<double>::infinity();  ///< for shear along local y [m^2]
  double shear_area_z = std::numeric_limits<double>::infinity();  ///< for shear along local z [m^2]
  double width = 0,
         depth = 0;  ///< outer dimensions along local y and z [m]; 0 if the section is defined by its properties
  bool is_round = false;
  double plastic_y = 0, plastic_z = 0;  ///< plastic moduli for bending about local y and z [m^3]; 0 if unknown
  /// Fibres whose initial stiffness the section has; null if it has none. Their material replaces that of the member.
  std::shared_ptr<const SectionFibres> fibres{};

  bool has_size() const { return depth > 0; }  ///< true if its outer dimensions are known
};

/// Linear elastic material.
struct Material {
  double young = 0;     ///< [Pa]
  double shear = 0;     ///< shear modulus [Pa]; unused in a plane frame without shear deformation
  double density = 0;   ///< [kg/m^3]; 0 if the masses are given at the nodes
  double strength = 0;  ///< yield strength, of steel [Pa]; 0 if unknown
};

/// lumped: half the mass on the translations of each node, without rotational inertia; offsets and releases have no
/// effect. consistent: with the shape functions of the stiffness; the rotary inertia of bending is neglected, torsion
/// has density (inertia_y + inertia_z).
enum class BeamMass { lumped, consistent };

/// Orientation, offsets, releases and other options of a member.
struct BeamOptions {
  /// Vector that orients local z: local y is reference x local x, local z is local x x local y. Default: global z, so
  /// that local y is horizontal and local z points upwards; for vertical members (to 1e-6) global -x, so that local y
  /// of an upward member is global y.
  std::optional<Eigen::Vector3d> reference{};
  /// Rigid offset from the node to the end of the member, global axes [m].
  Eigen::Vector3d start_offset = Eigen::Vector3d::Zero(), end_offset = Eigen::Vector3d::Zero();
  /// Forces that an end does not transmit, in local axes: {Dof::ry, Dof::rz} is a ball joint that transmits torsion.
  std::vector<Dof> start_releases{}, end_releases{};
  /// Tension > 0 [N]. A nonzero value adds the geometric stiffness of this constant force: the P-Delta effect including
  /// the curvature of the member, without that of rigid offsets and without the change of the torsional stiffness.
  double axial_force = 0;
  BeamMass mass = BeamMass::lumped;
};

/// Local matrices (12 x 12, symmetric) of a member of this length [m]; exact for nodal loads. Shape functions with phi
/// = 12 EI/(G As L^2), zero for an infinite shear area; Przemieniecki, Theory of Matrix Structural Analysis, 1968.
Matrix12 beam_stiffness(const Section& section, const Material& material, double length);
Matrix12 beam_mass(const Section& section, const Material& material, double length);
/// Geometric stiffness of a unit tensile force [1/m, 1, m].
Matrix12 beam_geometric_stiffness(const Section& section, const Material& material, double length);

/// Rows and columns ux, uz, ry of both ends.
Matrix6 in_plane(const Matrix12& matrix);

/// Local axes of a member in this direction, as the rows of a rotation: local = axes * global. See BeamOptions. Throws
/// std::invalid_argument for a reference parallel to the member.
Eigen::Matrix3d beam_axes(const Eigen::Vector3d& direction, const std::optional<Eigen::Vector3d>& reference = {});

/// A member between two nodes: its matrices in global axes and at the nodes.
class Beam {
 public:
  /// Throws std::invalid_argument for a zero length, an invalid section or material (area, inertia_y and young must be
  /// positive, other values nonnegative), releases that create a mechanism, and an axial force under which the released
  /// ends buckle.
  Beam(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, const Section& section,
       const Material& material, const BeamOptions& options = {});
  /// A bar with axial force only, pinned at both ends and free in torsion, with lumped mass. Under tension N it has the
  /// transverse stiffness of a string, N/L. Area and young must be positive.
  static Beam truss(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, double area,
                    const Material& material);

  /// Type, section, material and options of the member.
  bool is_truss() const { return is_truss_; }
  const Section& section() const { return section_; }
  const Material& material() const { return material_; }
  const BeamOptions& options() const { return options_; }
  /// See BeamOptions; throws std::invalid_argument like the constructor.
  void set_axial_force(double force);
  double axial_force() const { return options_.axial_force; }
  /// Inserts a rotational spring between an end of the member and its node, at index 4, 5 (start) or 10, 11 (end) of
  /// the twelve displacements [N m/rad]. The spring becomes part of the member. Throws std::invalid_argument for
  /// another index, a released end, and an axial force under which the member buckles.
  void set_end_spring(int place, double stiffness);
  /// True if this displacement of its ends, of twelve, is released.
  bool is_released(int place) const;

  /// Between the ends of the offsets [m].
  double length() const { return length_; }
  const Eigen::Matrix3d& axes() const { return axes_; }
  /// Displacements of the ends in local axes, for displacements of the nodes in global axes.
  const Matrix12& to_local() const { return to_local_; }
  /// Mass between the offsets [kg].
  double total_mass() const { return material_.density * section_.area * length_; }

  /// With the geometric stiffness of the axial force; releases and end springs are condensed.
  Matrix12 stiffness() const;
  Matrix12 mass() const;
  /// Forces [N] and moments [N m] on both ends of the member in local axes, for displacements of its nodes in global
  /// axes.
  Vector12 end_forces(const Vector12& displacements) const;
  Matrix12 end_force_matrix() const;
  /// In local axes at the ends of the member, with releases and springs condensed.
  const Matrix12& local_stiffness() const { return local_stiffness_; }

  // Loads between the ends; the shape functions are exact for a member without axial force.

  /// Forces and moments on both ends, local axes, for a load per length (global axes [N/m]) with fixed nodes.
  Vector12 fixed_end_forces(const Eigen::Vector3d& per_length) const;
  /// Fixed-end forces of the weight of the member per unit of gravity [kg], [kg m], for a consistent mass. A lumped
  /// mass acts at the nodes.
  Vector12 fixed_end_forces_of_weight() const;
  /// Displacements of the point on the axis at `along` in [0, 1], global axes, for displacements of the nodes, without
  /// load between the ends.
  Eigen::Matrix<double, 3, 12> motion_at(double along) const;
  /// Forces and moments on both ends, local axes, for a unit force along global x, y, z at that point, with fixed
  /// nodes.
  Eigen::Matrix<double, 12, 3> fixed_end_forces_at(double along) const;
  /// Equivalent nodal forces, global axes, of forces on the ends, local axes.
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
  std::vector<std::pair<int, double>> end_springs_;  // index and stiffness
  Matrix12 follow_;           // maps unreleased displacements to all end displacements, including springs
  Matrix12 local_stiffness_;  // releases and springs condensed
  Matrix12 to_local_;         // displacements of the nodes, global -> of the member ends, local
};

}  // namespace pounding
