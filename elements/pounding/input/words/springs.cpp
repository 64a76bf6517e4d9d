#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/words/springs.hpp>
#include <pounding/input/words/yielding_words.hpp>

namespace pounding::words {
namespace {

/// The words of the laws by which storeys yield. The stiffness is that of the storey.
struct OfLaws : YieldingWords {
  std::vector<Word> by_name;

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Word>& own = more_words();
    Example example;
    for (const auto& parameter : L::parameters) {
      if (parameter.info.name == "stiffness") continue;
      Word& word = own.emplace_back(word_of(parameter, made));
      word.form = Form::one_or_each;
      word.meaning =
          kept(fmt::format("{}: one for all storeys, or a list from the ground up.", capital(parameter.info.meaning)));
      if (word.need == Need::required) example.add(word);
    }
    add_choices(made, own);
    const Section& section =
        add_section({.name = L::name,
                     .place = kept(fmt::format("structures.NAME.shear_building.spring.{}", L::name)),
                     .meaning = kept(fmt::format("{}: {}.", capital(L::summary), L::shape)),
                     .words = own});
    by_name.push_back({.key = L::name,
                       .inside = &section,
                       .need = Need::exactly_one,
                       .since = "0.2.0",
                       .meaning = kept(fmt::format("The storeys follow this law: {}.", L::summary)),
                       .example = kept(example.text())});
  }
};

const OfLaws& laws() {
  static const OfLaws all = [] {
    OfLaws made;
    EachLaw<hysteresis::AnyLaw>::visit([&made]<class L>(const L& law) {
      // A storey has a stiffness and yields both ways.
      const bool has_stiffness =
          std::ranges::any_of(L::parameters, [](const auto& parameter) { return parameter.info.name == "stiffness"; });
      if (has_stiffness && hysteresis::Entry::of<L>().is_symmetric) made.add(law);
    });
    return made;
  }();
  return all;
}

}  // namespace

const Section storey_spring{
    .name = "spring",
    .place = "structures.NAME.shear_building.spring",
    .meaning = "The law by which storeys yield, by its name. Its stiffness is that of the storey.",
    .words = laws().by_name};

std::vector<const Section*> laws_of_springs() { return laws().sections(); }

}  // namespace pounding::words
