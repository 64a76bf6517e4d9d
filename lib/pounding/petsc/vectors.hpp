#pragma once
/// Whole vectors on every process, and PETSc vectors.

#include <petscvec.h>

#include <Eigen/Core>

namespace pounding::petsc {

/// Copies all entries of a vector to every process; `to` has its global size. Collective.
PetscErrorCode gather(Vec from, Eigen::VectorXd& to);
/// Copies the entries owned by this process from the whole vector.
PetscErrorCode scatter(const Eigen::VectorXd& from, Vec to);

}  // namespace pounding::petsc
