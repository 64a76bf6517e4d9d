#pragma once
/// Mass, damping and stiffness of a system, by the rows of the processes: products, factors, and the matrix of a step.

#include <petscsys.h>

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pounding/linear/factor.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// With at least as many groups as processes, each process has whole groups and solves them by itself, without
/// messages. Otherwise the rows are cut evenly, and one parallel factor serves all. Functions are collective on the
/// communicator unless they say that they are not. Vectors have the rows of this process.
class SystemMatrices {
 public:
  /// Throws as SparseSolver does. `prefix`: of the options of the factors. `system` must outlive this.
  SystemMatrices(MPI_Comm comm, const System& system, const std::string& prefix);
  ~SystemMatrices();

  /// Distribution of the rows: number of processes, whether each has whole groups, first row and number of rows on this
  /// process, and the groups of these rows. Not collective.
  int processes() const { return processes_; }
  bool whole_groups() const { return whole_; }
  int first() const { return first_row_[rank_]; }
  int rows() const { return first_row_[rank_ + 1] - first_row_[rank_]; }
  const std::vector<StructureSolver::Segment>& segments() const { return segments_; }
  /// Diagonal of M on this process [kg]. Not collective.
  const Eigen::VectorXd& diagonal_mass() const { return diagonal_mass_; }

  /// As the functions of StructureSolver with these names.
  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const;
  void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                     Eigen::Ref<Eigen::MatrixXd> y) const;
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const;
  void accelerate(Eigen::Ref<Eigen::VectorXd> r) const;
  void recover(Eigen::Ref<Eigen::VectorXd> x) const;

  /// The matrix of a step: its pattern, with columns numbered over the processes of solving_comm(), and its values in
  /// that pattern. Not collective.
  const Pattern& pattern() const { return pattern_; }
  std::vector<double> values(const EffectiveMatrix& step) const;
  MPI_Comm solving_comm() const { return solving_comm_; }
  /// Throws SolverError for the matrix of a step that could not be factored, naming the degree of freedom where it is
  /// singular.
  [[noreturn]] void name_singular(const EffectiveMatrix& step) const;

  /// All rows of x, on every process.
  void spread(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& all) const;
  /// True if it is true on all processes.
  bool agreed(bool mine) const;
  /// Sums over all processes, in place.
  void combine(std::span<double> sums) const;
  /// The largest value of all processes.
  double largest(double mine) const;

 private:
  struct Subset;

  // Column 0 of the pattern is this degree of freedom.
  int first_column() const { return whole_ ? first() : 0; }
  void fill();
  void find_segments();

  MPI_Comm comm_, solving_comm_;  // all processes; those that share a factor
  int rank_ = 0, processes_ = 1;
  bool whole_ = true;
  const System& system_;
  std::string prefix_;
  std::vector<int> first_row_;  // of each process, and last the number of all rows
  std::vector<StructureSolver::Segment> segments_;

  // K, M and C share one pattern, so that any A is a sum of their values.
  Pattern pattern_;
  std::vector<double> stiffness_, mass_, damping_;  // mass is empty when diagonal, damping when there is none
  Eigen::VectorXd diagonal_mass_;
  std::unique_ptr<Product> shared_stiffness_, shared_mass_,
      shared_damping_;  // where rows have entries of other processes
  MassSplit dofs_;
  std::unique_ptr<Subset> dynamic_;           // of a consistent mass matrix
  mutable std::unique_ptr<Subset> massless_;  // of the stiffness; factored when first used
};

}  // namespace pounding::petsc
