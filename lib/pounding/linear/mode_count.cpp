#include <pounding/linear/mode_count.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/SparseCholesky>

#include <pounding/core/error.hpp>
#include <pounding/linear/factor.hpp>
#include <pounding/petsc/library_lock.hpp>

namespace pounding::petsc {

#ifdef PETSC_HAVE_MUMPS
int count_modes_below(const SparseMatrix& shifted, double square, const std::string& prefix) {
  const LibraryLock lock;
  const Handle<Mat> matrix = make_matrix(PETSC_COMM_SELF, pattern_of(shifted), values_of(shifted));
  check(MatSetOption(matrix, MAT_SPD, PETSC_FALSE));
  check(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  const std::string count_prefix = prefix + "count_";
  check(MatSetOptionsPrefixFactor(matrix, count_prefix.c_str()));
  Handle<KSP> ksp;
  check(KSPCreate(PETSC_COMM_SELF, ksp.out()));
  check(KSPSetOptionsPrefix(ksp, count_prefix.c_str()));
  check(KSPSetOperators(ksp, matrix, matrix));
  check(KSPSetType(ksp, KSPPREONLY));
  PC pc = nullptr;
  check(KSPGetPC(ksp, &pc));
  check(PCSetType(pc, PCCHOLESKY));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  // MUMPS reports the inertia only if zero-pivot detection is on.
  Mat factor = nullptr;
  check(PCFactorSetUpMatSolverType(pc));
  check(PCFactorGetMatrix(pc, &factor));
  check(MatMumpsSetIcntl(factor, 24, 1));
  check(KSPSetFromOptions(ksp));
  check(KSPSetUp(ksp));
  PCFailedReason reason = PC_NOERROR;
  check(PCGetFailedReason(pc, &reason));
  if (reason != PC_NOERROR)
    throw SolverError(
        fmt::format("cannot count the modes below {:.6g} rad/s: factorization with MUMPS failed; type "
                    "-{}count_mat_mumps_icntl_14 100 for more memory",
                    std::sqrt(std::max(square, 0.0)), prefix));
  PetscInt negative = 0, zero = 0, positive = 0;
  check(MatGetInertia(factor, &negative, &zero, &positive));
  return negative + zero;
}
#else
int count_modes_below(const SparseMatrix& shifted, double square, const std::string&) {
  return count_modes_by_sequence(shifted, square);
}
#endif

int count_modes_by_sequence(const SparseMatrix& shifted, double square) {
  const Eigen::SimplicialLDLT<SparseMatrix> factor(shifted);
  if (factor.info() != Eigen::Success)
    throw SolverError(
        fmt::format("cannot count the modes below {:.6g} rad/s: a pivot is zero", std::sqrt(std::max(square, 0.0))));
  return static_cast<int>((factor.vectorD().array() <= 0).count());
}

}  // namespace pounding::petsc
