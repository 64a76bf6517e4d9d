#pragma once
/// Members of the input, which may be divided into several elements of a frame.

#include <string>
#include <string_view>
#include <vector>

#include <pounding/frames/frame.hpp>

namespace pounding {

/// A member of the input: one element of the frame, or all elements of a subdivided member.
struct WholeMember {
  std::string name;
  int first = 0, last = 0;  ///< elements of the frame
  double length = 0;        ///< of all elements [m]
};

/// All members, in the order of their elements.
std::vector<WholeMember> whole_members(const Frame& frame);

/// The horizontal ones for `beams`, the vertical ones for `columns`; without trusses.
std::vector<WholeMember> members_of_group(const Frame& frame, std::string_view group);

}  // namespace pounding
