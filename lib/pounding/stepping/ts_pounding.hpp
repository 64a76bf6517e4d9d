#pragma once
/// The TS type `pounding`: PETSc's time stepping around the stepper that lands on impacts.

#include <petscts.h>

#include <pounding/linear/make_solver.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding::petsc {

inline constexpr const char* ts_type = "pounding";

/// Makes the type known to TSSetType; may be called again.
PetscErrorCode register_ts_pounding();

/// What `-ts_pounding_scheme` (generalized_alpha, esdirk4), `-ts_pounding_radius` (spectral radius at infinite frequency,
/// 0 to 1) and `-ts_pounding_base` (automatic, modal, sparse) or the caller chose.
struct SolverOptions {
  Scheme scheme;
  SolverKind solver = SolverKind::automatic;
};
PetscErrorCode set_solver_options(TS ts, const SolverOptions& choice);
PetscErrorCode get_solver_options(TS ts, SolverOptions* choice);

/// The stepper that the TS drives; it must outlive the solve. The TS must hold its solution as TS2SetSolution does:
/// displacements and velocities of the stepper's system, in vectors of one or of all processes that share the stepper's base.
///
/// The error of a step goes to TSAdapt, whose answer is taken down to the stepper's ladder unless its type is `none`.
/// Steps end where the ground motion has a corner and where a contact changes phase.
PetscErrorCode set_stepper(TS ts, Stepper* stepper);

/// Keeps the beginning of every step, contacts included, so that TSRollBack() works. A TS with events does so unasked.
PetscErrorCode set_rollback(TS ts, PetscBool keep);

/// The vectors of the TS are brought up to date only where PETSc itself looks at them (monitors, events, the end), for a
/// caller whose callbacks ask the stepper.
PetscErrorCode set_lazy_vectors(TS ts, PetscBool lazy);

/// What the TS and its stepper keep from one step to the next: after it was read, TSSolve goes on with the same bits. Fails
/// for a TSAdapt that has a memory of its own: only `basic` and `none` have not.
PetscErrorCode archive(TS ts, Archive& state);

}  // namespace pounding::petsc
