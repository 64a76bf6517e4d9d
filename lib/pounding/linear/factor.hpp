#pragma once
/// A symmetric positive definite PETSc matrix with its factor, and conjugate gradients preconditioned by the factor of
/// a similar matrix.

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

/// Sparsity pattern of the rows of this process: compressed rows with sorted columns, both triangles. Column indices
/// are global on the communicator of the matrix.
struct Pattern {
  std::vector<PetscInt> begin{0};  ///< start of each row in `columns`, and the end of the last: rows + 1
  std::vector<PetscInt> columns;   ///< row by row

  /// Number of rows on this process.
  PetscInt rows() const { return static_cast<PetscInt>(begin.size()) - 1; }
};

/// Pattern and values of a compressed symmetric matrix. Eigen's stored columns serve as rows. The values are a view of
/// the matrix.
Pattern pattern_of(const Eigen::SparseMatrix<double>& symmetric);
std::span<const double> values_of(const Eigen::SparseMatrix<double>& symmetric);

/// Creates an AIJ matrix with these values, marked positive definite. Collective.
Handle<Mat> make_matrix(MPI_Comm comm, const Pattern& pattern, std::span<const double> values);

/// Matrix-vector products y = A x on plain arrays of the rows of this process. Collective if the matrix is.
class Product {
 public:
  explicit Product(Handle<Mat> matrix);
  /// y = A x.
  void operator()(const double* x, double* y) const;
  /// A, and the number of its rows on this process.
  Mat matrix() const { return matrix_; }
  PetscInt rows() const { return rows_; }

 private:
  friend class Factor;
  friend class NearSolver;
  Handle<Mat> matrix_;
  Handle<Vec> x_, y_;
  PetscInt rows_ = 0;
};

/// A KSP that applies a factor. Default: PETSc's Cholesky for small matrices, otherwise CHOLMOD on one process and
/// MUMPS on several. Options with the prefix select another package.
class Factor {
 public:
  /// Collective. ok() reports per process whether the factorization succeeded. Throws InputError if PETSc was built
  /// without the package.
  Factor(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const std::string& prefix);

  /// True if the matrix could be factored.
  bool ok() const { return ok_; }
  /// Factors another matrix of the same pattern and reuses the symbolic factorization, a third of the work. Returns
  /// false without doing anything on several processes; otherwise ok() reports the result.
  bool refactor(std::span<const double> values);
  /// x = A^-1 b. False if an iterative solver, selected by an option, did not converge.
  bool solve(const double* b, double* x) const;
  /// X = A^-1 B for all columns. Resizes x.
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const;
  /// Memory of the factor and the matrix on this process, as reported by the package [bytes].
  double memory() const { return memory_; }
  /// Package that holds the factor, or the iterative method selected by an option.
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

/// Conjugate gradients, preconditioned by the factor of a similar matrix, which must outlive this.
///
/// The relative tolerance is 1e-13: contact events are located to 1e-12 of the change of an event function, so at that
/// level a step solved here must not differ from a step solved by a factor. The recursively updated residual always
/// reaches this tolerance.
class NearSolver {
 public:
  NearSolver(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const Factor& near,
             const std::string& prefix);

  /// x = A^-1 b. `guess`: x holds an initial guess. False if the iteration did not converge.
  bool solve(const double* b, double* x, bool guess);
  /// Total number of iterations.
  long iterations() const { return iterations_; }

 private:
  Product product_;
  Handle<KSP> ksp_;
  long iterations_ = 0;
};

}  // namespace pounding::petsc
