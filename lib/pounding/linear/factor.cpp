#include <pounding/linear/factor.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/library_lock.hpp>
#include <pounding/petsc/version.hpp>

namespace pounding::petsc {
namespace {

// Below this size PETSc's own Cholesky is faster, because each call to CHOLMOD or MUMPS has a fixed cost.
constexpr PetscInt small_matrix = 500;
// If a factor does not reproduce a known solution to this relative error, the matrix is singular. Frames have condition
// numbers up to 1e12.
constexpr double max_reproduction_error = 1e-2;
constexpr double close_enough = 1e-13;
constexpr PetscInt max_iterations = 200;

int processes(MPI_Comm comm) {
  int count = 1;
  MPI_Comm_size(comm, &count);
  return count;
}

// Lets a Vec use an array of the caller during the lifetime of this object.
class Placed {
 public:
  Placed(Vec vec, const double* values) : vec_(vec) { check(VecPlaceArray(vec, values)); }
  ~Placed() { VecResetArray(vec_); }
  Placed(const Placed&) = delete;
  Placed& operator=(const Placed&) = delete;

 private:
  Vec vec_;
};

// Factor type of a preconditioner; MAT_FACTOR_NONE if it is not a factor.
MatFactorType factor_type(PC pc) {
  PetscBool cholesky = PETSC_FALSE, lu = PETSC_FALSE;
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), PCCHOLESKY, &cholesky));
  check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(pc), PCLU, &lu));
  return cholesky ? MAT_FACTOR_CHOLESKY : lu ? MAT_FACTOR_LU : MAT_FACTOR_NONE;
}

// Without this check, a package missing from PETSc would look like a singular matrix.
void require_package(PC pc, Mat matrix, const std::string& prefix) {
  const MatFactorType type = factor_type(pc);
  MatSolverType package = nullptr;
  if (type != MAT_FACTOR_NONE) check(PCFactorGetMatSolverType(pc, &package));
  // If an option has selected only the factor type, PETSc chooses an available package.
  if (!package) return;
  PetscBool available = PETSC_FALSE;
  check(MatGetFactorAvailable(matrix, package, type, &available));
  if (available) return;
  const int count = processes(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)));
  throw InputError(count > 1 ? fmt::format("PETSc was built without {}, which is required on {} processes; start at "
                                           "most as many processes as there are structures, or build PETSc with MUMPS",
                                           package, count)
                             : fmt::format("PETSc was built without {}; type -{}pc_factor_mat_solver_type cholmod",
                                           package, prefix));
}

PetscErrorCode apply_near(PC pc, Vec x, Vec y) {
  void* near = nullptr;
  PetscFunctionBegin;
  PetscCall(PCShellGetContext(pc, &near));
  PetscCall(PCApply(static_cast<const Factor*>(near)->preconditioner(), x, y));
  PetscFunctionReturn(POUNDING_PETSC_SUCCESS);
}

}  // namespace

Pattern pattern_of(const Eigen::SparseMatrix<double>& a) {
  const PetscInt* begin = a.outerIndexPtr();
  return {{begin, begin + a.cols() + 1}, {a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros()}};
}

std::span<const double> values_of(const Eigen::SparseMatrix<double>& a) {
  return {a.valuePtr(), static_cast<std::size_t>(a.nonZeros())};
}

Handle<Mat> make_matrix(MPI_Comm comm, const Pattern& pattern, std::span<const double> values) {
  const LibraryLock lock;
  Handle<Mat> matrix;
  check(MatCreate(comm, matrix.out()));
  check(MatSetSizes(matrix, pattern.rows(), pattern.rows(), PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetType(matrix, MATAIJ));
  if (processes(comm) == 1)
    check(MatSeqAIJSetPreallocationCSR(matrix, pattern.begin.data(), pattern.columns.data(), values.data()));
  else
    check(MatMPIAIJSetPreallocationCSR(matrix, pattern.begin.data(), pattern.columns.data(), values.data()));
  check(MatSetOption(matrix, MAT_SPD, PETSC_TRUE));
  return matrix;
}

Product::Product(Handle<Mat> matrix) : matrix_(std::move(matrix)) {
  const LibraryLock lock;
  check(MatGetLocalSize(matrix_, &rows_, nullptr));
  for (Handle<Vec>* vec : {&x_, &y_}) {
    const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(matrix_.get()));
    if (processes(comm) == 1)
      check(VecCreateSeqWithArray(comm, 1, rows_, nullptr, vec->out()));
    else
      check(VecCreateMPIWithArray(comm, 1, rows_, PETSC_DETERMINE, nullptr, vec->out()));
  }
}

void Product::operator()(const double* x, double* y) const {
  const LibraryLock lock;
  const Placed from(x_, x), to(y_, y);
  check(MatMult(matrix_, x_, y_));
}

Factor::Factor(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const std::string& prefix)
    : product_(make_matrix(comm, pattern, values)) {
  const LibraryLock lock;
  PetscInt size = 0;
  check(MatGetSize(product_.matrix(), &size, nullptr));
  check(KSPCreate(comm, ksp_.out()));
  check(KSPSetOptionsPrefix(ksp_, prefix.c_str()));
  check(KSPSetOperators(ksp_, product_.matrix(), product_.matrix()));
  check(KSPSetType(ksp_, KSPPREONLY));
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  if (processes(comm) > 1) {
    check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  } else if (size < small_matrix) {
    check(PCFactorSetMatSolverType(pc, MATSOLVERPETSC));
    check(PCFactorSetMatOrderingType(pc, MATORDERINGND));
  } else {
    check(PCFactorSetMatSolverType(pc, MATSOLVERCHOLMOD));
  }
  check(KSPSetFromOptions(ksp_));
  require_package(pc, product_.matrix(), prefix);
  set_up();
  if (ok_) inspect();
}

