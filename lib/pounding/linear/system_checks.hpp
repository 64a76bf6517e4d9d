#pragma once
/// Rows of a system on each process, requirements of the sparse solver, and the degree of freedom that makes a matrix
/// singular. Every process checks the whole System, so that all reach the same result.

#include <vector>

#include <pounding/model/system.hpp>

namespace pounding::petsc {

/// True if each process gets whole groups, because there are at least as many groups as processes.
bool shares_whole_groups(const System& system, int processes);

/// First row of each process, and last the number of all rows: length processes + 1. Whole groups, by the entries of
/// their stiffness, where shares_whole_groups; else even parts.
std::vector<int> first_rows(const System& system, int processes);

/// Throws std::invalid_argument for groups that do not follow one another over all degrees of freedom, and for an entry
/// of a matrix that joins two groups.
void require_groups(const System& system);

/// `diagonal` is that of the mass matrix [kg]. Throws std::invalid_argument for a negative mass, a massless degree of
/// freedom without stiffness, and a dashpot or contact at a massless one.
void require_masses(const System& system, const Eigen::VectorXd& diagonal);

/// Throws SolverError: `what` is singular or not positive definite over these degrees of freedom. Names one that moves
/// without resistance, if a pivot reveals it.
[[noreturn]] void fail_singular(const SparseMatrix& matrix, const std::vector<int>& dofs, const char* what);

}  // namespace pounding::petsc
