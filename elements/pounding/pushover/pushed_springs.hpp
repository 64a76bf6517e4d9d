#pragma once
/// The springs of a structure while it is pushed.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include <pounding/structures/structure.hpp>

namespace pounding {

/// The springs of the yielding parts of a structure, as they were given; they are left so.
class PushedSprings {
 public:
  explicit PushedSprings(const Structure& structure);
  ~PushedSprings() { refresh(); }
  PushedSprings(const PushedSprings&) = delete;
  PushedSprings& operator=(const PushedSprings&) = delete;

  const std::vector<Spring*>& all() const noexcept { return springs_; }
  Spring& operator[](Eigen::Index j) const { return *springs_[static_cast<std::size_t>(j)]; }
  /// Stiffness of a part before it yields, of all its force [N/m].
  double stiffness(Eigen::Index j) const { return (*this)[j].stiffness() + (*this)[j].first_slope(); }
  /// Whether the slope of a part jumps where it first yields; else it yields where its deformation says so.
  bool has_corner(Eigen::Index j) const { return has_corner_[static_cast<std::size_t>(j)]; }

  /// Forces on top of k d at these deformations, on the straight way from the kept ones, and their slopes.
  std::pair<Eigen::VectorXd, Eigen::VectorXd> law(const Eigen::VectorXd& deformations) const;
  /// Keeps the straight way from one state to another.
  void follow(const Eigen::VectorXd& from, const Eigen::VectorXd& to);
  /// Throws std::invalid_argument for a part, undeformed until now, that would have yielded at its deformation.
  void require_unyielded(const Eigen::VectorXd& deformations) const;
  /// Begins at these deformations, undeformed before.
  void start(const Eigen::VectorXd& deformations);

 private:
  void refresh();

  const Structure& structure_;
  std::vector<Spring*> springs_;
  std::vector<bool> has_corner_;
};

}  // namespace pounding
