#pragma once
/// Exit codes of the program, and the message printed on failure.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>

#include <pounding/base/excerpt.hpp>
#include <pounding/core/error.hpp>

namespace pounding::program {

constexpr int done = 0, bad_input = 2, failed_solve = 3;

inline int exit_code(const std::exception& error) {
  const bool is_input = dynamic_cast<const InputError*>(&error) || dynamic_cast<const std::invalid_argument*>(&error) ||
                        dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  return is_input ? bad_input : failed_solve;
}

inline void print_failure(const char* text) { std::fprintf(stderr, "pounding: %s\n", message_text(text).c_str()); }

}  // namespace pounding::program
