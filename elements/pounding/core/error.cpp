#include <pounding/core/error.hpp>

#include <pounding/laws/excerpt.hpp>
#include <pounding/laws/nearest_name.hpp>

namespace pounding {

InputError::InputError(std::string_view text) : std::runtime_error(laws::message_text(text)) {}

std::string excerpt(std::string_view text) { return laws::excerpt(text); }

std::string_view nearest_name(std::string_view read, std::span<const std::string_view> allowed) {
  return laws::nearest_name(read, allowed);
}

std::string suggestion(std::string_view read, std::span<const std::string_view> allowed) {
  return laws::suggestion(read, allowed);
}

}  // namespace pounding
