#pragma once
/// Quantities that follow linearly from the unknowns and from the ground at the supports: forces inside frames, and how
/// far the ends of links move.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <span>
#include <vector>

#include <pounding/ground/ground_motion.hpp>
#include <pounding/model/ground_plan.hpp>
#include <pounding/model/model.hpp>

namespace pounding {

/// Quantities f = at_rest + rows * u + by_ground * displacements of the ground, and their rates; parts that yield may
/// add to them.
///
/// Many forces of a frame are the same but for the sign: axial and shear forces at the two ends of a member, reactions
/// and the column that stands on them. Such quantities may be evaluated once.
class LinearQuantities {
 public:
  /// Values at some instants, a row for each, then rates at them.
  template <int instants>
  using Instants = Eigen::Matrix<double, 2 * instants, Eigen::Dynamic>;
  /// Instants that are evaluated at once cost less each: indices are read once for all.
  static constexpr int batch = 8;

  /// Where a quantity is among the evaluated ones, -1 if it is not, and whether it is the opposite of that one.
  struct Place {
    int at;
    bool opposite;
  };

  /// Whether a quantity belongs to these.
  using Choice = std::function<bool(int quantity)>;

  /// The first `unknowns` columns of `rows` are those of unknowns, from `first` on; the others those of forces of parts
  /// that yield. `by_ground` has one column a motion of the plan; all zero where supports move alike. With `merge`,
  /// equal and opposite quantities are evaluated once.
  LinearQuantities(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, int unknowns, int first,
                   const Eigen::VectorXd& at_rest, const Eigen::MatrixXd& by_ground, const Choice& chosen, bool merge);

  /// Number of evaluated quantities.
  int size() const { return static_cast<int>(at_rest_.size()); }
  /// Places of all quantities in their order.
  const std::vector<Place>& places() const { return places_; }
  /// Quantities, a column each, from `motions`: displacements [m] and velocities [m/s] of all unknowns, a column each,
  /// at these times [s], `instants` of them, which is 1 or `batch`.
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

/// Entries of the forces at the ends of the members of a structure, from this row on [row, unknown]; behind its
/// unknowns those of what yields in it.
void add_member_forces(std::vector<Eigen::Triplet<double>>& entries, const Structure& structure, int first_row);

/// Quantities of one frame: storey shears floor by floor, then InternalForces row by row. Without what members that
/// turn add. Columns of `rows` after the unknowns are those of its parts that yield.
LinearQuantities internal_forces(const Model& model, int structure, const GroundPlan& plan,
                                 const LinearQuantities::Choice& chosen, bool merge);

/// Quantities of all links, three each: displacements of the left and of the right end along the link, relative to the
/// ground at the first support of their structures, and how far the two have approached each other [m].
LinearQuantities approaches(const Model& model, const GroundPlan& plan);

}  // namespace pounding
