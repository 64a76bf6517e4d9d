#include <program/blas_threads.hpp>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace pounding::program {
namespace blas_threads_test {

class BlasThreads : public testing::Test {
 protected:
  void SetUp() override {
    set_ = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
    get_ = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
    if (!set_ || !get_) GTEST_SKIP() << "BLAS is not OpenBLAS";
    for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) unsetenv(name);
    set_(2);
    if (get_() != 2) GTEST_SKIP() << "this OpenBLAS has no threads";
  }
  void TearDown() override {
    for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) unsetenv(name);
    if (set_) set_(1);
  }

  void (*set_)(int) = nullptr;
  int (*get_)() = nullptr;
};

TEST_F(BlasThreads, AreOneWhereNobodyAskedForMore) {
  use_one_blas_thread();
  EXPECT_EQ(get_(), 1);
}

TEST_F(BlasThreads, AreThoseOfTheUser) {
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) {
    setenv(name, "2", 1);
    use_one_blas_thread();
    EXPECT_EQ(get_(), 2) << name;
    unsetenv(name);
  }
}

}  // namespace blas_threads_test
}  // namespace pounding::program
