#include <pounding/input/frames/by_storey.hpp>

#include <charconv>
#include <system_error>

#include <pounding/base/excerpt.hpp>

namespace pounding {

std::pair<int, int> storeys_of(const std::string& key, const Input& location, int storeys) {
  int first = 0, last = 0;
  const char *begin = key.data(), *end = begin + key.size();
  const auto [dash, bad_first] = std::from_chars(begin, end, first);
  bool is_range = bad_first == std::errc{};
  if (is_range && dash == end)
    last = first;
  else if (is_range && *dash == '-') {
    const auto [after, bad_last] = std::from_chars(dash + 1, end, last);
    is_range = bad_last == std::errc{} && after == end;
  } else
    is_range = false;
  if (!is_range)
    location.fail_at_key(
        fmt::format("\"{}\" is not a storey; type a number such as 4, or a range such as 1-3", excerpt(key)));
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
