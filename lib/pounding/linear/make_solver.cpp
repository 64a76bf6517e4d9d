#include <pounding/linear/make_solver.hpp>

#include <utility>
#include <vector>

#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include <pounding/linear/tangent_solver.hpp>
#include <pounding/model/reducible.hpp>

namespace pounding::petsc {

namespace {

// Structures with a memory next to the others in natural modes.
std::unique_ptr<StructureSolver> make_tangent_solver(const System& system) {
  std::vector<int> others;
  for (std::size_t k = 0; k < system.groups.size(); ++k)
    if (!system.groups[k].tangent) others.push_back(static_cast<int>(k));
  std::unique_ptr<StructureSolver> linear;
  if (!others.empty())
    linear = std::make_unique<ModalSolver>(system, ReducedGroups{}, ModalOptions{.groups = others, .natural = {}});
  return std::make_unique<TangentSolver>(system, std::move(linear));
}

}  // namespace

std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, MPI_Comm comm) {
  if (system.has_tangents()) return make_tangent_solver(system);
  const bool modal = kind == SolverKind::modal ||
                     (kind == SolverKind::automatic && ModalSolver::max_dynamic_dofs(system) <= small_structure);
  if (modal) return std::make_unique<ModalSolver>(system);
  return std::make_unique<SparseSolver>(comm, system);
}

}  // namespace pounding::petsc
