#pragma once
/// How many threads BLAS works with.

namespace pounding::program {

/// One, unless the user has set OPENBLAS_NUM_THREADS or OMP_NUM_THREADS: fronts of frames are small, more threads take
/// longer for them and wait busily on cores that other processes need. Of OpenBLAS; another BLAS goes on as it is.
void use_one_blas_thread();

}  // namespace pounding::program
