#pragma once
/// Requirements of the sparse solver on a System, and the diagnosis of singular matrices. Every process checks the
/// whole System, so all reach the same conclusion.

#include <vector>

#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// Throws std::invalid_argument for groups that are not contiguous or do not cover all degrees of freedom, and for a
/// matrix entry that couples two groups.
void require_groups(const System& system);

/// `diagonal` is that of the mass matrix [kg]. Throws std::invalid_argument for a negative mass, a massless degree of
/// freedom without stiffness, and a dashpot or contact at a massless one.
void require_masses(const System& system, const Eigen::VectorXd& diagonal);

/// Throws SolverError: `what` is singular or not positive definite over these degrees of freedom. Names one that moves
/// without resistance, if a pivot reveals it.
[[noreturn]] void fail_singular(const SparseMatrix& matrix, const std::vector<int>& dofs, const char* what);

}  // namespace pounding::petsc
