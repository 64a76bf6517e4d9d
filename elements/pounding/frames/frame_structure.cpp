#include <pounding/frames/frame_structure.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/frames/corotational_forces.hpp>
#include <pounding/frames/frame_surface.hpp>

namespace pounding {
namespace {

using Eigen::Vector3d;

// The turn about z that fits the motions of the nodes best: sum m r x u / sum m r^2 about their centre. Nodes at one point
// turn with the first.
Row mean_turn(const FrameModel& model, const AssembledFrame& frame, const std::vector<int>& nodes,
              const std::vector<double>& weights, const Vector3d& centre) {
  Row turn(frame.size());
  double inertia = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vector3d r = model.frame.position(nodes[i]) - centre;
    inertia += weights[i] * r.head<2>().squaredNorm();
    turn += weights[i] * (r.x() * frame.motion(nodes[i], Dof::uy) - r.y() * frame.motion(nodes[i], Dof::ux));
  }
  if (inertia == 0) return frame.motion(nodes.front(), Dof::rz);
  return turn / inertia;
}

std::vector<Row> floor_motion(const FrameModel& model, const AssembledFrame& frame, const FrameFloor& floor) {
  if (frame.dimension == 2) return {frame.motion(floor.nodes.front(), Dof::ux)};
  if (floor.master >= 0) {
    const int m = floor.master;
    return {frame.motion(m, Dof::ux), frame.motion(m, Dof::uy), frame.motion(m, Dof::rz)};
  }
  std::vector<double> weights;
  for (const int node : floor.nodes) weights.push_back(mass_along_x(frame, {node}));
  if (std::accumulate(weights.begin(), weights.end(), 0.0) == 0) weights.assign(weights.size(), 1.0);
  const double whole = std::accumulate(weights.begin(), weights.end(), 0.0);
  Row x(frame.size()), y(frame.size());
  Vector3d centre(0, 0, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    x += weights[i] / whole * frame.motion(floor.nodes[i], Dof::ux);
    y += weights[i] / whole * frame.motion(floor.nodes[i], Dof::uy);
    centre += weights[i] / whole * model.frame.position(floor.nodes[i]);
  }
  return {x, y, mean_turn(model, frame, floor.nodes, weights, centre)};
}

double mean_height(const Frame& frame, const std::vector<int>& nodes) {
  double sum = 0;
  for (const int node : nodes) sum += frame.position(node).z();
  return sum / static_cast<double>(nodes.size());
}

double lowest_support(const FrameModel& model) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const FrameSupport& support : model.supports)
    for (const int node : support.nodes) lowest = std::min(lowest, model.frame.position(node).z());
  return lowest;
}

// Forces along x, and y in space, on the upper ends of what joins the nodes above the cut to those below; not of members
// that turn.
std::vector<Row> shear_through(const FrameModel& model, const AssembledFrame& frame, const std::vector<bool>& above) {
  const int directions = frame.dimension - 1;
  std::vector<Eigen::VectorXd> sums(directions, Eigen::VectorXd::Zero(frame.size()));
  for (int member = 0; !model.corotational && member < model.frame.members(); ++member) {
    const auto [start, end] = model.frame.ends(member);
    if (above[start] == above[end]) continue;
    const Beam& beam = model.frame.beam(member);
    const Matrix12 forces = beam.end_force_matrix();
    const int upper = above[start] ? 0 : 6;
    for (const auto& [node, first] : {std::pair(start, 0), {end, 6}})
      for (const Dof dof : dofs_of(frame.dimension)) {
        const Vector3d by_motion =
            beam.axes().transpose() * forces.block<3, 1>(upper, first + static_cast<int>(dof));
        const Row motion = frame.motion(node, dof);
        for (Row::InnerIterator it(motion); it; ++it)
          for (int d = 0; d < directions; ++d) sums[d][it.index()] += by_motion[d] * it.value();
      }
  }
  for (const FrameSpring& spring : model.springs) {
    const int direction = static_cast<int>(spring.dof);
    if (above[spring.start] == above[spring.end] || direction >= directions) continue;
    const int upper = above[spring.start] ? spring.start : spring.end, lower = above[spring.start] ? spring.end : spring.start;
    sums[direction] += spring.stiffness * (frame.motion(upper, spring.dof) - frame.motion(lower, spring.dof));
  }
  std::vector<Row> rows;
  for (const Eigen::VectorXd& sum : sums) rows.push_back(sum.sparseView());
  return rows;
}

