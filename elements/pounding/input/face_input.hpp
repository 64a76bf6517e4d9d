#pragma once
/// The key `face` of a structure or of a link end.

#include <cctype>
#include <string>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/input/input.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Reads auto or a distance. Throws InputError.
inline Face read_face(const Input& node) {
  const std::string text = node.is_scalar() ? node.as_text() : std::string();
  if (text == "auto") return {.by_columns = true};
  if (!text.empty() && std::isalpha(static_cast<unsigned char>(text.front())))
    node.fail(fmt::format("takes auto (half the depth of the outer columns) or a length such as 0.3 m; \"{}\" was read",
                          excerpt(text)));
  return {.distance = node.as_quantity()};
}

}  // namespace pounding
