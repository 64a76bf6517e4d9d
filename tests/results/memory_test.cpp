// Memory that ends while the results file is made.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <fstream>

#include <pounding/core/error.hpp>
#include <pounding/results/results.hpp>

namespace pounding {
namespace memory_test {

constexpr std::size_t megabyte = std::size_t{1} << 20;

enum Ending : int { made = 0, out_of_memory = 3, another_error = 4 };

// Ends the process, which may take `room` bytes more than it has now.
[[noreturn]] void make_image_within(std::size_t room, const Results& results) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t all = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + room;
  const rlimit limit{all, all};
  setrlimit(RLIMIT_AS, &limit);
  int ending = made;
  try {
    results_image(results);
  } catch (const OutOfMemory&) {
    ending = out_of_memory;
  } catch (...) {
    ending = another_error;
  }
  std::_Exit(ending);
}

TEST(ResultsImage, SaysThatMemoryEndedWhereverItDoes) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer ends a process that gets no memory";
#endif
  Results results;
  results.summary_json.assign(64 * megabyte, ' ');
  EXPECT_GT(results_image(results).size(), 64 * megabyte) << "and HDF5 has begun";
  // The image takes some 64 MB, and no text is copied on the way.
  for (const std::size_t room : {16, 48}) {
    SCOPED_TRACE(room);
    EXPECT_EXIT(make_image_within(room * megabyte, results), testing::ExitedWithCode(out_of_memory), "");
  }
  EXPECT_EXIT(make_image_within(120 * megabyte, results), testing::ExitedWithCode(made), "");
}

}  // namespace memory_test
}  // namespace pounding
