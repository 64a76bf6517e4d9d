#include <pounding/model/arrivals.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

// Positions with arrivals within this distance have the same motion [m].
constexpr double one_arrival = 1e-6;

// Two ends of a link, the left one first.
struct Meeting {
  LinkEnd *left, *right;
  Eigen::Vector3d direction;
};

std::vector<Meeting> meetings(std::vector<Link>& links, std::vector<Device>& devices) {
  std::vector<Meeting> all;
  for (Link& link : links) all.push_back({&link.left, &link.right, link.direction});
  for (Device& device : devices) all.push_back({&device.left, &device.right, device.direction});
  return all;
}

class Arrivals {
 public:
  Arrivals(std::vector<Structure>& structures, const std::vector<bool>& on_wave, const Eigen::Vector3d& direction)
      : structures_(structures), on_wave_(on_wave), direction_(direction), places_(structures.size()) {}

  void place(const std::vector<Meeting>& all) {
    // Drawn faces first, then through other structures, so that the result does not depend on the order of the links.
    take_all(all, true);
    while (take_all(all, false)) {
    }
    for (std::size_t i = 0; i < structures_.size(); ++i)
      if (places_[i]) structures_[i].supports.front().position = *places_[i];
    for (std::size_t i = 0; i < structures_.size(); ++i)
      if (structures_[i].is_rigid() && on_wave_[i]) place_wall(static_cast<int>(i), all);
  }

 private:
  bool is_drawn(int structure) const { return structures_[structure].surface->plan().has_value(); }

  // Position of the face of an end; nullopt if its structure has no position.
  std::optional<Eigen::Vector3d> face(const LinkEnd& end, const Meeting& meeting) const {
    if (!is_drawn(end.structure)) return places_[end.structure];
    return end.point.position + (&end == meeting.left ? 1 : -1) * end.face.value_or(0) * meeting.direction;
  }

  double along(const Eigen::Vector3d& position) const { return position.dot(direction_); }

  // True if a structure got a position.
  bool take_all(const std::vector<Meeting>& all, bool by_drawn) {
    bool found = false;
    for (const Meeting& meeting : all)
      for (const auto& [end, other] : {std::pair(meeting.left, meeting.right), std::pair(meeting.right, meeting.left)})
        if (is_drawn(other->structure) == by_drawn && take(*end, *other, meeting)) found = true;
    return found;
  }

  // Derives the position of a structure from the other end; true if it had none before.
  bool take(const LinkEnd& end, const LinkEnd& other, const Meeting& meeting) {
    const Structure& s = structures_[end.structure];
    if (s.is_rigid() || is_drawn(end.structure) || !on_wave_[end.structure]) return false;
    const std::optional<Eigen::Vector3d> position = face(other, meeting);
    if (!position) return false;
    std::optional<Eigen::Vector3d>& place = places_[end.structure];
    if (place) {
      // The ground does not move a free body.
      if (!s.is_free && is_drawn(other.structure) && std::abs(along(*position) - along(*place)) > one_arrival)
        throw ModelError(
            ModelOption::wave, end.structure,
            fmt::format(
                "{} has no position in plan, and the wave reaches the faces linked to it at different positions, {} "
                "and {} along its direction; draw it as a frame, or give it its own ground_motion",
                s.name, format_quantity(along(*place), dimension::length, 6),
                format_quantity(along(*position), dimension::length, 6)));
      return false;
    }
    place = position;
    return true;
  }

  void place_wall(int wall, const std::vector<Meeting>& all) {
    std::vector<std::pair<LinkEnd*, std::size_t>> ends;
    std::vector<Eigen::Vector3d> positions;
    for (const Meeting& meeting : all)
      for (LinkEnd* end : {meeting.left, meeting.right}) {
        const LinkEnd& other = end == meeting.left ? *meeting.right : *meeting.left;
        const std::optional<Eigen::Vector3d> position = end->structure == wall ? face(other, meeting) : std::nullopt;
        if (!position) continue;
        const auto same = std::ranges::find_if(positions, [&](const Eigen::Vector3d& each) {
          return std::abs(along(each) - along(*position)) <= one_arrival;
        });
        ends.emplace_back(end, static_cast<std::size_t>(same - positions.begin()));
        if (same == positions.end()) positions.push_back(*position);
      }
    if (positions.empty()) {
      if (std::ranges::any_of(
              all, [&](const Meeting& one) { return one.left->structure == wall || one.right->structure == wall; }))
        throw ModelError(ModelOption::wave, wall,
                         fmt::format("{} is a wall that is connected only to walls, so the wave has no position at "
                                     "which it arrives there; give it its own ground_motion",
                                     structures_[wall].name));
      return;
    }
    std::vector<Support>& supports = structures_[wall].supports;
    supports.assign(positions.size(), supports.front());
    const int rows = 3 * static_cast<int>(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      supports[i].position = positions[i];
      supports[i].enforced = Eigen::MatrixX3d::Zero(rows, 3);
      supports[i].enforced.middleRows<3>(3 * static_cast<int>(i)).setIdentity();
    }
    // Relative to the first support, whose motion is that of the whole structure.
    for (const auto& [end, support] : ends)
      for (int axis = 0; axis < 3; ++axis) {
        end->point.supported[axis] = Row(rows);
        if (support > 0) end->point.supported[axis].insert(3 * static_cast<int>(support) + axis) = 1;
      }
  }

  std::vector<Structure>& structures_;
  const std::vector<bool>& on_wave_;
  Eigen::Vector3d direction_;
  std::vector<std::optional<Eigen::Vector3d>> places_;
};

}  // namespace

void place_by_links(std::vector<Structure>& structures, std::vector<Link>& links, std::vector<Device>& devices,
                    const std::vector<bool>& on_wave, const Eigen::Vector3d& direction) {
  Arrivals(structures, on_wave, direction).place(meetings(links, devices));
}

}  // namespace pounding
