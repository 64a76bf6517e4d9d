#pragma once
/// Typical values of the parameters of laws, as typed in a model.

#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <pounding/laws/table.hpp>

namespace pounding::test {

/// A number, a list, or true or false.
inline std::string typical_yaml(const laws::ParameterInfo& parameter) {
  if (parameter.is_flag) return parameter.typical != 0 ? "true" : "false";
  if (parameter.is_list()) return fmt::format("[{}]", fmt::join(parameter.typical_list, ", "));
  return fmt::format("{}", parameter.typical);
}

}  // namespace pounding::test
