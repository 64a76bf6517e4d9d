#include <pounding/structures/isolators.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <pounding/hysteresis/all.hpp>
#include <pounding/structures/coupled_bouc_wen.hpp>
#include <pounding/structures/coupled_pendulum.hpp>
#include <pounding/structures/make_spring.hpp>
#include <pounding/structures/sliding_spring.hpp>
#include <pounding/structures/yielding_law.hpp>

namespace pounding {
namespace {

using Factors = std::map<int, double>;

void add(const Factors& more, double times, Factors& sum) {
  for (const auto& [unknown, factor] : more) sum[unknown] += times * factor;
}

// Substitutes a linear combination for an unknown.
void replace(int unknown, const Factors& by, Factors& in) {
  const auto found = in.find(unknown);
  if (found == in.end()) return;
  const double times = found->second;
  in.erase(found);
  add(by, times, in);
}

// Parameters of the law combined with those of the velocity dependence.
SlidingFriction sliding(const IsolatorOptions::Velocity& velocity, const std::vector<YieldingPart::Parameter>& law) {
  const auto number = [&](const char* name) {
    const auto found = std::ranges::find(law, name, &YieldingPart::Parameter::name);
    if (found == law.end())
      throw std::invalid_argument("velocity-dependent friction requires the law friction_pendulum");
    return found->value;
  };
  return {.weight = number("weight"),
          .radius = number("radius"),
          .slow = velocity.slow_friction,
          .fast = number("friction"),
          .rate = velocity.rate,
          .sliding_deformation = number("yield_displacement")};
}

// A circle of radius (1-a) Fy around a k d.
std::shared_ptr<const Element> coupled(const hysteresis::Bilinear& law) {
  if (law.negative_yield_force.value_or(law.yield_force) != law.yield_force)
    throw std::invalid_argument(
        "negative_yield_force differs from yield_force, but a coupled law is the same in all directions; remove it, or "
        "type coupled: false");
  const double strength = (1 - law.hardening) * law.yield_force;
  return std::make_shared<CoupledPendulum>(SlidingFriction{.weight = strength,
                                                           .radius = strength / (law.hardening * law.initial_stiffness),
                                                           .slow = 1,
                                                           .fast = 1,
                                                           .rate = 1,
                                                           .sliding_deformation = law.yield_deformation()});
}
std::shared_ptr<const Element> coupled(const hysteresis::BoucWen& law) { return std::make_shared<CoupledBoucWen>(law); }

std::shared_ptr<const Element> coupled_element(const hysteresis::AnyLaw& law) {
  return std::visit(
      []<class L>(const L& given) -> std::shared_ptr<const Element> {
        if constexpr (requires { coupled(given); })
          return coupled(given);
        else if constexpr (requires { coupled(given.made()); })
          return coupled(given.made());
        else
          throw std::invalid_argument(
              std::string(L::name) +
              " has no form that couples x and y; type coupled: false for separate laws along x and y, or one of "
              "bilinear, bouc_wen, friction_pendulum, lead_rubber, elastomeric");
      },
      law);
}

}  // namespace

bool needs_weight(const IsolatorOptions& isolator) {
  if (isolator.law.values.contains("weight")) return false;
  const auto all = hysteresis::catalogue();
  const auto law = std::ranges::find(all, isolator.law.law, &hysteresis::Entry::name);
  return law != all.end() &&
         std::ranges::find(law->parameters, "weight", &hysteresis::ParameterInfo::name) != law->parameters.end();
}

std::vector<YieldingPart> make_isolator(const std::string& name, const std::vector<Row>& deformations,
                                        const IsolatorOptions& isolator, double weight) {
  if (isolator.capacity && !(*isolator.capacity > 0 && std::isfinite(*isolator.capacity)))
    throw std::invalid_argument("capacity must be positive and finite");
  hysteresis::Settings law = isolator.law;
  if (needs_weight(isolator)) law.values.emplace("weight", weight);
  std::vector<YieldingPart::Parameter> parameters = parameters_of(law);
  const bool in_space = deformations.size() > 1, is_coupled = in_space && isolator.is_coupled;
  std::shared_ptr<const Element> element = is_coupled ? coupled_element(hysteresis::make_law(law)) : make_spring(law);
  if (isolator.velocity) {
    const SlidingFriction friction = sliding(*isolator.velocity, parameters);
    if (is_coupled)
      element = std::make_shared<CoupledPendulum>(friction);
    else
      element = std::make_shared<SlidingSpring>(friction);
    parameters.push_back({"slow_friction", isolator.velocity->slow_friction});
    parameters.push_back({"rate", isolator.velocity->rate});
  }
  parameters.push_back({"capacity", isolator.capacity.value_or(std::numeric_limits<double>::infinity())});
  std::vector<YieldingPart> parts;
  for (std::size_t i = 0; i < deformations.size(); ++i) {
    const char* const axis = i == 0 ? " x" : " y";
    parts.emplace_back(in_space ? name + axis : name, deformations[i], law.law, parameters, element,
                       is_coupled ? static_cast<int>(i) : 0);
    parts.back().kind = YieldingPart::Kind::isolator;
  }
  return parts;
}

bool is_isolated(const Structure& s) { return std::ranges::any_of(s.yielding, isolates); }

SparseMatrix stiffness_of_isolators(const Structure& s) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const YieldingPart& part : s.yielding) {
    if (!isolates(part)) continue;
    for (Row::InnerIterator i(part.deformation); i; ++i)
      for (Row::InnerIterator j(part.deformation); j; ++j)
        entries.emplace_back(static_cast<int>(i.index()), static_cast<int>(j.index()),
                             part.stiffness() * i.value() * j.value());
  }
  return sparse_matrix(s.size(), s.size(), entries);
}

