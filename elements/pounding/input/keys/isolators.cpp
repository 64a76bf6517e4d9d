#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/isolators.hpp>
#include <pounding/input/keys/yielding_keys.hpp>

namespace pounding::keys {
namespace {

constexpr Key rate_key{"rate",
                       quantity({0, -1, 1}, bounds::positive).in("s/m"),
                       otherwise("none"),
                       "How fast the friction comes from the slow coefficient to the fast one as the velocity grows.",
                       "60 s/m",
                       "0.2.0"};

/// The words of the laws of isolators: of all laws that yield both ways.
struct OfIsolators : YieldingKeys {
  std::vector<Key> own{
      {"capacity", quantity(dimension::length, bounds::positive), otherwise("none"),
       "Deformation that it can bear. Nothing happens there, but a run that goes beyond says so.", "350 mm", "0.2.0"},
      {"coupled", boolean(), otherwise("true in space, where it is refused"),
       "false lets an isolator of a frame in space follow its law along x and along y, each by itself, which carries "
       "up to 1.41 times too much along a diagonal. Laws of both at once are not there yet.",
       "false", "0.2.0"}};

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& of_law = more_keys();
    Example example;
    for (const auto& parameter : L::parameters) {
      of_law.push_back(key_of(parameter, made));
      if (of_law.back().need == Need::required || parameter.info.need == hysteresis::Need::instead)
        example.add(of_law.back());
    }
    if (L::name == "friction_pendulum") of_law.push_back(rate_key);
    add_choices(made, of_law);
    const Section& section = add_section({kept(fmt::format("isolator_{}", L::name)),
                                          kept(fmt::format("structures.NAME.frame.supports.NODE.isolator.{}", L::name)),
                                          kept(fmt::format("{}: {}.", capital(L::summary), L::shape)), of_law});
    own.push_back({L::name, map(section), exactly_one, kept(fmt::format("It follows this law: {}.", L::summary)),
                   kept(example.text()), "0.2.0"});
  }

 private:
  template <class Parameter, class L>
  Key key_of(const Parameter& parameter, const L& made) {
    Key spec = YieldingKeys::key_of(parameter, made);
    if (spec.key == "friction") {
      spec.form = Form::one_or_list;
      spec.minimum = spec.maximum = 2;
      spec.meaning =
          "Coefficient of friction mu, or two, [slow, fast], with rate: mu = fast - (fast - slow) exp(-rate |v|).";
    }
    if (spec.key == "weight") {
      spec.need = Need::optional;
      spec.otherwise = "the load at rest";
    }
    return spec;
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
    "isolator", "structures.NAME.frame.supports.NODE.isolator",
    "An isolator under a foot of a frame, or all isolators of a shear building together, by its law.", isolators().own};

std::vector<const Section*> laws_of_isolators() { return isolators().sections(); }

}  // namespace pounding::keys
