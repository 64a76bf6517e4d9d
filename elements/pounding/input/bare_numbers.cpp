#include <pounding/input/bare_numbers.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include <pounding/input/keys/sections.hpp>

namespace pounding {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// Plausible values for buildings. Zero disables an effect and never causes a warning.
struct Usual {
  std::string_view section, key;
  double low, high;       // in SI
  std::string_view name;  // that suppresses it in Model::accept
  std::string_view advice;
};

constexpr std::string_view mass_advice = "a mass without a unit is in kg; type a unit, as in 90 t";
constexpr std::string_view damping_advice = "a typical value is 5 %; type 5 % or 0.05";
constexpr std::string_view height_advice = "a length without a unit is in m; type a unit, as in 3200 mm";

constexpr Usual usual_values[] = {
    {"grid", "floor_mass", 1e3, unbounded, "mass", mass_advice},
    {"materials", "density", 100, 15e3, "density",
     "a density without a unit is in kg/m^3; type a unit, as in 2.5 t/m^3"},
    {"sections", "stiffness", 0.02, 2, "stiffness",
     "it is a factor on the second moments of area; type it as 0.35 or 35 %"},
    {"structures", "damping", 1e-3, 0.4, "damping", damping_advice},
    {"oscillator", "damping", 1e-3, 0.4, "damping", damping_advice},
    {"shear_building", "damping", 1e-3, 0.4, "damping", damping_advice},
    {"frame", "damping", 1e-3, 0.4, "damping", damping_advice},
    {"rayleigh", "ratio", 1e-3, 0.4, "damping", damping_advice},
    {"mass_proportional", "ratio", 1e-3, 0.4, "damping", damping_advice},
    {"stiffness_proportional", "ratio", 1e-3, 0.4, "damping", damping_advice},
    {"modal", "ratio", 1e-3, 0.4, "damping", damping_advice},
    {"modal", "ratios", 1e-3, 0.4, "damping", damping_advice},
    {"modal", "others", 1e-3, 0.4, "damping", damping_advice},
    {"isolator", "capacity", 0.01, 3, "isolator", "a length without a unit is in m; type a unit, as in 350 mm"},
    {"isolator_friction_pendulum", "radius", 0.2, 30, "isolator",
     "a length without a unit is in m; type a unit, as in 2 m"},
    {"isolator_friction_pendulum", "friction", 1e-3, 0.5, "isolator", "it is a coefficient; type it as 6 % or 0.06"},
    {"grid", "storey_height", 0.3, 50, "height", height_advice},
    {"shear_building", "height", 0.3, 50, "height", height_advice},
    {"grid", "bay_width", 0.3, 300, "height", "a length without a unit is in m; type a unit, as in 6000 mm"},
    {"bay_width", "x", 0.3, 300, "height", "a length without a unit is in m; type a unit, as in 6000 mm"},
    {"bay_width", "y", 0.3, 300, "height", "a length without a unit is in m; type a unit, as in 6000 mm"},
    {"links", "friction", 0, 2, "friction", "it is a coefficient; type it as 40 % or 0.4"},
    {"friction", "coefficient", 0, 2, "friction", "it is a coefficient; type it as 40 % or 0.4"},
    {"friction", "static", 0, 2, "friction", "it is a coefficient; type it as 40 % or 0.4"},
    {"links", "level_within", 0, 2, "height", "a length without a unit is in m; type a unit, as in 50 mm"},
    {"displacement_harmonic", "amplitude", 0, 5, "amplitude",
     "a length without a unit is in m; type a unit, as in 20 mm"},
    {"displacement_sum", "amplitude", 0, 5, "amplitude", "a length without a unit is in m; type a unit, as in 20 mm"},
};

// Accelerations without a unit whose values are typical in g: PGA of strong motion, and amplitudes below 1 m/s^2.
struct InGravity {
  std::string_view section, key;
  double low, high;
};

constexpr InGravity usual_in_gravity[] = {{"ground_motion", "pga", 0.02, 1.5}, {"motion", "pga", 0.02, 1.5},
                                          {"synthetic", "pga", 0.02, 1.5},     {"harmonic", "amplitude", 0.05, 0.99},
                                          {"sum", "amplitude", 0.05, 0.99},    {"pulse", "amplitude", 0.05, 0.99}};

// A bound in the unit of the number: "1 t", "2".
std::string quoted(double value, const keys::Key& spec) {
  return spec.dimension == dimension::none ? fmt::format("{:g}", value) : format_quantity(value, spec.dimension);
}

class Warnings {
 public:
  void visit(const Input& node, const keys::Section& section) {
    for (const auto& [key, child] : node.entries()) {
      const keys::Key* const spec = section.find(key);
      if (!spec) continue;
      const bool named = spec->form == keys::Form::named || spec->form == keys::Form::named_lists;
      if (named && child.is_map())
        for (const auto& [name, value] : child.entries()) visit_value(value, section, *spec);
      else
        visit_value(child, section, *spec);
    }
  }

