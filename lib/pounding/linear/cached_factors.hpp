#pragma once
/// Cached factors of step matrices and link columns, within a memory limit.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pounding/linear/factor.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/linear/system_matrices.hpp>

namespace pounding::petsc {

/// Options prefix and limits of the factors.
struct SparseOptions {
  /// Prefix of the options of every factor: `-pounding_lev_pc_factor_mat_solver_type mumps`. The conjugate gradient
  /// solver appends `off_`. `-pounding_lev_memory` and `-pounding_lev_direct_below` override the two limits below.
  std::string prefix = "pounding_lev_";
  double memory = 4096;    ///< memory limit for the factors on one process, with LRU eviction [MB]
  int direct_below = 300;  ///< with fewer unknowns over all processes, every step length is factored
};

/// An effective matrix A with its factor and the columns Z = A^-1 B of the links. Off the step levels, A is either
/// factored or solved by conjugate gradients, preconditioned by the factor of the nearest level.
struct CachedFactor {
  std::optional<int> step_level;  ///< nullopt off the levels
  EffectiveMatrix matrix;
  std::unique_ptr<Factor> factor;
  CachedFactor* nearest = nullptr;  ///< level whose factor preconditions the conjugate gradients
  std::unique_ptr<NearSolver> gradients;
  std::vector<Eigen::MatrixXd> blocks;  ///< blocks of columns of Z
  std::vector<const double*> columns;   ///< all columns of Z; a link uses the rows of its groups
  Eigen::MatrixXd ends;                 ///< [slot, column] of B^T Z
  std::vector<int> column_of;           ///< column of each link, -1 for none
  double bytes = 0;                     ///< memory of the factor, maximum over processes
  long used = 0;                        ///< time of last use, by the clock of the cache

  /// Memory of the factor and of Z [bytes].
  double memory() const;
};

/// Factors by step level, where level k is the longest step divided by 2^k. Factors of levels are cached; the factor of
/// any other step lasts until the next step. The choice of factor depends on the current step only, so results do not
/// depend on earlier steps. Functions are collective on the communicator of the matrices unless stated otherwise.
class CachedFactors {
 public:
  /// `matrices` must outlive this. Adds each factorization to `factorizations`.
  CachedFactors(const SystemMatrices& matrices, const SparseOptions& options, int unknowns, int links,
                long& factorizations);

  /// Makes the factor of this matrix current. `step_level` = k if the step is the longest step divided by 2^k.
  void select(const EffectiveMatrix& matrix, std::optional<int> step_level);
  /// The factor that select() chose. Not collective.
  CachedFactor& current() { return *current_; }
  const CachedFactor& current() const { return *current_; }
  /// Factors the matrix of an entry. Throws SolverError, naming the degree of freedom, if the matrix is singular.
  void factorize(CachedFactor& entry);
  /// Evicts levels in LRU order until the memory limit is met, except `needed` and the levels of the current step.
  void make_room(const CachedFactor* needed);

  /// Factors that are held. Not collective.
  int count() const { return static_cast<int>(levels_.size()) + (off_level_ && off_level_->factor ? 1 : 0); }
  /// All that is held on this process [bytes]. Not collective.
  double memory() const;
  /// Iterations of conjugate gradients so far on this process. Not collective.
  long iterations() const {
    return finished_iterations_ + (off_level_ && off_level_->gradients ? off_level_->gradients->iterations() : 0);
  }
  /// Package of one of the factors; empty before the first. Not collective.
  std::string package() const;

 private:
  CachedFactor& at_level(int number, const EffectiveMatrix& matrix);
  void drop_off_level();

  const SystemMatrices& matrices_;
  const SparseOptions& options_;
  int unknowns_, links_;
  long& factorizations_;

  // First level requested; the others follow by powers of two.
  struct Reference {
    int level = 0;
    EffectiveMatrix matrix;
  };
  std::optional<Reference> reference_;
  std::vector<std::unique_ptr<CachedFactor>> levels_;
  std::unique_ptr<CachedFactor> off_level_;
  std::unique_ptr<Factor> spare_;  // from the last step off the levels; the next one reuses its ordering
  CachedFactor* current_ = nullptr;
  CachedFactor* last_level_ = nullptr;
  long clock_ = 0, finished_iterations_ = 0;
};

}  // namespace pounding::petsc
