#pragma once
/// Nodes and members of a frame, from its grid and its lists.

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <pounding/input/fail_at.hpp>
#include <pounding/input/frames/frame_input.hpp>
#include <pounding/input/frames/frame_parser.hpp>
#include <pounding/input/frames/section_input.hpp>

namespace pounding {

/// Reads `grid`, `nodes` and `members` into a frame and finds them by name. All functions throw InputError with the
/// location.
class FramePartsInput {
 public:
  /// `body` is the whole section of the frame; it must outlive this object.
  explicit FramePartsInput(const Input& body);

  /// The frame; the caller adds the rest of the input.
  FrameInput frame;

  const FrameParser& keys() const { return keys_; }  ///< reads single values of this frame
  int dimension() const { return dimension_; }       ///< 2 in the plane, 3 in space
  /// Position of the foot of the frame [m]; the caller moves the complete frame there.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// Ground nodes of the grid, and mass fractions of the nodes of a floor.
  const GridParts& grid() const { return grid_; }
  const std::map<std::string, int>& node_numbers() const { return nodes_; }
  const std::map<std::string, int>& member_numbers() const { return members_; }

  /// Nodes named by a key, an item or the items of a list.
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
