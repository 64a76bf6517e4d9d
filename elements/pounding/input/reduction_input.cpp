#include <pounding/input/reduction_input.hpp>

#include <fmt/format.h>

#include <pounding/model/reducible.hpp>

namespace pounding {

Reduction read_reduction(const Input& node) {
  Reduction reduction;
  if (!node.is_map()) {
    const std::string spec = node.as_choice();
    reduction.kind = spec == "auto"   ? Reduction::Kind::automatic
                     : spec == "none" ? Reduction::Kind::none
                                      : Reduction::Kind::all_modes;
    return reduction;
  }
  node.only_keys();
  if (const auto check = node.find("check")) reduction.check = check->as_bool();
  const auto links = node.find("links"), ground = node.find("ground"), modes = node.find("modes"),
             error = node.find("error"), of = node.find("of");
  if (of && !error)
    of->fail_at_key("selects responses for an error bound, which is missing; type {error: 1e-4, of: [acceleration]}");
  if (error) {
    for (const auto& other : {links, ground, modes})
      if (other) other->fail_at_key("is a size, and error determines the size automatically; keep one of the two");
    reduction.kind = Reduction::Kind::automatic;
    reduction.error = error->as_quantity();
    if (of)
      for (const Input& what : of->items())
        (what.as_choice() == "members" ? reduction.of_members : reduction.of_acceleration) = true;
    return reduction;
  }
  if (modes) {
    if (links || ground)
      (links ? links : ground)->fail_at_key("belongs to blocks, and modes is given too; keep one of the two");
    reduction.kind = Reduction::Kind::lowest;
    reduction.modes = static_cast<int>(modes->as_integer());
    return reduction;
  }
  if (!links && !ground && reduction.check) {
    reduction.kind = Reduction::Kind::automatic;
    return reduction;
  }
  if (!links && !ground) node.fail("the size is missing; type reduction: {links: 5, ground: 20}, or reduction: auto");
  reduction.kind = Reduction::Kind::blocks;
  if (links) reduction.links = static_cast<int>(links->as_integer());
  if (ground) reduction.ground = static_cast<int>(ground->as_integer());
  return reduction;
}

void check_reductions(const Model& model, const Input& root) {
  const auto structures = root.at("structures").entries();
  for (std::size_t i = 0; i < structures.size(); ++i) {
    const int number = static_cast<int>(i);
    if (const std::string reason = why_not_checked(model, number); !reason.empty()) {
      const auto own = structures[i].second.find("reduction");
      (own ? *own : root.at("analysis").at("reduction")).at("check").fail(reason);
    }
    if (!reduction_of(model, number).is_explicit()) continue;
    const std::string reason = why_not_reduced(model, number);
    if (reason.empty()) continue;
    const auto& [name, location] = structures[i];
    if (const auto own = location.find("reduction"))
      own->fail(fmt::format("\"{}\" cannot be reduced: {}; type reduction: none", name, reason));
    if (model.structures[i].size() > small_structure)
      root.at("analysis")
          .at("reduction")
          .fail(fmt::format("\"{}\" cannot be reduced: {}; type reduction: auto, which skips such structures", name,
                            reason));
  }
}

}  // namespace pounding
