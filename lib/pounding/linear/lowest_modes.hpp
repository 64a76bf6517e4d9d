#pragma once
/// Lowest natural modes of structures of any size.

#include <pounding/structures/damping.hpp>

namespace pounding::petsc {

/// A ModeSolver for structures of any size: dense_modes for small ones, otherwise SLEPc's Krylov-Schur iteration
/// (Stewart 2001) with a sparse factor of the stiffness. Requires an Environment. Every process computes all modes;
/// results are bitwise reproducible.
///
/// The iteration uses the symmetric operator L^T (K - s M)^-1 L on the dynamic degrees of freedom, where M = L L^T. Its
/// eigenvalues are 1 / (w^2 - s), and (K - s M)^-1 L y is the full shape, so the infinite frequencies of massless
/// degrees of freedom do not appear. The shift s is 0, or slightly negative if the stiffness alone is singular: a body
/// that moves freely has modes of frequency 0. A single starting vector finds only one of several equal frequencies.
/// Therefore Sylvester's law of inertia counts the frequencies below the last requested one, and missing modes are
/// sought in the orthogonal complement of the others.
///
/// Options: -pounding_modes_eps_tol, -pounding_modes_eps_ncv, ... for the iteration;
/// -pounding_modes_pc_factor_mat_solver_type, ... for its factor (CHOLMOD); -pounding_modes_count_mat_mumps_... for the
/// factor that counts (MUMPS).
///
/// Throws std::invalid_argument as dense_modes does, and SolverError, naming the option to change, if fewer modes are
/// found than requested.
Eigenmodes lowest_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count);

/// As lowest_modes, with the sparse method for any size.
Eigenmodes sparse_modes(const SparseMatrix& mass, const SparseMatrix& stiffness, int count);

}  // namespace pounding::petsc
