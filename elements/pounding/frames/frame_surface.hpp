#pragma once
/// Points at which a frame can be touched.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// The mass that moves along x with these nodes [kg]; what is tied to them moves with them.
double mass_along_x(const AssembledFrame& frame, const std::vector<int>& nodes);

/// A floor is touched on a side at its outermost node, in space at a point between the two outermost ends. A rigid
/// floor moves there as its master on an arm, straight between its nodes vertically; another floor is touched at its
/// node or on the member that passes there.
///
/// Between nodes a point moves as the member's shape functions say (see Frame::point_on_member). What is asked for and
/// does not exist, and a push on an unknown without mass, throw std::invalid_argument.
class FrameSurface final : public Surface {
 public:
  FrameSurface(std::shared_ptr<const FrameModel> model, std::shared_ptr<const AssembledFrame> assembled);

  std::optional<std::array<double, 4>> plan() const override;
  std::array<double, 2> edge(int floor, Side side) const override;
  ContactPoint floor(int floor, Side side, double along) const override;
  ContactPoint column(double elevation, Side side, double along) const override;
  ContactPoint node(const std::string& name) const override;
  std::optional<ColumnFace> column_face(const Eigen::Vector3d& point, Side side) const override;
  Row displacement(const std::string& node, const std::string& dof) const override;

 private:
  struct OnColumn {
    int member, node;  // the node on whose rigid arm the point lies, -1 on the member itself
    double along;      // on the member
    Eigen::Vector3d position;
  };

  Eigen::Vector3d position(int node) const { return model_->frame.position(node); }
  int axis_of(Side side) const;
  std::vector<int> edge_nodes(int floor, Side side) const;
  std::optional<OnColumn> on_column(int member, double elevation) const;
  std::optional<std::pair<int, double>> member_through(const Eigen::Vector3d& point) const;
  int numbered(const std::string& node) const;
  double mass_of(int node) const;
  double mass_of(const OnColumn& point) const;
  ContactPoint on_arm(int node, const Eigen::Vector3d& position, double mass) const;
  ContactPoint on_member(int member, double along, const Eigen::Vector3d& position, double mass) const;
  ContactPoint on_rigid_floor(int floor, int before, int after, const Eigen::Vector3d& position) const;
  double to_joint(const OnColumn& point) const;
  ContactPoint pushed(ContactPoint point, int axis) const;

  std::shared_ptr<const FrameModel> model_;
  std::shared_ptr<const AssembledFrame> assembled_;
  std::vector<int> floor_of_node_;
  std::vector<double> floor_mass_;
};

}  // namespace pounding
