#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/devices.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/yielding_keys.hpp>
#include <pounding/structures/bar_and_damper.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view axes[] = {"along", "x", "y", "z"};

constexpr Key between_key{
    .key = "between",
    .takes = Takes::text,
    .form = Form::list,
    .minimum = 2,
    .maximum = 2,
    .inside = &link_end,
    .need = Need::required,
    .since = "0.2.0",
    .meaning =
        "The two structures, the left one first, with their ends as links name them: A.3 is floor 3 of A. Two nodes of "
        "frames "
        "are joined along the line between them; all other ends along the horizontal axis of a link.",
    .example = "[left, right]"};
constexpr Key own_between_key{.key = "between",
                              .takes = Takes::text,
                              .form = Form::list,
                              .minimum = 2,
                              .maximum = 2,
                              .need = Need::exactly_one,
                              .since = "0.2.0",
                              .meaning =
                                  "Its two ends: nodes of a frame, floors of a shear building by their numbers, or "
                                  "ground. It gets longer where the second moves "
                                  "away from the first along the axis.",
                              .example = "[ground, 1]"};
constexpr Key storey_key{.key = "storey",
                         .takes = Takes::integer,
                         .bounds = {.low = 1, .high = 1000},
                         .need = Need::exactly_one,
                         .since = "0.2.0",
                         .meaning = "The storey of a shear building in which it stands, from 1 at the lowest.",
                         .example = "1"};
constexpr Key axis_key{.key = "axis",
                       .takes = Takes::choice,
                       .choices = axes,
                       .noun = "axis",
                       .otherwise = "along between two nodes, else x",
                       .since = "0.2.0",
                       .meaning = "Direction in which it acts: along the line between its two nodes, or x, y or z.",
                       .example = "x"};
constexpr Key bar_key{.key = "bar",
                      .inside = &bar,
                      .need = Need::at_least_one,
                      .since = "0.2.0",
                      .meaning =
                          "An elastic bar, which pulls and pushes: force = stiffness times elongation. Gravity and "
                          "preloads leave it undeformed.",
                      .example = "{stiffness: 50 MN/m}"};
constexpr Key damper_key{.key = "damper",
                         .inside = &damper,
                         .need = Need::at_least_one,
                         .since = "0.2.0",
                         .meaning =
                             "A viscous damper, beside the bar or the law where there is one: force = c |v|^a sign "
                             "v, with the rate of elongation v.",
                         .example = "{coefficient: 200 kN s/m}"};

/// The words of devices and of their laws of yielding.
struct OfDevices : YieldingKeys {
  std::vector<Key> between{between_key, bar_key}, within{own_between_key, storey_key, axis_key, bar_key};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& own = more_keys();
    Example example;
    for (const auto& parameter : L::parameters) {
      Key& spec = own.emplace_back(key_of(parameter, made));
      if (parameter.info.unit == "N/m") spec.example = kept(fmt::format("{:g} MN/m", parameter.info.typical / 1e6));
      if (spec.need == Need::required) example.add(spec);
    }
    add_choices(made, own);
    const Section& section =
        add_section({.name = kept(fmt::format("device_{}", L::name)),
                     .place = kept(fmt::format("devices.NAME.{}", L::name)),
                     .meaning = kept(fmt::format("{}: {}. d is the elongation.", capital(L::summary), L::shape)),
                     .keys = own});
    const Key spec{
        .key = L::name,
        .inside = &section,
        .need = Need::at_least_one,
        .since = "0.2.0",
        .meaning = kept(fmt::format(
            "It yields by this law, instead of a bar: {}. Gravity and preloads leave it undeformed.", L::summary)),
        .example = kept(example.text())};
    between.push_back(spec);
    within.push_back(spec);
  }
};

const OfDevices& devices() {
  static const OfDevices all = [] {
    OfDevices made;
    EachLaw<hysteresis::AnyLaw>::visit([&made]<class L>(const L& law) {
      // A device has a stiffness and yields both ways.
      const bool has_stiffness =
          std::ranges::any_of(L::parameters, [](const auto& parameter) { return parameter.info.name == "stiffness"; });
      if (has_stiffness && hysteresis::Entry::of<L>().is_symmetric) made.add(law);
    });
    made.between.push_back(damper_key);
    made.within.push_back(damper_key);
    return made;
  }();
  return all;
}

constexpr Key bar_keys[] = {
    {.key = "stiffness",
     .takes = Takes::quantity,
     .dimension = dimension::stiffness,
     .bounds = bounds::positive,
     .need = Need::exactly_one,
     .since = "0.2.0",
     .meaning = "Stiffness of the bar.",
     .example = "50 MN/m"},
    {.key = "E",
     .takes = Takes::quantity,
     .dimension = dimension::stress,
     .bounds = bounds::positive,
     .need = Need::exactly_one,
     .since = "0.2.0",
     .meaning = "Young's modulus: the stiffness is E area/length, with the length that is drawn between two frames.",
     .example = "210 GPa"},
    {.key = "area",
     .takes = Takes::quantity,
     .dimension = dimension::area,
     .bounds = bounds::positive,
     .since = "0.2.0",
     .meaning = "Area of the section, beside E.",
     .example = "20 cm^2"}};

constexpr Key damper_keys[] = {
    {.key = "coefficient",
     .takes = Takes::quantity,
     .dimension = dimension::damping,
     .unit = "N (s/m)^a",
     .bounds = bounds::positive,
     .need = Need::required,
     .since = "0.2.0",
     .meaning = "Coefficient c: the force at 1 m/s. With another exponent than 1 its unit follows: 200 kN (s/m)^0.35.",
     .example = "200 kN s/m"},
    {.key = "exponent",
     .takes = Takes::quantity,
     .bounds = {.low = Damper::min_exponent, .high = Damper::largest_exponent},
     .otherwise = "1",
     .since = "0.2.0",
     .meaning = "Exponent a of the velocity; 1 is linear.",
     .example = "1"},
    {.key = "rounding_velocity",
     .takes = Takes::quantity,
     .dimension = dimension::velocity,
     .bounds = bounds::positive,
     .otherwise = "1 mm/s; none beside a stiffness",
     .since = "0.2.0",
     .meaning = "Velocity v0 that rounds the force near v = 0 where the exponent is not 1: c v (v^2 + v0^2)^((a-1)/2).",
     .example = "1 mm/s"},
    {.key = "stiffness",
     .takes = Takes::quantity,
     .dimension = dimension::stiffness,
     .bounds = bounds::positive,
     .otherwise = "rigid",
     .since = "0.2.0",
     .meaning = "Stiffness k of what the damper stands in series with, its brace and its fluid (a Maxwell element): "
                "df/dt = k (v - (|f|/c)^(1/a) "
                "sign f). The exponent is at most 1.",
     .example = "40 MN/m"}};

}  // namespace

const Section device{
    .name = "devices",
    .place = "devices.NAME",
    .meaning = "A bar or what yields by a law, a damper, or both beside each other between two structures.",
    .keys = devices().between};
const Section own_device{
    .name = "devices_within",
    .place = "structures.NAME.shear_building.devices.NAME",
    .meaning =
        "The same inside one structure: an oscillator, a shear building or a frame. Damping ratios are those of the "
        "structure without its devices.",
    .keys = devices().within};
constinit const Section bar{.name = "bar", .place = "devices.NAME.bar", .meaning = "An elastic bar.", .keys = bar_keys};
constinit const Section damper{
    .name = "damper", .place = "devices.NAME.damper", .meaning = "A viscous damper.", .keys = damper_keys};

std::vector<const Section*> laws_of_devices() { return devices().sections(); }

}  // namespace pounding::keys
