#include <pounding/structures/storey_heights.hpp>

#include <algorithm>

namespace pounding {

bool knows_heights(const Structure& s) {
  return std::ranges::all_of(s.floors, [](const Floor& floor) { return floor.elevation.has_value(); });
}

double base_height(const Structure& s) {
  if (s.geometry.positions.empty()) return 0;
  double lowest = s.geometry.positions.front().z();
  for (const Eigen::Vector3d& position : s.geometry.positions) lowest = std::min(lowest, position.z());
  return lowest;
}

std::vector<double> storey_heights(const Structure& s) {
  std::vector<double> heights;
  if (!s.has_storeys() || !knows_heights(s)) return heights;
  double below = base_height(s);
  for (const Floor& floor : s.floors) {
    heights.push_back(*floor.elevation - below);
    below = *floor.elevation;
  }
  return heights;
}

}  // namespace pounding
