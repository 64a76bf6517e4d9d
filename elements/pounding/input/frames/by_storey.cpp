#include <pounding/input/frames/by_storey.hpp>

#include <charconv>
#include <system_error>

#include <pounding/base/excerpt.hpp>

namespace pounding {

std::pair<int, int> storeys_of(const std::string& key, const Input& location, int storeys) {
  const auto number = [&](std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      location.fail_at_key(
          fmt::format("\"{}\" is not a storey; type a number such as 4, or a range such as 1-3", excerpt(key)));
    return value;
  };
  const std::size_t dash = key.find('-');
  const int first = number(std::string_view(key).substr(0, dash)),
            last = dash == std::string::npos ? first : number(std::string_view(key).substr(dash + 1));
  if (first < 1 || last < first || last > storeys)
    location.fail_at_key(
        fmt::format("\"{}\" is out of range: storeys are numbered from 1 at the ground to {}", excerpt(key), storeys));
  return {first, last};
}

bool is_by_storey(const Input& node) {
  if (!node.is_map()) return false;
  const auto entries = node.entries();
  return !entries.empty() && entries.front().first.find_first_of("0123456789") == 0;
}

}  // namespace pounding
