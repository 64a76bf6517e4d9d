#include <pounding/frames/frame.hpp>

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

// Coordinates of the grid lines.
std::vector<double> lines(double origin, const std::vector<double>& widths) {
  std::vector<double> at{origin};
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

Frame make_frame(const GridFrame& grid) {
  if (grid.storeys < 1 || grid.bays_x < 1 || grid.bays_y < 0) refuse("a grid needs a storey and a bay along x");
  const std::vector<double> width_x = spread(grid.bay_width_x, grid.bays_x, "bay_width_x");
  const std::vector<double> width_y =
      grid.bays_y > 0 ? spread(grid.bay_width_y, grid.bays_y, "bay_width_y") : std::vector<double>{};
  const std::vector<double> x = lines(grid.origin.x(), width_x), y = lines(grid.origin.y(), width_y);
  const std::vector<double> z = lines(grid.origin.z(), spread(grid.storey_height, grid.storeys, "storey_height"));
  const std::vector<double> floor_mass = spread(grid.floor_mass, grid.storeys, "floor_mass", true);
  const std::vector<double> share_x = shares(width_x), share_y = shares(width_y);

  Frame frame(grid.bays_y == 0 ? 2 : 3);
  const auto at = [&](int storey, int i, int k) {
    const std::string plane = std::to_string(storey) + "." + std::to_string(i);
    return grid.bays_y == 0 ? plane : plane + "." + std::to_string(k);
  };
  const auto each = [&](int storey, auto&& act) {
    for (int k = 0; k <= grid.bays_y; ++k)
      for (int i = 0; i <= grid.bays_x; ++i) act(grid.node(storey, i, k), i, k);
  };
  for (int storey = 0; storey <= grid.storeys; ++storey)
    each(storey, [&](int, int i, int k) {
      const int node = frame.add_node({x[i], y[k], z[storey]}, at(storey, i, k));
      if (storey == 0) frame.fix(node);
      else frame.add_mass(node, floor_mass[storey - 1] * share_x[i] * share_y[k]);
    });

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

  for (int storey = 1; grid.rigid_floors && storey <= grid.storeys; ++storey) {
    std::vector<int> nodes;
    Vector3d centre(0, 0, z[storey]);
    each(storey, [&](int node, int i, int k) {
      nodes.push_back(node);
      centre += share_x[i] * share_y[k] * Vector3d(x[i], y[k], 0);
    });
    if (grid.bays_y == 0) nodes.erase(nodes.begin());
    else frame.fix(frame.add_node(centre, "floor " + std::to_string(storey)), {Dof::uz, Dof::rx, Dof::ry});
    frame.tie_floor(grid.floor(storey), nodes);
  }
  return frame;
}

}  // namespace pounding
