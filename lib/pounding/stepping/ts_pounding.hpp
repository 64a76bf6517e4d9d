#pragma once
/// The TS type `pounding`: a StepController behind the interface of PETSc's time steppers.

#include <petscts.h>

#include <pounding/stepping/stepper.hpp>

namespace pounding::petsc {

inline constexpr const char* ts_type = "pounding";

/// Registers the TS type and its default TSAdapt type, both `pounding`; may be called again.
PetscErrorCode register_ts_pounding();

/// Sets the stepper that the TS drives; it must outlive the solve. A null pointer removes it. The TS must hold the
/// displacements and velocities of the stepper's system (TS2SetSolution), in vectors of one process or of all processes
/// that share its solver.
///
/// ErrorControl chooses the steps unless the TSAdapt type differs from `pounding`. Steps are rounded down to a length
/// preferred by the stepper, except for the type `none`. They end at breakpoints of the ground motion and at contact
/// events.
PetscErrorCode set_stepper(TS ts, Stepper* stepper);

/// Keeps a copy of the state at the beginning of every step, including contacts, so that TSRollBack() works. Automatic
/// for a TS with events.
PetscErrorCode set_rollback(TS ts, PetscBool keep);

/// Writes the vectors of the TS only when PETSc itself reads them: monitors, events, the end. For hosts whose callbacks
/// query the stepper.
PetscErrorCode set_lazy_vectors(TS ts, PetscBool lazy);

/// Writes or reads the state of the TS and its stepper between two steps; a resumed TSSolve is bitwise identical. Fails
/// for TSAdapt types with internal state, that is all except `pounding`, `basic` and `none`.
PetscErrorCode archive(TS ts, Archive& state);

}  // namespace pounding::petsc
