#pragma once
/// All modes of a large structure, and all eigenpairs of a symmetric matrix.

#include <Eigen/Core>

#include <pounding/structures/damping.hpp>

namespace pounding::petsc {

/// Same result as eigenpairs(), by LAPACK's divide-and-conquer method through SLEPc: ten times faster for a few
/// thousand unknowns. Mass [kg] and stiffness [N/m] are n x n. Throws std::invalid_argument if the mass is not positive
/// definite.
Eigenpairs all_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

/// All eigenvalues (ascending) and orthonormal eigenvectors of a symmetric n x n matrix, by the same method. Throws
/// SolverError on failure.
Eigenpairs eigenpairs_of(const Eigen::MatrixXd& symmetric);

}  // namespace pounding::petsc
