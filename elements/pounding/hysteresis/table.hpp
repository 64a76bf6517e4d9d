#pragma once
/// Tables that describe a hysteretic law, for parser, reports, tests and documentation.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace pounding::hysteresis {

/// Necessity of a parameter.
enum class Need : unsigned char {
  required,  ///< no default
  optional,  ///< has a default
  instead,   ///< no default; may be omitted if the alternative parameters are given
  extra      ///< may be omitted, no default
};

/// A parameter of a law. Units are those of a translational spring; at a hinge m is rad and N is N m.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double typical = 0;  ///< SI
  Need need = Need::required;
};

/// A parameter and the corresponding member of the law: exactly one of the two pointers is set.
template <class L>
struct Parameter {
  ParameterInfo info;
  double L::* value = nullptr;
  std::optional<double> L::* choice = nullptr;
};

/// A parameter that takes one of several keywords; the first is the default.
struct ChoiceInfo {
  std::string_view name, meaning;
  std::span<const std::string_view> words;
};

/// Such a parameter of the law L; `set` takes the index of the keyword.
template <class L>
struct Choice {
  ChoiceInfo info;
  void (*set)(L&, std::size_t) = nullptr;
  std::size_t (*get)(const L&) = nullptr;
};

/// A state variable of a law, other than its deformation.
struct StateInfo {
  std::string_view name, unit, meaning;
};

/// Such a variable and its accessor.
template <class L>
struct StateValue {
  StateInfo info;
  double (*get)(const typename L::State&) = nullptr;
};

}  // namespace pounding::hysteresis
