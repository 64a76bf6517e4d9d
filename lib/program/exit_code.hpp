#pragma once
/// Exit codes of the program, and the message of a failure.

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

#include <pounding/core/error.hpp>
#include <pounding/laws/excerpt.hpp>

namespace pounding::program {

constexpr int done = 0, other_failure = 1, bad_input = 2, failed_solve = 3;

inline int exit_code(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error) || dynamic_cast<const std::invalid_argument*>(&error)) return bad_input;
  const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) || dynamic_cast<const std::length_error*>(&error);
  return is_memory || dynamic_cast<const SolverError*>(&error) ? failed_solve : other_failure;
}

inline void print_failure(const char* text) { std::fprintf(stderr, "pounding: %s\n", laws::message_text(text).c_str()); }

}  // namespace pounding::program
