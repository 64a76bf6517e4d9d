#include <pounding/frames/frame_parts.hpp>

#include <numeric>
#include <vector>

#include <fmt/format.h>

#include <pounding/core/refuse.hpp>

namespace pounding {
namespace {

// Up to this number, all nodes are reported by default.
constexpr int max_reported = 100;

void report_all_nodes(FrameModel& model) {
  if (model.reported_nodes) return;
  model.reported_nodes.emplace(model.given_nodes() <= max_reported ? model.given_nodes() : 0);
  std::iota(model.reported_nodes->begin(), model.reported_nodes->end(), 0);
}

// A frame without supports cannot carry loads at rest. `held`: nodes with a fixed displacement or a spring to the
// ground.
void complete_free(FrameModel& model, const std::vector<int>& held) {
  if (!held.empty() || !model.supports.empty())
    refuse(fmt::format("supports: none, but node {} is supported; remove supports: none or the support of the node",
                       model.frame.node_name(held.empty() ? model.supports.front().nodes.front() : held.front())));
  if (model.geometry != FrameGeometry::linear) refuse("without supports, the geometry must be linear; remove geometry");
  if (model.is_loaded()) refuse("without supports, loads and weights cannot be carried; remove loads and gravity");
  model.supports.emplace_back();
}

}  // namespace

void complete(FrameModel& model) {
  report_all_nodes(model);
  std::vector<bool> in_a_group(model.frame.nodes(), false);
  for (const FrameSupport& support : model.supports)
    for (const int node : support.nodes) in_a_group.at(node) = true;
  std::vector<int> others;
  for (const int node : model.frame.grounded_nodes())
    if (node < model.given_nodes() && !in_a_group[node]) others.push_back(node);
  if (model.is_free) return complete_free(model, others);
  const auto moves_as_all = [](const FrameSupport& support) { return support.delay == 0 && !support.motion; };
  if (!others.empty()) {
    if (model.supports.empty() || !moves_as_all(model.supports.front()))
      model.supports.insert(model.supports.begin(), FrameSupport{});
    std::vector<int>& common = model.supports.front().nodes;
    common.insert(common.end(), others.begin(), others.end());
  }
  if (model.supports.empty())
    refuse("the frame has no supports; type supports: {a: fixed}, or supports: none for a frame that floats freely");
  for (const FrameSupport& support : model.supports)
    if (model.frame.dimension() == 2 && support.motion && !(*support.motion)[1].is_still())
      refuse(fmt::format("support {}: a plane frame has no motion along y; remove it", support.name));
}

}  // namespace pounding
