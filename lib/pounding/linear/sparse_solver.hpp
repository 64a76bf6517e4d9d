#pragma once
/// The linear structures as sparse matrices with a factor per step length: for large frames and several processes.

#include <petscsys.h>

#include <pounding/linear/cached_factors.hpp>
#include <pounding/linear/link_ends.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/linear/system_matrices.hpp>

namespace pounding::petsc {

/// The coordinates are the degrees of freedom of the system; each process owns a contiguous range.
///
/// With at least as many groups as processes, each process owns whole groups and solves them without communication.
/// Otherwise the rows are distributed evenly, and all processes share one parallel factor (MUMPS).
///
/// Each step length that is the longest one divided by 2^k has a cached factor, and cached columns Z = A^-1 B of the
/// links that have become active. Other step lengths are solved by conjugate gradients, preconditioned by the factor of
/// the nearest step level, or factored if many links are in contact. Solutions depend on the current step only, not on
/// earlier solves.
///
/// Every process holds the whole System; the matrices here hold only the rows of this process.
class SparseSolver final : public StructureSolver {
 public:
  /// Collective. `system` must outlive the solver. Throws std::invalid_argument for groups that are not contiguous or
  /// do not cover all degrees of freedom, an entry that couples two groups, a negative mass, a massless degree of
  /// freedom without stiffness, and a contact or dashpot at a massless one. Throws SolverError, naming the degree of
  /// freedom, for a singular matrix.
  SparseSolver(MPI_Comm comm, const System& system, const SparseOptions& options = {});

  void stiffness_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<Eigen::MatrixXd> y) const override {
    matrices_.stiffness_times(x, y);
  }
  void damping_times(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::Ref<const Eigen::MatrixXd> kx,
                     Eigen::Ref<Eigen::MatrixXd> y) const override {
    matrices_.damping_times(x, kx, y);
  }
  void mass_times(Eigen::Ref<const Eigen::VectorXd> x, Eigen::Ref<Eigen::VectorXd> y) const override {
    matrices_.mass_times(x, y);
  }
  void accelerate(Eigen::Ref<Eigen::VectorXd> r) const override { matrices_.accelerate(r); }
  void recover(Eigen::Ref<Eigen::VectorXd> x) const override { matrices_.recover(x); }
  void set_matrix(const EffectiveMatrix& matrix, const std::optional<int>& step_level) override {
    factors_.select(matrix, step_level);
  }
  bool solve(Eigen::Ref<Eigen::VectorXd> x) override;
  bool flexibility(std::span<const int> links, Eigen::MatrixXd& g) override;
  void add_response(double factor, std::span<const int> links, const Eigen::VectorXd& f,
                    Eigen::Ref<Eigen::VectorXd> y) const override;
  void gather(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& relative) const override {
    ends_.gather(x, relative);
  }
  void gather(std::span<const int> links, Eigen::Ref<const Eigen::MatrixXd> x,
              Eigen::MatrixXd& relative) const override;
  void add_forces(double factor, const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override {
    ends_.add_forces(factor, f, y);
  }
  void add_physical_forces(const Eigen::VectorXd& f, Eigen::Ref<Eigen::VectorXd> y) const override {
    y += f.segment(matrices_.first(), size());
  }
  void observe(Eigen::Ref<const Eigen::MatrixXd> x, Eigen::MatrixXd& values) const override;
  Eigen::VectorXd coordinates(const Eigen::VectorXd& physical) const override {
    return physical.segment(matrices_.first(), size());
  }
  Eigen::MatrixXd physical(Eigen::Ref<const Eigen::MatrixXd> x) const override { return matrices_.spread(x); }
  void combine(std::span<double> sums) const override { matrices_.combine(sums); }
  std::string description() const override;

  /// Total number of factorizations. Not collective.
  long factorizations() const { return factorizations_; }
  /// Factors that are held, and their memory on this process [MB]. Not collective.
  int factors() const { return factors_.count(); }
  double memory() const { return factors_.memory() * 1e-6; }
  /// Iterations of conjugate gradients so far on this process. Not collective.
  long iterations() const { return factors_.iterations(); }

 private:
  bool solve_by(const Factor& factor, Eigen::Ref<Eigen::VectorXd> x) const;
  bool ensure(CachedFactor& entry, std::span<const int> links);
  bool ensure_at_level(CachedFactor& entry, std::span<const int> links);
  bool columns_by_gradients(CachedFactor& entry, std::span<const int> links);
  bool columns_by_factor(CachedFactor& entry, int first, int count);
  void add_columns(CachedFactor& entry, Eigen::MatrixXd columns) const;

  const System& system_;
  SparseOptions options_;
  SystemMatrices matrices_;
  LinkEnds ends_;
  long factorizations_ = 0;
  CachedFactors factors_;
  SparseMatrix outputs_;  // rows of this process
  Eigen::VectorXd work_;
};

}  // namespace pounding::petsc
