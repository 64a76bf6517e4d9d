#pragma once
/// The relative motions of all links at an instant; those of springs may wait until somebody asks for them.

#include <optional>

#include <pounding/linear/link_columns.hpp>
#include <pounding/linear/structure_solver.hpp>
#include <pounding/stepping/deformation_bound.hpp>
#include <pounding/stepping/link_set.hpp>
#include <pounding/stepping/step_state.hpp>

namespace pounding {

/// Makes Instant::relative, the products B^T of the motion. A frame may have a hundred hinges, which cost most of them,
/// and while all stay elastic nothing else depends on how far they turn.
class RelativeMotion {
 public:
  /// `width`: columns of Instant::motion that have products. The others must outlive it.
  RelativeMotion(const LinkSet& links, const StructureSolver& solver, int width);

  /// A bound on the deformations of springs that can wait; nothing where they cannot, as this process has not all of
  /// them. This must outlive it.
  std::optional<DeformationBound> bound() const;
  /// Makes those of all links.
  void gather(Instant& x) const;
  /// Makes all but those of the springs, which wait; only where they can.
  void gather_others(Instant& x) const;
  /// Makes so many columns of those of the springs, if they wait.
  void gather_springs(const Instant& x, int columns) const;
  /// Makes all columns of these, if they wait.
  void gather_springs(const Instant& x) const { gather_springs(x, width_); }
  /// Deformations of the springs alone, without forces of their own, for displacements of the coordinates [spring,
  /// column]; only where they can wait.
  void deformations(const Eigen::Ref<const Eigen::MatrixXd>& u, Eigen::MatrixXd& d) const;

 private:
  const LinkSet& links_;
  const StructureSolver& solver_;
  const int width_;
  bool can_wait_ = false;
  LinkColumns contacts_, springs_, frictions_;
  mutable Eigen::MatrixXd room_;  // a row for every link
};

}  // namespace pounding
