/// Devices within one structure, as yielding parts.

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/model/devices/device_parts.hpp>
#include <pounding/model/drawing.hpp>
#include <pounding/model/refuse_option.hpp>

namespace pounding {
namespace {

constexpr char axis_names[] = "xyz";

// Location of an end on its structure.
struct Place {
  std::string label;
  std::array<Row, 3> motion;                ///< empty rows for fixed directions
  std::optional<Eigen::Vector3d> position;  ///< of a node
  std::string node;
  int floor = -1;  ///< the highest floor that is not above the end; -1 for none
};

int floor_below(const Structure& s, double elevation) {
  int found = -1;
  for (std::size_t i = 0; i < s.floors.size(); ++i)
    if (s.floors[i].elevation && *s.floors[i].elevation <= elevation + drawn_rounding) found = static_cast<int>(i);
  return found;
}

Place placed(const DeviceEnd& end, const Structure& s, ModelOption option) {
  Place place;
  place.label = "the ground";
  place.node = end.node;
  for (Row& row : place.motion) row.resize(s.size());
  if (!end.node.empty()) {
    try {
      const ContactPoint point = s.surface->node(end.node);
      place.label = "node " + end.node;
      place.motion = point.motion;
      place.position = point.position;
      place.floor = floor_below(s, point.position.z());
    } catch (const std::invalid_argument& error) {
      refuse(option, fmt::format("{}: {}", s.name, error.what()));
    }
  } else if (end.floor) {
    const int count = static_cast<int>(s.floors.size());
    if (*end.floor < 1 || *end.floor > count)
      refuse(option, fmt::format("{} has floors 1 to {}; {} was given", s.name, count, *end.floor));
    place.floor = *end.floor - 1;
    place.label = "floor " + s.floors[place.floor].label;
    const std::vector<Row>& rows = s.floors[place.floor].motion;
    for (std::size_t axis = 0; axis < std::min<std::size_t>(2, rows.size()); ++axis) place.motion[axis] = rows[axis];
  }
  return place;
}

Eigen::Vector3d direction_of(const Place& from, const Place& to, std::optional<DeviceAxis> axis, const Structure& s) {
  const bool is_drawn = from.position && to.position;
  const DeviceAxis chosen = axis.value_or(is_drawn ? DeviceAxis::along : DeviceAxis::x);
  if (chosen != DeviceAxis::along)
    return Eigen::Vector3d::Unit(static_cast<int>(chosen) - static_cast<int>(DeviceAxis::x));
  if (!is_drawn) refuse(ModelOption::axis, "along is the line between two nodes; name two, or type axis: x");
  const Eigen::Vector3d line = *to.position - *from.position;
  if (line.norm() <= drawn_rounding)
    refuse(ModelOption::between,
           fmt::format(
               "{} and {} of {} are at the same point, but the device acts along the line between them; type axis: x",
               from.label, to.label, s.name));
  return unit_vector(line);
}

// Elongation in terms of the unknowns.
Row elongation(const Place& from, const Place& to, const Eigen::Vector3d& direction, const Structure& s) {
  Row row(s.size());
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    for (Row::InnerIterator it(to.motion[axis]); it; ++it) row.coeffRef(it.index()) += direction[axis] * it.value();
    for (Row::InnerIterator it(from.motion[axis]); it; ++it) row.coeffRef(it.index()) -= direction[axis] * it.value();
  }
  row.prune(0.0);
  return row;
}

void require_motion(const Row& row, const Place& from, const Place& to, const Eigen::Vector3d& direction,
                    bool is_damped, const Structure& s) {
  if (row.nonZeros() == 0) {
    std::string along;
    for (int axis = 0; axis < 3; ++axis)
      if (direction[axis] != 0)
        along += along.empty() ? fmt::format("{}", axis_names[axis]) : fmt::format(" and {}", axis_names[axis]);
    refuse(ModelOption::between,
           fmt::format("{} and {} of {} have no relative motion along {}; name two that have, or another axis",
                       from.label, to.label, s.name, along));
  }
  for (Row::InnerIterator it(row); is_damped && it; ++it)
    if (!(s.mass.coeff(it.index(), it.index()) > 0))
      refuse(ModelOption::damper, fmt::format("acts on {} of {}, which has no mass; give it one, or name a floor",
                                              s.unknowns[static_cast<std::size_t>(it.index())], s.name));
}

std::string law_name(const DeviceParts& parts) {
  const std::string first = parts.law ? parts.law->law : parts.bar ? "bar" : "";
  return !parts.damper ? first : first.empty() ? "damper" : first + " and damper";
}

std::vector<YieldingPart::Parameter> numbers(const DeviceParts& parts) {
  std::vector<YieldingPart::Parameter> all;
  if (parts.bar) all.push_back({"stiffness", parts.bar->stiffness});
  if (parts.law) {
    for (const auto& [name, value] : parts.law->values) all.push_back({name, value});
  }
  if (!parts.damper) return all;
  all.push_back({"damper_coefficient", parts.damper->coefficient});
  all.push_back({"damper_exponent", parts.damper->exponent});
  if (parts.damper->has_stiffness())
    all.push_back({"damper_stiffness", parts.damper->stiffness});
  else if (!parts.damper->is_linear())
    all.push_back({"damper_rounding_velocity", parts.damper->rounding_velocity});
  return all;
}

// Adds the force of the last part to the storey shears, if its ends are on different sides of the top of the storey.
void add_to_shears(const Place& from, const Place& to, const Eigen::Vector3d& direction, Structure& s) {
  const auto count = static_cast<Eigen::Index>(s.yielding.size());
  if (!s.has_storeys()) return;
  for (std::size_t i = 0; i < s.floors.size(); ++i) {
    Floor& floor = s.floors[i];
    std::vector<Row>& rows = floor.storey_shear_by_yielding;
    rows.resize(floor.storey_shear.size(), Row(count));
    const bool from_above = from.floor >= static_cast<int>(i), to_above = to.floor >= static_cast<int>(i);
    for (std::size_t d = 0; d < rows.size(); ++d) {
      rows[d].conservativeResize(count);
      if (from_above != to_above && direction[static_cast<int>(d)] != 0)
        rows[d].coeffRef(count - 1) = (to_above ? 1 : -1) * direction[static_cast<int>(d)];
    }
  }
}

// Adds the reactions at supported nodes.
void add_to_reactions(const Place& from, const Place& to, const Eigen::Vector3d& direction, Structure& s) {
  InternalForces& forces = s.forces;
  if (forces.rows.rows() == 0) return;
  const auto count = static_cast<Eigen::Index>(s.yielding.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < forces.by_yielding.outerSize(); ++row)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(forces.by_yielding, row); it; ++it)
      entries.emplace_back(row, static_cast<int>(it.col()), it.value());
  const std::size_t first = forces.members.size() * forces.components.size();
  for (const auto& [place, sign] : {std::pair(&from, -1.0), std::pair(&to, 1.0)})
    for (std::size_t support = 0; support < forces.supports.size(); ++support) {
      if (place->node.empty() || forces.supports[support] != place->node) continue;
      for (std::size_t d = 0; d < forces.directions.size(); ++d)
        for (int axis = 0; axis < 3; ++axis)
          if (forces.directions[d] == std::string(1, axis_names[axis]) && direction[axis] != 0 &&
              place->motion[axis].nonZeros() == 0)
            entries.emplace_back(static_cast<int>(first + support * forces.directions.size() + d),
                                 static_cast<int>(count - 1), sign * direction[axis]);
    }
  forces.by_yielding.resize(forces.rows.rows(), count);
  forces.by_yielding.setFromTriplets(entries.begin(), entries.end());
}

