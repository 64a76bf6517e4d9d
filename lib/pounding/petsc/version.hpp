#pragma once
/// Differences between PETSc versions, 3.18 to 3.26. No other file asks for the version.

#include <petscversion.h>
#include <petscsys.h>

#if PETSC_VERSION_LT(3, 18, 0)
#error "PETSc 3.18 or newer is needed"
#endif

// PETSC_SUCCESS came with 3.19.
#if PETSC_VERSION_LT(3, 19, 0)
#define POUNDING_PETSC_SUCCESS 0
#else
#define POUNDING_PETSC_SUCCESS PETSC_SUCCESS
#endif

namespace pounding::petsc {

#if PETSC_VERSION_LT(3, 23, 0)
/// The argument of setfromoptions; it became a value in 3.23.
using OptionItems = PetscOptionItems*;
#else
using OptionItems = PetscOptionItems;
#endif

}  // namespace pounding::petsc