  // One warning per kind of number, so that a mistake repeated in many buildings is reported once.
  std::vector<Warning> all() const {
    std::vector<Warning> warnings;
    for (const Found& found : found_)
      warnings.push_back({std::string(found.name), found.count == 1
                                                       ? found.text
                                                       : fmt::format("{} (and {} more)", found.text, found.count - 1)});
    return warnings;
  }

 private:
  struct Found {
    const void* rule;
    std::string_view name;
    std::string text;
    int count;
  };

  void visit_value(const Input& value, const keys::Section& section, const keys::Key& spec) {
    if (value.is_list()) {
      for (const Input& item : value.items()) visit_value(item, section, spec);
    } else if (value.is_map()) {
      const auto entries = value.entries();
      // A map is either a section, or has one value per storey.
      if (spec.inside &&
          std::ranges::any_of(entries, [&](const auto& entry) { return spec.inside->find(entry.first); }))
        visit(value, *spec.inside);
      else
        for (const auto& [key, child] : entries) visit_value(child, section, spec);
    } else if (value.is_scalar() && spec.takes == keys::Takes::quantity) {
      visit_number(value, section, spec);
    }
  }

  void visit_number(const Input& value, const keys::Section& section, const keys::Key& spec) {
    const std::string text = value.as_text();
    double number = 0;
    const bool is_bare = parse_number(text, number);
    for (const InGravity& rule : usual_in_gravity)
      if (is_bare && rule.section == section.name && rule.key == spec.key && number >= rule.low && number <= rule.high)
        add(&rule, "pga",
            fmt::format("{}: {} without a unit is in m/s^2, which is {:.3g} g; did you mean {} g? Type a unit",
                        value.path(), text, number / standard_gravity, text));
    for (const Usual& rule : usual_values) {
      if (rule.section != section.name || rule.key != spec.key) continue;
      if (!is_bare) number = parse_quantity(text, spec.dimension);
      if (number == 0 || (number >= rule.low && number <= rule.high)) continue;
      const bool is_low = number < rule.low;
      add(&rule, rule.name,
          fmt::format("{}: {} is {} {}; {}", value.path(), text, is_low ? "below" : "above",
                      quoted(is_low ? rule.low : rule.high, spec), rule.advice));
    }
  }

  void add(const void* rule, std::string_view name, std::string text) {
    const auto known = std::ranges::find(found_, rule, &Found::rule);
    if (known != found_.end())
      ++known->count;
    else
      found_.push_back({rule, name, std::move(text), 1});
  }

  std::vector<Found> found_;
};

}  // namespace

std::vector<Warning> doubtful_numbers(const Input& input) {
  Warnings warnings;
  warnings.visit(input, keys::model);
  return warnings.all();
}

}  // namespace pounding
