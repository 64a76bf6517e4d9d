#include <pounding/model/contact_law.hpp>

namespace pounding {
namespace {

// The exponent may be among the settings, or that of the law.
double exponent_of(const laws::Settings& settings) {
  laws::Settings typical = settings;
  for (const laws::ParameterInfo& parameter : laws::find_law(settings.law).parameters)
    if (parameter.name == "stiffness") typical.values.emplace("stiffness", parameter.typical);
  return std::visit([](const auto& law) { return stiffness_exponent(law); }, laws::make_law(typical));
}

}  // namespace

ContactLaw::ContactLaw(const laws::AnyLaw& law) {
  std::visit([&](const auto& chosen) { *this = ContactLaw(chosen); }, law);
}

ContactLaw::ContactLaw(const laws::Settings& settings) : reduced_mass_(settings.reduced_mass) {
  make_ = [settings](double reduced_mass, double gap, int link, const ContactStiffness& stiffness) {
    laws::Settings own = settings;
    own.reduced_mass = reduced_mass;
    if (stiffness.estimate) own.values["stiffness"] = stiffness.estimate(exponent_of(own));
    if (const auto own_stiffness = own.values.find("stiffness"); own_stiffness != own.values.end())
      own_stiffness->second *= stiffness.factor;
    return made(laws::make_law(own), gap, link);
  };
}

ContactLaw::Made ContactLaw::made(const laws::AnyLaw& law, double gap, int link) {
  std::visit([](const auto& chosen) { chosen.check(); }, law);
  return {.name = std::string(laws::entry_of(law).name),
          .formula = std::string(laws::formula_name(law)),
          .parameters = laws::describe(law),
          .contact = make_contact(law, gap, link)};
}

}  // namespace pounding
