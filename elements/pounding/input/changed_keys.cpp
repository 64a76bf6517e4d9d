#include <pounding/input/changed_keys.hpp>

#include <string>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

// One warning per frame is enough, as its hinges were written at the same time.
void warn_about_hinges(const Input& hinges, std::vector<Warning>& warnings) {
  for (const auto& [name, hinge] : hinges.entries()) {
    if (!hinge.is_map()) continue;
    for (const auto& [law, numbers] : hinge.entries()) {
      if (!numbers.is_map()) continue;
      const auto hardening = numbers.find("hardening");
      if (!hardening || !hardening->is_scalar()) continue;
      const std::string text = hardening->as_text();
      if (double value = 1; parse_number(text.substr(0, text.find_first_of(" %")), value) && value == 0)
        continue;  // zero has one meaning
      warnings.push_back(
          {"hardening", fmt::format("{}: this is the hardening ratio of the member end; version 0.2.0 used {} as the "
                                    "ratio of the spring alone, which is now spring_hardening: {}",
                                    hardening->path(), text, text)});
      return;
    }
  }
}

void visit_hinges(const Input& node, std::vector<Warning>& warnings) {
  if (!node.is_map()) return;
  if (node.key() == "hinges") return warn_about_hinges(node, warnings);
  for (const auto& [key, value] : node.entries()) visit_hinges(value, warnings);
}

}  // namespace

std::vector<Warning> changed_keys(const Input& input) {
  std::vector<Warning> warnings;
  visit_hinges(input, warnings);
  return warnings;
}

}  // namespace pounding
