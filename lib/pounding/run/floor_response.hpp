#pragma once
/// What a report takes from the unknowns: the motion of floors at every step, all else at the output times.

#include <Eigen/Core>
#include <span>
#include <vector>

#include <pounding/model/model.hpp>

namespace pounding {

/// Motion of the floors as reported: relative to the ground at the structure's first support, with the place at rest; accelerations
/// absolute.
class FloorResponse {
 public:
  explicit FloorResponse(const Model& model);

  /// Quantities that are followed, and directions of a structure's floors.
  int count() const { return static_cast<int>(at_rest_.size()); }
  int directions(int structure) const { return directions_[structure]; }
  /// Column of a floor in a direction.
  int column(int structure, int floor, int direction) const { return first_[structure] + floor * directions_[structure] + direction; }
  /// Of [quantity, u v a] as outputs; `ground` are the accelerations of the grounds just then.
  void complete(Eigen::MatrixXd& motion, double time, const Eigen::VectorXd& ground) const;
  /// Of accelerations alone, a column of them.
  void complete_accelerations(Eigen::Ref<Eigen::VectorXd> accelerations, const Eigen::VectorXd& ground) const;

 private:
  std::vector<GroundMotion> grounds_;
  std::vector<int> first_, directions_;
  Eigen::VectorXd at_rest_;        // [m]
  Eigen::MatrixXd by_difference_;  // of supports that move differently, columns x grounds; empty when none do
  std::vector<int> ground_of_;     // that moves the first support along each column; -1 for none
};

}  // namespace pounding
