#include <pounding/input/collision.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include <pounding/core/error.hpp>
#include <pounding/core/units.hpp>

namespace pounding {
namespace {

double read(const CollisionInput& keys, std::string_view name, const std::string& text, const Dimension& expected) {
  try {
    return parse_quantity(text, expected);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}{} {}: {}", keys.before_names, name, excerpt(text), error.what()));
  }
}

double read_mass(const CollisionInput& keys, std::string_view name, const std::string& text) {
  const double mass = read(keys, name, text, dimension::mass);
  if (!(mass > 0))
    throw InputError(fmt::format("{}{} {}: a mass must be positive", keys.before_names, name, excerpt(text)));
  return mass;
}

/// Reduced mass; a wall has infinite mass.
double reduced_mass(const CollisionInput& keys) {
  const double m1 = read_mass(keys, "m1", keys.m1);
  if (keys.m2 == "wall") return m1;
  const double m2 = read_mass(keys, "m2", keys.m2);
  return m1 / (1 + m1 / m2);
}

std::vector<std::pair<std::string, std::string>> given_parameters(const CollisionInput& keys) {
  std::vector<std::pair<std::string, std::string>> given;
  if (!keys.exponent.empty()) given.emplace_back("exponent", keys.exponent);
  if (!keys.stiffness.empty()) given.emplace_back("stiffness", keys.stiffness);
  given.insert(given.end(), keys.parameters.begin(), keys.parameters.end());
  return given;
}

bool is_item_given(const std::vector<std::pair<std::string, std::string>>& given, std::string_view name) {
  return std::ranges::find(given, name, &std::pair<std::string, std::string>::first) != given.end();
}

CalibratedRow calibrated(const Collision& c, std::string_view formula) {
  CalibratedRow row{.formula = formula, .impact = {}, .refused = {}};
  laws::Settings settings = c.settings;
  settings.formula = formula;
  const auto refuse = [&](std::string_view why) { row.refused = refused_impact(c.law.name, formula, why); };
  try {
    const laws::AnyLaw law = laws::make_law(settings);
    row.impact = laws::free_impact(law, settings.reduced_mass, c.velocity);
    row.number = damping_number(law, c.velocity);
    row.coefficient = damping_coefficient(law, c.velocity);
  } catch (const std::invalid_argument& error) {
    if (c.law.formulas.size() < 2) throw;
    row.refused = error.what();
  } catch (const std::domain_error&) {
    refuse("has no number");
  } catch (const std::runtime_error&) {
    refuse("does not end");
  }
  if (row.impact.duration > 0 && std::isinf(row.impact.peak_force)) refuse("has no number");
  return row;
}

}  // namespace

std::string refused_impact(std::string_view before, std::string_view formula, std::string_view why) {
  std::string refused = fmt::format("{} for these values; look at their units", why);
  if (formula.empty() || formula == "exact") throw InputError(fmt::format("{}: the impact {}", before, refused));
  return refused;
}

Collision read_collision(const CollisionInput& keys) {
  Collision c{.law = laws::find_law(keys.law), .settings = {}, .assumed = {}};
  c.settings = laws::typical_settings(c.law);
  c.settings.reduced_mass = reduced_mass(keys);
  if (c.law.takes_restitution) {
    if (keys.restitution.empty())
      throw InputError(
          fmt::format("{}restitution is missing; type the target restitution, such as 0.65", keys.before_names));
    c.settings.restitution = read(keys, "restitution", keys.restitution, dimension::none);
  } else if (!keys.restitution.empty()) {
    throw InputError(
        fmt::format("{}restitution: {} takes no restitution, since {}", keys.before_names, keys.law,
                    c.law.leaves_indentation ? "its dissipation follows from its curves" : "it dissipates no energy"));
  }
  const auto given = given_parameters(keys);
  for (const auto& [name, text] : given)
    if (name == "exponent") c.settings.values["exponent"] = read(keys, name, text, dimension::none);
  if (const auto n = c.settings.values.find("exponent"); n != c.settings.values.end()) c.exponent = n->second;
  for (const auto& [name, text] : given) {
    const auto p = std::ranges::find(c.law.parameters, laws::parameter_name(name), &laws::ParameterInfo::name);
    // An unknown name is kept, so that make_law rejects it and lists the known ones.
    const Dimension expected =
        p == c.law.parameters.end() ? dimension::none : parse_unit_dimension(laws::resolved_unit(p->unit, c.exponent));
    if (p != c.law.parameters.end() && p->is_list())
      std::erase_if(c.settings.values, [&](const auto& each) {
        return each.first != name && laws::parameter_name(each.first) == p->name && !is_item_given(given, each.first);
      });
    c.settings.values[name] = p == c.law.parameters.end() ? 0 : read(keys, name, text, expected);
  }
  for (const laws::ParameterInfo& p : c.law.parameters) {
    const bool is_given = laws::is_given(given, p.name);
    if (p.need == laws::Need::required && !is_given && p.unit.find('n') != std::string_view::npos &&
        !keys.exponent.empty())
      throw InputError(
          fmt::format("{}exponent {} requires {}{}, which has a typical value for the default exponent only",
                      keys.before_names, keys.exponent, keys.before_names, p.name));
    if (p.need == laws::Need::required && !is_given)
      c.assumed.push_back(fmt::format("{} {:g} {}", p.name, p.typical, laws::resolved_unit(p.unit, c.exponent)));
  }
  if (keys.velocity.empty())
    c.assumed.push_back(fmt::format("approach velocity {:g} m/s", c.velocity));
  else
    c.velocity = read(keys, "velocity", keys.velocity, dimension::velocity);
  return c;
}

std::vector<CalibratedRow> calibrate(const Collision& c) {
  if (c.law.formulas.empty()) return {calibrated(c, "")};
  // A value that every formula rejects is invalid.
  laws::Settings settings = c.settings;
  settings.formula = c.law.formulas[1 % c.law.formulas.size()].name;
  laws::make_law(settings);
  std::vector<CalibratedRow> rows;
  for (const laws::Formula& f : c.law.formulas) rows.push_back(calibrated(c, f.name));
  return rows;
}

}  // namespace pounding
