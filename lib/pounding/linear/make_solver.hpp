#pragma once
/// Creates the solver of the structures.

#include <petscsys.h>

#include <memory>

#include <pounding/linear/structure_solver.hpp>

namespace pounding::petsc {

/// Solver of the structures without their links.
enum class SolverKind {
  automatic,  ///< modal if no structure has more than 500 dynamic degrees of freedom, otherwise sparse
  modal,      ///< ModalSolver: all modes of every structure
  sparse      ///< SparseSolver: PETSc matrices and factors
};

/// Collective on `comm` if sparse. `system` must outlive the solver. Throws as the constructors of the two solvers do.
std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, MPI_Comm comm);

}  // namespace pounding::petsc
