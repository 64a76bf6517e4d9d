#pragma once
/// Whole vectors on every process, and their parts in PETSc's.

#include <petscvec.h>

#include <Eigen/Core>

namespace pounding::petsc {

/// All entries of a vector, on every process; `to` has its global size. Collective.
PetscErrorCode gather(Vec from, Eigen::VectorXd& to);
/// The entries that this process owns, out of the whole vector.
PetscErrorCode scatter(const Eigen::VectorXd& from, Vec to);

}  // namespace pounding::petsc
