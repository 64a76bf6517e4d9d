#pragma once
/// A symmetric positive definite PETSc matrix with its factor, and conjugate gradients on a matrix near to it.

#include <petscksp.h>

#include <Eigen/Core>
#include <Eigen/SparseCore>
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

/// Sparsity pattern of the rows of this process: compressed rows with sorted columns, both triangles. Columns are
/// numbered over all processes of the matrix's communicator.
struct Pattern {
  std::vector<PetscInt> begin{0};  ///< of each row in `columns`, and the end of the last: rows + 1
  std::vector<PetscInt> columns;   ///< row by row

  /// Number of rows on this process.
  PetscInt rows() const { return static_cast<PetscInt>(begin.size()) - 1; }
};

/// Pattern and values of a symmetric matrix, compressed; the columns that Eigen stores are its rows. The values are a
/// view of the matrix.
Pattern pattern_of(const Eigen::SparseMatrix<double>& symmetric);
std::span<const double> values_of(const Eigen::SparseMatrix<double>& symmetric);

/// An AIJ matrix with these values, marked as positive definite. Collective.
Handle<Mat> make_matrix(MPI_Comm comm, const Pattern& pattern, std::span<const double> values);

/// Products y = A x on plain arrays of the rows of this process. Collective when the matrix is.
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

/// A KSP that applies a factor: by default PETSc's own Cholesky for a small matrix, else CHOLMOD on one process and
/// MUMPS on several. Options with the prefix choose another one.
class Factor {
 public:
  /// Collective. ok() tells on each process by itself whether the matrix could be factored. Throws InputError where
  /// PETSc has not got the package.
  Factor(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const std::string& prefix);

  /// True if the matrix could be factored.
  bool ok() const { return ok_; }
  /// Factors another matrix of the same pattern. The symbolic factorization is kept, a third of the work. False, with
  /// nothing done, on several processes; else ok() tells the result.
  bool refactor(std::span<const double> values);
  /// x = A^-1 b. False when an iterative solver, chosen by an option, did not converge.
  bool solve(const double* b, double* x) const;
  /// X = A^-1 B for all columns. Resizes x.
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const;
  /// Memory of the factor and the matrix on this process, as far as the package reports it [bytes].
  double memory() const { return memory_; }
  /// Package that holds the factor, or the iterative method that an option chose.
  const std::string& package() const { return package_; }
  /// True for a direct solver, whose solves cannot fail.
  bool is_direct() const { return direct_; }
  /// The factor as a preconditioner.
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

/// Conjugate gradients on a matrix, preconditioned by the factor of a matrix near to it, which must outlive this.
///
/// They stop at a residual of 1e-13 of the right-hand side: contact events are located to 1e-12 of the change of an
/// event function, and a step solved here must not differ from one by a factor at that level. The recurred residual
/// always gets there.
class NearSolver {
 public:
  NearSolver(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const Factor& near,
             const std::string& prefix);

  /// x = A^-1 b. `guess`: x holds an initial guess. False when the iteration did not converge.
  bool solve(const double* b, double* x, bool guess);
  /// Iterations of all solves so far.
  long iterations() const { return iterations_; }

 private:
  Product product_;
  Handle<KSP> ksp_;
  long iterations_ = 0;
};

}  // namespace pounding::petsc
