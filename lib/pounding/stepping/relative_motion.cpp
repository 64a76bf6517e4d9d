#include <pounding/stepping/relative_motion.hpp>

#include <utility>

namespace pounding {

RelativeMotion::RelativeMotion(const LinkSet& links, const StructureSolver& solver, int width)
    : links_(links), solver_(solver), width_(width) {
  const LinkColumns* const columns = solver.columns();
  if (!columns || links.springs() == 0) return;
  can_wait_ = true;
  contacts_ = columns->part(0, links.contacts());
  springs_ = columns->part(links.contacts(), links.frictions_from());
  frictions_ = columns->part(links.frictions_from(), links.size());
}

std::optional<DeformationBound> RelativeMotion::bound() const {
  if (!can_wait_) return std::nullopt;
  Eigen::VectorXd at_rest(links_.springs());
  for (int i = 0; i < links_.springs(); ++i) at_rest[i] = links_.by_gravity(links_.contacts() + i);
  return DeformationBound(solver_, springs_, std::move(at_rest));
}

void RelativeMotion::gather(Instant& x) const {
  solver_.gather(x.motion.leftCols(width_), x.relative);
  x.springs_known = Instant::columns;
}

void RelativeMotion::gather_others(Instant& x) const {
  contacts_.gather_rows(x.motion.leftCols(width_), x.relative);
  frictions_.gather_rows(x.motion.leftCols(width_), x.relative);
  x.springs_known = 0;
}

void RelativeMotion::gather_springs(const Instant& x, int columns) const {
  const int known = x.springs_known;
  if (known >= columns) return;
  springs_.gather_rows(x.motion.middleCols(known, columns - known), x.relative.middleCols(known, columns - known));
  x.springs_known = columns;
}

void RelativeMotion::deformations(const Eigen::Ref<const Eigen::MatrixXd>& u, Eigen::MatrixXd& d) const {
  room_.resize(links_.size(), u.cols());
  springs_.gather_rows(u, room_);
  d = room_.middleRows(links_.contacts(), links_.springs());
  for (int i = 0; i < links_.springs(); ++i) d.row(i).array() += links_.by_gravity(links_.contacts() + i);
}

}  // namespace pounding
