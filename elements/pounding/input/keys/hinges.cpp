#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/hinges.hpp>
#include <pounding/input/keys/yielding_keys.hpp>
#include <pounding/structures/make_spring.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view places[] = {"start", "end", "both", "feet"};
constexpr std::string_view hinge_axes[] = {"y", "z", "both"};

constexpr Key at_key{"at",
                     choice(places, "end of a member"),
                     required,
                     "Which ends of the member: feet are those at nodes that the ground holds. A member that is cut "
                     "into parts has its two outer ends.",
                     "both",
                     "0.2.0"};
constexpr Key hinge_axis_key{
    "axis",
    choice(hinge_axes, "axis"),
    otherwise("y in the plane; in space it must be given"),
    "Local axis that the member bends about, see reference. both are two hinges that do not know of each other.",
    "y",
    "0.2.0"};
constexpr Key moment_key{
    "yield_moment", quantity(dimension::energy).called("a moment").or_list(2),
    optional,       "Moment at which the end yields: one, or two, [sagging, -hogging]. A beam sags with tension below.",
    "210 kN m",     "0.2.0"};
constexpr Key ultimate_key{"ultimate_rotation",
                           number(bounds::positive),
                           otherwise("none"),
                           "Plastic rotation that the end can bear, for reports [rad].",
                           "0.04",
                           "0.2.0"};

constexpr Key hinge_hardening_key{"hardening",
                                  number(bounds::from_0_below_1),
                                  otherwise("0"),
                                  "Ratio of the member end: fraction of its stiffness that the member keeps when both "
                                  "ends yield in double curvature. At a joint where all ends yield and keep nothing, "
                                  "each keeps 1e-8, so that the joint does not turn without end.",
                                  "3 %",
                                  "0.2.0"};
constexpr std::string_view spring_hardening = "spring_hardening";

Key rigid(Key spec) {
  spec.otherwise = "that of the law, where there is one";
  return spec;
}

Key hinge_of_series(Key spec) {
  spec.otherwise = "0, or by spring_hardening";
  return spec;
}

/// The words of the hinges and of the laws of springs in series.
struct OfHinges : YieldingKeys {
  std::vector<Key> own{at_key, hinge_axis_key, rigid(moment_key), hinge_hardening_key, ultimate_key};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& of_law = more_keys();
    of_law.push_back(moment_key);
    of_law.back().need = required;
    of_law.push_back(
        {"stiffness", quantity(dimension::energy, bounds::positive).called("a moment per radian"),
         otherwise("10 x 6EI/L"),
         "First stiffness of the spring between the member and its node [N m/rad]. Give it or stiffness_factor.",
         "900 MN m", "0.2.0"});
    of_law.push_back({"stiffness_factor", number(bounds::positive), otherwise("10"),
                      "The same as a multiple of 6EI/L of the member.", "10", "0.2.0"});
    of_law.push_back(hinge_of_series(hinge_hardening_key));
    for (const auto& parameter : L::parameters)
      if (const std::string_view name = parameter.info.name; name != "stiffness" && !name.ends_with("yield_force"))
        of_law.push_back(key_of(parameter, made));
    add_choices(made, of_law);
    const Section& section = add_section(
        {kept(fmt::format("hinge_{}", L::name)), kept(fmt::format("structures.NAME.frame.hinges.NAME.{}", L::name)),
         kept(fmt::format("{}: {}. Forces are moments, deformations rotations.", L::shape, L::summary)), of_law});
    own.push_back(
        {L::name, map(section), otherwise("rigid-plastic"),
         kept(fmt::format("A spring in series with the member, instead of a rigid-plastic hinge: {}.", L::summary)),
         "{yield_moment: 210 kN m}", "0.2.0"});
  }

 private:
  // Forces are moments here, deformations rotations.
  static std::string_view turned(std::string_view unit) {
    if (unit == "N" || unit == "N/m") return "N m";
    return unit == "m" ? std::string_view() : unit;
  }

  template <class Parameter, class L>
  Key key_of(const Parameter& parameter, const L& made) {
    const hysteresis::ParameterInfo& info = parameter.info;
    const std::string_view unit = turned(info.unit);
    const auto shown = [&](double value) {
      return kept(fmt::format("{:g}{}{}", value, unit.empty() ? "" : " ", unit));
    };
    Key spec{kept(in_moments(std::string(info.name))),
             quantity(parse_unit_dimension(unit)),
             info.need == hysteresis::Need::required ? required : optional,
             kept(in_moments(fmt::format("{}.", capital(info.meaning)))),
             shown(info.typical),
             "0.2.0"};
    if (spec.key == spring_hardening) {
      spec.bounds = bounds::from_0_below_1;
      spec.since = "0.3.0";
      spec.otherwise = "by hardening";
      spec.meaning =
          "Ratio of the bare spring, instead of hardening: fraction of its first stiffness that it keeps after "
          "yielding.";
    } else if (spec.need == Need::optional)
      spec.otherwise = parameter.value ? shown(made.*parameter.value) : std::string_view("what the others say");
    return spec;
  }
};

const OfHinges& hinges() {
  static const OfHinges all = [] {
    OfHinges made;
    EachLaw<hysteresis::AnyLaw>::visit([&made]<class L>(const L& law) {
      // A law without a yield force is no law of a moment.
      if (std::ranges::any_of(L::parameters,
                              [](const auto& parameter) { return parameter.info.name == "yield_force"; }))
        made.add(law);
    });
    return made;
  }();
  return all;
}

}  // namespace

const Section hinge{"hinges", "structures.NAME.frame.hinges.NAME",
                    "Ends of members that yield in bending: of one member by its name, or of beams (all level members) "
                    "or columns (all upright ones). What is said of one member counts before what is said of all.",
                    hinges().own};

std::vector<const Section*> laws_of_hinges() { return hinges().sections(); }

}  // namespace pounding::keys
