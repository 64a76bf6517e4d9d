#pragma once
/// The TS type `pounding`: PETSc's time stepping around the stepper that lands on impacts.

#include <petscts.h>

#include <pounding/stepper.hpp>

namespace pounding::petsc {

inline constexpr const char* ts_type = "pounding";

/// Makes the type known to TSSetType; may be called again.
PetscErrorCode register_ts_pounding();

/// Spectral radius at infinite frequency that `-ts_pounding_radius` or the caller chose, 0 to 1; 1 until then.
PetscErrorCode set_spectral_radius(TS ts, PetscReal radius);
PetscErrorCode get_spectral_radius(TS ts, PetscReal* radius);

/// The stepper that the TS drives; it must outlive the solve. The TS must hold its solution as TS2SetSolution does:
/// displacements and velocities of the stepper's system, sequential vectors.
///
/// The error of a step goes to TSAdapt, whose answer is taken down to the stepper's ladder unless its type is `none`.
/// Steps end where the ground motion has a corner and where a contact changes phase.
PetscErrorCode set_stepper(TS ts, Stepper* stepper);

}  // namespace pounding::petsc
