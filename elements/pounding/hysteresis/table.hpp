#pragma once
/// The tables in which a law of yielding describes itself, for parser, reports, tests and documentation.

#include <cstddef>
#include <span>
#include <string_view>

#include <pounding/laws/table.hpp>

namespace pounding::hysteresis {

using laws::infos;
using laws::Need;
/// Units are those of a spring along a line; at a hinge m is rad and N is N m.
using laws::Parameter;
using laws::ParameterInfo;

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
