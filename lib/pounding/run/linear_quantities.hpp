#pragma once
/// Quantities that follow linearly from the unknowns and from the ground at the supports: forces inside frames, and how far the ends
/// of links move.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Quantities f = at_rest + rows * u + by_ground * displacements of the ground, and their rates.
class LinearQuantities {
 public:
  /// `by_ground` has one column a motion of the plan; all zero where supports move alike. `first`: of the unknowns.
  LinearQuantities(Eigen::SparseMatrix<double, Eigen::RowMajor> rows, int first, Eigen::VectorXd at_rest, Eigen::MatrixXd by_ground);

  /// Number of quantities.
  int size() const { return static_cast<int>(at_rest_.size()); }
  /// Values and rates from the displacements u [m] and velocities v [m/s] of all unknowns at a time [s].
  void evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& v, double time, std::span<const GroundMotion> grounds,
                Eigen::Ref<Eigen::VectorXd> values, Eigen::Ref<Eigen::VectorXd> rates) const;

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;
  int first_;
  Eigen::VectorXd at_rest_;
  Eigen::MatrixXd by_ground_;  // empty for none
};

/// Quantities of one frame: storey shears floor by floor, then InternalForces row by row. Without what members that turn add.
LinearQuantities internal_forces(const Model& model, int structure, const GroundPlan& plan);

/// Quantities of all links, three each: displacements of the left and of the right end along the link, relative to the ground at the first
/// support of their structures, and how far the two have approached each other [m].
LinearQuantities approaches(const Model& model, const GroundPlan& plan);

}  // namespace pounding
