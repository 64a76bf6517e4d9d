#include <pounding/structures/make_spring.hpp>

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <variant>

#include <pounding/hysteresis/all.hpp>
#include <pounding/structures/hysteretic_spring.hpp>

namespace pounding {
namespace {

/// Parameter names of a law and of a hinge; no name may be contained in a later one. `hardening` of a hinge is the
/// ratio of the member end.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> moments{
    {{"hardening", "spring_hardening"},
     {"negative_yield_force", "negative_yield_moment"},
     {"yield_force", "yield_moment"},
     {"cracking_force", "cracking_moment"},
     {"yield_deformation", "yield_rotation"}}};

}  // namespace

std::string in_moments(std::string text) {
  for (const auto& [force, moment] : moments)
    for (std::size_t at = 0; (at = text.find(force, at)) != std::string::npos; at += moment.size())
      text.replace(at, force.size(), moment);
  return text;
}

std::unique_ptr<Spring> make_spring(const hysteresis::Settings& settings) {
  return std::visit(
      []<class L>(const L& law) -> std::unique_ptr<Spring> {
        if constexpr (requires { law.made(); })
          return std::make_unique<HystereticSpring<decltype(law.made())>>(law.made());
        else
          return std::make_unique<HystereticSpring<L>>(law);
      },
      hysteresis::make_law(settings));
}

std::unique_ptr<Spring> make_hinge(const hysteresis::Settings& settings) {
  hysteresis::Settings forces = settings;
  for (const auto& [force, moment] : moments) {
    if (settings.values.contains(force))
      throw std::invalid_argument("a hinge takes " + std::string(moment) + ", not " + std::string(force));
    if (auto given = forces.values.extract(std::string(moment)); !given.empty()) {
      given.key() = force;
      forces.values.insert(std::move(given));
    }
  }
  try {
    return make_spring(forces);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(in_moments(error.what()));
  }
}

}  // namespace pounding
