#pragma once
/// The motion of floors as reports show it, from the output quantities of the stepper.

#include <Eigen/Core>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Turns System::outputs^T times u, v, a into the reported motion of the floors: displacements and velocities relative
/// to the ground at the first support of their structure, with the displacement under gravity; absolute accelerations.
///
/// Each direction of each floor is one row of the motion: structure by structure, floor by floor.
class FloorResponse {
 public:
  FloorResponse(const Model& model, const GroundPlan& plan);

  /// Directions in which the floors of a structure move; 0 for a structure without floors.
  int directions(int structure) const { return directions_[structure]; }
  /// Row of the motion that holds a floor, counted from 0 at the lowest, in a direction.
  int row(int structure, int floor, int direction) const {
    return first_[structure] + floor * directions_[structure] + direction;
  }
  /// Rows of the translations of all floors of a structure.
  std::vector<int> translations(int structure) const;
  /// Completes a motion [row, u v a], [m], [m/s], [m/s^2], at a time [s]; `ground` holds the accelerations of all
  /// ground motions at that instant [m/s^2].
  void complete(Eigen::MatrixXd& motion, double time, const Eigen::VectorXd& ground) const;
  /// Completes accelerations alone [m/s^2].
  void complete_accelerations(Eigen::Ref<Eigen::VectorXd> accelerations, const Eigen::VectorXd& ground) const;

 private:
  std::vector<GroundMotion> grounds_;
  std::vector<int> first_, directions_;
  Eigen::VectorXd at_rest_;  // displacement under gravity [m]
  Eigen::MatrixXd
      by_difference_;  // rows on ground motions: supports that move unlike the first; empty where all move alike
  std::vector<int> ground_of_;  // ground motion that moves the first support along each row; -1 for none
};

}  // namespace pounding
