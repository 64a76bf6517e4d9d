#pragma once
/// Reports errors of the model at their location in the input.

#include <stdexcept>

#include <pounding/input/input.hpp>
#include <pounding/model/model_error.hpp>

namespace pounding {

/// Throws InputError at the option that the model rejected, at its key if the option is not allowed at all.
[[noreturn]] inline void fail_at(const Input& location, const ModelError& error) {
  if (error.is_idle()) location.fail_at_key(error.what());
  location.fail(error.what());
}

/// Returns the result of the call. Reports its std::invalid_argument, such as a ModelError, at this location.
template <class Act>
decltype(auto) placed(const Input& location, Act&& act) {
  try {
    return act();
  } catch (const ModelError& error) {
    fail_at(location, error);
  } catch (const std::invalid_argument& error) {
    location.fail(error.what());
  }
}

}  // namespace pounding
