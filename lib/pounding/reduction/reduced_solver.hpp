#pragma once
/// Creates the solver of structures that may be reduced.

#include <petscsys.h>

#include <memory>

#include <pounding/linear/make_solver.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/reduction/reduce.hpp>

namespace pounding::petsc {

/// As make_solver(); SolverKind::automatic follows the plan. Throws also as reduced_groups(), and InputError if a
/// structure that is not reduced has modal damping whose matrix would be too large.
std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, const ReductionPlan& plan,
                                             MPI_Comm comm);

}  // namespace pounding::petsc
