#include <pounding/reduction/reduced_solver.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/linear/modal_solver.hpp>
#include <pounding/linear/sparse_solver.hpp>
#include <pounding/reduction/shadowed_solver.hpp>
#include <pounding/structures/damping.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding::petsc {

std::unique_ptr<StructureSolver> make_solver(const System& system, SolverKind kind, const ReductionPlan& plan,
                                             MPI_Comm comm) {
  const bool requested =
      std::ranges::any_of(plan.groups, [](const Reduction& how) { return how.kind != Reduction::Kind::none; });
  if (kind != SolverKind::automatic || !requested) return make_solver(system, kind, comm);
  for (std::size_t k = 0; k < system.groups.size(); ++k)
    if (system.groups[k].tangent)
      throw InputError(fmt::format(
          "a reduction is not available in a model with members of fibres, and \"{}\" has some; remove reduction",
          plan.names[k]));
  if (const std::optional<ReducedGroups> reduced = reduced_groups(system, plan)) {
    const auto is_shadowed = [](const std::optional<ReducedGroup>& group) { return group && group->shadow; };
    if (std::ranges::any_of(*reduced, is_shadowed)) return std::make_unique<ShadowedSolver>(system, *reduced);
    return std::make_unique<ModalSolver>(system, *reduced);
  }
  for (std::size_t k = 0; k < system.groups.size(); ++k)
    if (const Group& group = system.groups[k]; group.modal_ratio > 0 && !system.has_modal_matrix(group))
      if (const auto count = split_by_mass(system.mass, group.first, group.count).dynamic.size();
          count > static_cast<std::size_t>(max_for_modal_damping))
        throw InputError(
            fmt::format("\"{}\" is not reduced, and its modal damping requires a full matrix of {} x {} modes; type "
                        "damping: 5 % for it, or reduce all large structures",
                        plan.names[k], count, count));
  return std::make_unique<SparseSolver>(comm, system);
}

}  // namespace pounding::petsc
