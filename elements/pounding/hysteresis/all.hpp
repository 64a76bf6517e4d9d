#pragma once
/// Registry of hysteretic laws, read by parser, reports, bindings, documentation and contract test. To add a law, write
/// its header, add two lines here (three if hinges can have it) and generate its page.

#include <span>
#include <string_view>
#include <variant>

#include <pounding/hysteresis/backfill.hpp>
#include <pounding/hysteresis/bilin.hpp>
#include <pounding/hysteresis/bilinear.hpp>
#include <pounding/hysteresis/bouc_wen.hpp>
#include <pounding/hysteresis/by_name.hpp>
#include <pounding/hysteresis/friction_pendulum.hpp>
#include <pounding/hysteresis/hysteretic.hpp>
#include <pounding/hysteresis/imk_bilinear.hpp>
#include <pounding/hysteresis/imk_peak_oriented.hpp>
#include <pounding/hysteresis/imk_pinching.hpp>
#include <pounding/hysteresis/lead_rubber.hpp>
#include <pounding/hysteresis/menegotto_pinto.hpp>
#include <pounding/hysteresis/mod_imk.hpp>
#include <pounding/hysteresis/multilinear_elastic.hpp>
#include <pounding/hysteresis/peak_oriented.hpp>
#include <pounding/hysteresis/pinching4.hpp>
#include <pounding/hysteresis/restrainer.hpp>
#include <pounding/hysteresis/uplift.hpp>

namespace pounding::hysteresis {

/// Any law of this library.
using AnyLaw = std::variant<Bilinear, MenegottoPinto, BoucWen, PeakOriented, FrictionPendulum, LeadRubber, Elastomeric,
                            Backfill, Restrainer, Uplift, MultilinearElastic, ImkBilinear, ImkPeakOriented, ImkPinching,
                            Bilin, ModImkPeakOriented, ModImkPinching, Hysteretic, Pinching4>;

/// Laws of hinges: those with an initial stiffness and a yield force, which the hinge sets.
using HingeLaw = std::variant<Bilinear, MenegottoPinto, BoucWen, PeakOriented, ImkBilinear, ImkPeakOriented,
                              ImkPinching, Bilin, ModImkPeakOriented, ModImkPinching, Hysteretic, Pinching4>;

/// True for a parameter that the hinge sets.
template <class L>
constexpr bool is_set_by_hinge(const Parameter<L>& p) noexcept {
  if constexpr (requires { &L::negative_yield_force; })
    if (p.choice == &L::negative_yield_force) return true;
  if constexpr (requires { &L::hardening; })
    if (p.value == &L::hardening) return true;
  if constexpr (requires { &L::s1n; })
    if (p.choice == &L::s1n || p.choice == &L::e1n) return true;
  return p.value == &L::initial_stiffness || p.value == &L::yield_force;
}

/// The catalogue of all laws.
using Laws = laws::Catalogue<Settings, Entry, AnyLaw>;

/// Entries of all laws, in the order of AnyLaw.
inline std::span<const Entry> catalogue() noexcept { return Laws::entries; }

/// Entry of a law by name. Throws std::invalid_argument, with the nearest known name, if there is none.
inline const Entry& find_law(std::string_view name) { return Laws::find(name); }

/// Creates a validated law. Throws std::invalid_argument for an unknown law or parameter (with the nearest known name),
/// a missing parameter and an invalid value.
inline AnyLaw make_law(const Settings& settings) { return Laws::make(settings); }

/// Entry of a law object.
inline const Entry& entry_of(const AnyLaw& law) noexcept { return catalogue()[law.index()]; }

}  // namespace pounding::hysteresis
