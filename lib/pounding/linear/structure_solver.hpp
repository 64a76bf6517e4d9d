#pragma once
/// The structures without their links, as the stepper needs them: products, solves, and sums over all processes.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <pounding/model/system.hpp>

namespace pounding {

/// A = mass M + damping C + stiffness K, the matrix of one step.
struct EffectiveMatrix {
  double mass = 1;
  double damping = 0;    ///< [s]
  double stiffness = 0;  ///< [s^2]
};

/// A base works in coordinates of its own, in which vectors have size() entries on this process; physical() leads back
/// to the unknowns of the system. But for what is handed out by reference, all processes call every function together.
///
/// Unknowns without mass have no inertia to balance: they follow the others as the stiffness asks, at all times.
class StructureSolver {
 public:
  /// Coordinates first .. first + count - 1 on this process belong to one group of the system.
  struct Segment {
    int first = 0, count = 0, group = 0;
  };

  virtual ~StructureSolver() = default;

  /// Coordinates on this process.
  int size() const { return static_cast<int>(load_.rows()); }
  /// P, one column a ground motion.
  const Eigen::MatrixXd& load() const { return load_; }
  /// What the square of a coordinate counts in the sum m u^2 of its group, zero without mass [kg]; those of a modal
  /// coordinate are one.
  const Eigen::VectorXd& weights() const { return weights_; }
  /// Sum of the masses of a group over its unknowns, on all processes: the sum of weighted squares divided by it is a mean.
  const std::vector<double>& group_masses() const { return group_masses_; }
  std::span<const Segment> segments() const { return segments_; }

  /// Columns y = K x.
  virtual void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const = 0;
  /// Columns y = C x; `kx` is K x.
  virtual void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                             Eigen::Ref<Eigen::MatrixXd> y) const = 0;
  /// y = M x.
  virtual void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const = 0;
  /// r becomes the acceleration that balances it at the unknowns with mass; zero at the others.
  virtual void accelerate(Eigen::Ref<Eigen::VectorXd> r) const = 0;
  /// Completes displacements, velocities or accelerations at the unknowns without mass.
  virtual void recover(Eigen::Ref<Eigen::VectorXd> x) const = 0;

  /// Steps from a ladder are cheaper than others: h0, h0/2, h0/4 ...
  virtual bool prefers_dyadic_steps() const { return false; }
  /// The matrix of the solves that follow. `rung` is given for a step on the ladder.
  virtual void set_matrix(const EffectiveMatrix& shift, std::optional<int> rung) = 0;
  /// x becomes A^-1 x. False when that failed.
  virtual bool solve(Eigen::Ref<Eigen::VectorXd> x) = 0;
  /// G = B^T A^-1 B of these links, the same on every process. False when that failed.
  virtual bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) = 0;
  /// y += factor A^-1 B f for the links of the last flexibility().
  virtual void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                            Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// Columns of B^T x for all links, the same on every process.
  virtual void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const = 0;
  /// y += factor B f.
  virtual void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// y += f, forces at all unknowns of the system, zero at those without mass; the same on every process.
  virtual void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const = 0;

  /// Columns of outputs^T x, the same on every process.
  virtual void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const = 0;

  /// Coordinates of a displacement or velocity that is given at the unknowns of the system.
  virtual Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const = 0;
  /// All unknowns of the system, on every process.
  virtual void physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const = 0;

  /// Adds up over all processes, in place.
  virtual void combine(std::span<double> /*sums*/) const {}

  /// One line for a report: what is solved and how.
  virtual std::string description() const = 0;
  long factorizations() const { return factorizations_; }

 protected:
  Eigen::MatrixXd load_;
  Eigen::VectorXd weights_;
  std::vector<double> group_masses_;
  std::vector<Segment> segments_;
  long factorizations_ = 0;
};

}  // namespace pounding
