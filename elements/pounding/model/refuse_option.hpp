#pragma once
/// Refusals of options of a model.

#include <string>

#include <pounding/core/refuse.hpp>
#include <pounding/model/model_error.hpp>

namespace pounding {

/// Throws ModelError: the value of an option is wrong.
[[noreturn]] inline void refuse(ModelOption option, const std::string& text) { throw ModelError(option, text); }
/// Throws ModelError: an option should not be there at all.
[[noreturn]] inline void refuse_idle(ModelOption option, const std::string& text) {
  throw ModelError(option, text).as_idle();
}

}  // namespace pounding
