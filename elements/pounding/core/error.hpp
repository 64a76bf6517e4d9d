#pragma once
/// Errors that users meet, and the search for the name they probably meant.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pounding {

/// Wrong input. The text says where, what was read, what is allowed and what to type. The program ends with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A solve that failed. The text says at which time and why. The program ends with exit code 3.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The allowed name nearest to `read` by edit distance, or an empty view when none is near.
std::string_view nearest_name(std::string_view read, std::span<const std::string_view> allowed);

/// ` Did you mean "hertz_damped"?` when a near name exists; otherwise ` Allowed: a, b, c.`
std::string suggestion(std::string_view read, std::span<const std::string_view> allowed);

}  // namespace pounding
