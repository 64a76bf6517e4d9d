#include <pounding/input/frames/fibre_material_input.hpp>

#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/names.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/input/spring_input.hpp>

namespace pounding {
namespace {

// Strain at the strength of a concrete, > 0.
double peak_strain(const materials::AnyMaterial& law) {
  return std::visit(
      [](const auto& of) -> double {
        if constexpr (requires { of.epsc0; }) return -of.epsc0;
        if constexpr (requires { of.epsc; }) return -of.epsc;
        return 0;
      },
      law);
}

// The law of a concrete with the strength and the strains of its confinement.
materials::AnyMaterial confined_law(materials::AnyMaterial law, const materials::Confinement& by, double unconfined) {
  std::visit(
      [&](auto& of) {
        if constexpr (requires { of.fpc; }) {
          of.fpc = -by.strength;
          of.epsc0 = -by.strain;
          of.fpcu = -materials::strength_at_ultimate(by, unconfined);
          of.epsU = -by.ultimate_strain;
        } else if constexpr (requires { of.fc; }) {
          of.fc = -by.strength;
          of.epsc = -by.strain;
          of.epscu = -by.ultimate_strain;
        }
        of.check();
      },
      law);
  return law;
}

// Clear distances between the bars that the hoops hold on two opposite sides.
void add_clear_distances(std::vector<double>& all, double side, double hoop, double bar, long long held) {
  const double gap = (side - hoop - static_cast<double>(held) * bar) / static_cast<double>(held - 1);
  all.insert(all.end(), 2 * static_cast<std::size_t>(held - 1), gap);
}

FibreMaterial read_confined(const std::string& name, const Input& node, const FibreMaterials& known) {
  node.only_keys();
  const Input of = node.at("of");
  const FibreMaterial& plain = find_law(of, known);
  if (plain.concrete_strength == 0 || plain.confinement)
    of.fail(fmt::format("takes an unconfined concrete with the law concrete01, concrete02 or concrete04; \"{}\" is {}",
                        plain.name, plain.confinement ? "confined" : "none"));
  const Input bars_node = node.at("bars");
  const sections::Bars bars = read_bars(bars_node);
  const double hoop = node.quantity("hoops"), bar = std::sqrt(4 * bars.area / M_PI);
  long long across_width = 2, across_depth = 2;
  if (const auto legs = node.find("legs")) {
    if (!legs->is_list() || legs->items().size() != 2)
      legs->fail("takes the numbers of legs parallel to the width and to the depth; type legs: [2, 4]");
    across_width = legs->items()[0].as_integer();
    across_depth = legs->items()[1].as_integer();
  }
  if (const long long held = 2 * (across_width + across_depth) - 4; bars.count < held)
    bars_node.fail(fmt::format("{} bars are less than the {} that hoops with legs: [{}, {}] hold", bars.count, held,
                               across_width, across_depth));
  materials::ConfinedCore core{.strength = plain.concrete_strength,
                               .strain = peak_strain(plain.law),
                               .width = node.quantity("width"),
                               .depth = node.quantity("depth"),
                               .bars = bars.count * bars.area,
                               .hoops_across_width = static_cast<double>(across_width) * sections::bar_area(hoop),
                               .hoops_across_depth = static_cast<double>(across_depth) * sections::bar_area(hoop),
                               .spacing = node.quantity("spacing"),
                               .clear_spacing = node.quantity("spacing") - hoop,
                               .hoop_strength = node.quantity("fyh"),
                               .hoop_strain = node.quantity("esu")};
  std::vector<double> clear_distances;
  add_clear_distances(clear_distances, core.width, hoop, bar, across_depth);
  add_clear_distances(clear_distances, core.depth, hoop, bar, across_width);
  for (const double gap : clear_distances)
    if (!(gap > 0))
      bars_node.fail("the bars that the hoops hold do not fit into the core; check width, depth and legs");
  return placed(node, [&] {
    const materials::Confinement confinement = materials::confine(core, clear_distances);
    return FibreMaterial{name, confined_law(plain.law, confinement, core.strength), core.strength, confinement};
  });
}

}  // namespace

sections::Bars read_bars(const Input& node) {
  const std::string text = node.as_text();
  const std::size_t d = text.find('d');
  int count = 0;
  const char* const begin = text.data();
  const auto [end, error] = std::from_chars(begin, begin + std::min(d, text.size()), count);
  const bool has_count =
      error == std::errc{} && text.find_first_not_of(' ', static_cast<std::size_t>(end - begin)) == d;
  double diameter = 0;
  if (d == text.npos || !has_count || count < 1 || count > 1000 || !parse_number(text.substr(d + 1), diameter) ||
      !(diameter > 0))
    node.fail(
        fmt::format("takes a number of bars up to 1000 and their diameter in mm such as \"4 d20\"; \"{}\" was read",
                    excerpt(text)));
  return {count, sections::bar_area(diameter * 1e-3)};
}

const FibreMaterial& find_law(const Input& node, const FibreMaterials& known) {
  const std::string name = node.as_text();
  if (const auto found = known.find(name); found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [each, material] : known) names.push_back(each);
  node.fail(fmt::format("{} A section of fibres takes a law from materials, such as {}: {{elastic: {{E: 200 GPa}}}}",
                        unknown_name("law of fibres", name, names), excerpt(name)));
}

FibreMaterial read_fibre_material(const std::string& name, const Input& node, const FibreMaterials& known) {
  node.only_keys();
  const std::string law = node.chosen("E: 30 GPa, or steel01: {Fy: 460 MPa, E0: 200 GPa, b: 0.01} for fibres");
  for (const char* const key : {"G", "poisson", "density", "strength"})
    if (const auto found = node.find(key))
      found->fail_at_key(fmt::format("belongs to an elastic material, and {} is a law of fibres; leave it out", law));
  const Input given = node.at(law);
  if (law == "confined") return read_confined(name, given, known);
  given.only_keys();
  const materials::Entry& entry = materials::find_material(law);
  materials::Settings settings{.law = law};
  for (const hysteresis::ParameterInfo& parameter : entry.parameters) {
    if (parameter.need == hysteresis::Need::required) given.at(parameter.name);
    if (const auto value = given.find(parameter.name)) settings.values.emplace(parameter.name, value->as_quantity());
  }
  try {
    const materials::AnyMaterial made = materials::make_material(settings);
    return {name, made, concrete_strength(made)};
  } catch (const std::invalid_argument& error) {
    location_of(error.what(), given, entry).fail(error.what());
  }
}

}  // namespace pounding
