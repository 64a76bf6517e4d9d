#include "one_thread.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <string_view>

namespace pounding::program {
namespace {

// The variables of these libraries are read when they are loaded, before main; and a library may lack the function, as
// the reference BLAS does.
void call(const char* function, int value) {
  using SetNumber = void (*)(int);
  if (const auto set = reinterpret_cast<SetNumber>(dlsym(RTLD_DEFAULT, function))) set(value);
}

}  // namespace

void use_one_thread() {
  const char* const given = std::getenv("OMP_NUM_THREADS");
  if (!given && !std::getenv("OPENBLAS_NUM_THREADS")) call("openblas_set_num_threads", 1);
  // CHOLMOD asks for four threads by number, which no OMP_NUM_THREADS takes back. With no active level each parallel
  // part has one.
  if (!given || std::string_view(given) == "1") call("omp_set_max_active_levels", 0);
}

}  // namespace pounding::program
