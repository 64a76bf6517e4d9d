#pragma once
/// What a launcher of MPI programs (mpirun, srun) tells each process in its environment, before MPI begins.

#include <optional>

namespace pounding::petsc {

/// One process of a parallel program, by its launcher.
struct Launch {
  int rank = 0, size = 1;  ///< place of this process, and how many there are
};

/// Nothing where no launcher has started this process.
std::optional<Launch> launch();

}  // namespace pounding::petsc
