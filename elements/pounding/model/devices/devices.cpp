/// Bars and dampers between two structures: ends, direction, and the periods of structures joined by bars.

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/model/devices/device_parts.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/model/facing.hpp>
#include <pounding/model/place_ends.hpp>
#include <pounding/model/refuse_option.hpp>
#include <pounding/structures/massless.hpp>

namespace pounding {
namespace {

// Number of frequencies of structures joined by bars.
constexpr int max_joined_modes = 3;

void check_name(const std::string& name, const std::vector<Device>& others) {
  if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos)
    refuse(ModelOption::device_name,
           "a name must not be empty, \".\" or \"..\", or contain \"/\"; type a name such as top damper");
  for (const Device& other : others)
    if (other.name == name)
      refuse(ModelOption::device_name, fmt::format("a device \"{}\" exists already; give this one another name", name));
}

// Two drawn nodes are joined along the line between them.
void lay_between_nodes(Device& device, const LinkPair& pair, const Structure& a, const Structure& b) {
  device.left = place_end(pair.left, a, Side::plus_x, 0, ModelOption::left);
  device.right = place_end(pair.right, b, Side::minus_x, 0, ModelOption::right);
  const Eigen::Vector3d line = device.right.point.position - device.left.point.position;
  if (line.norm() <= drawn_rounding)
    refuse(ModelOption::between,
           fmt::format("{} of {} and {} of {} are at the same point, but a device acts along the line between its "
                       "ends; name nodes apart from each other, or floors",
                       device.left.label, a.name, device.right.label, b.name));
  device.direction = unit_vector(line);
  device.length = line.norm();
}

// All other ends are joined like those of links.
void lay_between_sides(Device& device, const LinkPair& pair, const Model& model) {
  const Structure &a = model.structures[pair.left.structure], &b = model.structures[pair.right.structure];
  const Side side = facing_side(a, b);
  const double along = along_the_edge(1, pair, a, b, side).front();
  device.left = place_end(pair.left, a, side, along, ModelOption::left);
  device.right = place_end(pair.right, b, opposite(side), along, ModelOption::right);
  device.direction = outward(side);
  if (are_drawn(a, b)) device.length = drawn_gap(model, device.left, device.right, side, {});
}

// Each end must move a mass along all axes of the device: otherwise its force is taken by a support alone, or acts on
// no mass.
void require_motion(const LinkEnd& end, const Structure& s, const Eigen::Vector3d& direction, ModelOption option) {
  if (s.is_rigid()) return;
  if (end.point.member >= 0)
    refuse(option, fmt::format("the device meets member {} of {} between its ends; name a node there, or a floor",
                               s.forces.members[end.point.member], s.name));
  constexpr char axes[] = "xyz";
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const Row& row = end.point.motion[axis];
    if (row.nonZeros() == 0)
      refuse(option,
             fmt::format("{} of {} does not move along {}, where the device acts; name a floor, or a node that moves",
                         end.label, s.name, axes[axis]));
    for (Row::InnerIterator it(row); it; ++it)
      if (it.value() != 0 && !(s.mass.coeff(it.index(), it.index()) > 0))
        refuse(option, fmt::format("the device acts on {} of {}, which has no mass; give it one, or name a floor",
                                   s.unknowns[static_cast<std::size_t>(it.index())], s.name));
  }
}

std::string end_text(const LinkEnd& end, const Structure& s) {
  return end.label.empty() ? s.name : fmt::format("{} of {}", end.label, s.name);
}

std::string names_of(const Model& model, const std::vector<int>& structures) {
  std::string text;
  for (std::size_t i = 0; i < structures.size(); ++i)
    text += (i == 0 ? "" : i + 1 == structures.size() ? " and " : ", ") + model.structures[structures[i]].name;
  return text;
}

// Stiffness of a device at rest; zero for a damper, in slow motion, and for a slack cable.
double first_stiffness(const Device& device) { return LoadedSpring(*device.member).evaluate_slowly(0).by_penetration; }

}  // namespace

void Model::connect(const std::string& name, const ContactLocation& left, const ContactLocation& right,
                    const DeviceOptions& options) {
  require_open();
  check_name(name, devices);
  if (left.structure == right.structure)
    refuse(ModelOption::between, "both ends are on one structure; name two structures, the left one first");
  for (const auto& [location, option] : {std::pair(&left, ModelOption::left), std::pair(&right, ModelOption::right)})
    if (location->face) refuse(option, "face applies only to links; a device is drawn between axes: remove face");
  const LinkPair pair = pairs_of(*this, left, right, {}).front();
  const Structure &a = structures[left.structure], &b = structures[right.structure];
  Device device;
  device.name = name;
  if (!pair.left.node.empty() && !pair.right.node.empty() && are_drawn(a, b))
    lay_between_nodes(device, pair, a, b);
  else
    lay_between_sides(device, pair, *this);
  require_motion(device.left, a, device.direction, ModelOption::left);
  require_motion(device.right, b, device.direction, ModelOption::right);
  device.parts = parts_of(options, device.length);
  double stiffness = 0, mass = 0;
  for (const auto& [end, s] : {std::pair(&device.left, &a), std::pair(&device.right, &b)}) {
    if (s->is_rigid()) continue;
    const Row row = motion_along(*end, device.direction, s->size());
    stiffness = std::max(stiffness, against(s->stiffness, row));
    mass = std::max(mass, against(s->mass, row));
  }
  require_digits(device.parts, stiffness, mass);
  device.member = std::make_shared<const DeviceSpring>(device.parts);
  devices.push_back(std::move(device));
}

