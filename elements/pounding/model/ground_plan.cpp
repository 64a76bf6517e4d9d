#include <pounding/model/ground_plan.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <pounding/model/model.hpp>

namespace pounding {
namespace {

// Errors are relative to at least this fraction of the static response to the maximum acceleration.
constexpr double min_part = 1e-2;

// Delay of a travelling wave at a position, relative to its arrival at the first support [s].
double delay_by_wave(const Model& model, const Eigen::Vector3d& position) {
  if (!model.ground.wave) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Structure& s : model.structures)
    for (const Support& support : s.supports)
      nearest = std::min(nearest, support.position.dot(model.ground.wave->direction));
  return (position.dot(model.ground.wave->direction) - nearest) / model.ground.wave->velocity;
}

// True if the structure has a support motion along an axis, which acts on contacts that slide on it. A free body is the
// exception: it has an unknown along x and does not move along y and z.
bool moves_along(const Structure& s, int direction) { return direction == 0 || !s.is_free; }

// Off-diagonal masses are negligible for a scale.
double share_of(const AppliedForce& force, const Structure& s) {
  const Eigen::VectorXd masses = s.mass.diagonal();
  double sum = 0;
  for (Row::InnerIterator it(force.direction); it; ++it)
    if (masses[it.index()] > 0) sum += it.value() * it.value() / masses[it.index()];
  return std::sqrt(sum / masses.sum());
}

// Difference of the velocities before and after a motion.
double last_velocity(const GroundMotion& motion) {
  return std::abs(motion.velocity(motion.duration()) - motion.initial_velocity());
}

}  // namespace

GroundPlan ground_plan(const Model& model) {
  GroundPlan plan;
  std::vector<std::vector<std::array<int, 3>>> indices;  // [structure][support][axis]
  // Key of a motion: its source (-1 for the model, otherwise a counter of the supports' own motions), the axis, the
  // delay [s].
  std::map<std::tuple<int, int, double>, int> known;
  int own = 0;
  for (const Structure& s : model.structures) {
    std::vector<std::array<int, 3>>& under = indices.emplace_back();
    for (const Support& support : s.supports) {
      const int source = support.motion ? own++ : -1;
      const GroundComponents& components = support.motion ? *support.motion : model.ground.components;
      const double delay = support.delay + (support.motion ? 0 : delay_by_wave(model, support.position));
      if (!support.motion) plan.last_arrival = std::max(plan.last_arrival, delay);
      std::array<int, 3> index{-1, -1, -1};
      for (int i = 0; i < 3; ++i) {
        if (components[i].is_still() || !moves_along(s, i)) continue;
        const auto [found, is_new] = known.emplace(std::tuple(source, i, delay), static_cast<int>(plan.motions.size()));
        if (is_new) plan.motions.push_back(delay == 0 ? components[i] : components[i].delayed(delay));
        index[i] = found->second;
      }
      under.push_back(index);
    }
  }
  if (plan.motions.empty()) plan.motions.emplace_back();
  for (std::vector<std::array<int, 3>>& under : indices) plan.supports.emplace_back(plan.motions, std::move(under));
  for (std::size_t i = 0; i < model.structures.size(); ++i)
    for (const AppliedForce& force : model.structures[i].applied_forces) {
      plan.forces.push_back(
          {static_cast<int>(i), static_cast<int>(plan.motions.size()), share_of(force, model.structures[i])});
      plan.motions.push_back(force.history);
    }
  return plan;
}

double GroundPlan::duration() const {
  double last = 0;
  for (const GroundMotion& motion : motions) last = std::max(last, motion.duration());
  return last;
}

double GroundPlan::sample_step() const {
  double shortest = 0;
  for (const GroundMotion& motion : motions)
    if (motion.sample_step() > 0)
      shortest = shortest > 0 ? std::min(shortest, motion.sample_step()) : motion.sample_step();
  return shortest;
}

double GroundPlan::longest_step(double t) const {
  double shortest = std::numeric_limits<double>::infinity();
  for (const GroundMotion& motion : motions) shortest = std::min(shortest, motion.longest_step(t));
  return shortest;
}

template <class Minimum>
double GroundPlan::largest(int structure, const Minimum& minimum) const {
  double found = 0;
  for (std::size_t k = 0; k < motions.size() - forces.size(); ++k) found = std::max(found, minimum(motions[k]));
  for (const Force& force : forces)
    if (force.structure == structure)
      found = std::max(found, force.share * minimum(motions[static_cast<std::size_t>(force.motion)]));
  return found;
}

double GroundPlan::min_displacement(int structure, double w) const {
  return largest(structure, [w](const GroundMotion& motion) {
    return std::min({min_part * motion.peak() / (w * w), motion.peak_velocity() / w,
                     motion.peak_displacement() + last_velocity(motion) / w});
  });
}

double GroundPlan::min_velocity(int structure, double w) const {
  return largest(structure, [w](const GroundMotion& motion) {
    return std::min(
        {min_part * motion.peak() / w, motion.peak_velocity(), w * motion.peak_displacement() + last_velocity(motion)});
  });
}

}  // namespace pounding
