#pragma once
/// Mass, damping and stiffness of a system by rows of processes: their products, their factors, and the matrix of a step.

#include <petscsys.h>

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/linear/factor.hpp>
#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// With at least as many groups as processes each process has whole groups and solves them by itself, without a message.
/// Otherwise the rows are cut evenly and one parallel factor serves all. Functions are collective on the communicator unless
/// they say that they are not. Vectors have the rows of this process.
class SystemMatrices {
 public:
  /// Throws what SparseSolver does. `prefix`: options of the factors. `system` must outlive this.
  SystemMatrices(MPI_Comm comm, const System& system, const std::string& prefix);
  ~SystemMatrices();

  /// How the rows are shared: processes, whether each has whole groups, first row and number of rows here, and the
  /// groups that they belong to. Not collective.
  int processes() const { return processes_; }
  bool whole_groups() const { return whole_; }
  int first() const { return first_row_[rank_]; }
  int rows() const { return first_row_[rank_ + 1] - first_row_[rank_]; }
  const std::vector<StructureSolver::Segment>& segments() const { return segments_; }
  /// Diagonal of M [kg].
  const Eigen::VectorXd& diagonal_mass() const { return diagonal_mass_; }

  /// See StructureSolver.
  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const;
  void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                     Eigen::Ref<Eigen::MatrixXd> y) const;
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const;
  void accelerate(Eigen::Ref<Eigen::VectorXd> r) const;
  void recover(Eigen::Ref<Eigen::VectorXd> x) const;

  /// Of the matrix of a step, whose columns count over the processes of solving_comm(); its values belong to this pattern.
  /// Not collective.
  const Pattern& pattern() const { return pattern_; }
  std::vector<double> values(const EffectiveMatrix& shift) const;
  MPI_Comm solving_comm() const { return solving_comm_; }
  /// Throws SolverError that says with which unknown the matrix of this step, which could not be factored, is singular.
  [[noreturn]] void name_singular(const EffectiveMatrix& shift) const;

  /// All rows on every process.
  void spread(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& all) const;
  bool agreed(bool mine) const;
  /// Adds up in place.
  void combine(std::span<double> sums) const;
  double largest(double mine) const;

 private:
  struct Subset;

  // Columns of the pattern count from this unknown.
  int first_column() const { return whole_ ? first() : 0; }
  void fill();
  void find_segments();

  MPI_Comm comm_, solving_comm_;  // all processes; those that share a factor
  int rank_ = 0, processes_ = 1;
  bool whole_ = true;
  const System& system_;
  std::string prefix_;
  std::vector<int> first_row_;  // of each process, and the number of all
  std::vector<StructureSolver::Segment> segments_;

  // K, M and C share one pattern, so that any A is a sum of their values.
  Pattern pattern_;
  std::vector<double> stiffness_, mass_, damping_;  // mass is empty when diagonal, damping when there is none
  Eigen::VectorXd diagonal_mass_;
  std::unique_ptr<Product> shared_stiffness_, shared_mass_, shared_damping_;  // rows that touch other processes
  std::unique_ptr<Subset> heavy_;             // consistent masses
  mutable std::unique_ptr<Subset> massless_;  // factored when first asked for
  bool any_massless_ = false;
};

}  // namespace pounding::petsc
