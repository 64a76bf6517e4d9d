#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/yielding_keys.hpp>

namespace pounding::keys {
namespace {

/// Keys of the hysteretic laws of storeys.
struct OfLaws : YieldingKeys {
  std::vector<Key> by_name;

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& own = more_keys();
    Example example;
    for (const auto& parameter : L::parameters) {
      if (parameter.info.name == "stiffness") continue;
      Key& spec = own.emplace_back(key_of(parameter, made));
      if (parameter.info.is_list()) {
        spec.meaning = kept(fmt::format("{}, the same for all storeys.", capital(parameter.info.meaning)));
      } else {
        spec.form = Form::one_or_each;
        spec.meaning = kept(fmt::format("{}: one value for all storeys, or a list from the ground up.",
                                        capital(parameter.info.meaning)));
      }
      if (spec.need == Need::required) example.add(spec);
    }
    add_choices(made, own);
    const Section& section =
        add_section({L::name, kept(fmt::format("structures.NAME.shear_building.spring.{}", L::name)),
                     kept(fmt::format("{}: {}.", capital(L::summary), L::shape)), own});
    by_name.push_back({L::name, map(section), exactly_one,
                       kept(fmt::format("Hysteretic law of the storeys: {}.", L::summary)), kept(example.text()),
                       "0.2.0"});
  }
};

const OfLaws& laws() {
  static const OfLaws all = [] {
    OfLaws made;
    EachLaw<hysteresis::AnyLaw>::visit([&made]<class L>(const L& law) {
      // Only symmetric laws with a stiffness apply to storeys.
      const bool has_stiffness =
          std::ranges::any_of(L::parameters, [](const auto& parameter) { return parameter.info.name == "stiffness"; });
      if (has_stiffness && hysteresis::Entry::of<L>().is_symmetric) made.add(law);
    });
    return made;
  }();
  return all;
}

}  // namespace

const Section storey_spring{"spring", "structures.NAME.shear_building.spring",
                            "Hysteretic law of the storeys, by name. Its stiffness is the storey stiffness.",
                            laws().by_name};

std::vector<const Section*> laws_of_springs() { return laws().sections(); }

}  // namespace pounding::keys
