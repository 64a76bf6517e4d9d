#include <pounding/model/contact_law.hpp>

namespace pounding {

ContactLaw::ContactLaw(const laws::AnyLaw& law) {
  std::visit([&](const auto& chosen) { *this = ContactLaw(chosen); }, law);
}

ContactLaw::ContactLaw(const laws::Settings& settings) : reduced_mass_(settings.reduced_mass) {
  make_ = [settings](double reduced_mass, double gap, int link) {
    laws::Settings own = settings;
    own.reduced_mass = reduced_mass;
    return made(laws::make_law(own), gap, link);
  };
}

ContactLaw::Made ContactLaw::made(const laws::AnyLaw& law, double gap, int link) {
  std::visit([](const auto& chosen) { chosen.check(); }, law);
  return {.name = std::string(laws::entry_of(law).name),
          .formula = std::string(laws::formula_name(law)),
          .parameters = laws::describe(law),
          .contact = make_gap_link(law, gap, link)};
}

}  // namespace pounding
