#include <pounding/input/changed_keys.hpp>

#include <fmt/format.h>

namespace pounding {
namespace {

// One warning per frame is enough, as its hinges were written at the same time.
void doubt_hinges(const Input& hinges, std::vector<Doubt>& doubts) {
  for (const auto& [name, hinge] : hinges.entries()) {
    if (!hinge.is_map()) continue;
    for (const auto& [law, numbers] : hinge.entries()) {
      if (!numbers.is_map()) continue;
      const auto hardening = numbers.find("hardening");
      if (!hardening || hardening->as_quantity() == 0) continue;
      const std::string text = hardening->as_text();
      doubts.push_back({"hardening", fmt::format("{}: is the ratio of the member end; version 0.2.0 took {} as that of the bare spring, which is now "
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
