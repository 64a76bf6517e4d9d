#include <pounding/pushover/pushover.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <pounding/core/refuse.hpp>
#include <pounding/core/units.hpp>
#include <pounding/model/modes.hpp>
#include <pounding/structures/storey_heights.hpp>

namespace pounding {
namespace {

const char* axis(int direction) { return direction == 0 ? "x" : "y"; }

Eigen::VectorXd mode_of_floors(const Structure& s, int direction, const ModeSolver& solver) {
  constexpr int enough_modes = 12;
  const std::vector<Mode> found = modes(s, std::min(enough_modes, s.size()), solver);
  if (found.empty()) refuse("it has no mode");
  const auto strongest = std::max_element(found.begin(), found.end(), [&](const Mode& a, const Mode& b) {
    return a.effective_mass[direction] < b.effective_mass[direction];
  });
  return strongest->shape.col(direction);
}

std::vector<double> weights_of(const Structure& s, const PushoverOptions& options, const ModeSolver& solver) {
  const std::size_t floors = s.floors.size();
  if (options.pattern == LoadPattern::given) {
    if (options.forces.size() != floors)
      refuse(fmt::format("a load of {} forces for {} floors; give one force per floor, from the ground up",
                         options.forces.size(), floors));
    return options.forces;
  }
  Eigen::VectorXd shape = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(floors));
  if (options.pattern == LoadPattern::mode1) shape = mode_of_floors(s, options.direction, solver);
  if (options.pattern == LoadPattern::triangular)
    for (std::size_t i = 0; i < floors; ++i)
      shape[static_cast<Eigen::Index>(i)] =
          knows_heights(s) ? *s.floors[i].elevation - base_height(s) : static_cast<double>(i + 1);
  std::vector<double> weights;
  for (std::size_t i = 0; i < floors; ++i) weights.push_back(s.floors[i].mass * shape[static_cast<Eigen::Index>(i)]);
  return weights;
}

// Loads on the floors with sum 1.
std::vector<double> loads_of(const Structure& s, const PushoverOptions& options, const ModeSolver& solver) {
  std::vector<double> loads = weights_of(s, options, solver);
  double sum = 0, size = 0;
  for (const double load : loads) sum += load, size += std::abs(load);
  if (!std::isfinite(size) || !(std::abs(sum) > 1e-9 * size))
    refuse(
        "the forces on the floors have zero sum, so the base shear is zero; give other forces, or masses of the "
        "floors");
  for (double& load : loads) load /= sum;
  return loads;
}

// Distribution of a floor force over the unknowns. The nodes of a floor of a plane frame share it in proportion to
// their masses. For floors in space and for sticks it acts on the motion of the floor mass.
Eigen::VectorXd force_on(const Structure& s, std::size_t floor, int direction) {
  const Row& motion = s.floors[floor].motion.at(static_cast<std::size_t>(direction));
  if (s.dimension != 2) return motion;
  std::vector<Row> rows;
  for (std::size_t node = 0; node < s.geometry.node_names.size(); ++node)
    if (s.geometry.floor_of_node[node] == static_cast<int>(floor))
      rows.push_back(s.surface->displacement(s.geometry.node_names[node], "ux"));
  Eigen::VectorXd along = Eigen::VectorXd::Zero(s.size());
  for (const Support& support : s.supports) along += support.load.col(direction);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(s.size());
  double whole = 0;
  for (const Row& row : rows) {
    const double mass = row.dot(along);
    force += mass * Eigen::VectorXd(row);
    whole += mass;
  }
  return whole > 0 ? Eigen::VectorXd(force / whole) : Eigen::VectorXd(motion);
}

void check(const Structure& s, const PushoverOptions& options) {
  if (s.tangent)
    refuse("its members are of fibres, which a pushover does not support; give them hinges, or type pounding section");
  if (s.yielding.empty())
    refuse("it has no yielding parts; give yield_force to an oscillator or a shear_building, or hinges to a frame");
  if (s.floors.empty()) refuse("it has no floors to push; define them under floors");
  if (options.direction < 0 ||
      static_cast<std::size_t>(options.direction) >= std::min<std::size_t>(2, s.floors.front().motion.size()))
    refuse(fmt::format("it does not move along {}; push it along x", axis(options.direction)));
  if (options.targets.empty()) refuse("no target displacement; give a displacement of the roof such as 250 mm");
  for (const double target : options.targets)
    if (!std::isfinite(target) || target == 0)
      refuse("the displacement of the roof must not be zero; give one such as 250 mm");
}

// Displacement of the first yield under linear continuation of the initial path; infinite if there is none.
double way_to_yield(const Structure& s, const PushPath& path) {
  const PushPoint &first = path.points.front(), &last = path.points.back();
  double way = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < s.yielding.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    const double rate =
        (last.deformations[i] - first.deformations[i]) / std::abs(last.displacement - first.displacement);
    const double left = std::copysign(s.yielding[j].yield_deformation(), rate) - first.deformations[i];
    if (rate != 0) way = std::min(way, left / rate);
  }
  return way;
}

