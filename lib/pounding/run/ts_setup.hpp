#pragma once
/// Effective settings of a run, including the command line, and its TS.

#include <petscts.h>

#include <Eigen/Core>

#include <pounding/linear/make_solver.hpp>
#include <pounding/model/model.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/stepping/step_view.hpp>

namespace pounding {

/// Settings of a run: those of the model, overridden by options with the prefix -pounding_.
struct EffectiveSettings {
  StepperOptions stepper;
  petsc::SolverKind solver = petsc::SolverKind::automatic;
  double duration = 0;    ///< of the run [s]
  double first_step = 0;  ///< first step to try [s]
  long max_steps = 0;
};

/// Reads the options -pounding_ts_rtol, -ts_dt, -ts_max_steps, -ts_pounding_scheme (generalized_alpha, esdirk4),
/// -ts_pounding_radius (spectral radius at infinite frequency, 0 to 1) and -ts_pounding_base (automatic, modal,
/// sparse), all with this prefix. Throws InputError if one is invalid.
EffectiveSettings effective_settings(const Model& model);

/// A TS of type `pounding`, without its stepper.
struct TsSetup {
  petsc::Handle<TS> ts;
  petsc::Handle<Vec> u, v;  ///< solution of the TS: displacements and velocities of all degrees of freedom
};

/// Creates the TS for a run from displacements u [m] and velocities v [m/s] at time 0. Collective on `comm`. Throws
/// InputError for PETSc options that are invalid, unknown or have no effect.
TsSetup set_up_ts(const EffectiveSettings& settings, const Eigen::VectorXd& u, const Eigen::VectorXd& v, MPI_Comm comm);

/// Throws InputError for a -pounding_ option that nothing has read. Options of the first factorization
/// (-pounding_lev_...) are read when it is made; `factors_too`: it has been made.
void refuse_unread_options(bool factors_too);

}  // namespace pounding
