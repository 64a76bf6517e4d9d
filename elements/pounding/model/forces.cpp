#include <pounding/model/forces.hpp>

#include <algorithm>
#include <iterator>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/core/names.hpp>
#include <pounding/core/refuse.hpp>

namespace pounding {
namespace {

const Row& motion_of_floor(const Structure& s, const ForceOptions& options) {
  const int count = static_cast<int>(s.floors.size());
  if (count == 0) refuse("the frame has no floors; type the node on which the force acts, as in node: b");
  if (!options.floor && count > 1)
    refuse(fmt::format("its location is missing; type floor: {}, or the node of a frame", count));
  const int floor = options.floor.value_or(1);
  if (floor < 1 || floor > count) refuse(fmt::format("floor {} is not one of the {} floors", floor, count));
  const std::vector<Row>& motion = s.floors[floor - 1].motion;
  std::vector<std::string> names{"ux", "uy", "rz"};
  names.resize(motion.size());
  const auto found = std::find(names.begin(), names.end(), options.dof);
  if (found == names.end())
    refuse(fmt::format("a force on a floor acts along {}; \"{}\" was given{}", fmt::join(names, ", "), options.dof,
                       s.dimension > 1 ? ", which is possible for a node" : ""));
  return motion[static_cast<std::size_t>(std::distance(names.begin(), found))];
}

}  // namespace

AppliedForce applied_force(const Structure& s, const ForceOptions& options) {
  if (s.is_rigid()) refuse("a wall moves with the ground, so forces have no effect; remove the force");
  if (!options.node.empty() && options.floor) refuse("a force acts on a floor or on a node; keep one of the two");
  AppliedForce force;
  force.history = options.history;
  if (options.node.empty()) {
    force.direction = motion_of_floor(s, options);
    force.place = s.is_free ? options.dof : fmt::format("floor {} {}", options.floor.value_or(1), options.dof);
  } else {
    force.direction = s.surface->displacement(options.node, options.dof);
    force.place = fmt::format("node {} {}", options.node, options.dof);
  }
  force.direction.prune(0.0);
  if (force.direction.nonZeros() == 0)
    refuse(fmt::format("{} is fixed, so a force there has no effect; remove it", force.place));
  for (Row::InnerIterator it(force.direction); it; ++it)
    if (!has_mass(s.mass, static_cast<int>(it.index()))) {
      const bool turns = s.unknowns[it.index()].find(" r") != std::string::npos;
      refuse(fmt::format(
          "the force acts on {0}, which has no mass; give it one under masses, such as {1}, or type mass: consistent "
          "with a density",
          s.unknowns[it.index()], turns ? "100 kg m^2" : "1 t"));
    }
  return force;
}

}  // namespace pounding
