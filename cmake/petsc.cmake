# PETSc and SLEPc as pkg-config finds them, first in the folder PETSC_DIR (see `make petsc`). POUNDING_MPI is whether this PETSc has
# MPI; a value given by the user must agree.
set(PETSC_DIR "" CACHE PATH "Folder that PETSc and SLEPc were installed into, instead of those of the system")
if(PETSC_DIR)
  list(PREPEND CMAKE_PREFIX_PATH ${PETSC_DIR})
  set(ENV{PKG_CONFIG_PATH} "${PETSC_DIR}/lib/pkgconfig:$ENV{PKG_CONFIG_PATH}")
  # Installed files find the same PETSc.
  set(CMAKE_INSTALL_RPATH_USE_LINK_PATH ON)
endif()
pkg_check_modules(PETSC REQUIRED IMPORTED_TARGET PETSc>=3.18)
pkg_check_modules(SLEPC REQUIRED IMPORTED_TARGET slepc>=3.18)
# Drops the compile options of Debian's PETSc: its headers do not need them, and all sources are compiled with the same options.
set_property(TARGET PkgConfig::PETSC PkgConfig::SLEPC PROPERTY INTERFACE_COMPILE_OPTIONS)

find_file(POUNDING_PETSCCONF petscconf.h PATHS ${PETSC_INCLUDE_DIRS} NO_DEFAULT_PATH NO_CACHE REQUIRED)
file(STRINGS ${POUNDING_PETSCCONF} without_mpi REGEX "define PETSC_HAVE_MPIUNI")
set(petsc_has_mpi ON)
if(without_mpi)
  set(petsc_has_mpi OFF)
endif()
if(NOT DEFINED POUNDING_MPI)
  set(POUNDING_MPI ${petsc_has_mpi})
elseif(POUNDING_MPI AND NOT petsc_has_mpi)
  message(FATAL_ERROR "PETSc ${PETSC_VERSION} of ${POUNDING_PETSCCONF} has no MPI. Type cmake -DPOUNDING_MPI=OFF for a program of one "
    "process, or -DPETSC_DIR=FOLDER with a PETSc that has MPI (make petsc PETSC=${PETSC_VERSION} MPI=on)")
elseif(petsc_has_mpi AND NOT POUNDING_MPI)
  message(FATAL_ERROR "PETSc ${PETSC_VERSION} of ${POUNDING_PETSCCONF} has MPI, and -DPOUNDING_MPI=OFF was given. Type "
    "`make petsc PETSC=3.26.1 MPI=off`, then cmake -DPOUNDING_MPI=OFF with the -DPETSC_DIR=FOLDER that it prints")
endif()
