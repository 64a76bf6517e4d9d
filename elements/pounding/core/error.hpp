#pragma once
/// Errors for users, and the search for the name that was probably meant.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pounding {

/// Wrong input. The text says where it is, what was read, what is allowed and what to type; it is UTF-8 and can be
/// printed, whatever was read. Exit code 2 of the program.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string_view text);
};

/// A solve that failed. The text says at which time and why. Exit code 3 of the program.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A text of the user for a message: at most 200 characters, control characters and bytes that are no UTF-8 escaped;
/// see laws/excerpt.hpp.
std::string excerpt(std::string_view text);

/// The allowed name nearest to `read`, or an empty view when none is near; see laws/nearest_name.hpp.
std::string_view nearest_name(std::string_view read, std::span<const std::string_view> allowed);

/// ` Did you mean "hertz_damped"?` when a near name exists; otherwise ` Allowed: a, b, c.`
std::string suggestion(std::string_view read, std::span<const std::string_view> allowed);

}  // namespace pounding
