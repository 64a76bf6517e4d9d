#pragma once
/// Motion of the floors as reported, from the output quantities of the stepper.

#include <Eigen/Core>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Converts System::outputs^T times u, v and a to the reported motion of the floors. Displacements and velocities are
/// relative to the ground at the first support of the structure and include the displacement under gravity;
/// accelerations are absolute.
///
/// Each direction of each floor is one row of the motion: structure by structure, floor by floor.
class FloorResponse {
 public:
  FloorResponse(const Model& model, const GroundPlan& plan);

  /// Number of directions in which the floors of a structure move; zero without floors.
  int directions(int structure) const { return directions_[structure]; }
  /// Row of the motion for a floor, counted from 0 at the lowest, and a direction.
  int row(int structure, int floor, int direction) const {
    return first_[structure] + floor * directions_[structure] + direction;
  }
  /// Rows of the translations of all floors of a structure.
  std::vector<int> translations(int structure) const;
  /// Completes a motion [row, u v a], [m], [m/s], [m/s^2], at a time [s]; `ground` contains the accelerations of all
  /// ground motions at that time [m/s^2].
  void complete(Eigen::MatrixXd& motion, double time, const Eigen::VectorXd& ground) const;
  /// Completes accelerations only [m/s^2].
  void complete_accelerations(Eigen::Ref<Eigen::VectorXd> accelerations, const Eigen::VectorXd& ground) const;

 private:
  std::vector<GroundMotion> grounds_;
  std::vector<int> first_, directions_;
  Eigen::VectorXd at_rest_;  // displacement under gravity [m]
  // rows on ground motions, for supports whose motion differs from the first; empty if all are equal
  Eigen::MatrixXd by_difference_;
  std::vector<int> ground_of_;  // ground motion of the first support for each row; -1 for none
};

}  // namespace pounding
