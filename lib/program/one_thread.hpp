#pragma once
/// Number of threads of BLAS and of the factorization packages.

namespace pounding::program {

/// Limits OpenBLAS to one thread unless the user has set OPENBLAS_NUM_THREADS or OMP_NUM_THREADS, and OpenMP unless
/// OMP_NUM_THREADS is greater than one. The fronts of frames are small: more threads are slower and spin on cores that
/// other processes need. Two yielding towers with 4,320 degrees of freedom took 1.5 times as long with the four threads
/// of CHOLMOD on two cores. Other BLAS libraries are unchanged.
void use_one_thread();

}  // namespace pounding::program
