#pragma once
/// Checks of a YAML text before a tree is made of it.

#include <cstddef>
#include <string>
#include <string_view>

namespace pounding {

/// Limits of a model's text, far above the largest frames, whose trees take 1 GB.
inline constexpr std::size_t longest_model = 16'000'000;  ///< bytes
inline constexpr std::size_t max_values = 1'000'000;  ///< keys and values, an alias counting as all that it stands for
inline constexpr std::size_t longest_value = 10'000;  ///< bytes of one value
inline constexpr int deepest = 64;                    ///< levels of maps and lists in each other

/// Throws InputError with "name:line:column: " in front unless the text is one YAML document within these limits, in
/// UTF-8, without control characters. `name` is that of the file.
void check_yaml(std::string_view text, const std::string& name);

}  // namespace pounding
