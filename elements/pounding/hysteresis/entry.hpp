#pragma once
/// Hysteretic laws by name and parameters: settings and catalogue entry.

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/catalogue.hpp>

namespace pounding::hysteresis {

/// Settings of a law in an input. SI units.
struct Settings {
  std::string law;
  std::map<std::string, double, std::less<>> values{};      ///< numeric parameters; "force[1]" of a list
  std::map<std::string, std::string, std::less<>> words{};  ///< keyword parameters
};

/// Catalogue entry of a law, read from the tables of its struct.
struct Entry {
  std::string_view name, shape, summary, source;
  std::string_view symbols;  ///< symbols of `shape` with units, except f and d
  std::string_view range;    ///< range of validity
  std::string_view beware;   ///< limitations and unexpected properties
  std::span<const ParameterInfo> parameters;
  std::span<const ChoiceInfo> choices;
  std::span<const StateInfo> state;  ///< state variables, except the deformation
  bool has_corners = true;           ///< false if the slope jumps only at reversals
  bool is_symmetric = true;          ///< true if f(-d) = -f(d) on the mirrored path, with typical parameters
  std::string_view replaced_by{};    ///< law by which its authors replaced this one; empty if none did

  /// Entry of a law, from its members.
  template <Law L>
  static constexpr Entry of();
};

/// Message about an unknown law.
inline std::string unknown_law(std::string_view name, std::span<const Entry> catalogue) {
  return "unknown hysteretic law \"" + excerpt(name) + "\"." + suggestion(name, laws::names(catalogue));
}

/// Settings of a law with the typical values of its table.
inline Settings typical_settings(const Entry& entry) {
  Settings s{.law = std::string(entry.name)};
  laws::add_typical(entry.parameters, s.values, [](const ParameterInfo& p) { return p.need != Need::extra; });
  return s;
}

}  // namespace pounding::hysteresis
