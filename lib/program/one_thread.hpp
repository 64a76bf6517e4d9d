#pragma once
/// Number of threads of BLAS and of the packages that factor.

namespace pounding::program {

/// Keeps OpenBLAS to one thread unless the user has set OPENBLAS_NUM_THREADS or OMP_NUM_THREADS, and OpenMP unless
/// OMP_NUM_THREADS is above one. The fronts of frames are small: more threads take longer for them and wait busily on
/// cores that other processes need; two towers of 4,320 unknowns that yield took 1.5 times as long with the four
/// threads of CHOLMOD on two cores. Another BLAS is left as it is.
void use_one_thread();

}  // namespace pounding::program
