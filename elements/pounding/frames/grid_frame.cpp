#include <pounding/frames/frame_model.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include <fmt/format.h>

#include <pounding/core/limits.hpp>
#include <pounding/core/names.hpp>
#include <pounding/core/refuse.hpp>
#include <pounding/core/units.hpp>
#include <pounding/frames/frame_dofs.hpp>

namespace pounding {

using Eigen::Vector3d;

namespace {

// One positive value for all, or one per item.
std::vector<double> spread(const std::vector<double>& given, int count, const char* what, bool may_be_zero = false) {
  std::vector<double> all = given.size() == 1 ? std::vector<double>(count, given.front()) : given;
  if (static_cast<int>(all.size()) != count) refuse(std::string(what) + ": give one value or " + std::to_string(count));
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

// Fraction of the whole width tributary to each line, half a bay on each side; 1 for a single line.
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

// Adds one grid member, with its individual properties if the grid defines any, and `load` along z. Returns its length.
double add_grid_member(Frame& frame, const std::string& name, int start, int end, const Section& usual, double load,
                       const GridFrame& grid) {
  const auto found = grid.members.find(name);
  const GridMember own = found == grid.members.end() ? GridMember{} : found->second;
  if (own.material && !own.section && usual.fibres)
    refuse(name + ": the fibres of its section have materials; leave out its material");
  double length = 0;
  for (const int part : add_member_in_parts(frame, name, start, end,
                                            {.section = own.section.value_or(usual),
                                             .material = own.material.value_or(grid.material),
                                             .options = own.options.value_or(BeamOptions{.mass = grid.mass}),
                                             .load = own.load + load * Vector3d::UnitZ(),
                                             .parts = own.parts}))
    length += frame.beam(part).length();
  return length;
}

void check_loads(const GridFrame& grid, int lines) {
  grid.beam_load.check(grid.storeys, lines, "beam_load");
  for (const std::vector<double>& of_storey : grid.beam_load.values())
    for (const double load : of_storey)
      if (!std::isfinite(load) || (grid.mass_from_loads && load > 0))
        refuse(fmt::format("beam_load: the load must be finite{}, but {:.4g} kN/m was given",
                           grid.mass_from_loads ? " and act downwards, with a negative sign" : "", load / 1e3));
}

}  // namespace

// "S.I" in the plane, "S.I.K" in space.
std::string GridFrame::place(int storey, int i, int k) const {
  const std::string plane = std::to_string(storey) + "." + std::to_string(i);
  return bays_y == 0 ? plane : plane + "." + std::to_string(k);
}

std::vector<std::string> GridFrame::member_names() const {
  std::vector<std::string> names;
  for (int storey = 1; storey <= storeys; ++storey)
    for (int k = 0; k <= bays_y; ++k)
      for (int i = 0; i <= bays_x; ++i) {
        names.push_back("column " + place(storey, i, k));
        if (i < bays_x) names.push_back("beam x " + place(storey, i, k));
        if (k < bays_y) names.push_back("beam y " + place(storey, i, k));
      }
  return names;
}

int GridFrame::node(int storey, int i, int k) const {
  if (storey < 0 || storey > storeys || i < 0 || i > bays_x || k < 0 || k > bays_y)
    refuse("the grid has no node (" + std::to_string(storey) + ", " + std::to_string(i) + ", " + std::to_string(k) +
           ")");
  return (storey * (bays_y + 1) + k) * (bays_x + 1) + i;
}

int GridFrame::floor(int storey) const {
  const int first = node(storey, 0);
  if (storey == 0) refuse("the ground is not a floor");
  if (bays_y == 0) return first;
  int between = 0;
  for (const auto& [name, member] : members) between += member.parts - 1;
  return node(storeys, bays_x, bays_y) + between + storey;
}

template <class Value>
void ByStorey<Value>::check(int storeys, int lines, const std::string& name) const {
  if (values_.size() != 1 && static_cast<int>(values_.size()) != storeys)
    refuse(fmt::format("{}: give one value or {}, from the ground up", name, storeys));
  for (const std::vector<Value>& of_storey : values_)
    if (of_storey.size() != 1 && static_cast<int>(of_storey.size()) != lines)
      refuse(fmt::format("{}: give one value per storey or {}, from the first line", name, lines));
}

template class ByStorey<Section>;
template class ByStorey<double>;

std::vector<int> add_member_in_parts(Frame& frame, const std::string& name, int start, int end,
                                     const CutMember& member) {
  if (member.parts < 1 || member.parts > 100) refuse(name + ": parts must be in 1 to 100");
  const Vector3d first = frame.position(start) + member.options.start_offset;
  const Vector3d last = frame.position(end) + member.options.end_offset;
  std::vector<int> added;
  for (int part = 1, from = start; part <= member.parts; ++part) {
    const bool is_last = part == member.parts;
    const std::string of_part = member.parts == 1 ? name : name + "/" + std::to_string(part);
    const int to = is_last ? end : frame.add_node(first + (last - first) * part / member.parts, of_part);
    BeamOptions options = member.options;
    if (part > 1) {
      options.start_releases.clear();
      options.start_offset.setZero();
    }
    if (!is_last) {
      options.end_releases.clear();
      options.end_offset.setZero();
    }
    added.push_back(frame.add_member(from, to, member.section, member.material, options));
    frame.set_name(added.back(), of_part);
    if (!member.load.isZero()) frame.add_member_load(added.back(), member.load);
    from = to;
  }
  return added;
}

void GridFrame::require_affordable() const {
  const double nodes = (storeys + 1.0) * (bays_x + 1.0) * (bays_y + 1.0);
  const std::string grid = fmt::format("a grid of {} storeys and {}{} bays has {:.0f} nodes", storeys, bays_x,
                                       bays_y > 0 ? fmt::format(" x {}", bays_y) : "", nodes);
  if (nodes > limits::grid_nodes)
    refuse(fmt::format("{}, but the maximum is {:g}; use fewer storeys or bays", grid, limits::grid_nodes));
  // In space, a node of a rigid floor also has three unknowns.
  const double bytes = 3 * nodes * limits::bytes_of_unknown, memory = limits::memory();
  if (bytes > memory)
    refuse(
        fmt::format("{}, which need about {} of memory, but {} are available; use fewer storeys or bays, or a machine "
                    "with more memory",
                    grid, limits::text_of_bytes(bytes), limits::text_of_bytes(memory)));
}

GridParts add_grid(FrameModel& model, const GridFrame& grid) {
  if (grid.storeys < 1 || grid.bays_x < 1 || grid.bays_y < 0)
    refuse("a grid needs at least one storey and one bay along x");
  grid.require_affordable();
  Frame& frame = model.frame;
  const bool is_plane = frame.dimension() == 2;
  if (is_plane != (grid.bays_y == 0)) refuse("a grid needs bays along y in space, and none in the plane");
  if (frame.nodes() > 0) refuse("a grid must be added before all other nodes of its frame");
  const std::vector<double> width_x = spread(grid.bay_width_x, grid.bays_x, "bay_width_x");
  const std::vector<double> width_y =
      is_plane ? std::vector<double>{} : spread(grid.bay_width_y, grid.bays_y, "bay_width_y");
  const std::vector<double> x = lines(width_x), y = lines(width_y);
  const std::vector<double> z = lines(spread(grid.storey_height, grid.storeys, "storey_height"));
  const std::vector<double> floor_mass = grid.floor_mass.empty()
                                             ? std::vector<double>(grid.storeys, 0.0)
                                             : spread(grid.floor_mass, grid.storeys, "floor_mass", true);
  const std::vector<double> share_x = shares(width_x), share_y = shares(width_y);

  const auto each = [&](int storey, auto&& act) {
    for (int k = 0; k <= grid.bays_y; ++k)
      for (int i = 0; i <= grid.bays_x; ++i) act(grid.node(storey, i, k), i, k);
  };
  GridParts parts;
  each(0, [&](int, int i, int k) { parts.weights.push_back(share_x[i] * share_y[k]); });
  for (int storey = 0; storey <= grid.storeys; ++storey) {
    FrameFloor floor{.label = std::to_string(storey), .nodes = {}, .elevation = z[storey]};
    each(storey, [&](int, int i, int k) {
      floor.nodes.push_back(frame.add_node(Vector3d(x[i], y[k], z[storey]), grid.place(storey, i, k)));
    });
    if (storey == 0) {
      parts.feet = floor.nodes;
      continue;
    }
    for (std::size_t n = 0; n < floor.nodes.size(); ++n)
      frame.add_mass(floor.nodes[n], floor_mass[storey - 1] * parts.weights[n]);
    model.floors.push_back(std::move(floor));
  }

  if (!grid.members.empty()) {
    const std::vector<std::string> known = grid.member_names();
    for (const auto& [name, member] : grid.members)
      if (std::find(known.begin(), known.end(), name) == known.end()) refuse(unknown_name("member", name, known));
  }
  const int lines_of_columns = (grid.bays_x + 1) * (grid.bays_y + 1);
  grid.column.check(grid.storeys, lines_of_columns, "columns");
  grid.beam.check(grid.storeys, is_plane ? grid.bays_x : lines_of_columns, "beams");
  check_loads(grid, is_plane ? grid.bays_x : lines_of_columns);
  if (grid.mass_from_loads) parts.loaded_mass.assign(frame.nodes(), 0.0);
  for (int storey = 1; storey <= grid.storeys; ++storey)
    each(storey, [&](int node, int i, int k) {
      const int line = k * (grid.bays_x + 1) + i;
      const std::string place = grid.place(storey, i, k);
      const auto add_beam = [&](const char* kind, int to) {
        const double load = grid.beam_load.at(storey, line);
        const double length = add_grid_member(frame, kind + place, node, to, grid.beam.at(storey, line), load, grid);
        if (!grid.mass_from_loads) return;
        const double mass = -load * length / standard_gravity;
        for (const int end : {node, to}) {
          frame.add_mass(end, mass / 2);
          parts.loaded_mass[end] += mass / 2;
        }
      };
      add_grid_member(frame, "column " + place, grid.node(storey - 1, i, k), node, grid.column.at(storey, line), 0,
                      grid);
      if (i < grid.bays_x) add_beam("beam x ", grid.node(storey, i + 1, k));
      if (k < grid.bays_y) add_beam("beam y ", grid.node(storey, i, k + 1));
    });
  model.move_by(grid.origin);
  return parts;
}

void balance_loaded_mass(FrameModel& model, const GridParts& parts) {
  if (!model.has_gravity()) return;
  for (std::size_t node = 0; node < parts.loaded_mass.size(); ++node)
    if (parts.loaded_mass[node] > 0)
      model.frame.add_load(static_cast<int>(node), Dof::uz, parts.loaded_mass[node] * standard_gravity);
}

FrameModel make_frame_model(const GridFrame& grid) {
  FrameModel model{.frame = Frame(grid.bays_y == 0 ? 2 : 3)};
  GridFrame at_zero = grid;
  at_zero.origin.setZero();
  const GridParts parts = add_grid(model, at_zero);
  for (const int foot : parts.feet) model.frame.fix(foot);
  for (int floor = 0; grid.rigid_floors && floor < grid.storeys; ++floor) make_floor_rigid(model, floor, parts.weights);
  balance_loaded_mass(model, parts);
  model.move_by(grid.origin);
  return model;
}

Frame make_frame(const GridFrame& grid) { return make_frame_model(grid).frame; }

}  // namespace pounding
