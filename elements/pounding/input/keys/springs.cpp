#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/springs.hpp>
#include <pounding/input/keys/yielding_keys.hpp>

namespace pounding::keys {
namespace {

/// The words of the laws by which storeys yield. The stiffness is that of the storey.
struct OfLaws : YieldingKeys {
  std::vector<Key> by_name;

  template <hysteresis::Law L>
  void add(const L& made) {
    std::vector<Key>& own = more_keys();
    Example example;
    for (const auto& parameter : L::parameters) {
      if (parameter.info.name == "stiffness") continue;
      Key& spec = own.emplace_back(key_of(parameter, made));
      spec.form = Form::one_or_each;
      spec.meaning =
          kept(fmt::format("{}: one for all storeys, or a list from the ground up.", capital(parameter.info.meaning)));
      if (spec.need == Need::required) example.add(spec);
    }
    add_choices(made, own);
    const Section& section =
        add_section({.name = L::name,
                     .place = kept(fmt::format("structures.NAME.shear_building.spring.{}", L::name)),
                     .meaning = kept(fmt::format("{}: {}.", capital(L::summary), L::shape)),
                     .keys = own});
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
    .keys = laws().by_name};

std::vector<const Section*> laws_of_springs() { return laws().sections(); }

}  // namespace pounding::keys
