#include <pounding/linear/make_solver.hpp>

#include <algorithm>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>

namespace pounding::petsc {

std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, MPI_Comm comm) {
  const bool modal = kind == SolverKind::modal || (kind == SolverKind::automatic && ModalSolver::max_dynamic_dofs(system) <= small_structure);
  if (modal) return std::make_unique<ModalSolver>(system);
  return std::make_unique<SparseSolver>(comm, system);
}

std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, const ReductionPlan& plan, MPI_Comm comm) {
  const bool asked = std::ranges::any_of(plan.groups, [](const Reduction& how) { return how.kind != Reduction::Kind::none; });
  if (kind != SolverKind::automatic || !asked) return make_solver(system, kind, comm);
  if (const std::optional<ReducedGroups> reduced = reduced_groups(system, plan))
    return std::make_unique<ModalSolver>(system, *reduced);
  return std::make_unique<SparseSolver>(comm, system);
}

}  // namespace pounding::petsc
