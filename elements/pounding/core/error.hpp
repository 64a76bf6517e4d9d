#pragma once
/// Errors for users.

#include <stdexcept>
#include <string_view>

#include <pounding/base/excerpt.hpp>
#include <pounding/base/nearest_name.hpp>

namespace pounding {

/// Wrong input. The text says where it is, what was read, what is allowed and what to type; it is UTF-8 and can be
/// printed, whatever was read. Exit code 2 of the program.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string_view text) : std::runtime_error(message_text(text)) {}
};

/// A solve that failed. The text says at which time and why. Exit code 3 of the program.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pounding
