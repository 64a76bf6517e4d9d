#pragma once
/// Errors for users.

#include <stdexcept>
#include <string_view>

#include <pounding/base/excerpt.hpp>
#include <pounding/base/nearest_name.hpp>

namespace pounding {

/// Invalid input. The message states the location, what was read, what is allowed and what to type. It is printable
/// UTF-8, whatever was read. Exit code 2 of the program.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string_view text) : std::runtime_error(message_text(text)) {}
};

/// Failed solve. The message states the time and the reason. Exit code 3 of the program.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pounding
