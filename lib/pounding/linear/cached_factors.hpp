#pragma once
/// Factors of the matrices of steps, and what was solved with them, kept while there is memory for them.

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
  /// Prefix of the options of every factor: `-pounding_lev_pc_factor_mat_solver_type mumps`; the conjugate gradients
  /// have `off_` behind it. `-pounding_lev_memory` and `-pounding_lev_direct_below` set the two numbers below.
  std::string prefix = "pounding_lev_";
  double memory = 4096;    ///< limit for the factors on one process; the least recently used go first [MB]
  int direct_below = 300;  ///< with fewer unknowns on all processes every length of step is factored
};

/// One effective matrix A with its factor and the columns Z = A^-1 B of links. For a step off the levels there is a
/// factor of its own, or conjugate gradients with the factor of the nearest level.
struct CachedFactor {
  std::optional<int> step_level;  ///< nothing off the levels
  EffectiveMatrix matrix;
  std::unique_ptr<Factor> factor;
  CachedFactor* nearest = nullptr;  ///< level whose factor the conjugate gradients use
  std::unique_ptr<NearSolver> gradients;
  std::vector<Eigen::MatrixXd> blocks;  ///< of columns of Z
  std::vector<const double*> columns;   ///< of all blocks; a link's own part is that in its groups
  Eigen::MatrixXd ends;                 ///< [slot, column] of B^T Z
  std::vector<int> column_of;           ///< each link: its column, -1 for none
  double bytes = 0;                     ///< of the factor, on the process where it is largest
  long used = 0;                        ///< time of the last use, by the clock of the cache

  /// Memory of the factor and of Z [bytes].
  double memory() const;
};

/// Step levels: level k is the longest step over 2^k. Each level has a factor that is kept; a step off the levels has
/// one that lasts until the next step. Which factor serves a step depends on that step alone, so that results do not
/// depend on the steps before it. Functions are collective on the communicator of the matrices unless they say that
/// they are not.
class CachedFactors {
 public:
  /// `matrices` must outlive this. Adds each factorization to `factorizations`.
  CachedFactors(const SystemMatrices& matrices, const SparseOptions& options, int unknowns, int links,
                long& factorizations);

  /// Makes the factor of this matrix the current one. `step_level` is given for a step that is the longest over
  /// 2^level.
  void select(const EffectiveMatrix& matrix, std::optional<int> step_level);
  /// The factor that select() chose. Not collective.
  CachedFactor& current() { return *current_; }
  const CachedFactor& current() const { return *current_; }
  /// Gives an entry a factor of its own. Throws SolverError, with the unknown, where the matrix is singular.
  void factorize(CachedFactor& entry);
  /// Drops the least recently used levels until the limit of memory is kept; never `needed`, nor those of the present
  /// step.
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

  // The first level that was asked for: all others follow from it by powers of two.
  struct Reference {
    int level = 0;
    EffectiveMatrix matrix;
  };
  std::optional<Reference> reference_;
  std::vector<std::unique_ptr<CachedFactor>> levels_;
  std::unique_ptr<CachedFactor> off_level_;
  std::unique_ptr<Factor> spare_;  // of the last step off the levels; the next one takes over its ordering
  CachedFactor* current_ = nullptr;
  CachedFactor* last_level_ = nullptr;
  long clock_ = 0, finished_iterations_ = 0;
};

}  // namespace pounding::petsc
