#include <pounding/links/gap_contact.hpp>

#include <type_traits>
#include <variant>

#include <pounding/links/rigid_contact.hpp>

namespace pounding {

void Contact::press(ContactMemory&, double) const {
  throw std::invalid_argument("this contact cannot start closed: its law has no force; use a law with a force");
}

std::unique_ptr<const Contact> make_contact(const laws::AnyLaw& law, double gap, int link) {
  return std::visit(
      [&](const auto& chosen) -> std::unique_ptr<const Contact> {
        using Law = std::decay_t<decltype(chosen)>;
        if constexpr (laws::instantaneous<Law>)
          return std::make_unique<RigidContact>(chosen.restitution, gap, link);
        else
          return std::make_unique<GapContact<Law>>(chosen, gap, link);
      },
      law);
}

}  // namespace pounding
