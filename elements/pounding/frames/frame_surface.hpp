#pragma once
/// Contact points of a frame.

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pounding/frames/frame_model.hpp>
#include <pounding/structures/structure.hpp>

namespace pounding {

/// Mass that moves along x with these nodes [kg], including nodes tied to them.
double mass_along_x(const AssembledFrame& frame, const std::vector<int>& nodes);

/// The contact point of a floor on a side is its outermost node; in space, a point between the two outermost ends. On a
/// rigid floor it moves horizontally with the master, and vertically by linear interpolation between its nodes. On
/// other floors it is a node, or a point on the member that passes there.
///
/// Between nodes, a point moves according to the shape functions of the member (see Frame::point_on_member). Throws
/// std::invalid_argument for a point that does not exist, and for a contact force on a massless unknown.
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
    int member, node;  // the node with a rigid arm to the point; -1 on the member itself
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
