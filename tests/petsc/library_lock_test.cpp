// The lock of the libraries that are not thread-safe.

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <optional>
#include <thread>

#include <pounding/petsc/library_lock.hpp>

namespace pounding {
namespace library_lock_test {

// Takes and releases the lock in another thread.
class OtherThread {
 public:
  OtherThread()
      : taken_(promise_.get_future()), thread_([this] {
          const LibraryLock lock;
          promise_.set_value();
        }) {}
  // True if it gets the lock within some time.
  bool gets_it() { return taken_.wait_for(std::chrono::milliseconds(200)) == std::future_status::ready; }

 private:
  std::promise<void> promise_;
  std::future<void> taken_;
  std::jthread thread_;
};

TEST(LibraryLock, ExcludesOtherThreadsUntilItsLastHolderEnds) {
  std::optional<LibraryLock> first, second;
  first.emplace();
  second.emplace();
  OtherThread other;
  EXPECT_FALSE(other.gets_it());
  second.reset();
  EXPECT_FALSE(other.gets_it());
  first.reset();
  EXPECT_TRUE(other.gets_it());
}

TEST(LibraryLock, IsReleasedCompletelyAndTakenAgain) {
  const LibraryLock first, second;
  {
    const LibraryLock::Released released;
    EXPECT_TRUE(OtherThread().gets_it());
    const LibraryLock inside;
    OtherThread waits;
    EXPECT_FALSE(waits.gets_it());
    const LibraryLock::Released again;
    EXPECT_TRUE(waits.gets_it());
  }
  {
    OtherThread other;
    EXPECT_FALSE(other.gets_it());
    const LibraryLock::Released released;
    EXPECT_TRUE(other.gets_it());
  }
}

TEST(LibraryLock, ReleasesNothingThatTheThreadDoesNotHave) {
  const LibraryLock::Released released;
  EXPECT_TRUE(OtherThread().gets_it());
}

}  // namespace library_lock_test
}  // namespace pounding
