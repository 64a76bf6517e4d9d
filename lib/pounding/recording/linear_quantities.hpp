#pragma once
/// Quantities linear in the unknowns and in the ground motion at the supports: internal forces of frames, and
/// displacements of link ends.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <span>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Quantities f = at_rest + rows * u + by_ground * displacements of the ground, and their rates. Yielding parts may add
/// to them.
///
/// Many forces of a frame are equal up to the sign: axial and shear forces at the two ends of a member, or a reaction
/// and the force in the column above it. Such quantities can be evaluated only once.
class LinearQuantities {
 public:
  /// Values at several instants, one row each, then the rates.
  template <int instants>
  using Instants = Eigen::Matrix<double, 2 * instants, Eigen::Dynamic>;
  /// Number of instants evaluated together, which reads the indices only once.
  static constexpr int batch = 8;

  /// Index of a quantity among the evaluated ones, -1 if not evaluated, and true if it has the opposite sign.
  struct Place {
    int at;
    bool opposite;
  };

  /// True for the quantities to include.
  using Choice = std::function<bool(int quantity)>;

  /// The first `unknowns` columns of `rows` refer to unknowns from `first` on, the others to forces of yielding parts.
  /// `by_ground` has one column per motion of the plan; all zero if the supports move equally. With `merge`, equal and
  /// opposite quantities are evaluated once.
  LinearQuantities(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, int unknowns, int first,
                   const Eigen::VectorXd& at_rest, const Eigen::MatrixXd& by_ground, const Choice& chosen, bool merge);

  /// Number of evaluated quantities.
  int size() const { return static_cast<int>(at_rest_.size()); }
  /// Places of all quantities, in order.
  const std::vector<Place>& places() const { return places_; }
  /// Evaluates quantities, one column each. `motions` holds displacements [m] and velocities [m/s] of all unknowns, one
  /// column each, at the `instants` (1 or `batch`) times [s].
  template <int instants>
  void evaluate(const Instants<instants>& motions, std::span<const double> times, std::span<const GroundMotion> grounds,
                Instants<instants>& quantities) const;
  /// Adds what forces of parts that yield give to the quantities, or their rates to the rates.
  void add_yielding(const Eigen::Ref<const Eigen::VectorXd>& forces, Eigen::VectorXd& values) const {
    if (by_yielding_.nonZeros() > 0 && !forces.isZero(0)) values += by_yielding_ * forces;
  }

 private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> rows_, by_yielding_;
  std::vector<Place> places_;
  int first_;
  Eigen::VectorXd at_rest_;
  Eigen::MatrixXd by_ground_;  // empty for none
};

/// Appends the entries of the end forces of all members of a structure, from this row on [row, unknown]; columns for
/// its yielding parts follow those of its unknowns.
void add_member_forces(std::vector<Eigen::Triplet<double>>& entries, const Structure& structure, int first_row);

/// Quantities of one frame: storey shears by floor, then the rows of InternalForces. Excludes the contributions of
/// members that rotate by large angles. Columns of `rows` after the unknowns refer to its yielding parts.
LinearQuantities internal_forces(const Model& model, int structure, const GroundPlan& plan,
                                 const LinearQuantities::Choice& chosen, bool merge);

/// Three quantities per link: displacements of the left and the right end along the link, relative to the ground at the
/// first support of their structures, and the approach of the two ends [m].
LinearQuantities approaches(const Model& model, const GroundPlan& plan);

}  // namespace pounding
