#include <pounding/input/frames/grid_loads.hpp>

#include <cstddef>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <pounding/input/frames/by_storey.hpp>

namespace pounding {
namespace {

using Loads = std::vector<std::vector<double>>;  // [storey][line]

int lines_of_beams(const GridFrame& grid) {
  return grid.bays_y == 0 ? grid.bays_x : (grid.bays_x + 1) * (grid.bays_y + 1);
}

// Adds `factor` times the load under a key to every beam.
void add_loads(const Input& node, double factor, const GridFrame& grid, Loads& sum) {
  const int lines = lines_of_beams(grid);
  const ByStorey<double> read = read_by_storey(node, grid.storeys, lines, "load", {"-25 kN/m", "-20 kN/m"},
                                               [](const Input& each) { return each.as_quantity(); });
  for (int storey = 0; storey < grid.storeys; ++storey)
    for (int line = 0; line < lines; ++line) sum[storey][line] += factor * read.at(storey + 1, line);
}

}  // namespace

void read_loads(const Input& node, GridFrame& grid) {
  const auto load = node.find("beams_load"), dead = node.find("dead_load"), live = node.find("live_load");
  const auto combination = node.find("combination"), mass = node.find("mass_from_loads");
  if (load && (dead || live))
    load->fail_at_key("is the whole load, and load cases are also given; keep beams_load, or dead_load and live_load");
  if (combination && !dead && !live)
    combination->fail_at_key("combines dead_load and live_load; type dead_load: -20 kN/m, or leave it out");
  if (mass && !load && !dead && !live)
    mass->fail_at_key("needs a load on the beams; type beams_load: -25 kN/m, or leave it out");
  if (!load && !dead && !live) return;
  Loads sum(grid.storeys, std::vector<double>(lines_of_beams(grid), 0.0));
  if (load) add_loads(*load, 1, grid, sum);
  if (combination) combination->only_keys();
  if (dead) add_loads(*dead, combination ? combination->quantity("dead") : 1, grid, sum);
  if (live) {
    if (!combination || !combination->has("live"))
      live->fail_at_key("needs its factor during an earthquake; type combination: {dead: 1, live: 0.3}");
    add_loads(*live, combination->quantity("live"), grid, sum);
  }
  if (mass) grid.mass_from_loads = mass->as_bool();
  for (const std::vector<double>& row : sum)
    for (const double each : row)
      if (grid.mass_from_loads && each > 0)
        mass->fail(
            fmt::format("needs loads that act downwards, with a negative sign; {:.4g} kN/m was read", each / 1e3));
  grid.beam_load = std::move(sum);
}

}  // namespace pounding
