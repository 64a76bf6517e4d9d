#pragma once
/// Number of natural frequencies below a limit.

#include <string>

#include <pounding/structures/massless.hpp>

namespace pounding::petsc {

/// Number of modes with w^2 <= `square` [(rad/s)^2], from `shifted` = K - square M. By Sylvester's law of inertia it
/// equals the number of negative and zero pivots of the factor (MUMPS). The options prefix is `prefix` + "count_".
/// Throws SolverError, naming the option to change, if the factorization fails. If PETSc has no MUMPS,
/// count_modes_by_sequence() is called.
int count_modes_below(const SparseMatrix& shifted, double square, const std::string& prefix);

/// Counts the pivots of L D L^T, in an order that keeps L sparse, regardless of their size: a Sturm sequence (Bathe,
/// Finite element procedures, 1996, 11.4.3). Throws SolverError if a pivot is zero.
int count_modes_by_sequence(const SparseMatrix& shifted, double square);

}  // namespace pounding::petsc
