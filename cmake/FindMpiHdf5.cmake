# MpiHdf5::hdf5: the C library of HDF5 in its Open MPI flavour, with the include directories of MPI that its header
# needs. PETSc is linked with this flavour; a program that loads the serial one beside it would hold two libraries of
# the same symbols.
pkg_check_modules(MPI_HDF5 REQUIRED IMPORTED_TARGET GLOBAL hdf5-openmpi)

if(NOT TARGET MpiHdf5::hdf5)
  add_library(MpiHdf5::hdf5 ALIAS PkgConfig::MPI_HDF5)
endif()
