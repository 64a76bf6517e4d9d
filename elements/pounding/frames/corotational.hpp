#pragma once
/// Frames that turn by large angles while their members strain little: corotational beams, their frame, its
/// equilibrium. SI units.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include <pounding/frames/beam.hpp>
#include <pounding/frames/frame.hpp>

namespace pounding {

/// A member whose forces follow from the displacements of its nodes without any memory: an axis system turns with the
/// chord between the ends, and what the ends are displaced by within it goes into `beam_stiffness`. Force is the
/// gradient and tangent the (symmetric) Hessian of the strain energy. The local part is linear, so that a member under
/// a large axial force or bent strongly within itself is to be divided; the error falls with the square of its length.
///
/// Displacements are the twelve of Beam. In space the rotations of a node are its rotation vector (Euler axis times
/// angle) from the undeformed state, whose angle must stay below 2 pi, and moments are the conjugates of its
/// components: moments about fixed axes only while the vector stays parallel to itself. A plane member turns by any
/// angle. The rotation of an end against the chord must stay below pi. Rigid offsets turn with their node.
///
/// Plane: closed form, Crisfield, Non-linear Finite Element Analysis of Solids and Structures 1, 1991, ch. 7. In space:
/// axes from the chord and the mean of the ends' local y, Battini & Pacoste, CMAME 191 (2002) 1755-1789, with the
/// tangent of the exact logarithm.
class CorotationalBeam {
 public:
  /// Energy of the member and its derivatives by the displacements.
  struct Response {
    double energy = 0;                  ///< [J]
    Vector12 force = Vector12::Zero();  ///< on the nodes, global axes [N], [N m]
  };

  /// dimension 2: only ux, uz and ry of the nodes act. Throws std::invalid_argument as Beam does, and for an axial
  /// force: this member finds its own.
  CorotationalBeam(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, const Section& section,
                   const Material& material, const BeamOptions& options, int dimension);
  /// A bar that carries axial force only, see Beam::truss.
  static CorotationalBeam truss(const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, double area,
                                const Material& material, int dimension);

  /// At displacements of its nodes.
  Response evaluate(const Vector12& displacements) const { return respond(displacements, nullptr); }
  /// With the tangent, the second derivatives of the energy; it costs several times as much.
  Response evaluate(const Vector12& displacements, Matrix12& tangent) const { return respond(displacements, &tangent); }
  /// On its two ends in local axes that turned with the chord; as Beam::end_forces for small displacements.
  Vector12 end_forces(const Vector12& displacements) const;
  /// Rows: the local axes that have turned with the chord. Those of Beam for no displacements.
  Eigen::Matrix3d axes(const Vector12& displacements) const;

 private:
  CorotationalBeam(const Beam& beam, const Eigen::Vector3d& start_node, const Eigen::Vector3d& end_node, int dimension);
  // In the turned axes: rotations of the start, elongation, rotations of the end.
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  using Matrix7 = Eigen::Matrix<double, 7, 7>;
  struct Chord {
    Eigen::Vector3d arm_start, arm_end, direction;  // turned offsets; of unit length
    double length, elongation;
  };

  /// A plane member: x and z in global axes, moments about global y.
  struct Plane {
    double start_x, start_z, end_x, end_z;          // turned offsets
    double x, z, length;                            // from end to end
    double start_moment, normal_force, end_moment;  // on the ends
    double force_x, force_z;                        // on the start
    double energy;
  };

  Response respond(const Vector12& displacements, Matrix12* tangent) const;
  Chord chord(const Vector12& displacements) const;
  Plane plane(const Vector12& displacements) const;
  Response plane_response(const Plane& plane, Matrix12* tangent) const;
  Response space_ends(const Vector12& displacements, const Chord& chord, Matrix12* tangent) const;

  bool is_plane_;
  double length_;
  Eigen::Vector3d start_offset_, end_offset_, undeformed_;  // the last from end to end
  Eigen::Matrix3d axes_;                                    // columns, undeformed
  Matrix7 stiffness_;
};

/// A member of a frame that is to follow large rotations: what Frame::add_member was given, or Frame::add_truss.
struct CorotationalMember {
  int start = 0, end = 0;
  Section section;
  Material material;
  BeamOptions options{};
  bool is_truss = false;  ///< of the section the area counts only
};

/// All members of a frame.
std::vector<CorotationalMember> corotational_members(const Frame& frame);

/// A linear frame with some or all of its members corotational; everything else (springs, other members) stays linear,
/// and constraints stay linear in the displacements: those with an arm hold for small turns of their master, with an
/// error of the square of the turn. Unknowns are those of the assembled frame. Every function is pure.
class CorotationalFrame {
 public:
  /// One point of a path: what balances this part of the load.
  struct Equilibrium {
    double factor = 0;  ///< of the load
    Eigen::VectorXd q;
  };

  /// `assembled` with the same members in it, and without axial forces in them. Throws std::invalid_argument: a node
  /// that is not there, a member that cannot be or that the assembled stiffness does not contain.
  CorotationalFrame(const AssembledFrame& assembled, const std::vector<CorotationalMember>& members);

  /// Unknowns, and corotational members.
  int size() const { return static_cast<int>(linear_.rows()); }
  int members() const { return static_cast<int>(members_.size()); }

  double energy(const Eigen::VectorXd& q) const;          ///< strain energy [J]
  Eigen::VectorXd force(const Eigen::VectorXd& q) const;  ///< gradient of the energy [N], [N m]
  /// Symmetric, its entries always at the same places; at q = 0 the linear stiffness K.
  Eigen::SparseMatrix<double> tangent(const Eigen::VectorXd& q) const;

  /// See CorotationalBeam::end_forces; members are numbered as they were given.
  Vector12 end_forces(int member, const Eigen::VectorXd& q) const;
  /// See CorotationalBeam::axes.
  Eigen::Matrix3d axes(int member, const Eigen::VectorXd& q) const;
  /// On the nodes of the member, global axes.
  Vector12 nodal_forces(int member, const Eigen::VectorXd& q) const;

  /// Equilibrium under `load` (n) applied in equal steps by Newton's method; where a step fails, at a limit point say,
  /// the path is followed by arc length until it reaches the whole load. First the undeformed state, last factor 1. A
  /// branch that splits off is not looked for: a perfect column stays straight beyond its buckling load. Throws
  /// SolverError with the load factor reached.
  std::vector<Equilibrium> solve(const Eigen::VectorXd& load, int steps) const;
  /// The path by arc length (Riks; Keller 1977) from the undeformed state on, through limit points and snap-backs: this
  /// many points, of which the first is at about `first_factor`; distances along the path stay below that one.
  std::vector<Equilibrium> follow(const Eigen::VectorXd& load, double first_factor, int points) const;

 private:
  struct Member {
    CorotationalBeam beam;
    std::vector<Eigen::Triplet<double>> rows;  // displacement of the member, unknown, factor
    std::vector<int> places;  // of each pair of rows among the values of the tangent, the first going faster
    Matrix12 linear;          // tangent at rest
  };
  class Path;

  static Vector12 displacements(const Member& member, const Eigen::VectorXd& q);
  void add_excess_tangent(const Eigen::VectorXd& q, Eigen::SparseMatrix<double>& sum) const;
  const Member& of(int member, const Eigen::VectorXd& q) const;
  void require_size(const Eigen::VectorXd& q, const char* what) const;

  std::vector<Member> members_;
  Eigen::SparseMatrix<double> linear_;  // K
  Eigen::SparseMatrix<double> rest_;    // K without the members
};

}  // namespace pounding
