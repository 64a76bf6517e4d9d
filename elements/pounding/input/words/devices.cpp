#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/words/devices.hpp>
#include <pounding/input/words/sections.hpp>
#include <pounding/input/words/yielding_words.hpp>
#include <pounding/structures/bar_and_damper.hpp>

namespace pounding::words {
namespace {

constexpr std::string_view axes[] = {"along", "x", "y", "z"};

constexpr Word between_word{
    .key = "between",
    .takes = Takes::text,
    .form = Form::list,
    .least = 2,
    .most = 2,
    .inside = &link_end,
    .need = Need::required,
    .since = "0.2.0",
    .meaning =
        "The two structures, the left one first, with their ends as links name them: A.3 is floor 3 of A. Two nodes of "
        "frames "
        "are joined along the line between them; all other ends along the horizontal axis of a link.",
    .example = "[left, right]"};
constexpr Word own_between_word{.key = "between",
                                .takes = Takes::text,
                                .form = Form::list,
                                .least = 2,
                                .most = 2,
                                .need = Need::exactly_one,
                                .since = "0.2.0",
                                .meaning =
                                    "Its two ends: nodes of a frame, floors of a shear building by their numbers, or "
                                    "ground. It gets longer where the second moves "
                                    "away from the first along the axis.",
                                .example = "[ground, 1]"};
constexpr Word storey_word{.key = "storey",
                           .takes = Takes::integer,
                           .bounds = {.low = 1, .high = 1000},
                           .need = Need::exactly_one,
                           .since = "0.2.0",
                           .meaning = "The storey of a shear building in which it stands, from 1 at the lowest.",
                           .example = "1"};
constexpr Word axis_word{.key = "axis",
                         .takes = Takes::choice,
                         .choices = axes,
                         .noun = "axis",
                         .otherwise = "along between two nodes, else x",
                         .since = "0.2.0",
                         .meaning = "Direction in which it acts: along the line between its two nodes, or x, y or z.",
                         .example = "x"};
constexpr Word bar_word{.key = "bar",
                        .inside = &bar,
                        .need = Need::at_least_one,
                        .since = "0.2.0",
                        .meaning =
                            "An elastic bar, which pulls and pushes: force = stiffness times elongation. Gravity and "
                            "preloads leave it undeformed.",
                        .example = "{stiffness: 50 MN/m}"};
constexpr Word damper_word{.key = "damper",
                           .inside = &damper,
                           .need = Need::at_least_one,
                           .since = "0.2.0",
                           .meaning =
                               "A viscous damper, beside the bar or the law where there is one: force = c |v|^a sign "
                               "v, with the rate of elongation v.",
                           .example = "{coefficient: 200 kN s/m}"};

/// The words of devices and of their laws of yielding.
struct OfDevices : YieldingWords {
  std::vector<Word> between{between_word, bar_word}, within{own_between_word, storey_word, axis_word, bar_word};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Word>& own = more_words();
    Example example;
    for (const auto& parameter : L::parameters) {
      Word& word = own.emplace_back(word_of(parameter, made));
      if (parameter.info.unit == "N/m") word.example = kept(fmt::format("{:g} MN/m", parameter.info.typical / 1e6));
      if (word.need == Need::required) example.add(word);
    }
    add_choices(made, own);
    const Section& section =
        add_section({.name = kept(fmt::format("device_{}", L::name)),
                     .place = kept(fmt::format("devices.NAME.{}", L::name)),
                     .meaning = kept(fmt::format("{}: {}. d is the elongation.", capital(L::summary), L::shape)),
                     .words = own});
    const Word word{
        .key = L::name,
        .inside = &section,
        .need = Need::at_least_one,
        .since = "0.2.0",
        .meaning = kept(fmt::format(
            "It yields by this law, instead of a bar: {}. Gravity and preloads leave it undeformed.", L::summary)),
        .example = kept(example.text())};
    between.push_back(word);
    within.push_back(word);
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
    made.between.push_back(damper_word);
    made.within.push_back(damper_word);
    return made;
  }();
  return all;
}

constexpr Word bar_words[] = {
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

constexpr Word damper_words[] = {
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
     .bounds = {.low = Damper::least_exponent, .high = Damper::largest_exponent},
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
    .words = devices().between};
const Section own_device{
    .name = "devices_within",
    .place = "structures.NAME.shear_building.devices.NAME",
    .meaning =
        "The same inside one structure: an oscillator, a shear building or a frame. Damping ratios are those of the "
        "structure without its devices.",
    .words = devices().within};
constinit const Section bar{
    .name = "bar", .place = "devices.NAME.bar", .meaning = "An elastic bar.", .words = bar_words};
constinit const Section damper{
    .name = "damper", .place = "devices.NAME.damper", .meaning = "A viscous damper.", .words = damper_words};

std::vector<const Section*> laws_of_devices() { return devices().sections(); }

}  // namespace pounding::words
