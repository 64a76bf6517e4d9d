#include <pounding/input/frames/frame_bays.hpp>

#include <cstddef>

#include <fmt/format.h>

namespace pounding {
namespace {

std::vector<double> read_widths(const Input& node, int count) {
  if (node.is_list() && node.items().size() != static_cast<std::size_t>(count))
    node.fail(fmt::format("takes one width, or a list of {} in the order of the bays; a list of {} was read", count,
                          node.items().size()));
  return node.as_quantities(count);
}

}  // namespace

std::array<std::vector<double>, 2> read_bays(const Input& grid, int dimension) {
  const Input bays = grid.at("bays", dimension == 2 ? "3" : "[3, 2]");
  const Input width = grid.at("bay_width");
  if (dimension == 2) {
    const int count = static_cast<int>(bays.as_integer());
    return {read_widths(width, count), {}};
  }
  if (!bays.is_list() || bays.items().size() != 2)
    bays.fail("takes two numbers in space, along x and along y; type bays: [3, 2]");
  std::array<std::vector<double>, 2> both;
  if (width.is_map()) width.only_keys();
  if (width.is_list()) width.fail("takes one width, or one per direction in space; type bay_width: {x: 6 m, y: 5 m}");
  for (const int i : {0, 1}) {
    const int count = static_cast<int>(bays.items()[i].as_integer());
    both[i] = read_widths(width.is_map() ? width.at(i == 0 ? "x" : "y") : width, count);
  }
  return both;
}

}  // namespace pounding
