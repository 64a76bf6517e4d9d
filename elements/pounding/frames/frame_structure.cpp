#include <pounding/frames/frame_structure.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/frames/corotational_forces.hpp>
#include <pounding/frames/frame_floors.hpp>
#include <pounding/frames/frame_surface.hpp>

namespace pounding {
namespace {

using Eigen::Vector3d;

// Up to here all nodes are reported when nothing else is asked for.
constexpr int max_reported = 100;

bool turns(const FrameModel& model) { return model.geometry == FrameGeometry::corotational; }

// Fills in what the caller left out: the supports that move together, and the nodes that are reported.
void complete(FrameModel& model) {
  std::vector<bool> in_a_group(model.frame.nodes(), false);
  for (const FrameSupport& support : model.supports)
    for (const int node : support.nodes) in_a_group.at(node) = true;
  std::vector<int> others;
  for (const int node : model.frame.grounded_nodes())
    if (node < model.given_nodes() && !in_a_group[node]) others.push_back(node);
  const auto moves_as_all = [](const FrameSupport& support) { return support.delay == 0 && !support.motion; };
  if (!others.empty()) {
    if (model.supports.empty() || !moves_as_all(model.supports.front())) model.supports.insert(model.supports.begin(), FrameSupport{});
    std::vector<int>& common = model.supports.front().nodes;
    common.insert(common.end(), others.begin(), others.end());
  }
  if (model.supports.empty()) throw std::invalid_argument("nothing holds the frame to the ground; type supports: {a: fixed}");
  for (const FrameSupport& support : model.supports)
    if (model.frame.dimension() == 2 && support.motion && !(*support.motion)[1].is_still())
      throw std::invalid_argument(fmt::format("support {}: the frame is plane; leave the motion along y out", support.name));
  if (!model.reported_nodes) {
    model.reported_nodes.emplace(model.given_nodes() <= max_reported ? model.given_nodes() : 0);
    std::iota(model.reported_nodes->begin(), model.reported_nodes->end(), 0);
  }
}

// The part of the reports that follows from the motion of a support itself.
void report_enforced(const FrameModel& model, const AssembledFrame& frame, const MemberReport& members, Support& support) {
  const int dofs = static_cast<int>(dofs_of(frame.dimension).size());
  support.nodes.resize(static_cast<int>(model.reported_nodes->size()) * dofs, 3);
  for (std::size_t i = 0; i < model.reported_nodes->size(); ++i)
    support.nodes.middleRows(static_cast<int>(i) * dofs, dofs) = support.enforced.middleRows((*model.reported_nodes)[i] * dofs, dofs);
  support.shears = enforced_shears(model, frame, support.enforced);
  const int places = static_cast<int>(members.places.size());
  support.members.resize(static_cast<int>(members.members.size()) * places, 3);
  for (std::size_t m = 0; m < members.members.size(); ++m) {
    const Eigen::Matrix<double, 12, 3> forces = model.frame.enforced_end_forces(members.members[m], support.enforced);
    for (int j = 0; j < places; ++j) support.members.row(static_cast<int>(m) * places + j) = forces.row(members.places[j]);
  }
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

// Supports that a wave along this direction reaches at one time stay together.
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
  for (const int node : *model.reported_nodes) {
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
      rows.push_back(turns(model) ? Row(frame.size()) : Row(all.row(place).transpose()));
    const Vector12 held = model.is_loaded() && !turns(model) ? model.frame.fixed_end_forces(member) : Vector12(Vector12::Zero());
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
  s.storey_shears = [model, turning, above = storey_cuts(*model)](const Eigen::VectorXd& q) {
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
      if (model->is_loaded()) {  // which keep their directions in space
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
  geometry.floor_of_node.assign(model.given_nodes(), -1);
  for (std::size_t f = 0; f < model.floors.size(); ++f)
    for (const int node : model.floors[f].nodes) geometry.floor_of_node[node] = static_cast<int>(f);
  for (int node = 0; node < model.given_nodes(); ++node) {
    geometry.node_names.push_back(model.frame.node_name(node));
    geometry.positions.push_back(model.frame.position(node));
  }
  for (int member = 0; member < model.frame.members(); ++member) {
    geometry.member_names.push_back(model.frame.member_name(member));
    geometry.members.push_back(model.frame.ends(member));
    const Section& section = model.frame.beam(member).section();
    const double inertia = model.frame.dimension() == 3 ? std::max(section.inertia_y, section.inertia_z) : section.inertia_y;
    geometry.depths.push_back(std::max(std::sqrt(section.area), std::sqrt(12 * inertia / section.area)));
    geometry.moduli.push_back(model.frame.beam(member).material().young);
  }
  return geometry;
}

}  // namespace

Structure make_structure(FrameModel given) {
  complete(given);
  given.check_geometry();
  if (given.geometry == FrameGeometry::p_delta) given.frame.add_p_delta(given.has_gravity());
  const auto model = std::make_shared<const FrameModel>(std::move(given));
  const auto frame = std::make_shared<AssembledFrame>(model->frame.assemble(model->has_gravity()));
  if (frame->size() == 0) throw std::invalid_argument("all its nodes are held; let one move, or type {wall: {}} instead of the frame");
  Structure s;
  s.kind = "frame";
  s.dimension = frame->dimension;
  s.damping = frame->damping;
  for (const auto& [node, dof] : frame->unknowns)
    s.unknowns.push_back(fmt::format("{}{} {}", node < model->given_nodes() ? "node " : "", frame->node_names[node], name(dof)));
  // Also says which node gives way when nothing holds the frame.
  Eigen::VectorXd rest = model->frame.rest(*frame);
  std::shared_ptr<const CorotationalFrame> turning;
  if (turns(*model)) {
    turning = std::make_shared<const CorotationalFrame>(*frame, corotational_members(model->frame));
    const auto forces = std::make_shared<const CorotationalForces>(turning, frame->load_at_rest);
    rest = forces->at_rest();
    frame->stiffness = forces->stiffness();
    s.elastic = forces;
  }
  s.mass = frame->mass;
  s.stiffness = frame->stiffness;
  if (model->is_loaded()) s.at_rest = rest;
  s.initial_displacement = s.initial_velocity = Eigen::VectorXd::Zero(frame->size());
  s.floors = make_floors(*model, *frame);
  s.nodes = make_node_report(*model, *frame);
  s.members = make_member_report(*model, *frame);
  s.supports = make_supports(*model, *frame, model->supports, s.members);
  if (turning) let_turn(model, turning, s);
  s.supports_along = [model, frame, members = s.members](const Vector3d& direction) {
    const std::vector<FrameSupport> apart = apart_along(*model, direction);
    if (turns(*model) && apart.size() > 1)
      throw std::invalid_argument("a wave moves the supports of a frame one after the other, and with geometry: corotational all move "
                                  "alike; type geometry: p_delta");
    return make_supports(*model, *frame, apart, members);
  };
  s.geometry = make_geometry(*model);
  s.node_translations = [model, frame](const Eigen::VectorXd& q) {
    Eigen::MatrixX3d moved = Eigen::MatrixX3d::Zero(model->given_nodes(), 3);
    const Eigen::VectorXd all = frame->transform * q;
    const auto dofs = dofs_of(frame->dimension);
    for (int node = 0; node < model->given_nodes(); ++node)
      for (std::size_t j = 0; j < dofs.size(); ++j)
        if (static_cast<int>(dofs[j]) < 3) moved(node, static_cast<int>(dofs[j])) = all[node * dofs.size() + j];
    return moved;
  };
  s.surface = std::make_shared<FrameSurface>(model, frame);
  return s;
}

Structure make_structure(const GridFrame& grid) { return make_structure(make_frame_model(grid)); }

}  // namespace pounding
