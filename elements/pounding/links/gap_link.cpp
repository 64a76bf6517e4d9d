#include <pounding/links/gap_link.hpp>

#include <type_traits>
#include <variant>

#include <pounding/links/rigid_gap_link.hpp>

namespace pounding {

void Contact::press(double) {
  throw std::invalid_argument("this contact cannot start closed: its law has no force; use a law with a force");
}

std::unique_ptr<Contact> make_gap_link(const laws::AnyLaw& law, double gap, int link) {
  return std::visit(
      [&](const auto& chosen) -> std::unique_ptr<Contact> {
        using Law = std::decay_t<decltype(chosen)>;
        if constexpr (laws::instantaneous<Law>)
          return std::make_unique<RigidGapLink>(chosen.restitution, gap, link);
        else
          return std::make_unique<GapLink<Law>>(chosen, gap, link);
      },
      law);
}

}  // namespace pounding
