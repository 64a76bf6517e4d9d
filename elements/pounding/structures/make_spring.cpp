#include <pounding/structures/make_spring.hpp>

#include <variant>

#include <pounding/structures/hysteretic_spring.hpp>

namespace pounding {

std::unique_ptr<Spring> make_spring(const hysteresis::AnyLaw& law) {
  return std::visit(
      []<class L>(const L& given) -> std::unique_ptr<Spring> {
        if constexpr (requires { given.made(); })
          return std::make_unique<HystereticSpring<decltype(given.made())>>(given.made());
        else
          return std::make_unique<HystereticSpring<L>>(given);
      },
      law);
}

std::unique_ptr<Spring> make_spring(const hysteresis::Settings& settings) {
  return make_spring(hysteresis::make_law(settings));
}

}  // namespace pounding
