#pragma once
/// Message about an unknown name in an input.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/error.hpp>

namespace pounding {

/// unknown node "b1". Did you mean "b2"? Long lists are shown by their first and last name.
inline std::string unknown_name(std::string_view what, std::string_view read, const std::vector<std::string>& known) {
  const std::vector<std::string_view> all(known.begin(), known.end());
  const std::string text = fmt::format("unknown {} \"{}\".", what, excerpt(read));
  constexpr std::size_t shown = 8;
  if (all.empty()) return text + fmt::format(" There is no {}.", what);
  if (all.size() <= shown || !nearest_name(read, all).empty()) return text + suggestion(read, all);
  return text + fmt::format(" There are {}, from {} to {}.", all.size(), excerpt(all.front()), excerpt(all.back()));
}

}  // namespace pounding
