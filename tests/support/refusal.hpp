#pragma once
/// Message of the exception with which a call refuses.

#include <stdexcept>
#include <string>

namespace pounding::test {

/// The text of the std::invalid_argument that the call throws; "taken" when it throws none.
template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

}  // namespace pounding::test
