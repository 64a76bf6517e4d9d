#pragma once
/// Number of threads of BLAS.

namespace pounding::program {

/// Sets OpenBLAS to one thread unless the user has set OPENBLAS_NUM_THREADS or OMP_NUM_THREADS. The fronts of frames are small: more
/// threads take longer for them and wait busily on cores that other processes need. Another BLAS is left as it is.
void use_one_blas_thread();

}  // namespace pounding::program
