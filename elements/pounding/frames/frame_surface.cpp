#include <pounding/frames/frame_surface.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/names.hpp>
#include <pounding/core/refuse.hpp>
#include <pounding/core/units.hpp>
#include <pounding/frames/sections.hpp>

namespace pounding {
namespace {

using Eigen::Vector3d;

// Points closer than this coincide [m].
constexpr double together = 1e-6;
// Columns are in line if their axes differ by less than this, the rounding of typed decimals [m].
constexpr double in_line = 1e-3;

std::string metres(double length) { return format_quantity(length, dimension::length, 6); }

// First and last part of the whole member that contains this one; the member itself if it is not subdivided. Parts are
// consecutive.
std::pair<int, int> parts_of_whole(const Frame& frame, int member) {
  const std::string name = frame.member_name(member);
  const std::size_t slash = name.find('/');
  std::pair<int, int> parts{member, member};
  if (slash == std::string::npos) return parts;
  const auto belongs = [&](int other) {
    return other >= 0 && other < frame.members() && frame.member_name(other).starts_with(name.substr(0, slash + 1));
  };
  while (belongs(parts.first - 1)) --parts.first;
  while (belongs(parts.second + 1)) ++parts.second;
  return parts;
}

// Error message for a contact on a member, or a part of one, that has a hinge, with the key to type.
std::string beside_hinge(const Frame& frame, int member, double along) {
  const std::string part = frame.member_name(member), whole = part.substr(0, part.find('/'));
  const auto [first, last] = parts_of_whole(frame, member);
  bool yields_at[2] = {false, false};
  for (const Hinge& hinge : frame.hinges())
    if (hinge.member >= first && hinge.member <= last) yields_at[hinge.at == MemberEnd::start ? 0 : 1] = true;
  const double share = (member - first + along) / (last - first + 1);
  int more = 2;
  const auto hits_an_end = [&] {
    const int hit = static_cast<int>(share * more);
    return (yields_at[0] && hit == 0) || (yields_at[1] && hit >= more - 1);
  };
  while (more < 100 && hits_an_end()) ++more;
  return fmt::format(
      "member {} has a hinge and cannot be hit between its ends; type members: {{{}: {{parts: {}}}}}, so that the "
      "contact is on a part without a hinge",
      part, whole, more);
}

}  // namespace

double mass_along_x(const AssembledFrame& frame, const std::vector<int>& nodes) {
  std::set<int> unknowns;
  for (const int node : nodes) {
    const Row row = frame.motion(node, Dof::ux);
    for (Row::InnerIterator it(row); it; ++it)
      if (frame.unknowns[it.index()].second == Dof::ux) unknowns.insert(static_cast<int>(it.index()));
  }
  double sum = 0;
  for (const int unknown : unknowns) sum += frame.load(unknown, 0);
  return sum;
}

FrameSurface::FrameSurface(std::shared_ptr<const FrameModel> model, std::shared_ptr<const AssembledFrame> assembled)
    : model_(std::move(model)), assembled_(std::move(assembled)), floor_of_node_(model_->frame.nodes(), -1) {
  for (std::size_t f = 0; f < model_->floors.size(); ++f) {
    for (const int node : model_->floors[f].nodes) floor_of_node_[node] = static_cast<int>(f);
    floor_mass_.push_back(mass_along_x(*assembled_, model_->floors[f].nodes));
  }
}

std::optional<std::array<double, 4>> FrameSurface::plan() const {
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<double, 4> box{far, -far, far, -far};
  for (int node = 0; node < model_->given_nodes(); ++node)
    for (const int axis : {0, 1}) {
      box[2 * axis] = std::min(box[2 * axis], position(node)[axis]);
      box[2 * axis + 1] = std::max(box[2 * axis + 1], position(node)[axis]);
    }
  return box;
}

int FrameSurface::axis_of(Side side) const {
  const bool along_x = side == Side::plus_x || side == Side::minus_x;
  if (!along_x && assembled_->dimension == 2) refuse("contact with a plane frame must be along x");
  return along_x ? 0 : 1;
}

// Outermost nodes, in order along the edge.
std::vector<int> FrameSurface::edge_nodes(int floor, Side side) const {
  if (floor < 0 || floor >= static_cast<int>(model_->floors.size()))
    refuse(fmt::format("unknown floor {}; number of floors: {}", floor + 1, model_->floors.size()));
  const int across = 1 - axis_of(side);
  const Vector3d out = outward(side);
  const std::vector<int>& nodes = model_->floors[floor].nodes;
  double outermost = -std::numeric_limits<double>::infinity();
  for (const int node : nodes) outermost = std::max(outermost, out.dot(position(node)));
  std::vector<int> edge;
  for (const int node : nodes)
    if (out.dot(position(node)) > outermost - together) edge.push_back(node);
  std::stable_sort(edge.begin(), edge.end(), [&](int a, int b) { return position(a)[across] < position(b)[across]; });
  return edge;
}

std::array<double, 2> FrameSurface::edge(int floor, Side side) const {
  const std::vector<int> nodes = edge_nodes(floor, side);
  const int across = 1 - axis_of(side);
  return {position(nodes.front())[across], position(nodes.back())[across]};
}

ContactPoint FrameSurface::floor(int floor, Side side, double along) const {
  const std::vector<int> nodes = edge_nodes(floor, side);
  const int axis = axis_of(side), across = 1 - axis;
  const FrameFloor& of = model_->floors[floor];
  if (assembled_->dimension == 2)
    return pushed(on_arm(nodes.front(), position(nodes.front()), floor_mass_[floor]), axis);

  const double first = position(nodes.front())[across], last = position(nodes.back())[across];
  if (!(along > first - together && along < last + together))
    refuse(fmt::format("the edge of floor {} extends from {} to {}, but the point is at {}", of.label, metres(first),
                       metres(last), metres(along)));
  for (const int node : nodes)
    if (std::abs(position(node)[across] - along) < together)
      return pushed(on_arm(node, position(node), floor_mass_[floor]), axis);
  const auto after = std::find_if(nodes.begin(), nodes.end(), [&](int node) { return position(node)[across] > along; });
  const double share =
      (along - position(*(after - 1))[across]) / (position(*after)[across] - position(*(after - 1))[across]);
  const Vector3d point = (1 - share) * position(*(after - 1)) + share * position(*after);
  if (of.master >= 0) return pushed(on_rigid_floor(floor, *(after - 1), *after, point), axis);
  const auto member = member_through(point);
  if (!member)
    refuse(fmt::format(
        "floor {} has no member at its edge at {}, between the nodes {} and {}; add one, or make the floor rigid",
        of.label, metres(along), model_->frame.node_name(*(after - 1)), model_->frame.node_name(*after)));
  return pushed(on_member(member->first, member->second, point, floor_mass_[floor]), axis);
}

ContactPoint FrameSurface::column(double elevation, Side side, double along) const {
  const int axis = axis_of(side), across = 1 - axis;
  const Vector3d out = outward(side);
  std::vector<OnColumn> candidates;
  double outermost = -std::numeric_limits<double>::infinity();
  double lowest = -outermost, highest = outermost;
  for (int member = 0; member < model_->frame.members(); ++member) {
    if (model_->frame.beam(member).is_truss()) continue;
    for (const int node : model_->frame.ends(member)) {
      lowest = std::min(lowest, position(node).z());
      highest = std::max(highest, position(node).z());
    }
    if (const auto point = on_column(member, elevation)) {
      candidates.push_back(*point);
      outermost = std::max(outermost, out.dot(point->position));
    }
  }
  if (candidates.empty())
    refuse(fmt::format("no column at an elevation of {}; members extend from {} to {}", metres(elevation),
                       metres(lowest), metres(highest)));
  std::erase_if(candidates, [&](const OnColumn& each) { return out.dot(each.position) < outermost - together; });
  const auto distance = [&](const OnColumn& each) { return std::abs(each.position[across] - along); };
  const OnColumn& hit =
      *std::min_element(candidates.begin(), candidates.end(),
                        [&](const OnColumn& a, const OnColumn& b) { return distance(a) < distance(b); });
  ContactPoint point = hit.node >= 0 ? on_arm(hit.node, hit.position, mass_of(hit))
                                     : on_member(hit.member, hit.along, hit.position, mass_of(hit));
  const Beam& beam = model_->frame.beam(hit.member);
  point.to_joint = to_joint(hit);
  point.column_depth = extent(beam.section(), beam.axes(), out);
  return pushed(point, axis);
}

std::optional<ColumnFace> FrameSurface::column_face(const Vector3d& point, Side side) const {
  const Vector3d out = outward(side);
  const double line = out.dot(point);
  std::optional<ColumnFace> found;
  for (int member = 0; member < model_->frame.members(); ++member) {
    const Beam& beam = model_->frame.beam(member);
    if (beam.is_truss() || !is_upright(beam)) continue;
    const double half = 0.5 * extent(beam.section(), beam.axes(), out);
    const auto [start, end] = model_->frame.ends(member);
    for (const auto& [node, offset] :
         {std::pair(start, beam.options().start_offset), std::pair(end, beam.options().end_offset)}) {
      const double at_node = out.dot(position(node)), axis = at_node + out.dot(offset);
      if (std::min(std::abs(at_node - line), std::abs(axis - line)) > in_line) continue;
      const double distance = std::max(0.0, half + (axis - line));
      if (found && distance <= found->distance) continue;
      const std::string name = model_->frame.member_name(member);
      found = {distance, name.substr(0, name.find('/')), !beam.section().has_size()};
    }
  }
  return found;
}

// Distance along the column to the nearer joint: a node with other members or a floor, or the end of the column [m]. 0
// at a joint.
double FrameSurface::to_joint(const OnColumn& point) const {
  const Frame& frame = model_->frame;
  const auto next = [&](int node, int from) {
    int found = -1;
    if (floor_of_node_[node] >= 0) return found;
    for (int member = 0; member < frame.members(); ++member) {
      const auto [start, end] = frame.ends(member);
      if (member == from || (start != node && end != node) || frame.beam(member).is_truss()) continue;
      if (found >= 0 || !is_upright(frame.beam(member))) return -1;
      found = member;
    }
    return found;
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (int node : frame.ends(point.member)) {
    int member = point.member;
    for (int step = 0; step < frame.members(); ++step) {
      const int beyond = next(node, member);
      if (beyond < 0) break;
      const auto [start, end] = frame.ends(beyond);
      member = beyond;
      node = start == node ? end : start;
    }
    nearest = std::min(nearest, std::abs(position(node).z() - point.position.z()));
  }
  return nearest;
}

int FrameSurface::numbered(const std::string& name) const {
  std::vector<std::string> names;
  for (int node = 0; node < model_->given_nodes(); ++node) {
    names.push_back(model_->frame.node_name(node));
    if (names.back() == name) return node;
  }
  refuse(unknown_name("node", name, names));
}

ContactPoint FrameSurface::node(const std::string& name) const {
  const int node = numbered(name);
  return on_arm(node, position(node), mass_along_x(*assembled_, {node}));
}

Row FrameSurface::displacement(const std::string& node, const std::string& dof) const {
  std::vector<std::string> names;
  for (const Dof each : dofs_of(assembled_->dimension)) {
    names.emplace_back(name(each));
    if (names.back() == dof) return assembled_->motion(numbered(node), each);
  }
  refuse(unknown_name("displacement", dof, names));
}

// Position on the path from node to node including the rigid offsets; nullopt if it does not reach this height, or is
// level.
std::optional<FrameSurface::OnColumn> FrameSurface::on_column(int member, double elevation) const {
  const auto [start, end] = model_->frame.ends(member);
  const BeamOptions& options = model_->frame.beam(member).options();
  const std::array<Vector3d, 4> path{position(start), position(start) + options.start_offset,
                                     position(end) + options.end_offset, position(end)};
  if (std::abs(path[3].z() - path[0].z()) < together) return {};
  for (const int node : {start, end})
    if (std::abs(position(node).z() - elevation) < together)
      return OnColumn{member, node, node == start ? 0.0 : 1.0, position(node)};
  for (const int part : {1, 0, 2}) {
    const double rise = path[part + 1].z() - path[part].z(), share = (elevation - path[part].z()) / rise;
    if (std::abs(rise) < together || share < 0 || share > 1) continue;
    const int node = part == 1 ? -1 : part == 0 ? start : end;
    return OnColumn{member, node,
                    part == 1   ? share
                    : part == 0 ? 0.0
                                : 1.0,
                    (1 - share) * path[part] + share * path[part + 1]};
  }
  return {};
}

std::optional<std::pair<int, double>> FrameSurface::member_through(const Vector3d& point) const {
  for (int member = 0; member < model_->frame.members(); ++member) {
    if (model_->frame.beam(member).is_truss()) continue;
    const auto [start, end] = model_->frame.ends(member);
    const BeamOptions& options = model_->frame.beam(member).options();
    const Vector3d from = position(start) + options.start_offset, way = position(end) + options.end_offset - from;
    const double along = (point - from).dot(way) / way.squaredNorm();
    if (along >= 0 && along <= 1 && (from + along * way - point).norm() < together) return std::pair(member, along);
  }
  return {};
}

double FrameSurface::mass_of(int node) const {
  const int floor = floor_of_node_[node];
  return floor >= 0 ? floor_mass_[floor] : mass_along_x(*assembled_, {node});
}

// Between two floors, the interpolated mass of both. The nodes within a subdivided member have their own mass, which
// decreases with the number of parts, but the contact involves the two floors.
double FrameSurface::mass_of(const OnColumn& point) const {
  if (point.node >= 0 && floor_of_node_[point.node] >= 0) return floor_mass_[floor_of_node_[point.node]];
  const auto [first, last] = parts_of_whole(model_->frame, point.member);
  if (point.node >= 0 && first == last) return mass_of(point.node);
  const auto [start, after] = model_->frame.ends(first);
  const auto [before, end] = model_->frame.ends(last);
  double share = point.along;
  if (first != last) {
    const double from = position(start).z() + model_->frame.beam(first).options().start_offset.z(),
                 to = position(end).z() + model_->frame.beam(last).options().end_offset.z();
    share = std::clamp((point.position.z() - from) / (to - from), 0.0, 1.0);
  }
  return (1 - share) * mass_of(start) + share * mass_of(end);
}

ContactPoint FrameSurface::on_arm(int node, const Vector3d& at, double mass) const {
  ContactPoint point;
  point.position = at;
  point.mass = mass;
  const Vector3d arm = at - position(node);
  point.motion = {assembled_->motion(node, Dof::ux, arm), Row(assembled_->size()),
                  assembled_->motion(node, Dof::uz, arm)};
  if (assembled_->dimension == 3) point.motion[1] = assembled_->motion(node, Dof::uy, arm);
  return point;
}

ContactPoint FrameSurface::on_member(int member, double along, const Vector3d& at, double mass) const {
  if (!model_->is_linear())
    refuse(fmt::format("with {}, a member cannot be hit between its ends; add a node there", model_->nonlinear_key()));
  for (const Hinge& hinge : model_->frame.hinges())
    if (hinge.member == member) refuse(beside_hinge(model_->frame, member, along));
  const Frame::PointOnMember on = model_->frame.point_on_member(member, along, *assembled_);
  ContactPoint point;
  point.position = at;
  point.mass = mass;
  point.motion = on.motion;
  point.supported = on.supported;
  point.member = member;
  point.fixed_ends = on.fixed_ends;
  const Frame::Reactions ground = model_->frame.reactions(model_->held_nodes(), *assembled_, false, true);
  point.reactions.resize(ground.by_forces.rows(), 3);
  for (int axis = 0; axis < 3; ++axis)
    point.reactions.col(axis) = -(ground.by_forces * Eigen::VectorXd(on.supported[axis]));
  return point;
}

ContactPoint FrameSurface::on_rigid_floor(int floor, int before, int after, const Vector3d& at) const {
  ContactPoint point = on_arm(model_->floors[floor].master, at, floor_mass_[floor]);
  const double share = (at - position(before)).norm() / (position(after) - position(before)).norm();
  point.motion[2] = (1 - share) * assembled_->motion(before, Dof::uz) + share * assembled_->motion(after, Dof::uz);
  return point;
}

ContactPoint FrameSurface::pushed(ContactPoint point, int axis) const {
  for (Row::InnerIterator it(point.motion[axis]); it; ++it) {
    if (it.value() == 0 || !assembled_->massless[it.index()]) continue;
    const auto& [node, dof] = assembled_->unknowns[it.index()];
    const std::string name = assembled_->node_names[node];
    refuse(
        fmt::format("a contact force there acts on {0} of node {1}, which is massless; type masses: {{{1}: {{{0}: "
                    "{2}}}}}, or mass: consistent with a density",
                    pounding::name(dof), name, dof < Dof::rx ? "1 t" : "100 kg m^2"));
  }
  return point;
}

}  // namespace pounding
