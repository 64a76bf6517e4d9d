#pragma once
/// Distributed mass, damping and stiffness matrices: products, factors, and the matrix of a step.

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

/// With at least as many groups as processes, each process owns whole groups and solves them without communication.
/// Otherwise the rows are distributed evenly, and all processes share one parallel factor. Functions are collective on
/// the communicator unless stated otherwise. Vectors have the rows of this process.
class SystemMatrices {
 public:
  /// Throws as SparseSolver does. `prefix` is the options prefix of the factors. `system` must outlive this.
  SystemMatrices(MPI_Comm comm, const System& system, const std::string& prefix);
  ~SystemMatrices();

  /// Distribution of the rows: number of processes, true if each owns whole groups, first row and number of rows on
  /// this process, and the groups of these rows. Not collective.
  int processes() const { return processes_; }
  bool whole_groups() const { return whole_; }
  int first() const { return first_row_[rank_]; }
  int rows() const { return first_row_[rank_ + 1] - first_row_[rank_]; }
  const std::vector<StructureSolver::Segment>& segments() const { return segments_; }
  /// Diagonal of M on this process [kg]. Not collective.
  const Eigen::VectorXd& diagonal_mass() const { return diagonal_mass_; }

  /// As the functions of LinearOperator with these names.
  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const;
  void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                     Eigen::Ref<Eigen::MatrixXd> y) const;
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const;
  void accelerate(Eigen::Ref<Eigen::VectorXd> r) const;
  void recover(Eigen::Ref<Eigen::VectorXd> x) const;

  /// Pattern and values of the matrix of a step; columns are numbered over the processes of solving_comm(). Not
  /// collective.
  const Pattern& pattern() const { return pattern_; }
  std::vector<double> values(const EffectiveMatrix& step) const;
  MPI_Comm solving_comm() const { return solving_comm_; }
  /// Throws SolverError for the matrix of a step that could not be factored, naming the degree of freedom if it is
  /// singular.
  [[noreturn]] void name_singular(const EffectiveMatrix& step) const;

  /// All rows of x, on every process.
  Eigen::MatrixXd spread(Eigen::Ref<const Eigen::MatrixXd> x) const;
  /// True if `mine` is true on all processes.
  bool agreed(bool mine) const;
  /// Sums over all processes, in place.
  void combine(std::span<double> sums) const;
  /// Maximum over all processes.
  double largest(double mine) const;

 private:
  struct Subset;

  // The degree of freedom of column 0 of the pattern.
  int first_column() const { return whole_ ? first() : 0; }
  void fill();
  void find_segments();

  MPI_Comm comm_, solving_comm_;  // all processes; those that share a factor
  int rank_ = 0, processes_ = 1;
  bool whole_ = true;
  const System& system_;
  std::string prefix_;
  std::vector<int> first_row_;  // of each process, and the total number of rows
  std::vector<StructureSolver::Segment> segments_;

  // K, M and C share one pattern, so any A is a linear combination of their values.
  Pattern pattern_;
  std::vector<double> stiffness_, mass_, damping_;  // mass is empty if diagonal, damping if zero
  Eigen::VectorXd diagonal_mass_;
  // used if rows have entries on other processes
  std::unique_ptr<Product> shared_stiffness_, shared_mass_, shared_damping_;
  std::unique_ptr<Subset> dynamic_;   // consistent mass matrix
  std::unique_ptr<Subset> massless_;  // stiffness
};

}  // namespace pounding::petsc
