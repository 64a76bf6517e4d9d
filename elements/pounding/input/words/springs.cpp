#include <algorithm>
#include <deque>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/words/springs.hpp>

namespace pounding::words {
namespace {

/// The words of the laws by which storeys yield, with the texts that they point to. The stiffness is that of the storey.
struct OfLaws {
  std::deque<std::string> texts;
  std::deque<std::vector<Word>> words;
  std::deque<Section> sections;
  std::vector<Word> by_name;

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Word>& own = words.emplace_back();
    std::string example;
    for (const auto& parameter : L::parameters) {
      if (parameter.info.name == "stiffness") continue;
      own.push_back(word_of(parameter, made));
      if (parameter.info.need == hysteresis::Need::required)
        example += fmt::format("{}{}: {}", example.empty() ? "" : ", ", parameter.info.name, own.back().example);
    }
    if constexpr (requires { L::choices; })
      for (const auto& choice : L::choices)
        own.push_back({.key = choice.info.name, .takes = Takes::choice, .choices = choice.info.words,
                       .otherwise = choice.info.words[choice.get(made)], .since = "0.2.0", .meaning = kept(fmt::format("{}.", capital(choice.info.meaning))),
                       .example = choice.info.words.back()});
    sections.push_back({.name = L::name, .place = kept(fmt::format("structures.NAME.shear_building.spring.{}", L::name)),
                        .meaning = kept(fmt::format("{}: {}.", capital(L::summary), L::shape)), .words = own});
    by_name.push_back({.key = L::name, .inside = &sections.back(), .need = Need::exactly_one, .since = "0.2.0",
                       .meaning = kept(fmt::format("The storeys follow this law: {}.", L::summary)),
                       .example = kept(fmt::format("{{{}}}", example))});
  }

 private:
  std::string_view kept(std::string text) { return texts.emplace_back(std::move(text)); }

  // A number in the unit of its table; forces in kN.
  static std::string shown(double value, std::string_view unit) {
    if (unit == "N") return fmt::format("{:g} kN", value / 1e3);
    return fmt::format("{:g}{}{}", value, unit.empty() ? "" : " ", unit);
  }

  template <class Parameter, class L>
  Word word_of(const Parameter& parameter, const L& made) {
    const hysteresis::ParameterInfo& info = parameter.info;
    Word word{.key = info.name, .takes = Takes::quantity, .form = Form::one_or_each, .dimension = parse_unit_dimension(info.unit),
              .unit = info.unit, .bounds = bounds::any,
              .need = info.need == hysteresis::Need::required ? Need::required : Need::optional, .since = "0.2.0",
              .meaning = kept(fmt::format("{}: one for all storeys, or a list from the ground up.", capital(info.meaning))),
              .example = kept(shown(info.typical, info.unit))};
    if (word.need == Need::optional)
      word.otherwise = parameter.value ? kept(shown(made.*parameter.value, info.unit)) : std::string_view("none");
    return word;
  }

  static std::string capital(std::string_view text) {
    std::string all(text);
    if (!all.empty() && all[0] >= 'a' && all[0] <= 'z' && (all.size() < 2 || all[1] != ' ')) all[0] = static_cast<char>(all[0] - 'a' + 'A');
    return all;
  }
};

template <class Any>
struct Adder;
template <class... L>
struct Adder<std::variant<L...>> {
  static void run(OfLaws& laws) { (add<L>(laws), ...); }

 private:
  // A storey has a stiffness and yields both ways.
  template <class One>
  static void add(OfLaws& laws) {
    constexpr bool has_stiffness = std::ranges::find(hysteresis::by_name::infos<One::parameters>, "stiffness", &hysteresis::ParameterInfo::name) !=
                                   hysteresis::by_name::infos<One::parameters>.end();
    if constexpr (has_stiffness && hysteresis::by_name::entry<One>().is_symmetric) laws.add(One{});
  }
};

const OfLaws& laws() {
  static const OfLaws all = [] {
    OfLaws made;
    Adder<hysteresis::AnyLaw>::run(made);
    return made;
  }();
  return all;
}

}  // namespace

const Section storey_spring{.name = "spring", .place = "structures.NAME.shear_building.spring",
                            .meaning = "The law by which storeys yield, by its name. Its stiffness is that of the storey.",
                            .words = laws().by_name};

std::vector<const Section*> laws_of_springs() {
  std::vector<const Section*> all;
  for (const Section& section : laws().sections) all.push_back(&section);
  return all;
}

}  // namespace pounding::words
