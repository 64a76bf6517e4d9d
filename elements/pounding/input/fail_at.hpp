#pragma once
/// Refusals of a model, told at their place in the input.

#include <pounding/input/input.hpp>
#include <pounding/model/model_error.hpp>

namespace pounding {

/// Throws InputError at the place of the option that a model has refused: at its key where it should not be there at
/// all.
[[noreturn]] inline void fail_at(const Input& location, const ModelError& error) {
  if (error.is_idle()) location.fail_at_key(error.what());
  location.fail(error.what());
}

}  // namespace pounding
