#include <pounding/petsc/library_lock.hpp>

#include <mutex>
#include <utility>

namespace pounding {
namespace {

std::mutex libraries;
// Number of times that this thread has taken the lock.
thread_local int depth = 0;

}  // namespace

LibraryLock::LibraryLock() {
  if (depth++ == 0) libraries.lock();
}

LibraryLock::~LibraryLock() {
  if (--depth == 0) libraries.unlock();
}

LibraryLock::Released::Released() : depth_(std::exchange(depth, 0)) {
  if (depth_ > 0) libraries.unlock();
}

LibraryLock::Released::~Released() {
  if (depth_ > 0) libraries.lock();
  depth = depth_;
}

}  // namespace pounding