void require_yield(const Structure& s, const Pushover& found) {
  if (found.first_yield()) return;
  const double way = way_to_yield(s, found.path);
  if (!std::isfinite(way)) refuse("no part yields at any displacement");
  const double enough = 1.1 * way;
  refuse(
      fmt::format("nothing yields up to this displacement; the first part yields at a roof displacement of {}. Push it "
                  "farther, such as to {}",
                  format_quantity(way, dimension::length), format_quantity(enough, dimension::length, 2)));
}

}  // namespace

const char* name_of(LoadPattern pattern) {
  constexpr const char* names[] = {"triangular", "uniform", "mode1", "given"};
  return names[static_cast<int>(pattern)];
}

double roof_height(const Structure& s) {
  if (s.floors.empty() || !knows_heights(s)) return std::numeric_limits<double>::quiet_NaN();
  return *s.floors.back().elevation - base_height(s);
}

Pushover pushover(const Structure& s, const PushoverOptions& options, const ModeSolver& modes) {
  check(s, options);
  Pushover found;
  found.structure = s.name;
  found.options = options;
  found.height = roof_height(s);
  found.loads = loads_of(s, options, modes);
  for (const Floor& floor : s.floors) found.floors.push_back(floor.label);
  for (const YieldingPart& part : s.yielding)
    found.parts.push_back(
        {part.name, part.law, part.stiffness() + part.first_slope(), part.yield_deformation(), part.limits});

  PushOptions push_options;
  push_options.load = Eigen::VectorXd::Zero(s.size());
  push_options.targets = options.targets;
  push_options.control = s.floors.back().motion[static_cast<std::size_t>(options.direction)];
  for (std::size_t i = 0; i < s.floors.size(); ++i)
    push_options.load += found.loads[i] * force_on(s, i, options.direction);
  Eigen::MatrixXd motion(static_cast<Eigen::Index>(s.floors.size()), s.size());
  for (std::size_t i = 0; i < s.floors.size(); ++i)
    motion.row(static_cast<Eigen::Index>(i)) =
        Eigen::VectorXd(s.floors[i].motion[static_cast<std::size_t>(options.direction)]).transpose();
  push_options.follow = motion;
  found.path = push(s, push_options);
  // The force of a device has no linear part there; here it is in addition to its stiffness, like that of other parts.
  for (std::size_t j = 0; j < s.yielding.size(); ++j)
    if (const double stiffness = s.yielding[j].first_slope(); stiffness != 0)
      for (PushPoint& point : found.path.points)
        point.forces[static_cast<Eigen::Index>(j)] -= stiffness * point.deformations[static_cast<Eigen::Index>(j)];
  require_yield(s, found);

  const auto points = static_cast<Eigen::Index>(found.path.points.size());
  found.floor_displacements.resize(points, motion.rows());
  std::vector<double> displacements, base_shears;
  for (Eigen::Index i = 0; i < points; ++i) {
    const PushPoint& point = found.path.points[static_cast<std::size_t>(i)];
    found.floor_displacements.row(i) = point.followed.transpose();
    displacements.push_back(point.displacement);
    base_shears.push_back(point.factor);
  }
  if (options.targets.size() > 1) return found;
  // A curve in the negative direction is that of the mirrored building.
  const double way = options.targets.front() > 0 ? 1 : -1;
  for (double& value : displacements) value *= way;
  for (double& value : base_shears) value *= way;
  found.bilinear = bilinear_curve(displacements, base_shears);
  found.equivalent = equivalent_oscillator(s, found.loads, *found.bilinear);
  return found;
}

}  // namespace pounding
