#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/keys/sections.hpp>
#include <pounding/input/keys/yielding_keys.hpp>

namespace pounding::keys {
namespace {

constexpr Key rate_key(
    "rate", quantity({0, -1, 1}, bounds::positive).in("s/m"), otherwise("none"),
    "Rate at which the friction coefficient changes from the slow to the fast value with the velocity.", "60 s/m",
    "0.2.0");

/// Keys of the laws of isolators: all symmetric hysteretic laws.
struct OfIsolators : YieldingKeys {
  std::vector<Key> own{
      {"capacity", quantity(dimension::length, bounds::positive), otherwise("none"),
       "Deformation capacity. It does not change the response; a run that exceeds it reports a warning.", "350 mm",
       "0.2.0"},
      {"coupled", boolean(), otherwise("true"),
       "In a frame in space, true gives the isolator the same strength in every horizontal direction, for the laws "
       "bilinear, bouc_wen, friction_pendulum, lead_rubber and elastomeric. false applies the law separately along x "
       "and along y, which overestimates the strength along a diagonal by a factor of up to 1.41.",
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
    own.push_back({L::name, map(section), exactly_one,
                   kept(fmt::format("Hysteretic law of the isolator: {}.", L::summary)), kept(example.text()),
                   "0.2.0"});
  }

 private:
  template <class Parameter, class L>
  Key key_of(const Parameter& parameter, const L& made) {
    Key spec = YieldingKeys::key_of(parameter, made);
    if (spec.key == "friction") {
      spec.form = Form::one_or_list;
      spec.minimum = spec.maximum = 2;
      spec.meaning =
          "Friction coefficient mu, or two, [slow, fast], with rate: mu = fast - (fast - slow) exp(-rate |v|).";
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
      // The lists of a nonlinear elastic curve apply to storeys and devices.
      const bool has_lists =
          std::ranges::any_of(L::parameters, [](const auto& parameter) { return parameter.info.is_list(); });
      if (hysteresis::Entry::of<L>().is_symmetric && !has_lists) made.add(law);
    });
    return made;
  }();
  return all;
}

}  // namespace

const Section isolator{"isolator", "structures.NAME.frame.supports.NODE.isolator",
                       "Isolator under a foot of a frame, or all isolators of a shear building together, by law.",
                       isolators().own};

std::vector<const Section*> laws_of_isolators() { return isolators().sections(); }

}  // namespace pounding::keys
