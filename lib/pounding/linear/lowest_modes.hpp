#pragma once
/// The lowest natural modes of large structures.

#include <pounding/structures/damping.hpp>

namespace pounding::petsc {

/// A ModeSolver for structures of any size: dense_modes for small ones, else SLEPc's Krylov-Schur iteration (Stewart 2001)
/// with a sparse factor of the stiffness. Needs an Environment. Every process finds all modes by itself, the same bits each
/// time.
///
/// Iterated is the symmetric operator L^T (K - s M)^-1 L on the unknowns with mass only, where M = L L^T there; its
/// eigenvalues are 1 / (w^2 - s), and (K - s M)^-1 L y is the whole shape. So nothing of the infinite frequencies of unknowns
/// without mass takes part. The shift s is 0, or slightly negative where the stiffness alone is singular: a body that is free
/// to move has modes of frequency 0. One starting vector meets one of several equal frequencies: how many lie below the last
/// one wanted is counted by Sylvester's law of inertia, and those that are missing are sought orthogonally to the others.
///
/// Options with the prefix `-pounding_modes_`: -pounding_modes_eps_tol, -pounding_modes_eps_ncv ... of the iteration,
/// -pounding_modes_pc_factor_mat_solver_type ... of the factor (CHOLMOD), -pounding_modes_count_mat_mumps_... of the counting
/// one (MUMPS).
///
/// Throws std::invalid_argument as dense_modes does, and SolverError, with the option to change, when fewer modes are found
/// than asked for.
Eigenmodes lowest_modes(const Eigen::SparseMatrix<double>& mass, const Eigen::SparseMatrix<double>& stiffness, int count);

/// The same without the choice: sparse for any size.
Eigenmodes sparse_modes(const Eigen::SparseMatrix<double>& mass, const Eigen::SparseMatrix<double>& stiffness, int count);

}  // namespace pounding::petsc
