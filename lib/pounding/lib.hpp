#pragma once
/// Time integration and results: the target Pounding::lib. The main interfaces are
///
///     pounding::petsc::Environment   initializes and finalizes PETSc, unless the host does
///     pounding::run                  runs a model, on one process or on a communicator of the host
///     pounding::Results              histories in memory; write_results() writes them to an HDF5 file
///
/// A host with its own time integrator, such as a TS of PETSc, finds the links in pounding/links.hpp.

#include <pounding/elements.hpp>
#include <pounding/linear/lowest_modes.hpp>
#include <pounding/petsc/environment.hpp>
#include <pounding/results/results.hpp>
#include <pounding/results/summary.hpp>
#include <pounding/run/run.hpp>
