#pragma once
/// All modes of a large structure at once.

#include <Eigen/Core>

#include <pounding/structures/damping.hpp>

namespace pounding::petsc {

/// As eigenpairs(), by LAPACK's divide and conquer, which SLEPc calls: for some thousand unknowns a tenth of the time. Mass [kg] and stiffness [N/m] are
/// n x n, the mass is positive definite. Throws std::invalid_argument where it is not.
Eigenpairs all_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

}  // namespace pounding::petsc
