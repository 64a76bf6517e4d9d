#pragma once
/// Registry of hysteretic laws, read by parser, reports, bindings, documentation and contract test. To add a law, write
/// its header, add two lines here and generate its page.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>

#include <pounding/hysteresis/backfill.hpp>
#include <pounding/hysteresis/bilinear.hpp>
#include <pounding/hysteresis/bouc_wen.hpp>
#include <pounding/hysteresis/by_name.hpp>
#include <pounding/hysteresis/friction_pendulum.hpp>
#include <pounding/hysteresis/lead_rubber.hpp>
#include <pounding/hysteresis/menegotto_pinto.hpp>
#include <pounding/hysteresis/peak_oriented.hpp>

namespace pounding::hysteresis {

/// Any law of this library.
using AnyLaw =
    std::variant<Bilinear, MenegottoPinto, BoucWen, PeakOriented, FrictionPendulum, LeadRubber, Elastomeric, Backfill>;

/// Entries of all laws, in the order of AnyLaw.
inline std::span<const Entry> catalogue() noexcept { return by_name::List<AnyLaw>::entries; }

/// Entry of a law by name. Throws std::invalid_argument, with the nearest known name, if there is none.
inline const Entry& find_law(std::string_view name) {
  for (const Entry& entry : catalogue())
    if (entry.name == name) return entry;
  throw std::invalid_argument("unknown hysteretic law \"" + laws::excerpt(name) + "\"." +
                              laws::suggestion(name, by_name::names(catalogue())));
}

/// Creates a validated law. Throws std::invalid_argument for an unknown law or parameter (with the nearest known name),
/// a missing parameter and an invalid value.
inline AnyLaw make_law(const Settings& settings) { return by_name::make_any<AnyLaw>(settings); }

/// Entry of a law object.
inline const Entry& entry_of(const AnyLaw& law) noexcept { return catalogue()[law.index()]; }

}  // namespace pounding::hysteresis
