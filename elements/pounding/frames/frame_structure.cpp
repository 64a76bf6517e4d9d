#include <pounding/frames/frame_structure.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <pounding/frames/corotational_forces.hpp>
#include <pounding/frames/fibre_frame.hpp>
#include <pounding/frames/frame_parts.hpp>
#include <pounding/frames/frame_surface.hpp>

namespace pounding {
namespace {

using Eigen::Vector3d;

std::vector<std::string> directions(int dimension) {
  return dimension == 2 ? std::vector<std::string>{"x", "z", "ry"}
                        : std::vector<std::string>{"x", "y", "z", "rx", "ry", "rz"};
}

bool turns(const FrameModel& model) { return model.geometry == FrameGeometry::corotational; }

// Part of the reports that follows directly from the motion of a support.
void report_enforced(const FrameModel& model, const AssembledFrame& frame, const InternalForces& report,
                     const Frame::Reactions& reactions, const std::vector<int>& nodes, Support& support) {
  const int dofs = static_cast<int>(dofs_of(frame.dimension).size());
  support.nodes.resize(static_cast<int>(model.reported_nodes->size()) * dofs, 3);
  for (std::size_t i = 0; i < model.reported_nodes->size(); ++i)
    support.nodes.middleRows(static_cast<int>(i) * dofs, dofs) =
        support.enforced.middleRows((*model.reported_nodes)[i] * dofs, dofs);
  support.shears = enforced_shears(model, support.enforced);
  const int places = static_cast<int>(report.places.size());
  support.forces.resize(report.rows.rows(), 3);
  for (int m = 0; m < model.frame.members(); ++m) {
    const Eigen::Matrix<double, 12, 3> forces = model.frame.enforced_end_forces(m, support.enforced);
    for (int j = 0; j < places; ++j) support.forces.row(m * places + j) = forces.row(report.places[j]);
  }
  support.forces.bottomRows(reactions.at_rest.size()) =
      model.frame.enforced_reactions(reactions, nodes, support.enforced);
}

std::vector<Support> make_supports(const FrameModel& model, const AssembledFrame& frame,
                                   const std::vector<FrameSupport>& given, const InternalForces& report,
                                   const Frame::Reactions& reactions) {
  std::vector<Support> supports;
  for (const FrameSupport& of : given) {
    Support support;
    support.name = of.name;
    if (model.is_free) support.position = model.frame.position(0);
    for (const int node : of.nodes)
      support.position += model.frame.position(node) / static_cast<double>(of.nodes.size());
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
      report_enforced(model, frame, report, reactions, of.nodes, support);
    }
    supports.push_back(std::move(support));
  }
  return supports;
}

// Groups supports that a wave in this direction reaches at the same time.
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
  report.directions = directions(frame.dimension);
  for (const int node : *model.reported_nodes) {
    report.names.push_back(model.frame.node_name(node));
    std::vector<Row>& rows = report.motion.emplace_back();
    for (const Dof dof : dofs_of(frame.dimension)) rows.push_back(frame.motion(node, dof));
  }
  return report;
}

Frame::Reactions make_reactions(const FrameModel& model, const AssembledFrame& frame) {
  return model.frame.reactions(model.held_nodes(), frame, model.has_gravity(), model.is_linear());
}

// Loads and geometric effects included in the forces, such as the weight on a column.
std::string included_in_forces(const FrameModel& model) {
  std::vector<std::string> parts;
  if (model.has_gravity()) parts.emplace_back("gravity");
  if (model.frame.is_loaded()) parts.emplace_back("loads at rest");
  if (model.geometry == FrameGeometry::p_delta) parts.emplace_back("P-Delta");
  if (turns(model)) parts.emplace_back("large rotations");
  return fmt::format("{}", fmt::join(parts, ", "));
}

