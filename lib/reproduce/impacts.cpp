#include "reproduce/impacts.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/laws/free_impact.hpp>
#include <pounding/model/contact_law.hpp>
#include <pounding/structures/oscillators.hpp>

namespace pounding::reproduce {
namespace {

// Tolerance of the runs, for errors far below the last printed digit.
constexpr double tolerance = 1e-8;

}  // namespace

laws::Settings Asking::settings() const {
  const laws::Entry& entry = laws::find_law(law);
  laws::Settings settings{.law = law, .formula = formula};
  for (const laws::ParameterInfo& p : entry.parameters)
    if (p.need == laws::Need::required)
      settings.values.emplace(p.name, p.name == "stiffness" && stiffness > 0 ? stiffness : p.typical);
  if (entry.takes_restitution) settings.restitution = restitution;
  return settings;
}

laws::AnyLaw Asking::made(double reduced_mass) const {
  laws::Settings settings = laws::typical_settings(laws::find_law(law));
  settings.formula = formula;
  settings.reduced_mass = reduced_mass;
  if (stiffness > 0) settings.values["stiffness"] = stiffness;
  if (settings.restitution) settings.restitution = restitution;
  return laws::make_law(settings);
}

laws::FreeImpact Asking::free_impact(double reduced_mass, double speed) const {
  return laws::free_impact(made(reduced_mass), reduced_mass, speed);
}

Loop collide(const laws::Settings& law, double mass, double speed) {
  Model model;
  const StructureHandle body = model.add("body", make_body({.mass = mass}), {.initial_velocity = speed});
  const StructureHandle wall = model.add("wall", make_wall());
  model.link(body, wall, {.gap = 1e-3 * speed}, law);
  // A body that creeps out of a contact leaves slowly; a long free flight costs almost nothing.
  model.analysis = {
      .duration = 100, .tolerance = tolerance, .output_step = 1, .scheme = {.kind = Scheme::Kind::esdirk4}};
  const Outcome outcome = run(model);
  if (outcome.results.impacts.size() != 1)
    throw SolverError(fmt::format("a body hits the wall {} times with law {}, expected once",
                                  outcome.results.impacts.size(), law.law));
  return loop_of(outcome.results.links.at(0), outcome.results.impacts[0]);
}

Loop loop_of(const LinkHistory& link, const ImpactRow& impact, int points) {
  const auto first = std::ranges::lower_bound(link.time, impact.t_start) - link.time.begin();
  // The force is zero after the release.
  const auto last = std::ranges::upper_bound(link.time, impact.t_release) - link.time.begin();
  const double stride = std::max(1.0, static_cast<double>(last - first) / points);
  Loop loop{.time = {}, .penetration = {}, .velocity = {}, .force = {}, .impact = impact};
  const auto keep = [&](std::size_t i) {
    loop.time.push_back(link.time[i] - impact.t_start);
    loop.penetration.push_back(link.penetration[i]);
    loop.velocity.push_back(link.velocity[i]);
    loop.force.push_back(link.force[i]);
  };
  for (double place = static_cast<double>(first); place < static_cast<double>(last) - 1; place += stride)
    keep(static_cast<std::size_t>(place));
  if (last > first) keep(static_cast<std::size_t>(last - 1));
  return loop;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

}  // namespace pounding::reproduce
