#pragma once
/// Structures without their links, as the stepper uses them: coordinates, products and solves, and links.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pounding/linear/group_modes.hpp>
#include <pounding/linear/spring_relief.hpp>
#include <pounding/model/reduction.hpp>
#include <pounding/model/system.hpp>

namespace pounding {

/// Coefficients of A = mass M + damping C + stiffness K, the matrix of one step.
struct EffectiveMatrix {
  double mass = 1;       ///< [-]
  double damping = 0;    ///< [s]
  double stiffness = 0;  ///< [s^2]

  /// Bitwise equality of the coefficients.
  bool operator==(const EffectiveMatrix&) const = default;
};

/// Step lengths that a solver handles efficiently; dyadic ones are the longest one divided by 2^k.
enum class StepLengths {
  any,             ///< all lengths cost the same
  prefers_dyadic,  ///< dyadic lengths are cheaper
  needs_dyadic     ///< any other length is many times as expensive because it needs its own sparse factor
};

/// Constant data of a solver, in its coordinates on this process.
struct SolverLayout {
  /// Coordinates first .. first + count - 1, all of one group of the system.
  struct Segment {
    int first = 0, count = 0, group = 0;
    /// Modes of the group, one per coordinate, if sums over them cost less than sums over its unknowns; otherwise null.
    std::shared_ptr<const GroupModes> modes{};
  };

  /// Load vectors P, one column per ground motion: the force is -P times the ground acceleration.
  Eigen::MatrixXd load;
  /// Mass weight of each coordinate in the group norm sum(m u^2) [kg]; 0 if massless, 1 if modal.
  Eigen::VectorXd weights;
  /// Total mass of each group over its degrees of freedom and all processes [kg]: the group norm divided by it is a
  /// mean square.
  std::vector<double> group_masses;
  /// Deflection of massless degrees of freedom under spring forces.
  SpringRelief relief;
  /// The groups on this process. Sums over coordinates are sums over the segments: a solver may append coordinates that
  /// belong to none.
  std::vector<Segment> segments;
  /// Step lengths that this solver handles efficiently.
  StepLengths step_lengths = StepLengths::any;
  /// Reduced structures, without their errors.
  std::vector<ReducedStructure> reduced;
};

/// Coordinates of a solver, in which vectors have size() entries on this process. Functions are collective, except
/// layout() and size().
///
/// Massless degrees of freedom have no equation of motion: they are always in static equilibrium with the others. The
/// coordinates exclude their deflection under spring forces, see SpringRelief.
class Coordinates {
 public:
  virtual ~Coordinates() = default;

  /// Constant data.
  const SolverLayout& layout() const { return layout_; }
  /// Number of coordinates on this process.
  int size() const { return static_cast<int>(layout_.load.rows()); }

  /// Coordinates of a displacement or velocity given at all degrees of freedom of the system.
  virtual Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const = 0;
  /// Values at all degrees of freedom of the system, on every process, from coordinates x; without the relief:
  /// [degree of freedom, column of x]. Columns are bitwise independent of each other.
  virtual Eigen::MatrixXd physical(Eigen::Ref<const Eigen::MatrixXd> x) const = 0;
  /// y += f in these coordinates. f are forces at all degrees of freedom of the system, identical on every process and
  /// 0 at massless ones.
  virtual void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// Sums over all processes, in place.
  virtual void combine(std::span<double> /*sums*/) const {}

 protected:
  SolverLayout layout_;
};

/// Matrices M, C and K of the structures in the coordinates of a solver, and A. Functions are collective.
class LinearOperator {
 public:
  virtual ~LinearOperator() = default;

  /// y = K x, for each column.
  virtual void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const = 0;
  /// y = C x, for each column, from x and kx = K x.
  virtual void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                             Eigen::Ref<Eigen::MatrixXd> y) const = 0;
  /// y = M x.
  virtual void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// Replaces the force r by the acceleration M^-1 r; 0 at massless degrees of freedom.
  virtual void accelerate(Eigen::Ref<Eigen::VectorXd> r) const = 0;
  /// Recovers displacements, velocities or accelerations at massless degrees of freedom from those at the others, by
  /// static equilibrium.
  virtual void recover(Eigen::Ref<Eigen::VectorXd> x) const = 0;

  /// Sets A for the next solves. `step_level` = k if the step is the longest divided by 2^k, so that its factor is
  /// cached.
  virtual void set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) = 0;
  /// Sets the stiffness of a group with TangentForces in A for the next solves, by default K.
  virtual void set_tangent(int /*group*/, const SparseMatrix& /*tangent*/) {}
  /// Replaces x by A^-1 x. False if the solve failed.
  virtual bool solve(Eigen::Ref<Eigen::VectorXd> x) = 0;
};

/// Gap Jacobian B and outputs in the coordinates of a solver. B^T u are the relative displacements of the links; spring
/// forces act through B_e, see SpringRelief. Functions are collective.
class LinkOperator {
 public:
  virtual ~LinkOperator() = default;

  /// B^T x for all links [links x columns of x], identical on every process.
  virtual void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const = 0;
  /// B^T x for the links of the last flexibility() only [links in `links` x columns of x].
  virtual void gather(std::span<const int> links, Eigen::Ref<const Eigen::MatrixXd> x,
                      Eigen::MatrixXd& relative) const = 0;
  /// y += factor B f; f has one force per link of the system.
  virtual void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// G = B^T A^-1 B of these links, identical on every process. `g` may keep its contents from the last call if links
  /// and matrix are unchanged. False if a solve failed.
  virtual bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) = 0;
  /// y += factor A^-1 B f for the links of the last flexibility(); f has one force per link in `links`.
  virtual void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                            Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// Output quantities of x [outputs x columns of x], identical on every process.
  virtual void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const = 0;
};

/// Structures of a system without their links.
class StructureSolver : public Coordinates, public LinearOperator, public LinkOperator {
 public:
  /// Range of coordinates of one group.
  using Segment = SolverLayout::Segment;

  /// One line for a report: problem size and solution method.
  virtual std::string description() const = 0;

 protected:
  explicit StructureSolver(const System& system) { layout_.relief = SpringRelief(system); }
};

}  // namespace pounding
