#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <pounding/frames/frame_dofs.hpp>
#include <pounding/frames/frame_surface.hpp>
#include <pounding/frames/sections.hpp>

namespace pounding {
namespace {

using Eigen::Vector3d;

// Best-fit rotation about z of the nodes: sum m r x u / sum m r^2 about their centre. Nodes at one point rotate with
// the first.
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

// nullopt for a floor that is not rigid, and in the plane.
std::optional<std::array<double, 4>> plan_of(const FrameModel& model, const AssembledFrame& frame,
                                             const FrameFloor& floor) {
  if (frame.dimension == 2 || floor.master < 0) return {};
  const Vector3d centre = model.frame.position(floor.master);
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const int node : floor.nodes) {
    const Eigen::Array2d arm = (model.frame.position(node) - centre).head<2>().array();
    low = low.min(arm);
    high = high.max(arm);
  }
  return std::array{low.x(), high.x(), low.y(), high.y()};
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

// Forces along x, and y in space, on the upper ends of the members and springs that cross the cut, as factors of the
// displacements of all nodes; without members whose forces are nonlinear.
Eigen::SparseMatrix<double, Eigen::RowMajor> shear_through(const FrameModel& model, const std::vector<bool>& above) {
  const Frame& frame = model.frame;
  const int directions = frame.dimension() - 1, dofs = static_cast<int>(dofs_of(frame.dimension()).size());
  const auto index = [&](int node, Dof dof) { return node * dofs + frame_dofs::place(frame.dimension(), dof); };
  std::vector<Eigen::Triplet<double>> entries;
  for (int member = 0; model.is_linear() && member < frame.members(); ++member) {
    const auto [start, end] = frame.ends(member);
    if (above[start] == above[end]) continue;
    const Beam& beam = frame.beam(member);
    const Matrix12 forces = beam.end_force_matrix();
    const int upper = above[start] ? 0 : 6;
    for (const auto& [node, first] : {std::pair(start, 0), {end, 6}})
      for (const Dof dof : dofs_of(frame.dimension())) {
        const Vector3d by_motion = beam.axes().transpose() * forces.block<3, 1>(upper, first + static_cast<int>(dof));
        for (int d = 0; d < directions; ++d) entries.emplace_back(d, index(node, dof), by_motion[d]);
      }
  }
  for (const FrameSpring& spring : frame.springs()) {
    const int direction = static_cast<int>(spring.dof);  // ux and uy come first
    if (above[spring.start] == above[spring.end] || direction >= directions) continue;
    const double stiffness = above[spring.start] ? spring.stiffness : -spring.stiffness;
    entries.emplace_back(direction, index(spring.start, spring.dof), stiffness);
    entries.emplace_back(direction, index(spring.end, spring.dof), -stiffness);
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> factors(directions, frame.nodes() * dofs);
  factors.setFromTriplets(entries.begin(), entries.end());
  return factors;
}

// A storey of zero height, as with bearings, has its floor above the cut and all other nodes at this height below.
std::vector<bool> nodes_above(const Frame& frame, const FrameFloor& floor, double cut) {
  constexpr double level = 1e-6;  // [m]
  std::vector<bool> above;
  for (int node = 0; node < frame.nodes(); ++node) {
    const double height = frame.position(node).z() - cut;
    const bool of_floor =
        node == floor.master || std::find(floor.nodes.begin(), floor.nodes.end(), node) != floor.nodes.end();
    above.push_back(std::abs(height) < level ? of_floor : height > 0);
  }
  return above;
}

// Deeper beams idealise rigid floors: their depth is not that of a contact surface [m].
constexpr double deepest_beam = 1.2;

// Maximum depth of the beams connected to each floor [m]; 0 without beams.
std::vector<double> beam_depths(const FrameModel& model) {
  std::vector<int> floor_of_node(model.frame.nodes(), -1);
  for (std::size_t f = 0; f < model.floors.size(); ++f)
    for (const int node : model.floors[f].nodes) floor_of_node[node] = static_cast<int>(f);
  std::vector<double> depths(model.floors.size(), 0.0);
  for (int member = 0; member < model.frame.members(); ++member) {
    const Beam& beam = model.frame.beam(member);
    if (beam.is_truss() || is_upright(beam)) continue;
    const double depth = extent(beam.section(), beam.axes(), Vector3d::UnitZ());
    if (depth > deepest_beam) continue;
    for (const int node : model.frame.ends(member))
      if (const int floor = floor_of_node[node]; floor >= 0) depths[floor] = std::max(depths[floor], depth);
  }
  return depths;
}

}  // namespace

std::vector<std::vector<bool>> storey_cuts(const FrameModel& model) {
  std::vector<std::vector<bool>> above;
  double below = lowest_support(model);
  for (const FrameFloor& of : model.floors) {
    const double height = mean_height(model.frame, of.nodes);
    above.push_back(nodes_above(model.frame, of, (below + height) / 2));
    below = height;
  }
  return above;
}

Eigen::MatrixX3d enforced_shears(const FrameModel& model, const Eigen::MatrixX3d& enforced) {
  const int directions = model.frame.dimension() - 1;
  Eigen::MatrixX3d shears(static_cast<int>(model.floors.size()) * directions, 3);
  int row = 0;
  for (const std::vector<bool>& above : storey_cuts(model)) {
    shears.middleRows(row, directions) = shear_through(model, above) * enforced;
    row += directions;
  }
  return shears;
}

std::vector<Floor> make_floors(const FrameModel& model, const AssembledFrame& frame) {
  // A frame without supports has no storey above the ground.
  const std::vector<std::vector<bool>> above = model.is_free ? std::vector<std::vector<bool>>() : storey_cuts(model);
  const std::vector<double> depths = beam_depths(model);
  std::vector<Floor> floors;
  for (const FrameFloor& of : model.floors) {
    Floor floor;
    floor.label = of.label;
    floor.mass = mass_along_x(frame, of.nodes);
    floor.elevation = of.elevation;
    floor.beam_depth = depths[floors.size()];
    floor.motion = floor_motion(model, frame, of);
    floor.plan = plan_of(model, frame, of);
    if (!model.is_free) {
      const Eigen::SparseMatrix<double, Eigen::RowMajor> shear =
          shear_through(model, above[floors.size()]) * frame.transform;
      for (int row = 0; row < shear.rows(); ++row)
        floor.storey_shear.push_back(Row(shear.row(row).transpose()).pruned());
    }
    floors.push_back(std::move(floor));
  }
  return floors;
}

}  // namespace pounding