InternalForces make_internal_forces(const FrameModel& model, const AssembledFrame& frame,
                                    const Frame::Reactions& reactions) {
  constexpr std::array forces{"N", "Vy", "Vz", "T", "My", "Mz"};
  InternalForces report;
  for (const int end : {0, 6})
    for (const Dof dof : dofs_of(frame.dimension)) {
      report.components.push_back(fmt::format("{} {}", end == 0 ? "start" : "end", forces[static_cast<int>(dof)]));
      report.places.push_back(end + static_cast<int>(dof));
    }
  report.with_gravity = model.has_gravity();
  report.included = included_in_forces(model);
  report.directions = directions(frame.dimension);
  for (const int node : reactions.nodes) report.supports.push_back(model.frame.node_name(node));
  const int places = static_cast<int>(report.places.size()), first_reaction = model.frame.members() * places;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](int row, const auto& matrix, int from) {
    for (typename std::decay_t<decltype(matrix)>::InnerIterator it(matrix, from); it; ++it)
      entries.emplace_back(row, static_cast<int>(it.col()), it.value());
  };
  report.at_rest = Eigen::VectorXd::Zero(first_reaction + reactions.at_rest.size());
  for (int member = 0; member < model.frame.members(); ++member) {
    report.members.push_back(model.frame.member_name(member));
    if (!model.is_linear()) continue;
    const Eigen::SparseMatrix<double, Eigen::RowMajor> all = model.frame.end_force_rows(member, frame);
    for (int j = 0; j < places; ++j) add(member * places + j, all, report.places[j]);
    if (!model.is_loaded()) continue;
    const Vector12 held = model.frame.fixed_end_forces(member, model.has_gravity());
    for (int j = 0; j < places; ++j) report.at_rest[member * places + j] = held[report.places[j]];
  }
  const Eigen::SparseMatrix<double, Eigen::RowMajor> on_ground = reactions.by_displacements * frame.transform;
  for (int row = 0; row < on_ground.rows(); ++row) add(first_reaction + row, on_ground, row);
  if (model.is_loaded()) report.at_rest.tail(reactions.at_rest.size()) = reactions.at_rest;
  report.rows.resize(report.at_rest.size(), frame.size());
  report.rows.setFromTriplets(entries.begin(), entries.end());
  return report;
}

// Forces of one member whose forces are nonlinear, from the displacements q of the frame and the forces in members with
// a memory (TangentForces::member_forces).
struct MemberResponse {
  using Force = std::function<Vector12(int member, const Eigen::VectorXd& q, const Eigen::VectorXd& in_members)>;
  Force on_ends;   // local axes
  Force on_nodes;  // global axes
  std::function<Eigen::Matrix3d(int member, const Eigen::VectorXd& q)> axes;
};

MemberResponse response_of(const std::shared_ptr<const CorotationalFrame>& frame) {
  return {
      [frame](int member, const Eigen::VectorXd& q, const Eigen::VectorXd&) { return frame->end_forces(member, q); },
      [frame](int member, const Eigen::VectorXd& q, const Eigen::VectorXd&) { return frame->nodal_forces(member, q); },
      [frame](int member, const Eigen::VectorXd& q) { return frame->axes(member, q); }};
}

MemberResponse response_of(const std::shared_ptr<const FibreFrame>& frame) {
  return {[frame](int member, const Eigen::VectorXd& q, const Eigen::VectorXd& in_members) {
            return frame->end_forces(member, q, in_members);
          },
          [frame](int member, const Eigen::VectorXd& q, const Eigen::VectorXd& in_members) {
            return frame->nodal_forces(member, q, in_members);
          },
          [frame](int member, const Eigen::VectorXd& q) { return frame->axes(member, q); }};
}

// Reports of members whose forces are nonlinear; throws for properties that are not supported with them.
void report_nonlinear(const std::shared_ptr<const FrameModel>& model, const MemberResponse& response,
                      const Frame::Reactions& reactions, Structure& s) {
  if (model->supports.size() > 1)
    throw std::invalid_argument(
        fmt::format("{} needs the same motion at all supports; remove their delay and ground_motion{}",
                    model->nonlinear_key(), model->fibres.empty() ? ", or type geometry: p_delta" : ", or fibres"));
  s.storey_shears = [model, response, above = storey_cuts(*model)](const Eigen::VectorXd& q,
                                                                   const Eigen::VectorXd& in_members) {
    const int directions = model->frame.dimension() - 1;
    Eigen::VectorXd shears = Eigen::VectorXd::Zero(static_cast<int>(above.size()) * directions);
    for (int member = 0; member < model->frame.members(); ++member) {
      const auto [start, end] = model->frame.ends(member);
      std::optional<Vector12> forces;
      for (std::size_t floor = 0; floor < above.size(); ++floor) {
        if (above[floor][start] == above[floor][end]) continue;
        if (!forces) forces = response.on_nodes(member, q, in_members);
        shears.segment(static_cast<int>(floor) * directions, directions) +=
            forces->segment(above[floor][start] ? 0 : 6, directions);
      }
    }
    return shears;
  };
  s.forces.nonlinear = [model, response, places = s.forces.places, to_ground = reactions.by_forces](
                           const Eigen::VectorXd& q, const Eigen::VectorXd& in_members) {
    const auto dofs = dofs_of(model->frame.dimension());
    const int count = static_cast<int>(dofs.size());
    Eigen::VectorXd ends(model->frame.members() * static_cast<int>(places.size()));
    Eigen::VectorXd on_nodes = Eigen::VectorXd::Zero(model->frame.nodes() * count);
    int at = 0;
    for (int member = 0; member < model->frame.members(); ++member) {
      Vector12 forces = response.on_ends(member, q, in_members);
      const Vector12 held = model->frame.fixed_end_forces(member, model->has_gravity());
      if (model->is_loaded() && held.any()) {  // member loads keep their directions in space
        const Eigen::Matrix3d turn = response.axes(member, q) * model->frame.beam(member).axes().transpose();
        for (const int i : {0, 3, 6, 9}) forces.segment<3>(i) += turn * held.segment<3>(i);
      }
      for (const int place : places) ends[at++] = forces[place];
      const Vector12 nodal = response.on_nodes(member, q, in_members);
      const auto [start, end] = model->frame.ends(member);
      for (int j = 0; j < count; ++j) {
        on_nodes[start * count + j] += nodal[static_cast<int>(dofs[j])];
        on_nodes[end * count + j] += nodal[6 + static_cast<int>(dofs[j])];
      }
    }
    Eigen::VectorXd all(ends.size() + to_ground.rows());
    all << ends, to_ground * on_nodes;
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
    const double inertia =
        model.frame.dimension() == 3 ? std::max(section.inertia_y, section.inertia_z) : section.inertia_y;
    geometry.depths.push_back(std::max(std::sqrt(section.area), std::sqrt(12 * inertia / section.area)));
    geometry.moduli.push_back(model.frame.beam(member).material().young);
  }
  return geometry;
}

}  // namespace

