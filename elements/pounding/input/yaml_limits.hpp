#pragma once
/// Checks a YAML text before it is parsed into a tree.

#include <cstddef>
#include <string>
#include <string_view>

namespace pounding {

/// Limits of a model file, far above the largest frames, whose trees take 1 GB.
inline constexpr std::size_t longest_model = 16'000'000;  ///< bytes
inline constexpr std::size_t max_values = 1'000'000;      ///< keys and values, with aliases expanded
inline constexpr std::size_t longest_value = 10'000;      ///< bytes per value
inline constexpr int deepest = 64;                        ///< nesting depth of maps and lists

/// Throws InputError with the prefix "name:line:column: " unless the text is a single YAML document within these
/// limits, in UTF-8 and without control characters. `name` is the file name.
void check_yaml(std::string_view text, const std::string& name);

}  // namespace pounding
