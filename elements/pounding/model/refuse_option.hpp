#pragma once
/// Rejects options of a model.

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

}  // namespace pounding
