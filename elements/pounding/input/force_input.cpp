#include <pounding/input/force_input.hpp>

#include <string>
#include <vector>

#include <pounding/core/units.hpp>
#include <pounding/input/ground_input.hpp>

namespace pounding {
std::vector<ForceOptions> read_forces(const Input& list) {
  if (!list.is_list())
    list.fail(
        "takes a list with one force per line; type - {floor: 3, harmonic: {amplitude: 20 kN, period: 0.5 s, duration: "
        "10 s}}");
  if (list.items().empty()) list.fail("the list is empty; leave it out");
  std::vector<ForceOptions> forces;
  for (const Input& item : list.items()) {
    item.only_keys();
    ForceOptions& force = forces.emplace_back();
    if (const auto floor = item.find("floor")) force.floor = static_cast<int>(floor->as_integer());
    if (const auto node = item.find("node")) {
      if (force.floor) node->fail_at_key("a force acts on a floor or a node; keep one of the two");
      force.node = node->as_text();
    }
    if (const auto dof = item.find("dof")) force.dof = dof->as_choice();
    force.history = read_motion(item, force.dof[0] == 'r' ? dimension::energy : dimension::force);
  }
  return forces;
}

}  // namespace pounding
