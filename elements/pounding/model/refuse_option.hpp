#pragma once
/// Rejects options of a model.

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <pounding/core/refuse.hpp>
#include <pounding/model/model_error.hpp>

namespace pounding {

/// Throws ModelError: the value of an option is invalid.
[[noreturn]] inline void refuse(ModelOption option, const std::string& text) { throw ModelError(option, text); }
/// Throws ModelError: an option is not allowed here.
[[noreturn]] inline void refuse_idle(ModelOption option, const std::string& text) {
  throw ModelError(option, text).as_idle();
}

/// Returns the result of the call. Throws ModelError for this option instead of std::invalid_argument.
template <class Act>
decltype(auto) checked(ModelOption option, Act&& act) {
  try {
    return act();
  } catch (const ModelError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    refuse(option, error.what());
  }
}

/// Throws ModelError unless the value is positive and finite. Accepts an empty optional.
inline void require_positive(ModelOption option, const std::string& name, const std::optional<double>& value) {
  if (value && !(*value > 0 && std::isfinite(*value))) refuse(option, name + " must be positive and finite");
}

}  // namespace pounding
