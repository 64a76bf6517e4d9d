#pragma once
/// Tables that describe a hysteretic law, for parser, reports, tests and documentation.

#include <cstddef>
#include <span>
#include <string_view>

#include <pounding/laws/table.hpp>

namespace pounding::hysteresis {

using laws::infos;
using laws::Need;
/// Units are those of a translational spring; at a hinge m is rad and N is N m.
using laws::Parameter;
using laws::ParameterInfo;

/// Location of a law: a spring between two points, or a hinge, whose forces are moments and deformations rotations.
enum class Use : unsigned char { spring, hinge };

/// Name of a parameter in inputs and messages.
constexpr std::string_view name_at(Use use, const ParameterInfo& info) noexcept {
  return use == Use::hinge && !info.at_hinge.empty() ? info.at_hinge : info.name;
}

/// Yield force of a law with one yield force in each direction.
inline constexpr ParameterInfo yield_force_info{
    .name = "yield_force", .unit = "N", .meaning = "yield force Fy", .typical = 1.5e5, .at_hinge = "yield_moment"};
/// Ratio of post-yield to initial stiffness.
constexpr ParameterInfo hardening_info(std::string_view meaning) noexcept {
  return {.name = "hardening",
          .unit = "",
          .meaning = meaning,
          .typical = 0.05,
          .need = Need::optional,
          .at_hinge = "spring_hardening"};
}

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
