#pragma once
/// The one list of contact laws. Parser, reports, bindings, documentation and the contract test read it: a new law needs
/// its header and its line here.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <pounding/laws/adams_impact.hpp>
#include <pounding/laws/bilinear_hertz.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/laws/hertz.hpp>
#include <pounding/laws/hertz_damped.hpp>
#include <pounding/laws/jankowski.hpp>
#include <pounding/laws/kelvin_voigt.hpp>
#include <pounding/laws/kelvin_voigt_no_tension.hpp>
#include <pounding/laws/komodromos.hpp>
#include <pounding/laws/kuwabara_kono.hpp>
#include <pounding/laws/limited_damper.hpp>
#include <pounding/laws/linear_spring.hpp>
#include <pounding/laws/modified_kelvin.hpp>
#include <pounding/laws/modified_linear_viscoelastic.hpp>
#include <pounding/laws/stereomechanical.hpp>
#include <pounding/laws/viscous_hertz.hpp>

namespace pounding::laws {

/// One of the laws of this library.
using AnyLaw = std::variant<LinearSpring,
                            KelvinVoigt,
                            KelvinVoigtNoTension,
                            Komodromos,
                            ModifiedLinearViscoelastic,
                            ModifiedKelvin,
                            Hertz,
                            HertzDamped,
                            Jankowski,
                            BilinearHertz,
                            ViscousHertz,
                            KuwabaraKono,
                            AdamsImpact,
                            LimitedDamper,
                            Stereomechanical>;

/// Every law with its tables, in the order of the list.
inline std::span<const Entry> catalogue() noexcept { return by_name::List<AnyLaw>::entries; }

/// The entry of a law; throws std::invalid_argument with the nearest known name.
inline const Entry& find_law(std::string_view name) {
  for (const Entry& entry : catalogue())
    if (entry.name == name) return entry;
  throw std::invalid_argument("unknown law \"" + std::string(name) + "\"." + by_name::hint(name, by_name::names(catalogue())));
}

/// A checked law. Throws std::invalid_argument for an unknown law, formula or parameter (with the nearest known name), a
/// missing required one, a wrong value, damping given twice or not at all, and a formula without a restitution.
inline AnyLaw make_law(const Settings& settings) { return by_name::make_any<AnyLaw>(settings); }

/// The parameters of a made law, its damping number and its coefficient, for reports. Where the coefficient depends on the
/// closing speed it is that of `closing_speed` [m/s], which is then listed too.
inline std::vector<ResolvedValue> describe(const AnyLaw& law, double closing_speed = 1) {
  return std::visit([&](const auto& chosen) { return by_name::describe(chosen, closing_speed); }, law);
}

/// The entry of a made law.
inline const Entry& entry_of(const AnyLaw& law) noexcept { return catalogue()[law.index()]; }

/// The formula that calibrates a made law; empty when its damping was given directly or it has none.
inline std::string_view formula_name(const AnyLaw& law) noexcept {
  return std::visit(
      [](const auto& chosen) -> std::string_view {
        if constexpr (requires { chosen.formula; })
          if (chosen.restitution)
            for (const Formula& f : chosen.formulas)
              if (f.function == chosen.formula) return f.name;
        return {};
      },
      law);
}

}  // namespace pounding::laws
