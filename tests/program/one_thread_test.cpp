#include <program/one_thread.hpp>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace pounding::program {
namespace one_thread_test {

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
  use_one_thread();
  EXPECT_EQ(get_(), 1);
}

TEST_F(BlasThreads, AreThoseOfTheUser) {
  for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) {
    setenv(name, "2", 1);
    use_one_thread();
    EXPECT_EQ(get_(), 2) << name;
    unsetenv(name);
  }
}

class OpenMPThreads : public testing::Test {
 protected:
  void SetUp() override {
    set_ = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "omp_set_max_active_levels"));
    get_ = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_active_levels"));
    if (!set_ || !get_) GTEST_SKIP() << "nothing here uses OpenMP";
    unsetenv("OMP_NUM_THREADS");
    set_(1);
  }
  void TearDown() override {
    unsetenv("OMP_NUM_THREADS");
    if (set_) set_(0);
  }

  void (*set_)(int) = nullptr;
  int (*get_)() = nullptr;
};

TEST_F(OpenMPThreads, AreOneWhereNobodyAskedForMore) {
  use_one_thread();
  EXPECT_EQ(get_(), 0);
}

TEST_F(OpenMPThreads, AreOneWhereTheUserSaysSo) {
  setenv("OMP_NUM_THREADS", "1", 1);
  use_one_thread();
  EXPECT_EQ(get_(), 0);
}

TEST_F(OpenMPThreads, AreThoseOfTheUser) {
  setenv("OMP_NUM_THREADS", "3", 1);
  use_one_thread();
  EXPECT_EQ(get_(), 1);
}

}  // namespace one_thread_test
}  // namespace pounding::program
