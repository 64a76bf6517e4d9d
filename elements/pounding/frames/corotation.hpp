#pragma once
/// Deformations of a member in axes that rotate with the chord between its ends, and forces of them on its nodes.

#include <Eigen/Core>
#include <array>

#include <pounding/frames/beam.hpp>
#include <pounding/frames/finite_rotation.hpp>

namespace pounding {

/// Kinematics of a member with large rotations and small deformations.
///
/// Displacements are the twelve of Beam. In space, the rotations of a node are its rotation vector (Euler axis times
/// angle) from the undeformed state, whose angle must be below 2 pi. Moments are conjugate to its components, so they
/// are moments about fixed axes only if the vector keeps its direction. A plane member can rotate by any angle. The
/// rotation of an end relative to the chord must be below pi. Rigid offsets rotate with their node.
///
/// Plane: closed form, Crisfield, Non-linear Finite Element Analysis of Solids and Structures 1, 1991, ch. 7. In space:
/// axes from the chord and the mean local y of the ends, Battini & Pacoste, CMAME 191 (2002) 1755-1789, with the
/// tangent of the exact logarithm.
class Corotation {
 public:
  /// In space, deformations and conjugate forces: rotations of the start, elongation, rotations of the end.
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  using Matrix7 = Eigen::Matrix<double, 7, 7>;

  /// A plane member: x and z in global axes.
  struct Plane {
    double start_x, start_z, end_x, end_z;  // rotated offsets
    double x, z, length;                    // from end to end
    Eigen::Vector3d deformations;           ///< elongation, rotations of start and end about local y
  };
  struct Chord {
    Eigen::Vector3d arm_start, arm_end, direction;  // rotated offsets; unit vector
    double length, elongation;
  };
  /// A member in space; all vectors in the rotated axes.
  struct Space {
    using Matrix3x12 = Eigen::Matrix<double, 3, 12>;
    Chord chord;
    Eigen::Matrix3d axes;  // columns
    Vector7 deformations;
    std::array<Eigen::Vector3d, 2> y, turn;               // local y of the ends, and their rotations
    std::array<finite_rotation::RotationMap, 2> inverse;  // from spin to the rate of `turn`
    double slant, mean_y;                                 // of the mean local y: x/y, and y
    Matrix3x12 axes_spin;                                 // due to the motion of the ends
    std::array<Matrix3x12, 2> spin;                       // of the ends relative to the axes
    Eigen::Matrix<double, 7, 12> by_ends;                 // derivative of the deformations
  };

  /// Geometry of a beam: ends, offsets and axes.
  Corotation(const Beam& beam, const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node);

  /// Deformations at displacements of the nodes.
  Plane plane(const Vector12& displacements) const;
  Space space(const Vector12& displacements) const;

  /// Forces on the nodes, global axes, of forces conjugate to the deformations.
  Vector12 nodal_forces(const Plane& plane, const Eigen::Vector3d& forces) const;
  Vector12 nodal_forces(const Space& space, const Vector12& displacements, const Vector7& forces) const;
  /// Derivatives of the nodal forces with respect to the displacements, for a stiffness relating deformations and
  /// forces. Symmetric.
  Matrix12 tangent(const Plane& plane, const Eigen::Vector3d& forces, const Eigen::Matrix3d& stiffness) const;
  Matrix12 tangent(const Space& space, const Vector12& displacements, const Vector7& forces,
                   const Matrix7& stiffness) const;
  /// Forces on both ends in the rotated axes.
  Vector12 end_forces(const Plane& plane, const Eigen::Vector3d& forces) const;
  Vector12 end_forces(const Space& space, const Vector7& forces) const { return space.by_ends.transpose() * forces; }
  /// Rotated axes as rows; at zero displacements those of Beam.
  Eigen::Matrix3d axes(const Vector12& displacements, bool is_plane) const;

 private:
  Chord chord(const Vector12& displacements) const;

  double length_;
  Eigen::Vector3d start_offset_, end_offset_, undeformed_;  // the last between the ends
  Eigen::Matrix3d axes_;                                    // columns, undeformed
};

}  // namespace pounding
