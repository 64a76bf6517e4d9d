#pragma once
/// Number of natural frequencies below a limit.

#include <string>

#include <pounding/structures/massless.hpp>

namespace pounding::petsc {

/// Number of modes with w^2 <= `square` [(rad/s)^2], from `shifted` = K - square M: by Sylvester's law of inertia there are as
/// many as negative and zero pivots in its factor (MUMPS). Options have the prefix `prefix` + "count_". Throws SolverError,
/// naming the option to change, when there is no factor.
int count_modes_below(const SparseMatrix& shifted, double square, const std::string& prefix);

}  // namespace pounding::petsc
