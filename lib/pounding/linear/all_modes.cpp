#include <pounding/linear/all_modes.hpp>

#include <slepcds.h>

#include <Eigen/Cholesky>
#include <stdexcept>

#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/library_lock.hpp>

namespace pounding::petsc {
namespace {

constexpr PetscInt divide_and_conquer = 2;

class DirectSolver {
 public:
  explicit DirectSolver(PetscInt n) {
    check(DSCreate(PETSC_COMM_SELF, &ds_));
    check(DSSetType(ds_, DSHEP));
    check(DSSetMethod(ds_, divide_and_conquer));
    check(DSAllocate(ds_, n));
    check(DSSetDimensions(ds_, n, 0, 0));
  }
  ~DirectSolver() { DSDestroy(&ds_); }
  DirectSolver(const DirectSolver&) = delete;
  DirectSolver& operator=(const DirectSolver&) = delete;

  // Calls visit(matrix) with one of the matrices.
  template <class Visit>
  void with(DSMatType which, Eigen::Index n, Visit&& visit) {
    PetscInt stride = 0;
    PetscScalar* values = nullptr;
    check(DSGetLeadingDimension(ds_, &stride));
    check(DSGetArray(ds_, which, &values));
    visit(Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>(values, n, n, Eigen::OuterStride<>(stride)));
    check(DSRestoreArray(ds_, which, &values));
  }
  void solve(Eigen::VectorXd& values) {
    check(DSSetState(ds_, DS_STATE_RAW));
    check(DSSolve(ds_, values.data(), nullptr));
  }

 private:
  DS ds_ = nullptr;
};

}  // namespace

Eigenpairs eigenpairs_of(const Eigen::MatrixXd& symmetric) {
  const LibraryLock lock;
  const Eigen::Index n = symmetric.rows();
  DirectSolver solver(static_cast<PetscInt>(n));
  solver.with(DS_MAT_A, n, [&](auto&& matrix) { matrix = symmetric; });
  Eigenpairs made;
  made.values.resize(n);
  solver.solve(made.values);
  solver.with(DS_MAT_Q, n, [&](auto&& matrix) { made.vectors = matrix; });
  return made;
}

Eigenpairs all_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness) {
  const bool lumped = mass.isDiagonal(0);
  Eigen::VectorXd root;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::MatrixXd a = stiffness;
  if (lumped) {
    if (!(mass.diagonal().minCoeff() > 0)) throw std::invalid_argument("the mass matrix is not positive definite");
    root = mass.diagonal().cwiseSqrt().cwiseInverse();
    a = root.asDiagonal() * stiffness * root.asDiagonal();
  } else {
    factor.compute(mass);
    if (factor.info() != Eigen::Success) throw std::invalid_argument("the mass matrix is not positive definite");
    factor.matrixL().solveInPlace(a);
    a.transposeInPlace();
    factor.matrixL().solveInPlace(a);
  }
  Eigenpairs made = eigenpairs_of(0.5 * (a + a.transpose()));
  if (lumped)
    made.vectors = root.asDiagonal() * made.vectors;
  else
    factor.matrixU().solveInPlace(made.vectors);
  return made;
}

}  // namespace pounding::petsc
