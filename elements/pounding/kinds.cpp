/// The table of what an input can name.

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <pounding/gap_link.hpp>
#include <pounding/structures.hpp>

namespace pounding {
namespace {

void only_keys(const Input& body, std::initializer_list<std::string_view> own, bool moves = true, bool damped = true) {
  std::vector<std::string_view> keys(own);
  if (damped) keys.push_back("damping");
  if (moves) keys.insert(keys.end(), {"initial_velocity", "initial_displacement"});
  body.only_keys(keys);
}

Structure read_body(const Input& body) {
  only_keys(body, {"mass"}, true, false);
  return make_body(body.at("mass", "mass: 100 t").as_quantity(dimension::mass, bounds::positive));
}

// The damping is read with that of every other structure.
Structure read_oscillator(const Input& body) {
  only_keys(body, {"mass", "period", "stiffness"});
  const double mass = body.at("mass", "mass: 100 t").as_quantity(dimension::mass, bounds::positive);
  const std::optional<Input> period = body.find("period"), stiffness = body.find("stiffness");
  if (period && stiffness) stiffness->fail_at_key("give the period or the stiffness, not both");
  if (!period && !stiffness) body.fail("the stiffness is missing; type period: 0.8 s, or stiffness: 6.2 MN/m");
  if (stiffness) return make_oscillator(mass, stiffness->as_quantity(dimension::stiffness, bounds::positive), 0);
  const double w = 2 * M_PI / period->as_quantity(dimension::time, bounds::positive);
  return make_oscillator(mass, mass * w * w, 0);
}

Structure read_shear_building(const Input& body) {
  only_keys(body, {"storeys", "mass", "stiffness", "height"});
  const int storeys = static_cast<int>(body.at("storeys", "storeys: 5").as_integer(1, 100000));
  const auto masses = body.at("mass", "mass: 250 t").as_quantities(storeys, dimension::mass, bounds::positive);
  const auto stiffnesses =
      body.at("stiffness", "stiffness: 350 MN/m").as_quantities(storeys, dimension::stiffness, bounds::positive);
  std::vector<double> heights;
  if (const auto height = body.find("height")) heights = height->as_quantities(storeys, dimension::length, bounds::positive);
  return make_shear_building(masses, stiffnesses, heights);
}

Structure read_wall(const Input& body) {
  if (body.is_map()) body.only_keys({});
  if (body.is_list() || (body.is_scalar() && !body.as_text().empty())) body.fail("a wall has no parameters; type wall: {}");
  return make_wall();
}

double reduced(double left, double right) {
  if (std::isinf(left)) return right;
  if (std::isinf(right)) return left;
  return left * right / (left + right);
}

LinkLaw read_law(const Input& link, std::span<const std::string_view> link_keys, double gap, double left_mass,
                 double right_mass, int index) {
  std::vector<std::string_view> names;
  for (const laws::Entry& entry : laws::catalogue()) names.push_back(entry.name);
  laws::Settings settings;
  const Input law_node = link.at("law", "law: hertz_damped");
  settings.law = law_node.as_choice("law", names);
  const laws::Entry& entry = laws::find_law(settings.law);

  std::vector<std::string_view> keys(link_keys.begin(), link_keys.end());
  keys.insert(keys.end(), {"law", "formula", "restitution", "impact_velocity", "reduced_mass"});
  for (const laws::ParameterInfo& parameter : entry.parameters) keys.push_back(parameter.name);
  link.only_keys(keys);

  LinkLaw result;
  const std::optional<Input> mass = link.find("reduced_mass");
  result.reduced_mass_given = mass.has_value();
  settings.reduced_mass =
      mass ? mass->as_quantity(dimension::mass, bounds::positive) : reduced(left_mass, right_mass);
  if (const auto restitution = link.find("restitution"))
    settings.restitution = restitution->as_quantity(dimension::none, bounds::above_0_to_1);
  if (const auto velocity = link.find("impact_velocity"))
    settings.impact_velocity = velocity->as_quantity(dimension::velocity, bounds::positive);
  if (const auto formula = link.find("formula")) {
    std::vector<std::string_view> formulas;
    for (const laws::Formula& each : entry.formulas) formulas.push_back(each.name);
    if (formulas.empty()) formula->fail_at_key(fmt::format("the law {} has no damping formula", settings.law));
    settings.formula = formula->as_choice(fmt::format("formula of {}", settings.law), formulas);
  }
  double exponent = 1.5;
  if (const auto node = link.find("exponent")) exponent = node->as_number(bounds::positive);
  // A unit such as "N/m^n" depends on the exponent that the link chose.
  for (const laws::ParameterInfo& parameter : entry.parameters)
    if (const auto node = link.find(parameter.name))
      settings.values.emplace(
          std::string(parameter.name),
          node->as_quantity(parse_unit_dimension(laws::resolved_unit(parameter.unit, exponent))));
  try {
    const laws::AnyLaw law = laws::make_law(settings);
    result.law = settings.law;
    for (const laws::ResolvedValue& each : laws::describe(law)) result.parameters.push_back({each.name, each.value, each.unit});
    result.formula = laws::formula_name(law);
    result.reduced_mass = settings.reduced_mass;
    result.contact = make_gap_link(law, gap, index);
  } catch (const std::invalid_argument& error) {
    law_node.fail(error.what());
  }
  return result;
}

constexpr StructureKind structure_kinds[] = {
    {"body", read_body}, {"oscillator", read_oscillator}, {"shear_building", read_shear_building}, {"wall", read_wall}};

}  // namespace

const Kinds& kinds() {
  static constexpr Kinds table{structure_kinds, read_law};
  return table;
}

}  // namespace pounding
