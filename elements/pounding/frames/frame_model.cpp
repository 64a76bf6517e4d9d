#include <pounding/frames/frame_model.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

std::string height(double z) { return format_quantity(z, dimension::length); }

}  // namespace

void FrameModel::move_by(const Eigen::Vector3d& shift) {
  frame.move_by(shift);
  for (FrameFloor& floor : floors) floor.elevation += shift.z();
}

std::vector<int> FrameModel::held_nodes() const {
  std::vector<int> held = frame.grounded_nodes();
  std::erase_if(held, [&](int node) { return node >= given_nodes(); });
  std::sort(held.begin(), held.end());
  return held;
}

bool FrameModel::has_gravity() const {
  return gravity.value_or(frame.is_loaded() || geometry == FrameGeometry::p_delta);
}

bool FrameModel::is_loaded() const { return frame.is_loaded() || has_gravity(); }

void FrameModel::check_geometry() const {
  if (geometry == FrameGeometry::p_delta && !is_loaded())
    throw std::invalid_argument("p_delta needs loads at rest, but there are none; type gravity: true, or add loads");
}

void make_floor_rigid(FrameModel& model, int number, const std::vector<double>& weights) {
  Frame& frame = model.frame;
  FrameFloor& floor = model.floors.at(number);
  if (floor.nodes.empty()) throw std::invalid_argument(fmt::format("floor {} has no nodes", floor.label));
  const std::vector<double> of_nodes = frame.masses_along_x();
  double lowest = frame.position(floor.nodes.front()).z(), highest = lowest;
  double mass = 0;
  for (const int node : floor.nodes) {
    lowest = std::min(lowest, frame.position(node).z());
    highest = std::max(highest, frame.position(node).z());
    mass += of_nodes[node];
  }
  // The constraint requires horizontal arms.
  if (highest - lowest > 1e-9 * (1 + std::abs(highest)))
    throw std::invalid_argument(
        fmt::format("a rigid floor must be level, but its nodes are between {} and {}; type rigid: false",
                    height(lowest), height(highest)));
  std::vector<int> followers = floor.nodes;
  if (frame.dimension() == 2) {
    floor.master = followers.front();
    followers.erase(followers.begin());
  } else {
    Eigen::Vector3d centre(0, 0, 0);
    double whole = 0;
    for (std::size_t i = 0; i < floor.nodes.size(); ++i) {
      const double weight = mass > 0 ? of_nodes[floor.nodes[i]] : weights.empty() ? 1.0 : weights.at(i);
      centre += weight * frame.position(floor.nodes[i]);
      whole += weight;
    }
    centre /= whole;
    centre.z() = lowest;
    if (model.first_master < 0) model.first_master = frame.nodes();
    floor.master = frame.add_node(centre, "floor " + floor.label);
    frame.fix(floor.master, {Dof::uz, Dof::rx, Dof::ry});
  }
  frame.tie_floor(floor.master, followers);
}

}  // namespace pounding
