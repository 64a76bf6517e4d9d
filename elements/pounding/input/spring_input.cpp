#include <pounding/input/spring_input.hpp>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <pounding/hysteresis/all.hpp>
#include <pounding/input/fail_at.hpp>
#include <pounding/structures/make_spring.hpp>

namespace pounding {
namespace {

const hysteresis::Entry& law_of(const Input& spring) {
  if (spring.is_scalar()) {
    const std::string name = spring.as_text();
    placed(spring, [&] { hysteresis::find_law(name); });
    if (!spring.knows(name))
      spring.fail(fmt::format("{} is not available for storeys; see `pounding words spring`", name));
    spring.fail(fmt::format("the parameters of the law are missing; type spring: {{{}: {{yield_force: 2 MN}}}}", name));
  }
  spring.only_keys();
  return hysteresis::find_law(spring.chosen());
}

}  // namespace

const hysteresis::Entry* law_among_keys(const Input& map, const char* what) {
  const hysteresis::Entry* chosen = nullptr;
  for (const hysteresis::Entry& entry : hysteresis::catalogue())
    if (const auto found = map.find_known(entry.name)) {
      if (chosen)
        found->fail_at_key(
            fmt::format("{} has one law, and {} is also given; keep one of the two", what, chosen->name));
      chosen = &entry;
    }
  return chosen;
}

std::map<std::string, std::string, std::less<>> read_choices(const Input& law, const hysteresis::Entry& entry) {
  std::map<std::string, std::string, std::less<>> keys;
  for (const hysteresis::ChoiceInfo& choice : entry.choices)
    if (const auto spec = law.find(choice.name)) keys.emplace(choice.name, spec->as_choice());
  return keys;
}

Input location_of(const std::string& refusal, const Input& law, const hysteresis::Entry& entry) {
  const std::string_view first = laws::parameter_name(std::string_view(refusal).substr(0, refusal.find(' ')));
  for (const hysteresis::ParameterInfo& parameter : entry.parameters)
    if (parameter.name == first && law.knows(first))
      if (const auto found = law.find(first)) return *found;
  return law;
}

SpringOptions read_storey_spring(const Input& spring, const std::vector<double>& stiffness, int first_storey) {
  const hysteresis::Entry& entry = law_of(spring);
  const Input law = spring.at(entry.name);
  law.only_keys();
  const int storeys = static_cast<int>(stiffness.size());
  SpringOptions options{.law = std::string(entry.name)};
  for (const hysteresis::ParameterInfo& parameter : entry.parameters) {
    if (parameter.name == "stiffness") continue;
    if (parameter.need == hysteresis::Need::required) law.at(parameter.name);
    if (const auto value = law.find(parameter.name)) {
      if (parameter.is_list())
        read_list(*value, options.values);
      else
        options.values.emplace(parameter.name, value->as_quantities(storeys));
    }
  }
  options.words = read_choices(law, entry);
  for (int i = 0; i < storeys; ++i) try {
      make_spring(options.of_storey(i, stiffness));
    } catch (const std::invalid_argument& error) {
      const Input location = location_of(error.what(), law, entry);
      location.fail(location.is_list() ? fmt::format("storey {}: {}", first_storey + i, error.what()) : error.what());
    }
  return options;
}

}  // namespace pounding
