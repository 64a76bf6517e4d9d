#include <pounding/ground/support_motion.hpp>

#include <utility>

namespace pounding {

SupportMotion::SupportMotion(std::span<const GroundMotion> grounds, std::vector<std::array<int, 3>> indices)
    : indices_(std::move(indices)) {
  for (std::size_t q = 1; q < indices_.size(); ++q)
    for (int axis = 0; axis < 3; ++axis)
      for (const auto& [ground, sign] : {std::pair(at(q, axis), 1.0), std::pair(at_first(axis), -1.0)})
        if (ground >= 0) terms_.push_back({q, axis, ground, sign, grounds[static_cast<std::size_t>(ground)]});
}

void SupportMotion::project(const Influence& influence, Row row) const {
  for (std::size_t q = 1; q < indices_.size(); ++q)
    for (int axis = 0; axis < 3; ++axis) {
      const double part = influence(q, axis);
      if (part == 0) continue;
      if (at(q, axis) >= 0) row[at(q, axis)] += part;
      if (at_first(axis) >= 0) row[at_first(axis)] -= part;
    }
}

}  // namespace pounding
