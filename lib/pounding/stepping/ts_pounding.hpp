#pragma once
/// The TS type `pounding`: a StepController behind the interface of PETSc's time steppers.

#include <petscts.h>

#include <pounding/stepping/stepper.hpp>

namespace pounding::petsc {

inline constexpr const char* ts_type = "pounding";

/// Registers the TS type and its default TSAdapt type, both `pounding`; may be called again.
PetscErrorCode register_ts_pounding();

/// The stepper that the TS drives; it must outlive the solve, and nullptr takes it away. The TS must hold displacements
/// and velocities of the stepper's system (TS2SetSolution), in vectors of one or of all processes that share its
/// solver.
///
/// ErrorControl chooses the steps, unless the TS has another TSAdapt type than `pounding`. Steps are rounded down to a
/// length that the stepper prefers, except for the type `none`. They end at breakpoints of the ground motion and at
/// events of contacts.
PetscErrorCode set_stepper(TS ts, Stepper* stepper);

/// Keeps a copy of the state at the beginning of every step, contacts included, so that TSRollBack() works. A TS with
/// events does so by itself.
PetscErrorCode set_rollback(TS ts, PetscBool keep);

/// Writes the vectors of the TS only where PETSc itself reads them: monitors, events, the end. For a host whose
/// callbacks ask the stepper.
PetscErrorCode set_lazy_vectors(TS ts, PetscBool lazy);

/// State of the TS and its stepper between two steps: after reading, TSSolve makes the same bits. Fails for TSAdapt
/// types with a state of their own: all but `pounding`, `basic` and `none`.
PetscErrorCode archive(TS ts, Archive& state);

}  // namespace pounding::petsc