void check_name(const std::string& name, const Structure& s) {
  if (name.empty()) refuse(ModelOption::device_name, "a name must not be empty; type a name such as brace");
  for (const YieldingPart& part : s.yielding)
    if (part.name == name)
      refuse(ModelOption::device_name,
             fmt::format("{} has a part \"{}\" already; give this one another name", s.name, name));
}

}  // namespace

void Model::connect_within(const std::string& name, const StructureHandle& structure, const DeviceEnd& from,
                           const DeviceEnd& to, std::optional<DeviceAxis> axis, const DeviceOptions& options) {
  require_open();
  Structure& s = structures[static_cast<std::size_t>(structure.number())];
  check_name(name, s);
  if (s.is_rigid() || s.is_free)
    refuse(ModelOption::device,
           fmt::format("{} has no two points for a device; connect it to another structure", s.name));
  if (const std::string why = s.why_stiffness_changes(); !why.empty())
    refuse(ModelOption::device,
           fmt::format("{}: {}, which its devices do not support; {}", s.name, why,
                       s.elastic ? "type geometry: p_delta" : "leave its members elastic, or give them hinges"));
  const Place a = placed(from, s, ModelOption::left), b = placed(to, s, ModelOption::right);
  const Eigen::Vector3d direction = direction_of(a, b, axis, s);
  const std::optional<double> length =
      a.position && b.position ? std::optional((*b.position - *a.position).norm()) : std::nullopt;
  const DeviceParts parts = parts_of(options, length);
  Row row = elongation(a, b, direction, s);
  require_motion(row, a, b, direction, parts.damper.has_value(), s);
  require_digits(parts, against(s.stiffness, row), against(s.mass, row));
  YieldingPart part(name, std::move(row), law_name(parts), numbers(parts), std::make_unique<DeviceSpring>(parts));
  part.kind = YieldingPart::Kind::device;
  part.device = fmt::format("{}, between {} and {}", describe(parts), a.label, b.label);
  s.yielding.push_back(std::move(part));
  const auto count = static_cast<Eigen::Index>(s.yielding.size());
  if (s.yielding_flexibility.size() > 0) s.yielding_flexibility.conservativeResize(count, count);
  add_to_shears(a, b, direction, s);
  add_to_reactions(a, b, direction, s);
}

}  // namespace pounding
