#include <pounding/structures/yielding_law.hpp>

#include <array>
#include <limits>
#include <span>
#include <stdexcept>
#include <variant>

#include <pounding/hysteresis/all.hpp>

namespace pounding {

hysteresis::Settings SpringOptions::of_storey(int storey, const std::vector<double>& stiffness) const {
  if (values.contains("stiffness"))
    throw std::invalid_argument("the stiffness of a spring is that of its storey; remove stiffness");
  hysteresis::Settings settings{.law = law, .words = words};
  for (const auto& [name, each] : values)
    settings.values.emplace(name, each.of_each(static_cast<int>(stiffness.size()), name)[storey]);
  settings.values.emplace("stiffness", stiffness[storey]);
  return settings;
}

std::vector<YieldingPart::Parameter> parameters_of(const hysteresis::Settings& settings) {
  std::vector<YieldingPart::Parameter> all;
  std::visit(
      [&all]<class L>(const L& law) {
        for (const auto& parameter : L::parameters) {
          const std::string name(parameter.info.name);
          if (name == "stiffness") continue;
          if (const std::optional<double> value = parameter.get(law)) all.push_back({name, *value});
        }
        if constexpr (requires { L::choices; })
          for (const auto& choice : L::choices)
            all.push_back({std::string(choice.info.name), static_cast<double>(choice.get(law))});
      },
      hysteresis::make_law(settings));
  return all;
}

double slope_far_behind_yield(const Element& element, int direction) {
  std::array<LinkMotion, max_deformations> far{};
  far[direction].penetration = 1000 * element.yield_deformation(direction);
  far[direction].lag = std::numeric_limits<double>::infinity();
  const auto count = static_cast<std::size_t>(element.deformations());
  return first_response(element, std::span(far).first(count)).by_deformation[direction][direction];
}

}  // namespace pounding
