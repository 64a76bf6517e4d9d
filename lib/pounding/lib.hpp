#pragma once
/// Runs of models through time and their results: the target Pounding::lib. A host needs
///
///     pounding::petsc::Environment   starts and ends PETSc, unless the host does
///     pounding::run                  runs a model, alone or on a communicator of the host
///     pounding::Results              the histories in memory; write_results() makes the HDF5 file
///
/// A host with a time stepper of its own finds the links in pounding/links.hpp, and one that drives PETSc's TS itself
/// finds the TS type `pounding` in pounding/stepping/ts_pounding.hpp.

#include <pounding/elements.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/collective_exit.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/petsc/handle.hpp>
#include <pounding/petsc/launch.hpp>
#include <pounding/petsc/ranks.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/run/restart.hpp>
#include <pounding/run/run.hpp>
#include <pounding/stepping/ts_pounding.hpp>
