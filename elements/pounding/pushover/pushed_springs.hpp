#pragma once
/// Springs of a structure during a pushover.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// Springs of the yielding parts of a structure, with their memories.
class PushedSprings {
 public:
  explicit PushedSprings(const Structure& structure);

  const std::vector<LoadedSpring>& all() const noexcept { return springs_; }
  LoadedSpring& operator[](Eigen::Index j) { return springs_[static_cast<std::size_t>(j)]; }
  const LoadedSpring& operator[](Eigen::Index j) const { return springs_[static_cast<std::size_t>(j)]; }
  /// Stiffness of a part before yield, of its total force [N/m].
  double stiffness(Eigen::Index j) const { return (*this)[j]->stiffness() + (*this)[j]->first_slope(); }
  /// True if the slope of a part jumps at first yield; otherwise yield is defined by its deformation.
  bool has_corner(Eigen::Index j) const { return has_corner_[static_cast<std::size_t>(j)]; }

  /// Forces in addition to k d at these deformations, on the straight path from the accepted ones, and their slopes.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> law(const Eigen::VectorXd& deformations) const;
  /// Accepts the straight path from one state to another.
  void follow(const Eigen::VectorXd& from, const Eigen::VectorXd& to);
  /// Throws std::invalid_argument for an undeformed part that would yield at its deformation.
  void require_unyielded(const Eigen::VectorXd& deformations) const;
  /// Starts at these deformations, from the undeformed state.
  void start(const Eigen::VectorXd& deformations);

 private:
  const Structure& structure_;
  std::vector<LoadedSpring> springs_;
  std::vector<bool> has_corner_;
};

}  // namespace pounding
