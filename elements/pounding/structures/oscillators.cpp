#include <pounding/structures/oscillators.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <pounding/core/units.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/structures/make_spring.hpp>
#include <pounding/structures/structure_damping.hpp>

namespace pounding {
namespace {

constexpr const char* needs_yielding = "hardening requires yield_force; give both";
constexpr const char* one_law = "spring defines how the storeys yield; remove yield_force and hardening";

// Floors of a stick model that move only along x: the unknowns themselves.
class FloorSurface final : public Surface {
 public:
  explicit FloorSurface(std::vector<double> masses) : masses_(std::move(masses)) {}

  ContactPoint floor(int floor, Side, double) const override {
    const int n = static_cast<int>(masses_.size());
    ContactPoint point;
    for (Row& row : point.motion) row.resize(n);
    point.motion[0].insert(floor) = 1;
    point.mass = masses_.at(floor);
    return point;
  }

 private:
  std::vector<double> masses_;
};

class WallSurface final : public Surface {
 public:
  ContactPoint floor(int, Side, double) const override {
    ContactPoint point;
    point.mass = std::numeric_limits<double>::infinity();
    return point;
  }
};

// Storeys from the ground up; a free mass has zero stiffness and no storey.
Structure make_stick(const std::vector<double>& masses, const std::vector<double>& stiffnesses,
                     const std::vector<double>& heights) {
  const int n = static_cast<int>(masses.size());
  Structure s;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(n, n);
  const Eigen::VectorXd mass = Eigen::Map<const Eigen::VectorXd>(masses.data(), n);
  double elevation = 0;
  for (int i = 0; i < n; ++i) {
    Floor floor;
    floor.label = std::to_string(i + 1);
    floor.mass = masses[i];
    if (!heights.empty()) floor.elevation = elevation += heights[i];
    floor.motion.emplace_back(n).insert(i) = 1;
    s.unknowns.push_back("floor " + floor.label);
    if (!stiffnesses.empty()) {
      const double k = stiffnesses[i];
      stiffness(i, i) += k;
      Row& shear = floor.storey_shear.emplace_back(n);
      if (i > 0) {
        stiffness(i - 1, i - 1) += k;
        stiffness(i - 1, i) = stiffness(i, i - 1) = -k;
        shear.insert(i - 1) = -k;
      }
      shear.insert(i) = k;
    }
    s.floors.push_back(std::move(floor));
  }
  s.mass = SparseMatrix(Eigen::MatrixXd(mass.asDiagonal()).sparseView());
  s.stiffness = stiffness.sparseView();
  s.damping.resize(n, n);
  s.storey_stiffness = stiffnesses;
  Support ground;
  ground.influence = ground.load = Eigen::MatrixX3d::Zero(n, 3);
  ground.influence.col(0).setOnes();
  ground.load.col(0) = mass;
  s.supports.push_back(std::move(ground));
  s.initial_displacement = s.initial_velocity = Eigen::VectorXd::Zero(n);
  s.surface = std::make_shared<FloorSurface>(masses);
  return s;
}

}  // namespace

Structure make_body(const BodyOptions& options) {
  laws::require_positive("mass", options.mass);
  Structure s = make_stick({options.mass}, {}, {});
  s.kind = "body";
  s.damping_note = "none";
  s.is_free = true;
  s.frequencies = Eigen::VectorXd::Zero(1);
  if (!std::isfinite(options.gravity)) throw std::invalid_argument("gravity must be finite");
  if (options.gravity != 0)
    s.applied_forces.push_back({"ux by its weight", s.floors.front().motion.front(),
                                GroundMotion(Step{.amplitude = options.mass * options.gravity}, dimension::force)});
  return s;
}

double stiffness_of_period(double mass, double period) {
  const double w = 2 * M_PI / period;
  return mass * w * w;
}

Structure make_oscillator(const OscillatorOptions& options) {
  laws::require_positive("mass", options.mass);
  if (options.period.has_value() == options.stiffness.has_value())
    throw std::invalid_argument("an oscillator needs exactly one of period and stiffness");
  laws::require_positive("period", options.period);
  const double stiffness = options.stiffness ? *options.stiffness : stiffness_of_period(options.mass, *options.period);
  laws::require_positive("stiffness", stiffness);
  Structure s = make_stick({options.mass}, {stiffness}, {});
  s.kind = "oscillator";
  if (options.damping_ratio) {
    set_frequencies(s);
    set_damping(s, *options.damping_ratio);
  }
  if (options.spring && (options.yield_force || options.hardening != 0)) throw std::invalid_argument(one_law);
  if (options.spring)
    let_storeys_yield(s, *options.spring);
  else if (options.yield_force)
    let_storeys_yield(s, {*options.yield_force}, {options.hardening});
  else if (options.hardening != 0)
    throw std::invalid_argument(needs_yielding);
  return s;
}

namespace {

Row drift_of(int storey, int size) {
  Row drift(size);
  if (storey > 0) drift.insert(storey - 1) = -1;
  drift.insert(storey) = 1;
  return drift;
}

YieldingPart isolators_under(const std::vector<double>& masses, const IsolatorOptions& options) {
  const double weight = standard_gravity * std::accumulate(masses.begin(), masses.end(), 0.0);
  try {
    return make_isolator("isolators", {drift_of(0, static_cast<int>(masses.size()))}, options, weight).front();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("isolators: " + std::string(error.what()));
  }
}

// With larger ratios of stiffness, the motion of soft storeys is lost to round-off; this limit preserves six of 16
// digits.
void require_digits_of_storeys(const std::vector<double>& stiffnesses) {
  constexpr double largest_ratio = 1e10;
  if (stiffnesses.empty()) return;
  const auto [softest, stiffest] = std::ranges::minmax(stiffnesses);
  if (stiffest > largest_ratio * softest)
    throw std::invalid_argument(
        fmt::format("stiffness: storeys of {:.3g} and {:.3g} N/m differ by a factor above {:g}, so the motion of the "
                    "soft one is lost to round-off; check the unit, or type at most {:.3g} N/m for the stiff one",
                    softest, stiffest, largest_ratio, largest_ratio * softest));
}

}  // namespace

Structure make_shear_building(const ShearBuildingOptions& options) {
  if (options.storeys < 1) throw std::invalid_argument("storeys must be at least 1");
  const std::vector<double> masses = options.mass.of_each(options.storeys, "mass");
  for (const double mass : masses) laws::require_positive("mass", mass);
  std::optional<YieldingPart> isolators;
  if (options.isolator) isolators = isolators_under(masses, *options.isolator);
  const int above = options.storeys - (isolators ? 1 : 0);
  std::vector<double> stiffnesses;
  if (above > 0)
    stiffnesses =
        options.stiffness.of_each(above, isolators ? "stiffness of the storeys above the isolators" : "stiffness");
  for (const double stiffness : stiffnesses) laws::require_positive("stiffness", stiffness);
  require_digits_of_storeys(stiffnesses);
  if (isolators) stiffnesses.insert(stiffnesses.begin(), isolators->stiffness());
  std::vector<double> heights;
  if (!options.height.empty()) heights = options.height.of_each(options.storeys, "height");
  for (const double height : heights) laws::require_positive("height", height);
  Structure s = make_stick(masses, stiffnesses, heights);
  s.kind = "shear_building";
  if (isolators) s.yielding.push_back(std::move(*isolators));
  if (options.spring && !(options.yield_force.empty() && options.hardening.empty()))
    throw std::invalid_argument(one_law);
  if (options.spring) let_storeys_yield(s, *options.spring);
  if (options.yield_force.empty() && !options.hardening.empty()) throw std::invalid_argument(needs_yielding);
  if (!options.yield_force.empty())
    let_storeys_yield(
        s, options.yield_force.of_each(above, "yield_force"),
        options.hardening.empty() ? std::vector<double>(above, 0.0) : options.hardening.of_each(above, "hardening"));
  return s;
}

std::vector<double> stiffness_of_storeys(const Structure& s) {
  return {s.storey_stiffness.begin() + (is_isolated(s) ? 1 : 0), s.storey_stiffness.end()};
}

void let_storeys_yield(Structure& s, const std::vector<double>& yield_forces, const std::vector<double>& hardening) {
  const std::size_t storeys = stiffness_of_storeys(s).size();
  if (yield_forces.size() != storeys || hardening.size() != storeys)
    throw std::invalid_argument("yield_forces and hardening need one value per storey");
  let_storeys_yield(s, {.law = "bilinear", .values = {{"yield_force", yield_forces}, {"hardening", hardening}}});
}

void let_storeys_yield(Structure& s, const SpringOptions& spring) {
  std::erase_if(s.yielding, [](const YieldingPart& part) { return !isolates(part); });
  const std::vector<double> stiffness = stiffness_of_storeys(s);
  const int first = static_cast<int>(s.storey_stiffness.size() - stiffness.size());
  for (int i = 0; i < static_cast<int>(stiffness.size()); ++i) {
    const std::string name = "storey " + std::to_string(first + i + 1);
    try {
      const hysteresis::Settings settings = spring.of_storey(i, stiffness);
      s.yielding.emplace_back(name, drift_of(first + i, s.size()), spring.law, parameters_of(settings),
                              make_spring(settings));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(stiffness.size() == 1 ? error.what() : name + ": " + error.what());
    }
  }
}

Structure make_wall() {
  Structure s;
  s.kind = "wall";
  s.dimension = 3;
  s.damping_note = "rigid";
  s.supports.emplace_back();
  s.surface = std::make_shared<WallSurface>();
  return s;
}

}  // namespace pounding
