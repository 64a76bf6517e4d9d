# MpiHdf5::hdf5: the C library of HDF5 in the flavour of PETSc. With MPI that is Open MPI's unless MPI_HDF5_MODULE names another
# one (hdf5-mpich), and the include directories of MPI, which its header needs, come with it; a program that loads the serial one
# beside it would hold two libraries of the same symbols. Without MPI it is the serial one.
if(NOT MPI_HDF5_MODULE)
  set(MPI_HDF5_MODULE hdf5-openmpi)
endif()
pkg_check_modules(MPI_HDF5 REQUIRED IMPORTED_TARGET GLOBAL ${MPI_HDF5_MODULE})

if(NOT TARGET MpiHdf5::hdf5)
  add_library(MpiHdf5::hdf5 ALIAS PkgConfig::MPI_HDF5)
endif()