void Factor::set_up() {
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  try {
    check(KSPSetUp(ksp_));
    PCFailedReason reason = PC_NOERROR;
    check(PCGetFailedReason(pc, &reason));
    if (reason == PC_FACTOR_OUTMEMORY)
      throw SolverError(fmt::format("out of memory for the factor of a matrix of {} rows", product_.rows()));
    ok_ = reason == PC_NOERROR && reproduces();
  } catch (const SolverError&) {
    ok_ = false;
  }
}

bool Factor::refactor(std::span<const double> values) {
  const LibraryLock lock;
  const Mat matrix = product_.matrix();
  if (processes(PetscObjectComm(reinterpret_cast<PetscObject>(matrix))) > 1) return false;
  PetscScalar* entries = nullptr;
  check(MatSeqAIJGetArray(matrix, &entries));
  std::copy(values.begin(), values.end(), entries);
  check(MatSeqAIJRestoreArray(matrix, &entries));
  check(KSPSetOperators(ksp_, matrix, matrix));
  set_up();
  return true;
}

// Multiplies a vector with components in all motions, and solves for it again.
bool Factor::reproduces() const {
  Eigen::VectorXd x(product_.rows()), b(product_.rows()), again(product_.rows());
  for (PetscInt i = 0; i < product_.rows(); ++i) x[i] = 1 + 0.5 * std::sin(1.7 * i);
  product_(x.data(), b.data());
  return solve(b.data(), again.data()) && (again - x).lpNorm<Eigen::Infinity>() <= max_reproduction_error;
}

void Factor::inspect() {
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  MatInfo info;
  check(MatGetInfo(product_.matrix(), MAT_LOCAL, &info));
  memory_ = info.memory;
  const MatFactorType type = factor_type(pc);
  KSPType ksp_type = nullptr;
  check(KSPGetType(ksp_, &ksp_type));
  direct_ = type != MAT_FACTOR_NONE && std::string_view(ksp_type) == KSPPREONLY;
  if (type == MAT_FACTOR_NONE) {
    PCType pc_type = nullptr;
    check(PCGetType(pc, &pc_type));
    package_ = std::string(ksp_type) + " with " + pc_type;
    return;
  }
  Mat factor = nullptr;
  MatSolverType package = nullptr;
  check(PCFactorGetMatrix(pc, &factor));
  check(MatFactorGetSolverType(factor, &package));
  check(MatGetInfo(factor, MAT_LOCAL, &info));
  package_ = std::string(package) + (type == MAT_FACTOR_CHOLESKY ? " Cholesky" : " LU");
  // MUMPS reports the number of entries, not bytes.
  memory_ += std::max<double>(info.memory, info.nz_used * sizeof(PetscScalar));
}

PC Factor::preconditioner() const {
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  return pc;
}

bool Factor::solve(const double* b, double* x) const {
  const LibraryLock lock;
  const Placed from(product_.x_, b), to(product_.y_, x);
  check(KSPSolve(ksp_, product_.x_, product_.y_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp_, &reason));
  return reason > 0;
}

bool Factor::solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) const {
  const LibraryLock lock;
  const MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(ksp_.get()));
  x.resize(b.rows(), b.cols());
  Handle<Mat> from, to;
  const PetscInt rows = static_cast<PetscInt>(b.rows()), columns = static_cast<PetscInt>(b.cols());
  check(MatCreateDense(comm, rows, PETSC_DECIDE, PETSC_DETERMINE, columns, const_cast<double*>(b.data()), from.out()));
  check(MatCreateDense(comm, rows, PETSC_DECIDE, PETSC_DETERMINE, columns, x.data(), to.out()));
  check(KSPMatSolve(ksp_, from, to));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetConvergedReason(ksp_, &reason));
  return reason > 0;
}

NearSolver::NearSolver(MPI_Comm comm, const Pattern& pattern, std::span<const double> values, const Factor& near,
                       const std::string& prefix)
    : product_(make_matrix(comm, pattern, values)) {
  const LibraryLock lock;
  check(KSPCreate(comm, ksp_.out()));
  check(KSPSetOptionsPrefix(ksp_, prefix.c_str()));
  check(KSPSetOperators(ksp_, product_.matrix(), product_.matrix()));
  check(KSPSetType(ksp_, KSPCG));
  check(KSPSetTolerances(ksp_, close_enough, 0, PETSC_DEFAULT, max_iterations));
  PC pc = nullptr;
  check(KSPGetPC(ksp_, &pc));
  check(PCSetType(pc, PCSHELL));
  check(PCShellSetContext(pc, const_cast<Factor*>(&near)));
  check(PCShellSetApply(pc, apply_near));
  check(PCShellSetName(pc, "factor of a nearby step"));
  check(KSPSetFromOptions(ksp_));
}

bool NearSolver::solve(const double* b, double* x, bool guess) {
  const LibraryLock lock;
  check(KSPSetInitialGuessNonzero(ksp_, guess ? PETSC_TRUE : PETSC_FALSE));
  const Placed from(product_.x_, b), to(product_.y_, x);
  check(KSPSolve(ksp_, product_.x_, product_.y_));
  PetscInt iterations = 0;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  check(KSPGetIterationNumber(ksp_, &iterations));
  check(KSPGetConvergedReason(ksp_, &reason));
  iterations_ += iterations;
  return reason > 0;
}

}  // namespace pounding::petsc
