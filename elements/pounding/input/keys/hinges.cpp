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

constexpr Key at_key{.key = "at",
                     .takes = Takes::choice,
                     .choices = places,
                     .noun = "end of a member",
                     .need = Need::required,
                     .since = "0.2.0",
                     .meaning =
                         "Which ends of the member: feet are those at nodes that the ground holds. A member that is "
                         "cut into parts has its "
                         "two outer ends.",
                     .example = "both"};
constexpr Key hinge_axis_key{
    .key = "axis",
    .takes = Takes::choice,
    .choices = hinge_axes,
    .noun = "axis",
    .otherwise = "y in the plane; in space it must be given",
    .since = "0.2.0",
    .meaning =
        "Local axis that the member bends about, see reference. both are two hinges that do not know of each other.",
    .example = "y"};
constexpr Key moment_key{
    .key = "yield_moment",
    .takes = Takes::quantity,
    .form = Form::one_or_list,
    .minimum = 2,
    .maximum = 2,
    .dimension = dimension::energy,
    .bounds = bounds::any,
    .noun = "a moment",
    .since = "0.2.0",
    .meaning = "Moment at which the end yields: one, or two, [sagging, -hogging]. A beam sags with tension below.",
    .example = "210 kN m"};
constexpr Key ultimate_key{.key = "ultimate_rotation",
                           .takes = Takes::quantity,
                           .bounds = bounds::positive,
                           .otherwise = "none",
                           .since = "0.2.0",
                           .meaning = "Plastic rotation that the end can bear, for reports [rad].",
                           .example = "0.04"};

constexpr Key hinge_hardening_key{
    .key = "hardening",
    .takes = Takes::quantity,
    .bounds = bounds::from_0_below_1,
    .otherwise = "0",
    .since = "0.2.0",
    .meaning =
        "Ratio of the member end: fraction of its stiffness that the member keeps when both ends yield in double "
        "curvature. At a "
        "joint where all ends yield and keep nothing, each keeps 1e-8, so that the joint does not turn without end.",
    .example = "3 %"};
constexpr std::string_view spring_hardening = "spring_hardening";

Key rigid(Key spec) {
  spec.otherwise = "that of the law, where there is one";
  return spec;
}

Key hinge_of_series(Key spec) {
  spec.otherwise = "0, or by spring_hardening";
  return spec;
}

Key required(Key spec) {
  spec.need = Need::required;
  return spec;
}

/// The words of the hinges and of the laws of springs in series.
struct OfHinges : YieldingKeys {
  std::vector<Key> own{at_key, hinge_axis_key, rigid(moment_key), hinge_hardening_key, ultimate_key};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& of_law = more_keys();
    of_law.push_back(required(moment_key));
    of_law.push_back(
        {.key = "stiffness",
         .takes = Takes::quantity,
         .dimension = dimension::energy,
         .bounds = bounds::positive,
         .noun = "a moment per radian",
         .otherwise = "10 x 6EI/L",
         .since = "0.2.0",
         .meaning =
             "First stiffness of the spring between the member and its node [N m/rad]. Give it or stiffness_factor.",
         .example = "900 MN m"});
    of_law.push_back({.key = "stiffness_factor",
                      .takes = Takes::quantity,
                      .bounds = bounds::positive,
                      .otherwise = "10",
                      .since = "0.2.0",
                      .meaning = "The same as a multiple of 6EI/L of the member.",
                      .example = "10"});
    of_law.push_back(hinge_of_series(hinge_hardening_key));
    for (const auto& parameter : L::parameters)
      if (const std::string_view name = parameter.info.name; name != "stiffness" && !name.ends_with("yield_force"))
        of_law.push_back(key_of(parameter, made));
    add_choices(made, of_law);
    const Section& section = add_section(
        {.name = kept(fmt::format("hinge_{}", L::name)),
         .place = kept(fmt::format("structures.NAME.frame.hinges.NAME.{}", L::name)),
         .meaning = kept(fmt::format("{}: {}. Forces are moments, deformations rotations.", L::shape, L::summary)),
         .keys = of_law});
    own.push_back({.key = L::name,
                   .inside = &section,
                   .otherwise = "rigid-plastic",
                   .since = "0.2.0",
                   .meaning = kept(fmt::format(
                       "A spring in series with the member, instead of a rigid-plastic hinge: {}.", L::summary)),
                   .example = "{yield_moment: 210 kN m}"});
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
    Key spec{.key = kept(in_moments(std::string(info.name))),
             .takes = Takes::quantity,
             .dimension = parse_unit_dimension(unit),
             .bounds = bounds::any,
             .need = info.need == hysteresis::Need::required ? Need::required : Need::optional,
             .since = "0.2.0",
             .meaning = kept(in_moments(fmt::format("{}.", capital(info.meaning)))),
             .example = shown(info.typical)};
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

const Section hinge{.name = "hinges",
                    .place = "structures.NAME.frame.hinges.NAME",
                    .meaning =
                        "Ends of members that yield in bending: of one member by its name, or of beams (all level "
                        "members) or columns (all "
                        "upright ones). What is said of one member counts before what is said of all.",
                    .keys = hinges().own};

std::vector<const Section*> laws_of_hinges() { return hinges().sections(); }

}  // namespace pounding::keys
