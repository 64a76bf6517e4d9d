#pragma once
/// Values of a law with their units, for reports.

#include <string>
#include <string_view>
#include <utility>

#include <pounding/laws/checks.hpp>

namespace pounding::laws {

/// A resolved value of a law.
struct ResolvedValue {
  std::string name;
  double value = 0;
  std::string unit;
};

/// Substitutes the exponent n in a unit of the tables: "N/m^n" becomes "N/m^1.5" for 1.5 and "N/m" for 1.
inline std::string resolved_unit(std::string_view unit, double exponent) {
  const std::pair<std::string_view, double> forms[] = {
      {"^((n+1)/2)", (exponent + 1) / 2}, {"^(n+1)", exponent + 1}, {"^n", exponent}};
  std::string text(unit);
  for (const auto& [form, power] : forms)
    if (const auto at = text.find(form); at != std::string::npos)
      return text.replace(at, form.size(), power == 1 ? std::string() : std::string("^").append(number_text(power)));
  return text;
}

}  // namespace pounding::laws
