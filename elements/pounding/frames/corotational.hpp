#pragma once
/// Large rotations and small strains: corotational beams, frames of them, and their equilibrium. SI units.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include <pounding/frames/beam.hpp>
#include <pounding/frames/corotation.hpp>
#include <pounding/frames/frame.hpp>
#include <pounding/frames/member_unknowns.hpp>

namespace pounding {

/// A corotational member of a frame: the arguments of Frame::add_member or Frame::add_truss.
struct CorotationalMember {
  int start = 0, end = 0;
  Section section;
  Material material;
  BeamOptions options{};
  bool is_truss = false;  ///< only the area of the section is used
};

/// A path-independent member with large rotations: a local frame rotates with the chord between the ends, and
/// displacements relative to it are multiplied by `beam_stiffness`. The force is the gradient and the tangent the
/// (symmetric) Hessian of the strain energy. The local part is linear, so members with a large axial force or strong
/// bending must be subdivided; the error is proportional to the square of the length. Displacements and axes are those
/// of Corotation.
class CorotationalBeam {
 public:
  /// Energy of the member and its derivatives with respect to the displacements.
  struct Response {
    double energy = 0;                  ///< [J]
    Vector12 force = Vector12::Zero();  ///< on the nodes, global axes [N], [N m]
  };

  /// dimension 2: only ux, uz and ry of the nodes are used. Throws std::invalid_argument like Beam, and for a given
  /// axial force, which this member computes itself.
  CorotationalBeam(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, const Section& section,
                   const Material& material, const BeamOptions& options, int dimension);
  /// A bar with axial force only, see Beam::truss.
  static CorotationalBeam truss(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, double area,
                                const Material& material, int dimension);

  /// A member of a frame.
  static CorotationalBeam of(const CorotationalMember& member, const AssembledFrame& assembled);

  /// Response at displacements of its nodes.
  Response evaluate(const Vector12& displacements) const { return respond(displacements, nullptr); }
  /// Also computes the tangent, the second derivatives of the energy, at several times the cost.
  Response evaluate(const Vector12& displacements, Matrix12& tangent) const { return respond(displacements, &tangent); }
  /// Forces on both ends in local axes rotated with the chord; equal to Beam::end_forces for small displacements.
  Vector12 end_forces(const Vector12& displacements) const;
  /// Local axes rotated with the chord, as rows; for zero displacements those of Beam.
  Eigen::Matrix3d axes(const Vector12& displacements) const { return motion_.axes(displacements, is_plane_); }

 private:
  CorotationalBeam(const Beam& beam, const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, int dimension);
  Response respond(const Vector12& displacements, Matrix12* tangent) const;

  bool is_plane_;
  Corotation motion_;
  Corotation::Matrix7 stiffness_;
  Eigen::Matrix3d plane_stiffness_;
};

/// All members of a frame as corotational members.
std::vector<CorotationalMember> corotational_members(const Frame& frame);

/// A linear frame with some or all members corotational. Springs, other members and constraints remain linear in the
/// displacements: constraints with an arm are valid for small rotations of their master, with an error of second order.
/// The unknowns are those of the assembled frame. All functions are pure.
class CorotationalFrame {
 public:
  /// A point of an equilibrium path, for this multiple of the load.
  struct Equilibrium {
    double factor = 0;  ///< load factor
    Eigen::VectorXd q;
  };

  /// `assembled` must contain the same members, without axial forces. Throws std::invalid_argument for an unknown node,
  /// an invalid member, and a member that the assembled stiffness does not contain.
  CorotationalFrame(const AssembledFrame& assembled, const std::vector<CorotationalMember>& members);

  /// Number of unknowns, and of corotational members.
  int size() const { return static_cast<int>(linear_.rows()); }
  int members() const { return static_cast<int>(members_.size()); }

  double energy(const Eigen::VectorXd& q) const;          ///< strain energy [J]
  Eigen::VectorXd force(const Eigen::VectorXd& q) const;  ///< gradient of the energy [N], [N m]
  /// Symmetric, with a constant sparsity pattern; at q = 0 the linear stiffness K.
  Eigen::SparseMatrix<double> tangent(const Eigen::VectorXd& q) const;

  /// See CorotationalBeam::end_forces; members are numbered in the given order.
  Vector12 end_forces(int member, const Eigen::VectorXd& q) const;
  /// See CorotationalBeam::axes.
  Eigen::Matrix3d axes(int member, const Eigen::VectorXd& q) const;
  /// Forces on the nodes of the member, global axes.
  Vector12 nodal_forces(int member, const Eigen::VectorXd& q) const;

  /// Equilibrium under `load` (n), applied in equal steps with Newton's method. If a step fails, for example at a limit
  /// point, the path is followed by arc length up to the whole load. The first point is the undeformed state, the last
  /// has factor 1. Bifurcations are not detected: a perfect column remains straight beyond its buckling load. Throws
  /// SolverError with the load factor reached.
  std::vector<Equilibrium> solve(const Eigen::VectorXd& load, int steps) const;
  /// Follows the path from the undeformed state by arc length (Riks; Keller 1977), through limit points and snap-backs,
  /// for this number of points. The first is at about `first_factor`; distances along the path do not exceed its
  /// distance.
  std::vector<Equilibrium> follow(const Eigen::VectorXd& load, double first_factor, int points) const;

 private:
  struct Member {
    CorotationalBeam beam;
    MemberUnknowns unknowns;
    Matrix12 linear;  // tangent at rest
  };
  class Path;

  void add_excess_tangent(const Eigen::VectorXd& q, Eigen::SparseMatrix<double>& sum) const;
  const Member& of(int member, const Eigen::VectorXd& q) const;
  void require_size(const Eigen::VectorXd& q, const char* what) const;

  std::vector<Member> members_;
  Eigen::SparseMatrix<double> linear_;  // K
  Eigen::SparseMatrix<double> rest_;    // K without the members
};

}  // namespace pounding