SparseMatrix motions_on_fixed_base(const Structure& s) {
  constexpr double rounding = 1e-12;
  std::map<int, Factors> given;  // unknowns that depend on the others
  for (const YieldingPart& part : s.yielding) {
    if (!isolates(part)) continue;
    Factors row;
    for (Row::InnerIterator it(part.deformation); it; ++it) row[static_cast<int>(it.index())] = it.value();
    for (const auto& [unknown, by] : given) replace(unknown, by, row);
    const auto largest = std::ranges::max_element(row, {}, [](const auto& entry) { return std::abs(entry.second); });
    if (largest == row.end() || std::abs(largest->second) < rounding)
      continue;  // depends on isolators that are already fixed
    const int unknown = largest->first;
    const double factor = largest->second;
    row.erase(largest);
    Factors by;
    add(row, -1 / factor, by);
    for (auto& [other, of_other] : given) replace(unknown, by, of_other);
    given.emplace(unknown, std::move(by));
  }
  std::vector<int> column(s.size(), -1);
  int count = 0;
  for (int i = 0; i < s.size(); ++i)
    if (!given.contains(i)) column[i] = count++;
  if (count == 0)
    throw std::invalid_argument("only the isolators deform, so there is nothing to damp; type damping: 0");
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < s.size(); ++i)
    if (column[i] >= 0) entries.emplace_back(i, column[i], 1);
  for (const auto& [unknown, by] : given)
    for (const auto& [other, factor] : by)
      if (factor != 0) entries.emplace_back(unknown, column[other], factor);
  return sparse_matrix(s.size(), count, entries);
}

double isolated_period(const Structure& s) {
  Eigen::VectorXd along = Eigen::VectorXd::Zero(s.size());
  for (const Support& support : s.supports) along += support.influence.col(0);
  double stiffness = 0;
  for (const YieldingPart& part : s.yielding) {
    if (!isolates(part)) continue;
    const double unit = part.deformation.dot(along);
    stiffness += (part.stiffness() + slope_far_behind_yield(*part.element, part.direction)) * unit * unit;
  }
  const double mass = s.total_mass()[0];
  return stiffness > 1e-9 * mass ? 2 * M_PI * std::sqrt(mass / stiffness) : std::numeric_limits<double>::infinity();
}

}  // namespace pounding
