#pragma once
/// A symmetric positive definite PETSc matrix with its factor, and conjugate gradients on a matrix near to it.

#include <petscksp.h>

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>

namespace pounding::petsc {

template <>
struct Destroyer<Mat> {
  static PetscErrorCode destroy(Mat* object) { return MatDestroy(object); }
};
template <>
struct Destroyer<KSP> {
  static PetscErrorCode destroy(KSP* object) { return KSPDestroy(object); }
};

/// Where the entries of the rows of this process stand: compressed rows with sorted columns, both triangles. Columns count
/// over all processes of the matrix's communicator.
struct Pattern {
  std::vector<PetscInt> begin{0};  ///< one more than rows
  std::vector<PetscInt> columns;

  /// Of this process.
  PetscInt rows() const { return static_cast<PetscInt>(begin.size()) - 1; }
};

/// Rows of an AIJ matrix with these values. Collective.
Handle<Mat> make_matrix(MPI_Comm comm, const Pattern& pattern, std::span<const double> values);

/// y = A x with Eigen's memory, all on the rows of this process; collective when the matrix is.
class Product {
 public:
  explicit Product(Handle<Mat> matrix);
  /// y = A x.
  void operator()(const double* x, double* y) const;
  /// A, and its rows on this process.
  Mat matrix() const { return matrix_; }
  PetscInt rows() const { return rows_; }

 private:
  friend class Factor;
  friend class NearSolver;
  Handle<Mat> matrix_;
  Handle<Vec> x_, y_;
  PetscInt rows_ = 0;
};

/// A KSP that applies a factor: by default PETSc's own Cholesky for a small matrix, CHOLMOD on one process, MUMPS on several;
/// any other by options with the prefix.
class Factor {
 public:
  /// Collective. ok() tells, on each process by itself, whether the matrix could be factored.
  Factor(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const std::string& prefix);

  /// Whether the matrix could be factored.
  bool ok() const { return ok_; }
  /// Factors another matrix of the same pattern, on one process only: what the first one told of the pattern is kept, which
  /// is a third of the work. False when that is not possible here; ok() is told anew otherwise.
  bool refactor(std::span<const double> values);
  /// False when an iterative solver that was asked for did not converge.
  bool solve(const double* b, double* x) const;
  /// Every column; columns stand one after the other.
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const;
  /// Of the factor and the matrix on this process [bytes]; as far as the package tells.
  double memory() const { return memory_; }
  /// What really solves: the package that PETSc holds the factor in.
  const std::string& package() const { return package_; }
  /// Its solves cannot fail.
  bool is_direct() const { return direct_; }
  PC preconditioner() const;

 private:
  void set_up();
  void inspect();
  bool reproduces() const;

  Product product_;
  Handle<KSP> ksp_;
  bool ok_ = false, direct_ = false;
  double memory_ = 0;
  std::string package_;
};

/// Conjugate gradients on a matrix, preconditioned by the factor of one near to it, which must outlive this.
///
/// Stops at 1e-13 of the right-hand side: instants of contact are located to 1e-12 of a margin's change, and a step from here
/// must not differ from one by a factor at that level. The residual of the recurrence reaches it in any case.
class NearSolver {
 public:
  NearSolver(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const Factor& near,
             const std::string& prefix);

  /// `guess`: x holds one. False when it did not converge.
  bool solve(const double* b, double* x, bool guess);
  long iterations() const { return iterations_; }

 private:
  Product product_;
  Handle<KSP> ksp_;
  long iterations_ = 0;
};

}  // namespace pounding::petsc
