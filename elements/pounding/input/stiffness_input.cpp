#include <pounding/input/stiffness_input.hpp>

#include <array>
#include <initializer_list>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace pounding {
namespace {

// One value for both bodies, or [left, right].
std::array<double, 2> read_both(const Input& node) {
  if (!node.is_list()) {
    const double both = node.as_quantity();
    return {both, both};
  }
  const std::vector<Input> items = node.items();
  if (items.size() != 2)
    node.fail(fmt::format("takes one value for both bodies, or two; a list of {} was read", items.size()));
  return {items[0].as_quantity(), items[1].as_quantity()};
}

void refuse_beside(const Input& node, std::string_view key, std::initializer_list<std::string_view> others) {
  for (const std::string_view other : others)
    if (const auto found = node.find(other))
      found->fail_at_key(fmt::format("is not used in an estimate from {}; keep one of the two", key));
}

}  // namespace

bool is_estimate(const Input& node) { return node.is_map() || (node.is_scalar() && node.as_text() == "auto"); }

std::optional<StiffnessEstimate> read_stiffness_estimate(const Input& node) {
  if (!is_estimate(node)) return {};
  if (!node.is_map()) return StiffnessOfBalls{};
  node.only_keys();
  if (const auto penetration = node.find("penetration")) {
    refuse_beside(node, "penetration", {"E", "poisson", "density", "radius", "area", "length"});
    return StiffnessOfPenetration{penetration->as_quantity(), node.quantity("velocity")};
  }
  if (const auto velocity = node.find("velocity"))
    velocity->fail_at_key("belongs to penetration; add penetration: 5 mm");
  const auto area = node.find("area"), length = node.find("length");
  if (area || length) {
    refuse_beside(node, "slabs", {"poisson", "density", "radius"});
    return StiffnessOfSlabs{
        .young = node.quantity("E"), .areas = read_both(node.at("area")), .lengths = read_both(node.at("length"))};
  }
  const auto radius = node.find("radius");
  ContactMaterial material{.young = node.quantity("E"), .poisson = node.quantity("poisson")};
  if (radius) {
    refuse_beside(node, "radius", {"density"});
    return StiffnessOfRadii{.radii = read_both(*radius), .material = material};
  }
  material.density = node.quantity("density");
  return StiffnessOfBalls{material};
}

}  // namespace pounding
