#pragma once
/// Environment variables with which MPI launchers (mpirun, srun) describe a process, available before MPI_Init.

#include <optional>

namespace pounding::petsc {

/// One process of a parallel program, according to its launcher.
struct Launch {
  int rank = 0;  ///< of this process, from 0
  int size = 1;  ///< number of processes
};

/// nullopt if no launcher started this process.
std::optional<Launch> launch();

/// Throws InputError in a process of several if PETSc has no MPI: each would run the whole model independently.
void require_mpi_for_several();

}  // namespace pounding::petsc
