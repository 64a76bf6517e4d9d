#pragma once
/// Differences between PETSc 3.18 to 3.26, and between PETSc with and without MPI. No other file checks the version.

#include <petscsys.h>
#include <petscversion.h>

#if PETSC_VERSION_LT(3, 18, 0)
#error "PETSc 3.18 or newer is needed"
#endif

// PETSC_SUCCESS was added in 3.19.
#if PETSC_VERSION_LT(3, 19, 0)
#define POUNDING_PETSC_SUCCESS 0
#else
#define POUNDING_PETSC_SUCCESS PETSC_SUCCESS
#endif

namespace pounding::petsc {

#if PETSC_VERSION_LT(3, 23, 0)
/// The argument of setfromoptions; a value since 3.23.
using OptionItems = PetscOptionItems*;
#else
using OptionItems = PetscOptionItems;
#endif

#ifdef PETSC_HAVE_MPIUNI
/// True if several processes can work together. PETSc without MPI substitutes functions for a single process.
inline constexpr bool has_mpi = false;
#else
inline constexpr bool has_mpi = true;
#endif

/// Starts a barrier of all processes; is_complete() tests it. Without MPI it is complete immediately.
inline int begin_barrier([[maybe_unused]] MPI_Comm comm, MPI_Request* request) {
#ifdef PETSC_HAVE_MPIUNI
  *request = MPI_REQUEST_NULL;
  return MPI_SUCCESS;
#else
  return MPI_Ibarrier(comm, request);
#endif
}

/// True if that barrier is complete.
inline bool is_complete(MPI_Request* request) {
#ifdef PETSC_HAVE_MPIUNI
  return *request == MPI_REQUEST_NULL;
#else
  int complete = 0;
  MPI_Test(request, &complete, MPI_STATUS_IGNORE);
  return complete != 0;
#endif
}

}  // namespace pounding::petsc
