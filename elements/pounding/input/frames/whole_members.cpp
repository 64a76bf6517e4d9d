#include <pounding/input/frames/whole_members.hpp>

#include <cmath>

namespace pounding {

std::vector<WholeMember> whole_members(const Frame& frame) {
  std::vector<WholeMember> all;
  for (int member = 0; member < frame.members(); ++member) {
    const std::string name = frame.member_name(member), whole = name.substr(0, name.find('/'));
    if (all.empty() || all.back().name != whole) all.push_back({whole, member, member});
    all.back().last = member;
    all.back().length += frame.beam(member).length();
  }
  return all;
}

std::vector<WholeMember> members_of_group(const Frame& frame, std::string_view group) {
  std::vector<WholeMember> all;
  for (const WholeMember& whole : whole_members(frame)) {
    const Beam& beam = frame.beam(whole.first);
    const double rise = std::abs(beam.axes()(0, 2));
    if (!beam.is_truss() && (group == "beams" ? rise < 1e-6 : rise > 1 - 1e-12)) all.push_back(whole);
  }
  return all;
}

}  // namespace pounding
