#pragma once
/// The linear structures as sparse matrices with a factor for each length of step: for big frames and several processes.

#include <petscsys.h>

#include <memory>

#include <pounding/linear/structure_solver.hpp>
#include <pounding/linear/link_ends.hpp>
#include <pounding/linear/system_matrices.hpp>

namespace pounding::petsc {

/// Where the options of the factors come from, and their limits.
struct SparseOptions {
  /// Of the options of every factor: `-pounding_lev_pc_factor_mat_solver_type mumps`; those of the conjugate gradients have
  /// `off_` behind it. `-pounding_lev_memory` and `-pounding_lev_direct_below` set the two numbers below.
  std::string prefix = "pounding_lev_";
  double memory = 4096;    ///< that factors may take on one process; the least recently used go first [MB]
  int direct_below = 300;  ///< with fewer unknowns on all processes every length of step is factored
};

/// Coordinates are the unknowns of the system themselves; each process has a row of consecutive ones.
///
/// With at least as many groups as processes each process has whole groups and solves them by itself, without a message.
/// Otherwise the rows are cut evenly and one parallel factor (MUMPS) serves all.
///
/// Steps on the ladder have a factor each, and columns Z = A^-1 B of the links as they become active. A step off the ladder is
/// solved by conjugate gradients with the factor of the nearest rung, or, where many links press, by a factor of its own. What
/// a solve gives depends on its step alone, not on what was solved before it.
///
/// Every process holds the whole System; what is stored here is for the rows of this process.
class SparseSolver final : public StructureSolver {
 public:
  /// Collective. Throws std::invalid_argument for groups that do not follow one another over all unknowns, an entry that joins
  /// two groups, a mass that is negative, an unknown without mass that nothing holds, and a link or a dashpot at an unknown
  /// without mass; SolverError where a matrix is singular, with the unknown. `system` must outlive the base.
  SparseSolver(MPI_Comm comm, const System& system, const SparseOptions& options = {});
  ~SparseSolver() override;

  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const override;
  void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                     Eigen::Ref<Eigen::MatrixXd> y) const override;
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const override;
  void accelerate(Eigen::Ref<Eigen::VectorXd> r) const override;
  void recover(Eigen::Ref<Eigen::VectorXd> x) const override;
  bool prefers_dyadic_steps() const override { return true; }
  void set_matrix(const EffectiveMatrix& shift, std::optional<int> rung) override;
  bool solve(Eigen::Ref<Eigen::VectorXd> x) override;
  bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) override;
  void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                    Eigen::Ref<Eigen::VectorXd> y) const override;
  void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const override;
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;
  void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override;
  void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const override;
  Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const override;
  void physical(Eigen::Ref<const Eigen::VectorXd> x, Eigen::VectorXd& u) const override;
  void combine(std::span<double> sums) const override;
  std::string description() const override;

  /// Factors that are held, and what they take on this process [MB].
  int levels() const;
  double memory() const;
  /// Of conjugate gradients so far, on this process.
  long iterations() const;

 private:
  struct Level;

  Level& rung(int number, const EffectiveMatrix& shift);
  void factor(Level& level);
  void make_room(const Level* needed);
  void drop_off();
  bool solve_by(const Factor& factor, Eigen::Ref<Eigen::VectorXd> x) const;
  bool ensure(Level& level, std::span<const int> links);
  bool columns_by_factor(Level& level, int first, int count);
  void add_columns(Level& level, Eigen::MatrixXd columns) const;

  const System& system_;
  SparseOptions options_;
  SystemMatrices matrices_;
  LinkEnds ends_;
  SparseMatrix outputs_;  // the rows of this process

  // The first rung that was asked for: all others follow from it by powers of two.
  struct Ladder {
    int rung = 0;
    EffectiveMatrix shift;
  };
  std::optional<Ladder> ladder_;
  std::vector<std::unique_ptr<Level>> rungs_;
  std::unique_ptr<Level> off_;
  std::unique_ptr<Factor> spare_;  // of the last step off the ladder; the next one takes over its ordering
  Level* current_ = nullptr;
  Level* last_rung_ = nullptr;
  long clock_ = 0, finished_iterations_ = 0;
  Eigen::VectorXd work_;
};

}  // namespace pounding::petsc
