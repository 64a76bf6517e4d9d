#include "blas_threads.hpp"

#include <dlfcn.h>

#include <cstdlib>

namespace pounding::program {

void use_one_blas_thread() {
  if (std::getenv("OPENBLAS_NUM_THREADS") || std::getenv("OMP_NUM_THREADS")) return;
  // Its variables are read when it is loaded, before main; and BLAS may be the reference one, which has no such function.
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))) set(1);
}

}  // namespace pounding::program
