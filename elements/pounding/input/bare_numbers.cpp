#include <pounding/input/bare_numbers.hpp>

#include <fmt/format.h>

namespace pounding {
namespace {

// Peaks of strong motion in g.
constexpr double weakest = 0.02, strongest = 1.5;

void visit(const Input& node, std::vector<Doubt>& doubts) {
  if (node.is_list())
    for (const Input& item : node.items()) visit(item, doubts);
  if (node.is_map())
    for (const auto& [key, value] : node.entries()) visit(value, doubts);
  if (double value = 0; node.key() == "pga" && node.is_scalar() && parse_number(node.as_text(), value) && value >= weakest && value <= strongest)
    doubts.push_back({"pga", fmt::format("{}: a bare {} is in m/s^2, {:.3g} g; did you mean {} g? Type its unit", node.path(), node.as_text(),
                                         value / standard_gravity, node.as_text())});
}

}  // namespace

std::vector<Doubt> bare_accelerations(const Input& input) {
  std::vector<Doubt> doubts;
  visit(input, doubts);
  return doubts;
}

}  // namespace pounding
