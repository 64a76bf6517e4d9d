#pragma once
/// Quantities that follow linearly from the unknowns and from the ground at the supports: forces inside frames, and how far the ends
/// of links move.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <span>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Quantities f = at_rest + rows * u + by_ground * displacements of the ground, and their rates.
///
/// Many forces of a frame are the same but for the sign: axial and shear forces at the two ends of a member, reactions and the column
/// that stands on them. Such quantities are evaluated once.
class LinearQuantities {
 public:
  /// Where a quantity is among the evaluated ones, and whether it is the opposite of that one.
  struct Place {
    int at;
    bool opposite;
  };

  /// `by_ground` has one column a motion of the plan; all zero where supports move alike. `first`: of the unknowns. Quantities for
  /// which `apart` says so are evaluated for themselves.
  LinearQuantities(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, int first, const Eigen::VectorXd& at_rest,
                   const Eigen::MatrixXd& by_ground, const std::function<bool(int quantity)>& apart);

  /// Number of evaluated quantities.
  int size() const { return static_cast<int>(at_rest_.size()); }
  /// Places of all quantities in their order.
  const std::vector<Place>& places() const { return places_; }
  /// Values and rates from the displacements u [m] and velocities v [m/s] of all unknowns at a time [s].
  void evaluate(const Eigen::VectorXd& u, const Eigen::VectorXd& v, double time, std::span<const GroundMotion> grounds,
                Eigen::Ref<Eigen::VectorXd> values, Eigen::Ref<Eigen::VectorXd> rates) const;

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_;
  std::vector<Place> places_;
  int first_;
  Eigen::VectorXd at_rest_;
  Eigen::MatrixXd by_ground_;  // empty for none
};

/// Quantities of one frame: storey shears floor by floor, then InternalForces row by row. Without what members that turn add.
LinearQuantities internal_forces(const Model& model, int structure, const GroundPlan& plan, const std::function<bool(int quantity)>& apart);

/// Quantities of all links, three each: displacements of the left and of the right end along the link, relative to the ground at the first
/// support of their structures, and how far the two have approached each other [m].
LinearQuantities approaches(const Model& model, const GroundPlan& plan);

}  // namespace pounding