// A storey without height, as on bearings, has its floor above and all other nodes at this height below.
std::vector<bool> nodes_above(const Frame& frame, const FrameFloor& floor, double cut) {
  constexpr double level = 1e-6;  // [m]
  std::vector<bool> above;
  for (int node = 0; node < frame.nodes(); ++node) {
    const double height = frame.position(node).z() - cut;
    const bool of_floor = node == floor.master || std::find(floor.nodes.begin(), floor.nodes.end(), node) != floor.nodes.end();
    above.push_back(std::abs(height) < level ? of_floor : height > 0);
  }
  return above;
}

// Of each floor, the nodes above the middle height of the storey below it.
std::vector<std::vector<bool>> cuts(const FrameModel& model) {
  std::vector<std::vector<bool>> above;
  double below = lowest_support(model);
  for (const FrameFloor& of : model.floors) {
    const double height = mean_height(model.frame, of.nodes);
    above.push_back(nodes_above(model.frame, of, (below + height) / 2));
    below = height;
  }
  return above;
}

// As shear_through, by displacements of all nodes that supports enforce: floor by floor.
Eigen::MatrixX3d enforced_shears(const FrameModel& model, const AssembledFrame& frame, const Eigen::MatrixX3d& enforced) {
  const std::vector<std::vector<bool>> above = cuts(model);
  const int directions = frame.dimension - 1;
  const int dofs = static_cast<int>(dofs_of(frame.dimension).size());
  Eigen::MatrixX3d shears = Eigen::MatrixX3d::Zero(static_cast<int>(above.size()) * directions, 3);
  for (std::size_t floor = 0; floor < above.size(); ++floor) {
    auto sum = shears.middleRows(static_cast<int>(floor) * directions, directions);
    for (int member = 0; member < model.frame.members(); ++member) {
      const auto [start, end] = model.frame.ends(member);
      if (above[floor][start] == above[floor][end]) continue;
      const Eigen::Matrix<double, 12, 3> forces = model.frame.enforced_end_forces(member, enforced);
      const Eigen::Matrix3d in_space =
          model.frame.beam(member).axes().transpose() * forces.middleRows<3>(above[floor][start] ? 0 : 6);
      sum += in_space.topRows(directions);
    }
    for (const FrameSpring& spring : model.springs) {
      const int direction = static_cast<int>(spring.dof);
      if (above[floor][spring.start] == above[floor][spring.end] || direction >= directions) continue;
      const double sign = above[floor][spring.start] ? 1 : -1;  // ux and uy come first
      sum.row(direction) += sign * spring.stiffness * (enforced.row(spring.start * dofs + direction) - enforced.row(spring.end * dofs + direction));
    }
  }
  return shears;
}

// What the reports take from a support itself.
void report_enforced(const FrameModel& model, const AssembledFrame& frame, const MemberReport& members, Support& support) {
  const int dofs = static_cast<int>(dofs_of(frame.dimension).size());
  support.nodes.resize(static_cast<int>(model.reported_nodes.size()) * dofs, 3);
  for (std::size_t i = 0; i < model.reported_nodes.size(); ++i)
    support.nodes.middleRows(static_cast<int>(i) * dofs, dofs) = support.enforced.middleRows(model.reported_nodes[i] * dofs, dofs);
  support.shears = enforced_shears(model, frame, support.enforced);
  const int places = static_cast<int>(members.places.size());
  support.members.resize(static_cast<int>(members.members.size()) * places, 3);
  for (std::size_t m = 0; m < members.members.size(); ++m) {
    const Eigen::Matrix<double, 12, 3> forces = model.frame.enforced_end_forces(members.members[m], support.enforced);
    for (int j = 0; j < places; ++j) support.members.row(static_cast<int>(m) * places + j) = forces.row(members.places[j]);
  }
}

std::vector<Floor> make_floors(const FrameModel& model, const AssembledFrame& frame) {
  const std::vector<std::vector<bool>> above = cuts(model);
  std::vector<Floor> floors;
  for (const FrameFloor& of : model.floors) {
    Floor floor;
    floor.label = of.label;
    floor.mass = mass_along_x(frame, of.nodes);
    floor.elevation = of.elevation;
    floor.motion = floor_motion(model, frame, of);
    floor.storey_shear = shear_through(model, frame, above[floors.size()]);
    floors.push_back(std::move(floor));
  }
  return floors;
}

