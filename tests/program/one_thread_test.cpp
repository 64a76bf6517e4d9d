#include <program/one_thread.hpp>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace pounding::program {
namespace one_thread_test {

// A threading library with one function to set and one to get the number of threads; `many` and `one` are its answers.
class Threads : public testing::Test {
 protected:
  Threads(const char* set, const char* get, int many, int one)
      : many_(many),
        one_(one),
        set_(reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, set))),
        get_(reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, get))) {}

  void SetUp() override {
    if (!set_ || !get_) GTEST_SKIP() << "this library is not loaded";
    forget();
    set_(many_);
    if (get_() != many_) GTEST_SKIP() << "this library has no threads";
  }
  void TearDown() override {
    forget();
    if (set_) set_(one_);
  }
  // The number that the program keeps if the environment has this variable.
  int left(const char* name = nullptr, const char* value = nullptr) {
    forget();
    set_(many_);
    if (name) setenv(name, value, 1);
    use_one_thread();
    return get_();
  }

  const int many_, one_;

 private:
  static void forget() {
    for (const char* name : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"}) unsetenv(name);
  }

  void (*set_)(int) = nullptr;
  int (*get_)() = nullptr;
};

class BlasThreads : public Threads {
 protected:
  BlasThreads() : Threads("openblas_set_num_threads", "openblas_get_num_threads", 2, 1) {}
};

TEST_F(BlasThreads, AreOneWhereNobodyAskedForMore) { EXPECT_EQ(left(), one_); }

TEST_F(BlasThreads, AreThoseOfTheUser) {
  EXPECT_EQ(left("OPENBLAS_NUM_THREADS", "2"), many_);
  EXPECT_EQ(left("OMP_NUM_THREADS", "2"), many_);
}

// Without an active level each parallel region has one thread.
class OpenMPThreads : public Threads {
 protected:
  OpenMPThreads() : Threads("omp_set_max_active_levels", "omp_get_max_active_levels", 1, 0) {}
};

TEST_F(OpenMPThreads, AreOneWhereNobodyAskedForMore) {
  EXPECT_EQ(left(), one_);
  EXPECT_EQ(left("OPENBLAS_NUM_THREADS", "2"), one_);
  EXPECT_EQ(left("OMP_NUM_THREADS", "1"), one_);
}

TEST_F(OpenMPThreads, AreThoseOfTheUser) { EXPECT_EQ(left("OMP_NUM_THREADS", "3"), many_); }

}  // namespace one_thread_test
}  // namespace pounding::program
