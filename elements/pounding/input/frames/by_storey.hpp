#pragma once
/// Values of a grid that vary by storey and by line.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/input.hpp>

namespace pounding {

/// True for a map from storeys such as {1-3: ..., 4: ...}.
bool is_by_storey(const Input& node);

/// First and last storey of a key such as "4" or "1-3". Throws InputError at the key for storeys outside 1 to
/// `storeys`.
std::pair<int, int> storeys_of(const std::string& key, const Input& location, int storeys);

/// [storey or 1][line or 1] of a value: one for all, a list from the ground up, or a map from storeys; each item may be
/// a list by line. `read` converts a single item, `noun` names it in messages: "section", and `examples`
/// are two values as typed. Throws InputError.
template <class Read>
auto read_by_storey(const Input& node, int storeys, int lines, const char* noun,
                    const std::array<const char*, 2>& examples, const Read& read) {
  using Value = decltype(read(node));
  const auto of_storey = [&](const Input& each) {
    if (!each.is_list()) return std::vector<Value>{read(each)};
    const std::vector<Input> items = each.items();
    if (static_cast<int>(items.size()) != lines)
      each.fail(fmt::format("takes one {} for the storey, or a list of {} by line; a list of {} was read", noun, lines,
                            items.size()));
    std::vector<Value> values;
    for (const Input& item : items) values.push_back(read(item));
    return values;
  };
  std::vector<std::vector<Value>> rows;
  if (node.is_list()) {
    const std::vector<Input> items = node.items();
    if (static_cast<int>(items.size()) != storeys)
      node.fail(fmt::format("takes one {} or a list of {} from the ground up; a list of {} was read", noun, storeys,
                            items.size()));
    for (const Input& item : items) rows.push_back(of_storey(item));
    return rows;
  }
  if (!is_by_storey(node)) {
    rows.push_back({read(node)});
    return rows;
  }
  rows.resize(storeys);
  for (const auto& [key, each] : node.entries()) {
    const auto [first, last] = storeys_of(key, each, storeys);
    for (int storey = first; storey <= last; ++storey) {
      if (!rows[storey - 1].empty()) each.fail_at_key(fmt::format("storey {} is given twice; keep it once", storey));
      rows[storey - 1] = of_storey(each);
    }
  }
  for (int storey = 1; storey <= storeys; ++storey)
    if (rows[storey - 1].empty())
      node.fail(fmt::format("storey {} is missing; list every storey from 1 to {} once, as in {{1-3: {}, 4-5: {}}}",
                            storey, storeys, examples[0], examples[1]));
  return rows;
}

}  // namespace pounding
