#pragma once
/// The tables in which a law of yielding describes itself, for parser, reports, tests and documentation.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace pounding::hysteresis {

/// Necessity of a parameter.
enum class Need : unsigned char {
  required,  ///< no default: it must be given
  optional,  ///< has a default
  instead,   ///< has no default, but may be left out where others are given instead
  extra      ///< may be left out, and has no default
};

/// One parameter of a law. Units are those of a spring along a line; at a hinge m is rad and N is N m.
struct ParameterInfo {
  std::string_view name, unit, meaning;
  double typical = 0;  ///< SI
  Need need = Need::required;
};

/// A parameter and the member of the law that holds it: exactly one of the two pointers is set.
template <class L>
struct Parameter {
  ParameterInfo info;
  double L::* value = nullptr;
  std::optional<double> L::* choice = nullptr;
};

/// A parameter that is one of some words, the first of them by default.
struct ChoiceInfo {
  std::string_view name, meaning;
  std::span<const std::string_view> words;
};

/// Such a parameter of the law L; `set` takes the place of the word.
template <class L>
struct Choice {
  ChoiceInfo info;
  void (*set)(L&, std::size_t) = nullptr;
  std::size_t (*get)(const L&) = nullptr;
};

/// A number of the state of a law, beside its deformation.
struct StateInfo {
  std::string_view name, unit, meaning;
};

/// Such a number, and how to read it.
template <class L>
struct StateValue {
  StateInfo info;
  double (*get)(const typename L::State&) = nullptr;
};

}  // namespace pounding::hysteresis
