#pragma once
/// Number of natural frequencies below a limit.

#include <string>

#include <pounding/structures/massless.hpp>

namespace pounding::petsc {

/// Number of modes with w^2 <= `square` [(rad/s)^2], from `shifted` = K - square M: by Sylvester's law of inertia there
/// are as many as negative and zero pivots in its factor (MUMPS). Options have the prefix `prefix` + "count_". Throws
/// SolverError, naming the option to change, when there is no factor. Where PETSc has no MUMPS this is
/// count_modes_by_sequence().
int count_modes_below(const SparseMatrix& shifted, double square, const std::string& prefix);

/// Counts them by the pivots of L D L^T in an order that keeps L sparse, whatever their size: a Sturm sequence (Bathe,
/// Finite element procedures, 1996, 11.4.3). Throws SolverError when a pivot is zero.
int count_modes_by_sequence(const SparseMatrix& shifted, double square);

}  // namespace pounding::petsc
