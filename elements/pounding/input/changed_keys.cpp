#include <pounding/input/changed_keys.hpp>

#include <string>

#include <fmt/format.h>

#include <pounding/core/units.hpp>

namespace pounding {
namespace {

// One warning per frame is enough, as its hinges were written at the same time.
void doubt_hinges(const Input& hinges, std::vector<Doubt>& doubts) {
  for (const auto& [name, hinge] : hinges.entries()) {
    if (!hinge.is_map()) continue;
    for (const auto& [law, numbers] : hinge.entries()) {
      if (!numbers.is_map()) continue;
      const auto hardening = numbers.find("hardening");
      if (!hardening || !hardening->is_scalar()) continue;
      const std::string text = hardening->as_text();
      if (double value = 1; parse_number(text.substr(0, text.find_first_of(" %")), value) && value == 0)
        continue;  // zero has one meaning
      doubts.push_back(
          {"hardening",
           fmt::format(
               "{}: is the ratio of the member end; version 0.2.0 took {} as that of the bare spring, which is now "
               "spring_hardening: {}",
               hardening->path(), text, text)});
      return;
    }
  }
}

void visit_hinges(const Input& node, std::vector<Doubt>& doubts) {
  if (!node.is_map()) return;
  if (node.key() == "hinges") return doubt_hinges(node, doubts);
  for (const auto& [key, value] : node.entries()) visit_hinges(value, doubts);
}

}  // namespace

std::vector<Doubt> changed_keys(const Input& input) {
  std::vector<Doubt> doubts;
  visit_hinges(input, doubts);
  return doubts;
}

}  // namespace pounding
