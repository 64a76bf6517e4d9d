#include <pounding/petsc/launch.hpp>

#include <cstdlib>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/petsc/version.hpp>

namespace pounding::petsc {

std::optional<Launch> launch() {
  // Variables of Open MPI, PMI (MPICH, Slurm) and PMIx, for which Slurm's own variable has the number of processes.
  static constexpr struct {
    const char *rank, *size;
  } variables[] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                   {"PMI_RANK", "PMI_SIZE"},
                   {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [rank, size] : variables)
    if (const char* place = std::getenv(rank)) {
      const char* count = std::getenv(size);
      return Launch{std::atoi(place), count ? std::atoi(count) : 1};
    }
  return std::nullopt;
}

void require_mpi_for_several() {
  if (has_mpi) return;
  if (const auto launched = launch(); launched && launched->size > 1)
    throw InputError(
        fmt::format("pounding was built without MPI and runs in one process only, but {} were started; run it without "
                    "mpirun, or build it from source with PETSc and MPI (make program)",
                    launched->size));
}

}  // namespace pounding::petsc
