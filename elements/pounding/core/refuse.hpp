#pragma once
/// Rejects invalid arguments.

#include <stdexcept>
#include <string>

namespace pounding {

/// Throws std::invalid_argument with this text.
[[noreturn]] inline void refuse(const std::string& text) { throw std::invalid_argument(text); }

}  // namespace pounding
