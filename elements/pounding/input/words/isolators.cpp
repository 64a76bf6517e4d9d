#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/words/isolators.hpp>
#include <pounding/input/words/yielding_words.hpp>

namespace pounding::words {
namespace {

constexpr Word rate_word{
    .key = "rate",
    .takes = Takes::quantity,
    .dimension = {0, -1, 1},
    .unit = "s/m",
    .bounds = bounds::positive,
    .otherwise = "none",
    .since = "0.2.0",
    .meaning = "How fast the friction comes from the slow coefficient to the fast one as the velocity grows.",
    .example = "60 s/m"};

/// The words of the laws of isolators: of all laws that yield both ways.
struct OfIsolators : YieldingWords {
  std::vector<Word> own{
      {.key = "capacity",
       .takes = Takes::quantity,
       .dimension = dimension::length,
       .bounds = bounds::positive,
       .otherwise = "none",
       .since = "0.2.0",
       .meaning = "Deformation that it can bear. Nothing happens there, but a run that goes beyond says so.",
       .example = "350 mm"},
      {.key = "coupled",
       .takes = Takes::boolean,
       .otherwise = "true in space, where it is refused",
       .since = "0.2.0",
       .meaning = "false lets an isolator of a frame in space follow its law along x and along y, each by itself, "
                  "which carries up to 1.41 times too "
                  "much along a diagonal. Laws of both at once are not there yet.",
       .example = "false"}};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Word>& of_law = more_words();
    Example example;
    for (const auto& parameter : L::parameters) {
      of_law.push_back(word_of(parameter, made));
      if (of_law.back().need == Need::required || parameter.info.need == hysteresis::Need::instead)
        example.add(of_law.back());
    }
    if (L::name == "friction_pendulum") of_law.push_back(rate_word);
    add_choices(made, of_law);
    const Section& section =
        add_section({.name = kept(fmt::format("isolator_{}", L::name)),
                     .place = kept(fmt::format("structures.NAME.frame.supports.NODE.isolator.{}", L::name)),
                     .meaning = kept(fmt::format("{}: {}.", capital(L::summary), L::shape)),
                     .words = of_law});
    own.push_back({.key = L::name,
                   .inside = &section,
                   .need = Need::exactly_one,
                   .since = "0.2.0",
                   .meaning = kept(fmt::format("It follows this law: {}.", L::summary)),
                   .example = kept(example.text())});
  }

 private:
  template <class Parameter, class L>
  Word word_of(const Parameter& parameter, const L& made) {
    Word word = YieldingWords::word_of(parameter, made);
    if (word.key == "friction") {
      word.form = Form::one_or_list;
      word.least = word.most = 2;
      word.meaning =
          "Coefficient of friction mu, or two, [slow, fast], with rate: mu = fast - (fast - slow) exp(-rate |v|).";
    }
    if (word.key == "weight") {
      word.need = Need::optional;
      word.otherwise = "the load at rest";
    }
    return word;
  }
};

const OfIsolators& isolators() {
  static const OfIsolators all = [] {
    OfIsolators made;
    EachLaw<hysteresis::AnyLaw>::visit([&made]<class L>(const L& law) {
      if (hysteresis::Entry::of<L>().is_symmetric) made.add(law);
    });
    return made;
  }();
  return all;
}

}  // namespace

const Section isolator{
    .name = "isolator",
    .place = "structures.NAME.frame.supports.NODE.isolator",
    .meaning = "An isolator under a foot of a frame, or all isolators of a shear building together, by its law.",
    .words = isolators().own};

std::vector<const Section*> laws_of_isolators() { return isolators().sections(); }

}  // namespace pounding::words