std::vector<Support> make_supports(const FrameModel& model, const AssembledFrame& frame,
                                   const std::vector<FrameSupport>& given, const MemberReport& members) {
  std::vector<Support> supports;
  for (const FrameSupport& of : given) {
    Support support;
    support.name = of.name;
    for (const int node : of.nodes) support.position += model.frame.position(node) / static_cast<double>(of.nodes.size());
    support.delay = of.delay;
    support.motion = of.motion;
    if (given.size() == 1) {
      support.influence = frame.influence;
      support.load = frame.load;
    } else {
      const Frame::SupportMotion motion = model.frame.support_motion(of.nodes, frame);
      support.influence = motion.influence;
      support.load = motion.load;
      support.enforced = motion.enforced;
      report_enforced(model, frame, members, support);
    }
    supports.push_back(std::move(support));
  }
  return supports;
}

// Those that a wave along this direction reaches at one time stay together.
std::vector<FrameSupport> apart_along(const FrameModel& model, const Vector3d& direction) {
  constexpr double together = 1e-6;  // [m]
  std::vector<FrameSupport> apart;
  for (const FrameSupport& of : model.supports) {
    if (of.motion) {
      apart.push_back(of);
      continue;
    }
    std::vector<std::pair<double, int>> places;
    for (const int node : of.nodes) places.emplace_back(model.frame.position(node).dot(direction), node);
    std::sort(places.begin(), places.end());
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i == 0 || places[i].first - places[i - 1].first > together)
        apart.push_back({model.frame.node_name(places[i].second), {}, of.delay, {}});
      apart.back().nodes.push_back(places[i].second);
    }
  }
  return apart;
}

NodeReport make_node_report(const FrameModel& model, const AssembledFrame& frame) {
  NodeReport report;
  report.directions = frame.dimension == 2 ? std::vector<std::string>{"x", "z", "ry"}
                                           : std::vector<std::string>{"x", "y", "z", "rx", "ry", "rz"};
  for (const int node : model.reported_nodes) {
    report.names.push_back(model.frame.node_name(node));
    std::vector<Row>& rows = report.motion.emplace_back();
    for (const Dof dof : dofs_of(frame.dimension)) rows.push_back(frame.motion(node, dof));
  }
  return report;
}

MemberReport make_member_report(const FrameModel& model, const AssembledFrame& frame) {
  constexpr std::array forces{"N", "Vy", "Vz", "T", "My", "Mz"};
  MemberReport report;
  for (const int end : {0, 6})
    for (const Dof dof : dofs_of(frame.dimension)) {
      report.components.push_back(fmt::format("{} {}", end == 0 ? "start" : "end", forces[static_cast<int>(dof)]));
      report.places.push_back(end + static_cast<int>(dof));
    }
  for (const int member : model.reported_members) {
    report.names.push_back(model.frame.member_name(member));
    report.members.push_back(member);
    const Eigen::SparseMatrix<double, Eigen::RowMajor> all = model.frame.end_force_rows(member, frame);
    std::vector<Row>& rows = report.forces.emplace_back();
    for (const int place : report.places)
      rows.push_back(model.corotational ? Row(frame.size()) : Row(all.row(place).transpose()));
    const Vector12 held = model.loads && !model.corotational ? model.frame.fixed_end_forces(member) : Vector12(Vector12::Zero());
    std::vector<double>& loads = report.held.emplace_back();
    for (const int place : report.places) loads.push_back(held[place]);
  }
  return report;
}

// Reports of members that turn; what they would show wrong is refused.
void let_turn(const std::shared_ptr<const FrameModel>& model, const std::shared_ptr<const CorotationalFrame>& turning, Structure& s) {
  if (model->supports.size() > 1)
    throw std::invalid_argument("with geometry: corotational all supports move alike; leave out their delay and ground_motion, or "
                                "type geometry: p_delta");
  s.storey_shears = [model, turning, above = cuts(*model)](const Eigen::VectorXd& q) {
    const int directions = model->frame.dimension() - 1;
    Eigen::VectorXd shears = Eigen::VectorXd::Zero(static_cast<int>(above.size()) * directions);
    for (int member = 0; member < model->frame.members(); ++member) {
      const auto [start, end] = model->frame.ends(member);
      std::optional<Vector12> forces;
      for (std::size_t floor = 0; floor < above.size(); ++floor) {
        if (above[floor][start] == above[floor][end]) continue;
        if (!forces) forces = turning->nodal_forces(member, q);
        shears.segment(static_cast<int>(floor) * directions, directions) += forces->segment(above[floor][start] ? 0 : 6, directions);
      }
    }
    return shears;
  };
  s.end_forces = [model, turning, members = s.members.members, places = s.members.places](const Eigen::VectorXd& q) {
    Eigen::VectorXd all(static_cast<int>(members.size() * places.size()));
    int at = 0;
    for (const int member : members) {
      Vector12 forces = turning->end_forces(member, q);
      if (model->loads) {  // which keep their directions in space
        const Eigen::Matrix3d turn = turning->axes(member, q) * model->frame.beam(member).axes().transpose();
        const Vector12 held = model->frame.fixed_end_forces(member);
        for (const int i : {0, 3, 6, 9}) forces.segment<3>(i) += turn * held.segment<3>(i);
      }
      for (const int place : places) all[at++] = forces[place];
    }
    return all;
  };
}

