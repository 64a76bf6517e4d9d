#pragma once
/// Tables that describe a law, for parser, reports, tests and documentation.

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace pounding::laws {

/// Necessity of a parameter.
enum class Need : unsigned char {
  required,  ///< no default
  optional,  ///< has a default
  damping,   ///< gives the damping directly, instead of a restitution
  together,  ///< all parameters of this kind together replace all other parameters
  instead,   ///< no default; may be omitted if the alternative parameters are given
  extra      ///< may be omitted, no default
};

/// A parameter of a law. In a unit, `n` is the exponent of the law.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double typical = 0;  ///< SI
  Need need = Need::required;
  std::span<const double> typical_list{};  ///< of a parameter that is a list [SI]; empty for a single value
  bool is_flag = false;                    ///< true or false, as 1 or 0
  std::string_view at_hinge{};             ///< name at a hinge, where forces are moments; empty: the same

  bool is_list() const noexcept { return !typical_list.empty(); }  ///< true for a list of values
};

/// A parameter and the corresponding member of the law: exactly one of the pointers is set.
template <class L>
struct Parameter {
  constexpr Parameter(const ParameterInfo& of, double L::* member) : info(of), value(member) {}
  constexpr Parameter(const ParameterInfo& of, std::optional<double> L::* member) : info(of), choice(member) {}
  constexpr Parameter(const ParameterInfo& of, std::vector<double> L::* member) : info(of), list(member) {}

  /// Sets the member of the law [SI]; for a list, its only item.
  void set(L& law, double number) const {
    if (list)
      law.*list = {number};
    else if (value)
      law.*value = number;
    else
      law.*choice = number;
  }
  /// Sets an item of a list, counted from 0 [SI]. Items that are not set are NaN.
  void set_item(L& law, std::size_t index, double number) const {
    std::vector<double>& items = law.*list;
    if (items.size() <= index) items.resize(index + 1, std::numeric_limits<double>::quiet_NaN());
    items[index] = number;
  }
  /// Empty if not given, and for a list.
  std::optional<double> get(const L& law) const {
    if (list) return {};
    return value ? law.*value : law.*choice;
  }

  ParameterInfo info;
  double L::* value = nullptr;
  std::optional<double> L::* choice = nullptr;
  std::vector<double> L::* list = nullptr;
};

/// The `info` of each row of a table.
template <auto& table>
inline constexpr auto infos = [] {
  std::array<decltype(table[0].info), table.size()> result{};
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = table[i].info;
  return result;
}();

/// Arguments of a damping formula; many formulas use only the restitution.
struct CalibrationTarget {
  double restitution = 1;    ///< e in (0, 1]
  double closing_speed = 1;  ///< v [m/s]
  double stiffness = 1;      ///< k [N/m^n]
  double exponent = 1.5;     ///< n
  double reduced_mass = 1;   ///< m [kg]
  double depth = 1;          ///< penetration at which damping is full (adams_impact) [m]
  double yield_ratio = 0.1;  ///< ratio of yield penetration to design penetration (bilinear_hertz)
};

/// Dimensionless damping number of a law (its `number`: a, zeta, xi ...) for a restitution.
using DampingFormula = double (*)(const CalibrationTarget&);

/// A published damping formula, or the exact calibration: damping number for a restitution e.
struct Formula {
  std::string_view name, equation, source, note;
  DampingFormula function = nullptr;
};

/// A named value with its unit.
struct Quantity {
  std::string_view name, unit;
};

}  // namespace pounding::laws
