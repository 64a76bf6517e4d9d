# MpiHdf5::hdf5: the C library of HDF5 that matches PETSc. With MPI it is the one of Open MPI, or MPI_HDF5_MODULE (hdf5-mpich), with
# the include directories of MPI that its header needs; loading the serial library as well would duplicate its symbols. Without MPI it
# is the serial one.
if(NOT MPI_HDF5_MODULE)
  set(MPI_HDF5_MODULE hdf5-openmpi)
endif()
pkg_check_modules(MPI_HDF5 REQUIRED IMPORTED_TARGET GLOBAL ${MPI_HDF5_MODULE})

if(NOT TARGET MpiHdf5::hdf5)
  add_library(MpiHdf5::hdf5 ALIAS PkgConfig::MPI_HDF5)
endif()
