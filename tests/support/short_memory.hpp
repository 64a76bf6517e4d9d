#pragma once
/// Memory that ends on purpose, in a program of tests that has short_memory.cpp among its sources.

#include <gtest/gtest.h>

#include <new>

namespace pounding::test {

/// The `number`-th operator new from now on throws std::bad_alloc, counted from 1, once; none for 0. True where the one
/// that was asked for before has come.
bool fail_allocation(long number);

/// Calls `answer` with each of its allocations failing once, by itself: it must throw std::bad_alloc, or give what it
/// gives with all memory.
template <class Answer>
void expect_right_answers_in_short_memory(const Answer& answer) {
  const auto right = answer();
  long number = 0, refused = 0;
  for (bool came = true; came;) {
    fail_allocation(++number);
    try {
      const auto found = answer();
      came = fail_allocation(0);
      EXPECT_TRUE(found == right) << "the answer without allocation " << number;
    } catch (const std::bad_alloc&) {
      came = fail_allocation(0);
      ++refused;
    }
  }
  EXPECT_GT(refused, 0) << "an answer without an allocation tells nothing";
}

}  // namespace pounding::test
