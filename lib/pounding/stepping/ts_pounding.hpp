#pragma once
/// The TS type `pounding`: a StepController behind the interface of PETSc's time steppers.

#include <petscts.h>

#include <pounding/linear/make_solver.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding::petsc {

inline constexpr const char* ts_type = "pounding";

/// Makes the type known to TSSetType; may be called again.
PetscErrorCode register_ts_pounding();

/// Set by the caller or by the options -ts_pounding_scheme (generalized_alpha, esdirk4), -ts_pounding_radius (spectral
/// radius at infinite frequency, 0 to 1) and -ts_pounding_base (automatic, modal, sparse).
struct SolverOptions {
  Scheme scheme;
  SolverKind solver = SolverKind::automatic;
};
PetscErrorCode set_solver_options(TS ts, const SolverOptions& options);
PetscErrorCode get_solver_options(TS ts, SolverOptions* options);

/// The stepper that the TS drives; it must outlive the solve, and nullptr takes it away. The TS must hold displacements
/// and velocities of the stepper's system (TS2SetSolution), in vectors of one or of all processes that share its
/// solver.
///
/// TSAdapt gets the error of each step; its answer is rounded down to a length that the stepper prefers, unless its
/// type is `none`. Steps end at breakpoints of the ground motion and at events of contacts.
PetscErrorCode set_stepper(TS ts, Stepper* stepper);

/// Keeps a copy of the state at the beginning of every step, contacts included, so that TSRollBack() works. A TS with
/// events does so by itself.
PetscErrorCode set_rollback(TS ts, PetscBool keep);

/// Writes the vectors of the TS only where PETSc itself reads them: monitors, events, the end. For a host whose
/// callbacks ask the stepper.
PetscErrorCode set_lazy_vectors(TS ts, PetscBool lazy);

/// State of the TS and its stepper between two steps: after reading, TSSolve makes the same bits. Fails for a TSAdapt
/// with a memory of its own; only `basic` and `none` have none.
PetscErrorCode archive(TS ts, Archive& state);

}  // namespace pounding::petsc
