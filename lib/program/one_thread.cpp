#include "one_thread.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <string_view>

namespace pounding::program {
namespace {

// These libraries read their environment variables when they are loaded, before main(). A library may lack the
// function, for example the reference BLAS.
void call(const char* function, int value) {
  using SetNumber = void (*)(int);
  if (const auto set = reinterpret_cast<SetNumber>(dlsym(RTLD_DEFAULT, function))) set(value);
}

}  // namespace

void use_one_thread() {
  const char* const given = std::getenv("OMP_NUM_THREADS");
  if (!given && !std::getenv("OPENBLAS_NUM_THREADS")) call("openblas_set_num_threads", 1);
  // CHOLMOD requests four threads explicitly, regardless of OMP_NUM_THREADS. Without active levels, each parallel
  // region has one thread.
  if (!given || std::string_view(given) == "1") call("omp_set_max_active_levels", 0);
}

}  // namespace pounding::program
