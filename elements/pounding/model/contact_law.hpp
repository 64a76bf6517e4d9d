#pragma once
/// Contact law of any type, as a model accepts it for a link.

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <pounding/laws/all.hpp>
#include <pounding/links/gap_contact.hpp>
#include <pounding/links/rigid_contact.hpp>

namespace pounding {

/// Throws std::invalid_argument.
[[noreturn]] inline void refuse_estimate(std::string_view law) {
  throw std::invalid_argument(std::string(law) + " has no stiffness to estimate");
}

/// Exponent n of a law with stiffness k in F = k d^n. Throws std::invalid_argument for a law without a stiffness or
/// without a known exponent.
template <class Law>
double stiffness_exponent(const Law& law) {
  if constexpr (requires {
                  law.stiffness;
                  law.exponent;
                }) {
    return law.exponent;
  } else if constexpr (requires {
                         law.stiffness;
                         Law::parameters;
                       }) {
    for (const auto& parameter : Law::parameters)
      if (parameter.info.name == "stiffness") return parameter.info.unit == "N/m" ? 1 : 1.5;
  }
  refuse_estimate(Law::name);
}

/// Stiffness that replaces the one of a law.
struct ContactStiffness {
  std::function<double(double exponent)>
      estimate{};     ///< k [N/m^n] for a law with this exponent n; empty: stiffness of the law
  double factor = 1;  ///< multiplies either
};

/// A law of the library, a law by name (laws::Settings), or a user-defined struct of the form described in
/// laws/law.hpp. The model creates one contact per link and sets its reduced mass to that of the bodies at the ends of
/// the link, unless one is given.
class ContactLaw {
 public:
  /// A contact, and the description of its law for reports.
  struct Made {
    std::string name, formula;
    std::vector<laws::ResolvedValue> parameters;  ///< calibrated damping included
    std::shared_ptr<const Contact> contact;
  };

  ContactLaw(const laws::AnyLaw& law);
  ContactLaw(const laws::Settings& settings);
  template <class Law>
    requires requires(const Law& law) {
      law.check();
      law.name;
    }
  ContactLaw(const Law& law) {
    if constexpr (requires { law.reduced_mass; }) reduced_mass_ = law.reduced_mass;
    make_ = [law](double reduced_mass, double gap, int link, const ContactStiffness& stiffness) {
      Law own = law;
      if constexpr (requires { own.stiffness = 1.0; }) {
        if (stiffness.estimate) own.stiffness = stiffness.estimate(stiffness_exponent(law));
        own.stiffness *= stiffness.factor;
      } else if (stiffness.estimate) {
        refuse_estimate(Law::name);
      }
      if constexpr (requires { own.reduced_mass; }) own.reduced_mass = reduced_mass;
      if constexpr (is_of_the_library<Law>(static_cast<laws::AnyLaw*>(nullptr)))
        return made(laws::AnyLaw(own), gap, link);
      else
        return made_of_own(own, gap, link);
    };
  }

  /// Reduced mass given by the user [kg]; 0 for none.
  double reduced_mass() const noexcept { return reduced_mass_; }
  /// Creates the contact of this law with a gap [m] for the link with this index. Throws std::invalid_argument for
  /// invalid parameters of the law, and for an estimated stiffness of a law without stiffness.
  Made make(double reduced_mass, double gap, int link, const ContactStiffness& stiffness = {}) const {
    return make_(reduced_mass, gap, link, stiffness);
  }

 private:
  template <class Law, class... L>
  static constexpr bool is_of_the_library(std::variant<L...>*) {
    return (std::is_same_v<Law, L> || ...);
  }

  static Made made(const laws::AnyLaw& law, double gap, int link);

  template <class Law>
  static Made made_of_own(const Law& law, double gap, int link) {
    Made made{.name = std::string(Law::name), .formula = {}, .parameters = {}, .contact = nullptr};
    law.check();
    constexpr bool has_table = requires { Law::parameters; };
    constexpr bool names_its_damping = requires {
      Law::number;
      Law::coefficient;
    };
    if constexpr (has_table && (!laws::has_damping<Law> || names_its_damping))
      made.parameters = laws::by_name::describe(law, 1);
    if constexpr (laws::instantaneous<Law>)
      made.contact = std::make_shared<const RigidContact>(law.restitution, gap, link);
    else
      made.contact = std::make_shared<const GapContact<Law>>(law, gap, link);
    return made;
  }

  double reduced_mass_ = 0;
  std::function<Made(double, double, int, const ContactStiffness&)> make_;
};

}  // namespace pounding