Structure make_structure(FrameModel given) {
  place_uplifts(given);
  complete(given);
  given.check_geometry();
  place_isolators(given);
  if (given.geometry == FrameGeometry::p_delta) given.frame.add_p_delta(given.has_gravity());
  const auto model = std::make_shared<const FrameModel>(std::move(given));
  const auto frame = std::make_shared<AssembledFrame>(model->frame.assemble(model->has_gravity()));
  if (frame->size() == 0)
    throw std::invalid_argument(
        "all nodes of the frame are fixed; release one, or type {wall: {}} instead of the frame");
  Structure s;
  s.kind = "frame";
  s.dimension = frame->dimension;
  s.damping = frame->damping;
  for (const auto& [node, dof] : frame->unknowns)
    s.unknowns.push_back(
        fmt::format("{}{} {}", node < model->given_nodes() ? "node " : "", frame->node_names[node], name(dof)));
  if (model->is_free) {
    s.rigid_motions = frame->dimension == 2 ? 3 : 6;
    model->frame.require_motion(*frame);
  }
  // Also reports the unsupported node if there is one.
  Eigen::VectorXd rest = model->is_free ? Eigen::VectorXd::Zero(frame->size()) : model->frame.rest(*frame);
  std::optional<MemberResponse> response;
  if (!model->fibres.empty()) {
    const auto forces = std::make_shared<const FibreFrame>(*model, *frame);
    rest = forces->at_rest();
    response = response_of(forces);
    s.tangent = forces;
  } else if (turns(*model)) {
    const auto turning = std::make_shared<const CorotationalFrame>(*frame, corotational_members(model->frame));
    const auto forces = std::make_shared<const CorotationalForces>(turning, frame->load_at_rest);
    rest = forces->at_rest();
    frame->stiffness = forces->stiffness();
    response = response_of(turning);
    s.elastic = forces;
  }
  s.mass = frame->mass;
  s.stiffness = frame->stiffness;
  if (model->is_loaded()) s.at_rest = rest;
  s.initial_displacement = s.initial_velocity = Eigen::VectorXd::Zero(frame->size());
  s.floors = make_floors(*model, *frame);
  s.nodes = make_node_report(*model, *frame);
  const Frame::Reactions reactions = make_reactions(*model, *frame);
  s.forces = make_internal_forces(*model, *frame, reactions);
  s.reported_members = model->reported_members;
  s.supports = make_supports(*model, *frame, model->supports, s.forces, reactions);
  if (response) report_nonlinear(model, *response, reactions, s);
  let_hinges_yield(*model, *frame, reactions, model->is_free ? std::vector<std::vector<bool>>() : storey_cuts(*model),
                   s);
  let_isolators_yield(*model, *frame, reactions, s);
  let_supports_uplift(*model, *frame, reactions, s);
  if (!model->is_free)
    s.supports_along = [model, frame, forces = s.forces, reactions](const Vector3d& direction) {
      const std::vector<FrameSupport> apart = apart_along(*model, direction);
      if (!model->is_linear() && apart.size() > 1)
        throw std::invalid_argument(fmt::format(
            "a wave moves the supports of a frame at different times, but {} needs the same motion at all supports; {}",
            model->nonlinear_key(), instead_of_nonlinear(*model, "the wave")));
      if (!(model->frame.hinges().empty() && model->isolators.empty() && model->uplifts.empty()) && apart.size() > 1)
        throw std::invalid_argument(
            "a wave moves the supports of a frame at different times, but a frame with hinges, isolators or springs "
            "that lift off needs the same motion at all supports; remove the wave, or these parts");
      return make_supports(*model, *frame, apart, forces, reactions);
    };
  s.geometry = make_geometry(*model);
  s.fibre_sections = report_fibre_sections(*model);
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
