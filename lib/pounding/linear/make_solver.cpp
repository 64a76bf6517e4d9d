#include <pounding/linear/make_solver.hpp>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include <pounding/model/reducible.hpp>

namespace pounding::petsc {

std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, MPI_Comm comm) {
  const bool modal = kind == SolverKind::modal ||
                     (kind == SolverKind::automatic && ModalSolver::max_dynamic_dofs(system) <= small_structure);
  if (modal) return std::make_unique<ModalSolver>(system);
  return std::make_unique<SparseSolver>(comm, system);
}

}  // namespace pounding::petsc
