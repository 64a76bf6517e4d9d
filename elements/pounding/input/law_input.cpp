/// The table of what an input can name.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <pounding/frames/frame_structure.hpp>
#include <pounding/links/gap_link.hpp>
#include <pounding/structures/oscillators.hpp>

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
  return make_body(body.at("mass", "100 t").as_quantity(dimension::mass, bounds::positive));
}

void read_yielding(const Input& body, Structure& s) {
  const std::optional<Input> force = body.find("yield_force"), hardening = body.find("hardening");
  if (hardening && !force)
    hardening->fail_at_key("belongs to storeys that yield; type yield_force: 2 MN beside it, or leave it out");
  if (!force) return;
  const int storeys = s.size();
  const auto forces = force->as_quantities(storeys, dimension::force, bounds::positive);
  const auto ratios = hardening ? hardening->as_quantities(storeys, dimension::none, bounds::from_0_below_1)
                                : std::vector<double>(storeys, 0.0);
  let_storeys_yield(s, forces, ratios);
}

Structure read_linear_oscillator(const Input& body) {
  const double mass = body.at("mass", "100 t").as_quantity(dimension::mass, bounds::positive);
  const std::optional<Input> period = body.find("period"), stiffness = body.find("stiffness");
  if (period && stiffness) stiffness->fail_at_key("give the period or the stiffness, not both");
  if (!period && !stiffness) body.fail("the stiffness is missing; type period: 0.8 s, or stiffness: 6.2 MN/m");
  if (stiffness) return make_oscillator(mass, stiffness->as_quantity(dimension::stiffness, bounds::positive), 0);
  const double w = 2 * M_PI / period->as_quantity(dimension::time, bounds::positive);
  if (!std::isfinite(mass * w * w)) period->fail("is so short that the stiffness m (2 pi/T)^2 is no number");
  return make_oscillator(mass, mass * w * w, 0);
}

// The damping is read with that of every other structure.
Structure read_oscillator(const Input& body) {
  only_keys(body, {"mass", "period", "stiffness", "yield_force", "hardening"});
  Structure s = read_linear_oscillator(body);
  read_yielding(body, s);
  return s;
}

Structure read_shear_building(const Input& body) {
  only_keys(body, {"storeys", "mass", "stiffness", "height", "yield_force", "hardening"});
  const int storeys = static_cast<int>(body.at("storeys", "5").as_integer(1, 1000));
  const auto masses = body.at("mass", "250 t").as_quantities(storeys, dimension::mass, bounds::positive);
  const auto stiffnesses =
      body.at("stiffness", "350 MN/m").as_quantities(storeys, dimension::stiffness, bounds::positive);
  std::vector<double> heights;
  if (const auto height = body.find("height")) heights = height->as_quantities(storeys, dimension::length, bounds::positive);
  Structure s = make_shear_building(masses, stiffnesses, heights);
  read_yielding(body, s);
  return s;
}

Structure read_wall(const Input& body) {
  constexpr std::string_view bare = "a wall has no parameters; type wall: {}";
  if (body.is_map())
    for (const auto& [key, value] : body.entries()) value.fail_at_key(bare);
  if (body.is_list() || (body.is_scalar() && !body.as_text().empty())) body.fail(bare);
  return make_wall();
}

double reduced(double left, double right) {
  if (std::isinf(left)) return right;
  if (std::isinf(right)) return left;
  return left * right / (left + right);
}

// The laws know no places: what one of them refuses is reported at the first of the link's own keys that the text names.
Input place_of(const std::string& refusal, const Input& link, const Input& law, const laws::Entry& entry) {
  std::vector<std::string_view> keys{"formula", "restitution", "impact_velocity", "reduced_mass"};
  for (const laws::ParameterInfo& parameter : entry.parameters) keys.push_back(parameter.name);
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz_";
  for (std::size_t begin = 0; (begin = refusal.find_first_of(letters, begin)) != std::string::npos;) {
    const std::size_t end = std::min(refusal.find_first_not_of(letters, begin), refusal.size());
    const std::string_view word = std::string_view(refusal).substr(begin, end - begin);
    if (std::find(keys.begin(), keys.end(), word) != keys.end())
      if (const auto found = link.find(word)) return *found;
    begin = end;
  }
  return law;
}

LinkLaw read_law(const Input& link, std::span<const std::string_view> link_keys, double gap, double left_mass,
                 double right_mass, int index) {
  std::vector<std::string_view> names;
  for (const laws::Entry& entry : laws::catalogue()) names.push_back(entry.name);
  laws::Settings settings;
  const Input law_node = link.at("law", "hertz_damped");
  settings.law = law_node.as_choice("law", names);
  const laws::Entry& entry = laws::find_law(settings.law);

  std::vector<std::string_view> keys(link_keys.begin(), link_keys.end());
  keys.insert(keys.end(), {"law", "formula", "restitution", "impact_velocity", "reduced_mass"});
  for (const laws::ParameterInfo& parameter : entry.parameters) keys.push_back(parameter.name);
  link.only_keys(keys);

  double exponent = 1.5;
  if (const auto node = link.find("exponent")) exponent = node->as_number(bounds::positive);
  for (const laws::ParameterInfo& parameter : entry.parameters)
    if (parameter.need == laws::Need::required && !link.has(parameter.name))
      law_node.fail(fmt::format("{0} needs {1} ({2}); type {1}: {3:g} {4}", settings.law, parameter.name, parameter.meaning,
                                parameter.typical, laws::resolved_unit(parameter.unit, exponent)));

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
    if (formulas.empty()) formula->fail_at_key(fmt::format("the law {} has no damping formula; leave it out", settings.law));
    settings.formula = formula->as_choice(fmt::format("formula of {}", settings.law), formulas);
  }
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
    place_of(error.what(), link, law_node, entry).fail(error.what());
  }
  return result;
}

constexpr StructureKind structure_kinds[] = {
    {"body", read_body}, {"oscillator", read_oscillator}, {"shear_building", read_shear_building},
    {"frame", read_frame_structure}, {"wall", read_wall}};

}  // namespace

const Kinds& kinds() {
  static constexpr Kinds table{structure_kinds, read_law};
  return table;
}

}  // namespace pounding
