#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/yielding_keys.hpp>

namespace pounding::keys {
namespace {

constexpr std::string_view places[] = {"start", "end", "both", "feet"};
constexpr std::string_view hinge_axes[] = {"y", "z", "both"};

constexpr Key at_key("at", choice(places, "end of a member"), required,
                     "Ends of the member with a hinge; feet are ends at supported nodes. A subdivided member has "
                     "hinges at its two outer ends only.",
                     "both", "0.2.0");
constexpr Key hinge_axis_key("axis", choice(hinge_axes, "axis"), otherwise("y in the plane; required in space"),
                             "Local bending axis of the hinge, see reference. both gives two uncoupled hinges.", "y",
                             "0.2.0");
constexpr Key moment_key(
    "yield_moment", quantity(dimension::energy).called("a moment").or_list(2), optional,
    "Yield moment: one value, or two, [sagging, -hogging]. A sagging beam has tension at the bottom.", "210 kN m",
    "0.2.0");
constexpr std::string_view of_material[] = {"material"};
constexpr Key strength_key(
    "strength", quantity(dimension::stress, bounds::positive).or_one_of(of_material), optional,
    "Yield strength of steel, instead of yield_moment: the yield moment of each hinge is the plastic modulus of its "
    "section times this strength, without axial force. material: strength of the material of the member.",
    "355 MPa", "0.3.0");
constexpr Key ultimate_key("ultimate_rotation", number(bounds::positive), otherwise("none"),
                           "Ultimate plastic rotation, for reports only [rad].", "0.04", "0.2.0");

constexpr Key hinge_hardening_key(
    "hardening", number(bounds::from_0_below_1), otherwise("0"),
    "Hardening ratio of the member end: ratio of the stiffness of the member after yielding to its elastic stiffness, "
    "with both ends in double curvature. If all ends at a joint yield without hardening, each gets a ratio of 1e-8 to "
    "keep the system regular.",
    "3 %", "0.2.0");
constexpr Key spring_hardening_key(
    "spring_hardening", number(bounds::from_0_below_1), otherwise("by hardening"),
    "Hardening ratio of the spring alone, instead of hardening: ratio of its stiffness after yielding to its initial "
    "stiffness.",
    "0.05", "0.3.0");

Key rigid(Key spec) {
  spec.otherwise = "from the hysteretic law, if given";
  return spec;
}

Key hinge_of_series(Key spec) {
  spec.otherwise = "0, or by spring_hardening";
  return spec;
}

/// Keys of the hinges and of the laws of springs in series.
struct OfHinges : YieldingKeys {
  std::vector<Key> own{at_key,      hinge_axis_key, rigid(moment_key), rigid(strength_key), hinge_hardening_key,
                       ultimate_key};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& of_law = more_keys();
    of_law.push_back(moment_key);
    of_law.back().need = required;
    of_law.push_back({"stiffness", quantity(dimension::energy, bounds::positive).called("a moment per radian"),
                      otherwise("10 x 6EI/L"),
                      "Initial stiffness of the spring between the member and its node [N m/rad]. Give stiffness or "
                      "stiffness_factor, not both.",
                      "900 MN m", "0.2.0"});
    of_law.push_back({"stiffness_factor", number(bounds::positive), otherwise("10"),
                      "Initial stiffness of the spring as a multiple of 6EI/L of the member.", "10", "0.2.0"});
    if constexpr (requires { made.hardening; }) {
      of_law.push_back(hinge_of_series(hinge_hardening_key));
      of_law.push_back(spring_hardening_key);
    }
    Example example;
    example.add(moment_key);
    for (const auto& parameter : L::parameters) {
      if (is_set_by_hinge(parameter)) continue;
      of_law.push_back(key_of(parameter, made));
      if (of_law.back().need == required) example.add(of_law.back());
    }
    add_choices(made, of_law);
    const Section& section = add_section(
        {kept(fmt::format("hinge_{}", L::name)), kept(fmt::format("structures.NAME.frame.hinges.NAME.{}", L::name)),
         kept(fmt::format("{}: {}. Forces are moments and deformations are rotations.", L::shape, L::summary)),
         of_law});
    own.push_back(
        {L::name, map(section), otherwise("rigid-plastic"),
         kept(fmt::format("Spring in series with the member instead of a rigid-plastic hinge: {}.", L::summary)),
         kept(example.text()), "0.2.0"});
  }

 private:
  // Forces are moments here, and deformations are rotations.
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
    Key spec{name_at(hysteresis::Use::hinge, info),
             quantity(parse_unit_dimension(unit)),
             info.need == hysteresis::Need::required ? required : optional,
             kept(fmt::format("{}.", capital(info.meaning))),
             shown(info.typical),
             "0.2.0"};
    if (spec.need == Need::optional)
      spec.otherwise = parameter.value ? shown(made.*parameter.value) : std::string_view("none");
    return spec;
  }
};

const OfHinges& hinges() {
  static const OfHinges all = [] {
    OfHinges made;
    EachLaw<hysteresis::HingeLaw>::visit([&made](const auto& law) { made.add(law); });
    return made;
  }();
  return all;
}

}  // namespace

const Section hinge{"hinges", "structures.NAME.frame.hinges.NAME",
                    "Plastic hinges at the ends of members: of one member by name, of beams (all horizontal members) "
                    "or of columns (all vertical members). The entry of a single member takes precedence.",
                    hinges().own};

std::vector<const Section*> laws_of_hinges() { return hinges().sections(); }

}  // namespace pounding::keys
