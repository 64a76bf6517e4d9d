#pragma once
/// How far springs can be deformed at most, all of them at once, without a product for each.

#include <Eigen/Core>
#include <utility>

#include <pounding/linear/link_columns.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// A spring i is deformed by sum_k b_ik u_k + c_i, which leaves no range c_i - r_i < d < c_i + r_i as long as sum_k
/// |b_ik| |u_k| < r_i. With g_k, the largest |b_ik|/r_i of all springs of a structure, sum_k g_k |u_k| < 1 says so of
/// all its springs, in as many operations as it has coordinates. In modes this is close: few of them take part, and
/// each bends the same hinges most.
class DeformationBound {
 public:
  /// `springs`: their columns of B in the coordinates of the solver, both of which must outlive it; `at_rest`: c [m].
  /// Nothing is sure until ranges are set.
  DeformationBound(const StructureSolver& solver, const LinkColumns& springs, Eigen::VectorXd at_rest)
      : solver_(solver), springs_(springs), at_rest_(std::move(at_rest)) {}

  /// Ranges of deformation of all springs [m], infinite ones for those that do not count. Nothing is sure where c of
  /// one lies outside its range.
  void set(const Eigen::VectorXd& low, const Eigen::VectorXd& high);

  /// The largest part of their room that springs may use.
  struct Reach {
    double at = 0;       ///< an instant
    double by_rate = 0;  ///< in a second at its rates
    /// Within a time before and after it, if they went on at these rates [s].
    double after(double time) const { return at + time * by_rate; }
  };
  Reach reach(const Instant& x) const;
  /// Whether so much leaves all springs strictly inside, rounding included.
  static bool inside(double part) { return part < 1 - 1e-9; }

 private:
  template <class Moved>
  double largest(const Moved& moved) const;

  const StructureSolver& solver_;
  const LinkColumns& springs_;
  Eigen::VectorXd at_rest_;
  bool is_set_ = false;
  Eigen::VectorXd parts_;  // g
};

}  // namespace pounding