JoinedByBars joined_by_bars(const Model& model) {
  std::set<int> numbers;
  for (const Device& device : model.devices)
    for (const LinkEnd* end : {&device.left, &device.right})
      if (first_stiffness(device) > 0 && !model.structures[end->structure].is_rigid()) numbers.insert(end->structure);
  JoinedByBars joined{{numbers.begin(), numbers.end()}, {}};
  if (numbers.empty()) return joined;

  std::vector<int> first(model.structures.size(), 0);
  std::vector<Eigen::Triplet<double>> mass, stiffness;
  int n = 0, modes = 0;
  for (const int number : joined.structures) {
    const Structure& s = model.structures[number];
    first[number] = n;
    add_entries(mass, s.mass, n);
    add_entries(stiffness, s.stiffness, n);
    n += s.size();
    modes += count_of_modes(s);
  }
  for (const Device& device : model.devices) {
    const double k = first_stiffness(device);
    if (k == 0) continue;
    Eigen::SparseVector<double> elongation(n);
    for (const auto& [end, sign] : {std::pair(&device.left, -1.0), std::pair(&device.right, 1.0)})
      if (const Structure& s = model.structures[end->structure]; !s.is_rigid()) {
        const Row row = motion_along(*end, sign * device.direction, s.size());
        for (Row::InnerIterator it(row); it; ++it)
          elongation.coeffRef(first[end->structure] + it.index()) += it.value();
      }
    for (Row::InnerIterator i(elongation); i; ++i)
      for (Row::InnerIterator j(elongation); j; ++j)
        stiffness.emplace_back(static_cast<int>(i.index()), static_cast<int>(j.index()), k * i.value() * j.value());
  }
  const SparseMatrix m = sparse_matrix(n, n, mass), k = sparse_matrix(n, n, stiffness);
  joined.frequencies = model.mode_solver(m, k, std::min(modes, max_joined_modes)).frequencies;
  return joined;
}

std::string describe_joined(const Model& model) {
  const JoinedByBars joined = joined_by_bars(model);
  std::string periods;
  for (const double w : joined.frequencies)
    if (w > 0) periods += fmt::format("{}{:.4g} s", periods.empty() ? "" : ", ", 2 * M_PI / w);
  if (periods.empty()) return {};
  return fmt::format("joined by bars: {} together, first periods {}; those above are for each structure alone\n",
                     names_of(model, joined.structures), periods);
}

std::string describe(const DeviceParts& parts) {
  std::string text;
  if (parts.bar) text += "bar " + format_quantity(parts.bar->stiffness, dimension::stiffness, 6);
  if (parts.law) {
    const DeviceSpring spring({.law = parts.law});
    text += fmt::format("{} {}", parts.law->law, format_quantity(spring.first_slope(), dimension::stiffness, 6));
    if (const auto slack = parts.law->values.find("slack"); slack != parts.law->values.end())
      text += " with a slack of " + format_quantity(slack->second, dimension::length, 6);
    text += std::isfinite(spring.yield_force())
                ? ", yields at " + format_quantity(spring.yield_force(), dimension::force, 6)
                : ", elastic";
  }
  if (!parts.damper) return text;
  const Damper& damper = *parts.damper;
  text += fmt::format("{}damper {:.6g} kN ", text.empty() ? "" : ", ", damper.coefficient / 1e3);
  text += damper.is_linear() ? "s/m" : fmt::format("(s/m)^{:g}", damper.exponent);
  if (damper.has_stiffness()) return text + " behind " + format_quantity(damper.stiffness, dimension::stiffness, 6);
  if (!damper.is_linear())
    text += fmt::format(", rounded as c v (v^2 + v0^2)^{:g} with v0 = {:g} mm/s", 0.5 * (damper.exponent - 1),
                        1e3 * damper.rounding_velocity);
  return text;
}

std::string describe(const Model& model, const Device& device) {
  std::string text = fmt::format("device {}: {}", device.name, describe(device.parts));
  text += fmt::format(", between {} and {}", end_text(device.left, model.structures[device.left.structure]),
                      end_text(device.right, model.structures[device.right.structure]));
  if (device.length) text += fmt::format(", {} long", format_quantity(*device.length, dimension::length, 6));
  return text + '\n';
}

}  // namespace pounding
