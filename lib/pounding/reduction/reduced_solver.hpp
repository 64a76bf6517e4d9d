#pragma once
/// Creates the solver of structures that may be reduced.

#include <petscsys.h>

#include <memory>

#include <pounding/linear/make_solver.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/reduction/reduce.hpp>

namespace pounding::petsc {

/// As make_solver() in linear; SolverKind::automatic follows the plan. Also throws as reduced_groups(), and InputError
/// if the modal damping matrix of a structure that is not reduced would be too large.
std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, const ReductionPlan& plan,
                                             MPI_Comm comm);

}  // namespace pounding::petsc
