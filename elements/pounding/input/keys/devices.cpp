#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/yielding_keys.hpp>
#include <pounding/structures/bar_and_damper.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view axes[] = {"along", "x", "y", "z"};

constexpr Key between_key(
    "between", text().or_map(link_end).list(2), required,
    "The two ends, the left structure first, in the notation of links: A.3 is floor 3 of A. Two frame nodes are "
    "connected along the line between them, all other ends along the horizontal axis of a link.",
    "[left, right]", "0.2.0");
constexpr Key own_between_key("between", text().list(2), exactly_one,
                              "The two ends: nodes of a frame, floor numbers of a shear building, or ground. "
                              "Elongation is positive if the second end moves away from the first along the axis.",
                              "[ground, 1]", "0.2.0");
constexpr Key storey_key("storey", integer(1, 1000), exactly_one,
                         "Storey of a shear building that contains the device; 1 is the lowest.", "1", "0.2.0");
constexpr Key axis_key("axis", choice(axes, "axis"), otherwise("along for two nodes, else x"),
                       "Direction of the force: along the line between the two nodes, or x, y or z.", "x", "0.2.0");
constexpr Key bar_key("bar", map(bar), at_least_one,
                      "Elastic bar in tension and compression: force = stiffness times elongation. It is undeformed "
                      "under gravity and preloads.",
                      "{stiffness: 50 MN/m}", "0.2.0");
constexpr Key damper_key("damper", map(damper), at_least_one,
                         "Viscous damper, in parallel with the bar or the hysteretic law if given: force = c |v|^a "
                         "sign v, with the rate of elongation v.",
                         "{coefficient: 200 kN s/m}", "0.2.0");

/// Keys of devices and of their hysteretic laws.
struct OfDevices : YieldingKeys {
  std::vector<Key> between{between_key, bar_key}, within{own_between_key, storey_key, axis_key, bar_key};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& own = more_keys();
    Example example;
    for (const auto& parameter : L::parameters) {
      Key& spec = own.emplace_back(key_of(parameter, made));
      if (parameter.info.unit == "N/m") spec.example = kept(fmt::format("{:g} MN/m", parameter.info.typical / 1e6));
      if (parameter.info.name == "slack") spec.example = "20 mm";
      if (spec.need == Need::required) example.add(spec);
    }
    add_choices(made, own);
    const Section& section =
        add_section({kept(fmt::format("device_{}", L::name)), kept(fmt::format("devices.NAME.{}", L::name)),
                     kept(fmt::format("{}: {}. d is the elongation.", capital(L::summary), L::shape)), own});
    const Key spec{
        L::name,
        map(section),
        at_least_one,
        kept(fmt::format("Hysteretic law instead of a bar: {}. The device is undeformed under gravity and preloads.",
                         L::summary)),
        kept(example.text()),
        "0.2.0"};
    between.push_back(spec);
    within.push_back(spec);
  }
};

const OfDevices& devices() {
  static const OfDevices all = [] {
    OfDevices made;
    EachLaw<hysteresis::AnyLaw>::visit([&made]<class L>(const L& law) {
      // Symmetric laws with a stiffness apply to devices, and restrainers.
      const bool has_stiffness =
          std::ranges::any_of(L::parameters, [](const auto& parameter) { return parameter.info.name == "stiffness"; });
      if ((has_stiffness && hysteresis::Entry::of<L>().is_symmetric) || std::is_same_v<L, hysteresis::Restrainer>)
        made.add(law);
    });
    made.between.push_back(damper_key);
    made.within.push_back(damper_key);
    return made;
  }();
  return all;
}

constexpr Key bar_keys[] = {
    {"stiffness", quantity(dimension::stiffness, bounds::positive), exactly_one, "Stiffness of the bar.", "50 MN/m",
     "0.2.0"},
    {"E", quantity(dimension::stress, bounds::positive), exactly_one,
     "Young's modulus. The stiffness is E area/length, with the distance between the two frame nodes as the length.",
     "210 GPa", "0.2.0"},
    {"area", quantity(dimension::area, bounds::positive), optional, "Cross-sectional area; requires E.", "20 cm^2",
     "0.2.0"},
};

constexpr Key damper_keys[] = {
    {"coefficient", quantity(dimension::damping, bounds::positive).in("N (s/m)^a"), required,
     "Coefficient c: force at 1 m/s. Its unit depends on the exponent: 200 kN (s/m)^0.35.", "200 kN s/m", "0.2.0"},
    {"exponent", number(Damper::min_exponent, Damper::largest_exponent), otherwise("1"),
     "Exponent a of the velocity; 1 is linear.", "1", "0.2.0"},
    {"rounding_velocity", quantity(dimension::velocity, bounds::positive), otherwise("1 mm/s; none with a stiffness"),
     "Velocity v0 that smooths the force near v = 0 if the exponent is not 1: c v (v^2 + v0^2)^((a-1)/2).", "1 mm/s",
     "0.2.0"},
    {"stiffness", quantity(dimension::stiffness, bounds::positive), otherwise("rigid"),
     "Stiffness k in series with the damper, of its brace and fluid (Maxwell element): df/dt = k (v - (|f|/c)^(1/a) "
     "sign f).",
     "40 MN/m", "0.2.0"},
};

}  // namespace

const Section device{"devices", "devices.NAME",
                     "Device between two structures: a bar or a hysteretic law, a damper, or both in parallel.",
                     devices().between};
const Section own_device{"devices_within", "structures.NAME.shear_building.devices.NAME",
                         "Device inside one structure: an oscillator, a shear building or a frame. Damping ratios "
                         "refer to the structure without devices.",
                         devices().within};
constinit const Section bar{"bar", "devices.NAME.bar", "Elastic bar.", bar_keys};
constinit const Section damper{"damper", "devices.NAME.damper", "Viscous damper.", damper_keys};

std::vector<const Section*> laws_of_devices() { return devices().sections(); }

}  // namespace pounding::keys
