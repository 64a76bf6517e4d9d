#pragma once
/// Registry of contact laws, read by parser, reports, bindings, documentation and contract test. To add a law, write
/// its header and add two lines here. Sources that link Pounding::links include compiled.hpp instead.

#include <span>
#include <string_view>
#include <variant>

#include <pounding/laws/adams_impact.hpp>
#include <pounding/laws/backfill.hpp>
#include <pounding/laws/bilinear_hertz.hpp>
#include <pounding/laws/by_name.hpp>
#include <pounding/laws/elastic_plastic_gap.hpp>
#include <pounding/laws/elastoplastic.hpp>
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
#include <pounding/laws/tabulated.hpp>
#include <pounding/laws/viscous_hertz.hpp>

namespace pounding::laws {

/// Any law of this library.
using AnyLaw =
    std::variant<LinearSpring, KelvinVoigt, KelvinVoigtNoTension, Komodromos, ModifiedLinearViscoelastic,
                 ModifiedKelvin, Hertz, HertzDamped, Jankowski, BilinearHertz, ViscousHertz, KuwabaraKono, AdamsImpact,
                 LimitedDamper, Stereomechanical, Elastoplastic, Backfill, ElasticPlasticGap, Tabulated>;

/// Their catalogue.
using Laws = Catalogue<Settings, Entry, AnyLaw>;

/// Entries of all laws, in the order of AnyLaw.
inline std::span<const Entry> catalogue() noexcept { return Laws::entries; }

/// Entry of a law by name. Throws std::invalid_argument, with the nearest known name, if there is none.
inline const Entry& find_law(std::string_view name) { return Laws::find(name); }

/// Creates a validated law. Throws std::invalid_argument for an unknown law, formula or parameter (with the nearest
/// known name), a missing parameter, an invalid value, damping given twice or not at all, and a formula without a
/// restitution.
inline AnyLaw make_law(const Settings& settings) { return Laws::make(settings); }

/// Entry of a law object.
inline const Entry& entry_of(const AnyLaw& law) noexcept { return catalogue()[law.index()]; }

}  // namespace pounding::laws
