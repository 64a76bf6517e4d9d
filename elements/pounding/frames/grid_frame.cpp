#include <pounding/frames/frame_model.hpp>

#include <cmath>
#include <numeric>
#include <string>

#include <pounding/frames/frame_dofs.hpp>

namespace pounding {

using Eigen::Vector3d;
using frame_dofs::refuse;

namespace {

// One value for all or one each, positive.
std::vector<double> spread(const std::vector<double>& given, int count, const char* what, bool may_be_zero = false) {
  std::vector<double> all = given.size() == 1 ? std::vector<double>(count, given.front()) : given;
  if (static_cast<int>(all.size()) != count) refuse(std::string(what) + ": one value, or " + std::to_string(count));
  for (const double value : all)
    if (!(may_be_zero ? value >= 0 : value > 0) || std::isinf(value))
      refuse(std::string(what) + (may_be_zero ? " must be finite and not negative" : " must be positive and finite"));
  return all;
}

// Distances of the grid lines from the first one.
std::vector<double> lines(const std::vector<double>& widths) {
  std::vector<double> at{0.0};
  for (const double width : widths) at.push_back(at.back() + width);
  return at;
}

// Part of the whole width that belongs to each line, half a bay on each side; all of it when there is one line only.
std::vector<double> shares(const std::vector<double>& widths) {
  if (widths.empty()) return {1.0};
  const double whole = std::accumulate(widths.begin(), widths.end(), 0.0);
  std::vector<double> share(widths.size() + 1, 0.0);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    share[i] += 0.5 * widths[i] / whole;
    share[i + 1] += 0.5 * widths[i] / whole;
  }
  return share;
}

}  // namespace

int GridFrame::node(int storey, int i, int k) const {
  if (storey < 0 || storey > storeys || i < 0 || i > bays_x || k < 0 || k > bays_y)
    refuse("the grid has no node (" + std::to_string(storey) + ", " + std::to_string(i) + ", " + std::to_string(k) + ")");
  return (storey * (bays_y + 1) + k) * (bays_x + 1) + i;
}

int GridFrame::floor(int storey) const {
  const int first = node(storey, 0);
  if (storey == 0) refuse("the ground is no floor");
  return bays_y == 0 ? first : node(storeys, bays_x, bays_y) + storey;
}

GridParts add_grid(FrameModel& model, const GridFrame& grid) {
  if (grid.storeys < 1 || grid.bays_x < 1 || grid.bays_y < 0) refuse("a grid needs a storey and a bay along x");
  Frame& frame = model.frame;
  const bool is_plane = frame.dimension() == 2;
  if (is_plane != (grid.bays_y == 0)) refuse("a grid has bays along y in space, and in the plane none");
  if (frame.nodes() > 0) refuse("a grid comes before all other nodes of its frame");
  const std::vector<double> width_x = spread(grid.bay_width_x, grid.bays_x, "bay_width_x");
  const std::vector<double> width_y = is_plane ? std::vector<double>{} : spread(grid.bay_width_y, grid.bays_y, "bay_width_y");
  const std::vector<double> x = lines(width_x), y = lines(width_y);
  const std::vector<double> z = lines(spread(grid.storey_height, grid.storeys, "storey_height"));
  const std::vector<double> floor_mass = grid.floor_mass.empty() ? std::vector<double>(grid.storeys, 0.0)
                                                                 : spread(grid.floor_mass, grid.storeys, "floor_mass", true);
  const std::vector<double> share_x = shares(width_x), share_y = shares(width_y);

  const auto at = [&](int storey, int i, int k) {
    const std::string plane = std::to_string(storey) + "." + std::to_string(i);
    return is_plane ? plane : plane + "." + std::to_string(k);
  };
  const auto each = [&](int storey, auto&& act) {
    for (int k = 0; k <= grid.bays_y; ++k)
      for (int i = 0; i <= grid.bays_x; ++i) act(grid.node(storey, i, k), i, k);
  };
  GridParts parts;
  each(0, [&](int, int i, int k) { parts.weights.push_back(share_x[i] * share_y[k]); });
  for (int storey = 0; storey <= grid.storeys; ++storey) {
    FrameFloor floor{.label = std::to_string(storey), .nodes = {}, .elevation = z[storey] + grid.origin.z()};
    each(storey, [&](int, int i, int k) {
      floor.nodes.push_back(frame.add_node(Vector3d(x[i], y[k], z[storey]) + grid.origin, at(storey, i, k)));
    });
    if (storey == 0) {
      parts.feet = floor.nodes;
      continue;
    }
    for (std::size_t n = 0; n < floor.nodes.size(); ++n) frame.add_mass(floor.nodes[n], floor_mass[storey - 1] * parts.weights[n]);
    model.floors.push_back(std::move(floor));
  }

  const BeamOptions options{.mass = grid.mass};
  for (int storey = 1; storey <= grid.storeys; ++storey)
    each(storey, [&](int node, int i, int k) {
      const auto member = [&](const char* kind, int from, int to, const Section& section) {
        frame.set_name(frame.add_member(from, to, section, grid.material, options), kind + at(storey, i, k));
      };
      member("column ", grid.node(storey - 1, i, k), node, grid.column);
      if (i < grid.bays_x) member("beam x ", node, grid.node(storey, i + 1, k), grid.beam);
      if (k < grid.bays_y) member("beam y ", node, grid.node(storey, i, k + 1), grid.beam);
    });
  return parts;
}

FrameModel make_frame_model(const GridFrame& grid) {
  FrameModel model{.frame = Frame(grid.bays_y == 0 ? 2 : 3)};
  const GridParts parts = add_grid(model, grid);
  for (const int foot : parts.feet) model.frame.fix(foot);
  for (int floor = 0; grid.rigid_floors && floor < grid.storeys; ++floor) make_floor_rigid(model, floor, parts.weights);
  return model;
}

Frame make_frame(const GridFrame& grid) { return make_frame_model(grid).frame; }

}  // namespace pounding
