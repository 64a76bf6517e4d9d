#include <pounding/core/error.hpp>

namespace pounding {

InputError::InputError(std::string_view text) : std::runtime_error(message_text(text)) {}

}  // namespace pounding
