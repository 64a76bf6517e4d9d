#include <pounding/linear/make_solver.hpp>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>

namespace pounding::petsc {
namespace {

// Dynamic degrees of freedom of one structure up to which all its modes are computed.
constexpr int max_modes = 500;

}  // namespace

std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, MPI_Comm comm) {
  const bool modal = kind == SolverKind::modal || (kind == SolverKind::automatic && ModalSolver::max_dynamic_dofs(system) <= max_modes);
  if (modal) return std::make_unique<ModalSolver>(system);
  return std::make_unique<SparseSolver>(comm, system);
}

}  // namespace pounding::petsc
