#pragma once
/// All modes of a large structure at once, and all eigenpairs of a matrix.

#include <Eigen/Core>

#include <pounding/structures/damping.hpp>

namespace pounding::petsc {

/// As eigenpairs(), by LAPACK's divide and conquer, which SLEPc calls: for some thousand unknowns a tenth of the time.
/// Mass [kg] and stiffness [N/m] are n x n, the mass is positive definite. Throws std::invalid_argument where it is
/// not.
Eigenpairs all_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// All eigenvalues, ascending, and orthonormal eigenvectors of a symmetric n x n matrix, by the same. Throws
/// SolverError where it fails.
Eigenpairs eigenpairs_of(const Eigen::MatrixXd& symmetric);

}  // namespace pounding::petsc
