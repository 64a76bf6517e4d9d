#pragma once
/// Chooses how the structures are solved.

#include <petscsys.h>

#include <memory>

#include <pounding/linear/structure_solver.hpp>

namespace pounding::petsc {

/// How the structures are solved without their links.
enum class SolverKind {
  automatic,  ///< modal while setting it up is cheap, else sparse
  modal,      ///< all modes of every structure
  sparse      ///< PETSc matrices and factors
};

/// `automatic` is modal while setting that up is cheap. Collective on `comm` when it is sparse.
std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, MPI_Comm comm);

}  // namespace pounding::petsc
