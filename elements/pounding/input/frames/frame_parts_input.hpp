#pragma once
/// The nodes and members of a frame's input: its grid and its lists.

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/input/frames/frame_input.hpp>
#include <pounding/input/frames/frame_parser.hpp>
#include <pounding/input/frames/section_input.hpp>

namespace pounding {

/// Returns what the call returns; its std::invalid_argument is reported at this place of the input.
template <class Act>
auto placed(const Input& location, Act&& act) {
  try {
    return act();
  } catch (const std::invalid_argument& error) {
    location.fail(error.what());
  }
}

/// Reads `grid`, `nodes` and `members` into a frame and knows them by their names afterwards. Everything throws
/// InputError at what is wrong.
class FramePartsInput {
 public:
  /// `body` is the whole input of the frame and outlives this.
  explicit FramePartsInput(const Input& body);

  /// The frame so far; the rest of the input is added by the caller.
  FrameInput frame;

  const FrameParser& keys() const { return keys_; }  ///< reads single words of this frame
  int dimension() const { return dimension_; }       ///< 2 in the plane, 3 in space
  /// Place of the foot of the frame, by which the caller moves it when all is read [m].
  const Eigen::Vector3d& origin() const { return origin_; }
  /// Nodes on the ground of the grid, and the shares of the nodes of each of its floors.
  const GridParts& grid() const { return grid_; }
  const std::map<std::string, int>& node_numbers() const { return nodes_; }
  const std::map<std::string, int>& member_numbers() const { return members_; }

  /// The node that a key, an item or the items of a list name.
  int node_at_key(const std::string& name, const Input& location) const;
  int node_of(const Input& item) const;
  std::vector<int> nodes_of(const Input& list) const;

 private:
  std::vector<std::string> node_names() const;
  void read_origin();
  void read_grid(const Input& grid);
  bool is_of_grid(const std::string& name) const;
  void read_members_of_grid(const Input& members, GridFrame& grid) const;
  GridMember read_member_of_grid(const Input& node) const;
  Eigen::Vector3d read_load(const Input& load) const;
  void read_node(const std::string& name, const Input& node);
  void read_member(const std::string& name, const Input& node);
  BeamOptions read_beam_options(const Input& node) const;
  void add_truss(const std::string& name, const Input& node, const Input& truss, int start, int end,
                 const Material& material);
  void name_member(int member, const std::string& name, const Input& location);
  void check_name(const std::string& name, const Input& location) const;

  const Input& body_;
  FrameParser keys_;
  int dimension_ = keys_.dimension();
  SectionLibrary library_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  BeamMass mass_kind_ = BeamMass::lumped;
  std::map<std::string, int> nodes_, members_;
  GridParts grid_;
};

}  // namespace pounding
