#include "support/short_memory.hpp"

#include <cstdlib>
#include <new>
#include <utility>

namespace {

// Before the one that fails; 0 where none does.
long ahead = 0;
bool has_failed = false;

}  // namespace

namespace pounding::test {

bool fail_allocation(long number) {
  ahead = number;
  return std::exchange(has_failed, false);
}

}  // namespace pounding::test

// A compiler that sees both in one place takes free() for the wrong end of a block.
[[gnu::noinline]] void* operator new(std::size_t size) {
  const bool fails = ahead > 0 && --ahead == 0;
  has_failed = has_failed || fails;
  void* const block = fails ? nullptr : std::malloc(size > 0 ? size : 1);
  if (!block) throw std::bad_alloc();
  return block;
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
[[gnu::noinline]] void operator delete(void* block) noexcept { std::free(block); }
[[gnu::noinline]] void operator delete(void* block, std::size_t) noexcept { std::free(block); }
