// Failures of cooperating processes, on one process and on two. For a process that fails while others wait for it in
// the middle of a task, see tests/program/test_processes.py and tests/python/test_processes.py.

#include <gtest/gtest.h>

#include <petscsys.h>

#include <functional>
#include <string>

#include <pounding/core/error.hpp>
#include <pounding/petsc/collective_exit.hpp>
#include <pounding/petsc/ranks.hpp>
#include "support/messages.hpp"

namespace pounding::petsc {
namespace collective_exit_test {

// Text of the exception of type Error that ends a task on this process.
template <class Error>
std::string failure_of(const std::function<void()>& task) {
  try {
    run_collectively(PETSC_COMM_WORLD, task, [](const std::string&, const std::exception&) {});
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(RunCollectively, ReturnsWhenAllProcessesHaveSucceeded) {
  int runs = 0;
  run_collectively(PETSC_COMM_WORLD, [&] { ++runs; }, [](const std::string&, const std::exception&) { FAIL(); });
  EXPECT_EQ(runs, 1);
}

TEST(RunCollectively, ThrowsWhatAllProcessesHaveThrown) {
  EXPECT_EQ(failure_of<InputError>([] { throw InputError("a wrong model"); }), "a wrong model");
  EXPECT_EQ(failure_of<SolverError>([] { throw SolverError("a failed solve"); }), "a failed solve");
}

TEST(RunCollectively, ThrowsOnAllProcessesWhatOneHasThrownAtTheEnd) {
  const Ranks ranks(PETSC_COMM_WORLD);
  if (ranks.size() == 1) GTEST_SKIP() << "requires two processes";
  const std::string text = failure_of<InputError>([&] {
    if (ranks.rank() == 1) throw InputError("no such file");
  });
  EXPECT_TRUE(test::mentions(text, {"2"}));
}

}  // namespace collective_exit_test
}  // namespace pounding::petsc
