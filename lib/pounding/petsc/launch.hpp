#pragma once
/// The environment variables by which a launcher of MPI programs (mpirun, srun) describes a process, before MPI begins.

#include <optional>

namespace pounding::petsc {

/// One process of a parallel program, by its launcher.
struct Launch {
  int rank = 0;  ///< of this process, from 0
  int size = 1;  ///< number of processes
};

/// Empty where no launcher has started this process.
std::optional<Launch> launch();

/// Throws InputError in a process of several where PETSc has no MPI: each of them would run the whole model by itself.
void require_mpi_for_several();

}  // namespace pounding::petsc
