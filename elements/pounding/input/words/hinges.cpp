#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/words/hinges.hpp>
#include <pounding/input/words/yielding_words.hpp>
#include <pounding/structures/make_spring.hpp>

namespace pounding::words {
namespace {

constexpr std::string_view places[] = {"start", "end", "both", "feet"};
constexpr std::string_view hinge_axes[] = {"y", "z", "both"};

constexpr Word at_word{.key = "at",
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
constexpr Word hinge_axis_word{
    .key = "axis",
    .takes = Takes::choice,
    .choices = hinge_axes,
    .noun = "axis",
    .otherwise = "y in the plane; in space it must be given",
    .since = "0.2.0",
    .meaning =
        "Local axis that the member bends about, see reference. both are two hinges that do not know of each other.",
    .example = "y"};
constexpr Word moment_word{
    .key = "yield_moment",
    .takes = Takes::quantity,
    .form = Form::one_or_list,
    .least = 2,
    .most = 2,
    .dimension = dimension::energy,
    .bounds = bounds::any,
    .noun = "a moment",
    .since = "0.2.0",
    .meaning = "Moment at which the end yields: one, or two, [sagging, -hogging]. A beam sags with tension below.",
    .example = "210 kN m"};
constexpr Word ultimate_word{.key = "ultimate_rotation",
                             .takes = Takes::quantity,
                             .bounds = bounds::positive,
                             .otherwise = "none",
                             .since = "0.2.0",
                             .meaning = "Plastic rotation that the end can bear, for reports [rad].",
                             .example = "0.04"};

constexpr Word hinge_hardening_word{
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

Word rigid(Word word) {
  word.otherwise = "that of the law, where there is one";
  return word;
}

Word hinge_of_series(Word word) {
  word.otherwise = "0, or by spring_hardening";
  return word;
}

Word required(Word word) {
  word.need = Need::required;
  return word;
}

/// The words of the hinges and of the laws of springs in series.
struct OfHinges : YieldingWords {
  std::vector<Word> own{at_word, hinge_axis_word, rigid(moment_word), hinge_hardening_word, ultimate_word};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Word>& of_law = more_words();
    of_law.push_back(required(moment_word));
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
    of_law.push_back(hinge_of_series(hinge_hardening_word));
    for (const auto& parameter : L::parameters)
      if (const std::string_view name = parameter.info.name; name != "stiffness" && !name.ends_with("yield_force"))
        of_law.push_back(word_of(parameter, made));
    add_choices(made, of_law);
    const Section& section = add_section(
        {.name = kept(fmt::format("hinge_{}", L::name)),
         .place = kept(fmt::format("structures.NAME.frame.hinges.NAME.{}", L::name)),
         .meaning = kept(fmt::format("{}: {}. Forces are moments, deformations rotations.", L::shape, L::summary)),
         .words = of_law});
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
  Word word_of(const Parameter& parameter, const L& made) {
    const hysteresis::ParameterInfo& info = parameter.info;
    const std::string_view unit = turned(info.unit);
    const auto shown = [&](double value) {
      return kept(fmt::format("{:g}{}{}", value, unit.empty() ? "" : " ", unit));
    };
    Word word{.key = kept(in_moments(std::string(info.name))),
              .takes = Takes::quantity,
              .dimension = parse_unit_dimension(unit),
              .bounds = bounds::any,
              .need = info.need == hysteresis::Need::required ? Need::required : Need::optional,
              .since = "0.2.0",
              .meaning = kept(in_moments(fmt::format("{}.", capital(info.meaning)))),
              .example = shown(info.typical)};
    if (word.key == spring_hardening) {
      word.bounds = bounds::from_0_below_1;
      word.since = "0.3.0";
      word.otherwise = "by hardening";
      word.meaning =
          "Ratio of the bare spring, instead of hardening: fraction of its first stiffness that it keeps after "
          "yielding.";
    } else if (word.need == Need::optional)
      word.otherwise = parameter.value ? shown(made.*parameter.value) : std::string_view("what the others say");
    return word;
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
                    .words = hinges().own};

std::vector<const Section*> laws_of_hinges() { return hinges().sections(); }

}  // namespace pounding::words
