#include <pounding/frames/frame_parts.hpp>

#include <algorithm>
#include <set>
#include <utility>

#include <pounding/frames/frame_dofs.hpp>

namespace pounding {
namespace {

bool turns(const AssembledFrame& frame, int node) {
  return std::ranges::any_of(dofs_of(frame.dimension),
                             [&](Dof dof) { return dof >= Dof::rx && frame.motion(node, dof).nonZeros() > 0; });
}

}  // namespace

std::vector<bool> at_loose_joints(const Frame& frame, const AssembledFrame& assembled,
                                  const std::vector<bool>& keeps_nothing) {
  const std::vector<Hinge>& hinges = frame.hinges();
  std::set<std::pair<int, int>> yields;  // members and indices of their end forces
  for (std::size_t i = 0; i < hinges.size(); ++i)
    if (keeps_nothing[i]) yields.emplace(hinges[i].member, hinges[i].place());
  const auto lets_go = [&](int member, MemberEnd at) {
    const Beam& beam = frame.beam(member);
    const auto is_free = [&](BendingAxis about) {
      const Hinge end{.member = member, .at = at, .about = about};
      return beam.is_released(end.place()) || yields.contains({member, end.place()});
    };
    return beam.is_truss() || (is_free(BendingAxis::y) && (frame.dimension() == 2 || is_free(BendingAxis::z)));
  };
  std::vector<bool> held(static_cast<std::size_t>(frame.nodes()), false);
  for (int member = 0; member < frame.members(); ++member) {
    const auto [start, end] = frame.ends(member);
    if (!lets_go(member, MemberEnd::start)) held[start] = true;
    if (!lets_go(member, MemberEnd::end)) held[end] = true;
  }
  std::vector<bool> loose;
  for (const Hinge& hinge : hinges) {
    const auto [start, end] = frame.ends(hinge.member);
    const int node = hinge.at == MemberEnd::start ? start : end;
    loose.push_back(!held[node] && turns(assembled, node));
  }
  return loose;
}

}  // namespace pounding