Geometry make_geometry(const FrameModel& model) {
  Geometry geometry;
  geometry.floor_of_node.assign(model.given_nodes, -1);
  for (std::size_t f = 0; f < model.floors.size(); ++f)
    for (const int node : model.floors[f].nodes) geometry.floor_of_node[node] = static_cast<int>(f);
  for (int node = 0; node < model.given_nodes; ++node) {
    geometry.node_names.push_back(model.frame.node_name(node));
    geometry.positions.push_back(model.frame.position(node));
  }
  for (int member = 0; member < model.frame.members(); ++member) {
    geometry.member_names.push_back(model.frame.member_name(member));
    geometry.members.push_back(model.frame.ends(member));
  }
  return geometry;
}

}  // namespace

Structure make_structure(FrameModel given) {
  if (given.p_delta) given.frame.add_p_delta(given.gravity);
  const auto model = std::make_shared<const FrameModel>(std::move(given));
  const auto frame = std::make_shared<AssembledFrame>(model->frame.assemble(model->gravity));
  if (frame->size() == 0) throw std::invalid_argument("all its nodes are held; let one move, or type {wall: {}} instead of the frame");
  Structure s;
  s.kind = "frame";
  s.dimension = frame->dimension;
  s.damping = frame->damping;
  for (const auto& [node, dof] : frame->unknowns)
    s.unknowns.push_back(fmt::format("{}{} {}", node < model->given_nodes ? "node " : "", frame->node_names[node], name(dof)));
  // Also says which node gives way when nothing holds the frame.
  Eigen::VectorXd rest = model->frame.rest(*frame);
  std::shared_ptr<const CorotationalFrame> turning;
  if (model->corotational) {
    turning = std::make_shared<const CorotationalFrame>(*frame, corotational_members(model->frame));
    const auto forces = std::make_shared<const CorotationalForces>(turning, frame->load_at_rest);
    rest = forces->at_rest();
    frame->stiffness = forces->stiffness();
    s.elastic = forces;
  }
  s.mass = frame->mass;
  s.stiffness = frame->stiffness;
  if (model->loads) s.at_rest = rest;
  s.initial_displacement = s.initial_velocity = Eigen::VectorXd::Zero(frame->size());
  s.floors = make_floors(*model, *frame);
  s.nodes = make_node_report(*model, *frame);
  s.members = make_member_report(*model, *frame);
  s.supports = make_supports(*model, *frame, model->supports, s.members);
  if (turning) let_turn(model, turning, s);
  s.supports_along = [model, frame, members = s.members](const Vector3d& direction) {
    const std::vector<FrameSupport> apart = apart_along(*model, direction);
    if (model->corotational && apart.size() > 1)
      throw std::invalid_argument("a wave moves the supports of a frame one after the other, and with geometry: corotational all move "
                                  "alike; type geometry: p_delta");
    return make_supports(*model, *frame, apart, members);
  };
  s.geometry = make_geometry(*model);
  s.node_translations = [model, frame](const Eigen::VectorXd& q) {
    Eigen::MatrixX3d moved = Eigen::MatrixX3d::Zero(model->given_nodes, 3);
    const Eigen::VectorXd all = frame->transform * q;
    const auto dofs = dofs_of(frame->dimension);
    for (int node = 0; node < model->given_nodes; ++node)
      for (std::size_t j = 0; j < dofs.size(); ++j)
        if (static_cast<int>(dofs[j]) < 3) moved(node, static_cast<int>(dofs[j])) = all[node * dofs.size() + j];
    return moved;
  };
  s.surface = std::make_shared<FrameSurface>(model, frame);
  return s;
}

Structure read_frame_structure(const Input& body) {
  const FrameModel model = read_frame(body);
  try {
    return make_structure(model);
  } catch (const std::invalid_argument& error) {
    fail_at_part(error.what(), model, body);
  }
}

}  // namespace pounding
