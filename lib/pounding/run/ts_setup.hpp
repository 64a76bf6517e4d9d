#pragma once
/// The TS of a run, and the settings of the run after the command line.

#include <petscts.h>

#include <Eigen/Core>

#include <pounding/linear/make_solver.hpp>
#include <pounding/model/model.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {

/// A TS of the type `pounding` without its stepper.
///
/// Settings flow one way: the model gives the defaults, PETSc parses the command line (-pounding_ts_...) into the TS,
/// and what holds then is taken from the TS here, once. Nothing asks the TS for a setting later.
struct TsSetup {
  petsc::Handle<TS> ts;
  petsc::Handle<Vec> u, v;  ///< solution of the TS: displacements and velocities of all unknowns
  StepperOptions stepper;
  petsc::SolverKind solver = petsc::SolverKind::automatic;
  double first_step = 0;  ///< that is wanted [s]
};

/// Makes the TS for a run from displacements u [m] and velocities v [m/s] at time 0. Collective on `comm`.
/// Throws InputError for PETSc options that are wrong, would change nothing, or that nothing reads.
TsSetup set_up_ts(const Model& model, const Eigen::VectorXd& u, const Eigen::VectorXd& v, MPI_Comm comm);

/// Throws InputError for a -pounding_ option that nothing has read. Options of the first factor (-pounding_lev_...) are
/// read when it is made; `factors_too` tells that this has happened.
void refuse_unread_options(bool factors_too);

}  // namespace pounding
