#include <pounding/stepping/springs/spring_forces.hpp>

#include <algorithm>

namespace pounding {
namespace {

// Laws are evaluated at this fraction of a step after its beginning: further than a located corner may lie from the end
// of its step (EventLocator).
constexpr double just_behind = 4e-3;
constexpr int max_branches = 8;

}  // namespace

Eigen::MatrixXd relief_among(const SparseMatrix& s, std::span<const int> springs) {
  const auto count = static_cast<Eigen::Index>(springs.size());
  Eigen::MatrixXd part = Eigen::MatrixXd::Zero(count, count);
  std::vector<Eigen::Index> place(static_cast<std::size_t>(s.rows()), -1);
  for (Eigen::Index i = 0; i < count; ++i)
    if (springs[i] >= 0) place[springs[i]] = i;
  for (Eigen::Index j = 0; j < count; ++j) {
    if (springs[j] < 0) continue;
    for (SparseMatrix::InnerIterator it(s, springs[j]); it; ++it)
      if (place[it.row()] >= 0) part(place[it.row()], j) = it.value();
  }
  return part;
}

SpringForces::SpringForces(const LinkSet& links) : links_(links), any_(links.relief().any()), solver_(links) {
  for (const CoupledElement& element : links.coupled()) width_ = std::max(width_, element.count);
}

bool SpringForces::settle(std::vector<LinkMotion>& motions, Eigen::VectorXd& force) {
  const int first = links_.contacts(), count = links_.springs();
  const SparseMatrix& s = links_.relief().flexibility();
  std::vector<bool> is_active(static_cast<std::size_t>(count), false);
  active_.clear();
  const auto gives_way = [&](int i) { return s.outerIndexPtr()[i + 1] > s.outerIndexPtr()[i]; };
  for (int i = 0; i < count; ++i)
    if (!gives_way(i) && !links_.is_coupled(first + i))
      force[first + i] = links_.law(first + i, motions[first + i]).force;
  for (const CoupledElement& element : links_.coupled())
    for (int j = 0; j < element.count; ++j) {
      is_active[element.first + j - first] = true;
      active_.push_back(element.first + j);
    }
  for (std::size_t known = 0;; known = active_.size()) {
    relief_.setZero(count);
    links_.relief().add_relief(1, force.segment(first, count), relief_);
    for (int i = 0; i < count; ++i) {
      if (is_active[i] || !gives_way(i)) continue;
      const LinkMotion& free = motions[first + i];
      if (links_.law(first + i, {free.penetration - relief_[i], free.rate}).force == force[first + i]) continue;
      is_active[i] = true;
      active_.push_back(first + i);
    }
    if (active_.size() == known) break;
    std::sort(active_.begin(), active_.end());
    if (!solve(motions, force)) return false;
  }
  for (int i = 0; i < count; ++i) motions[first + i].penetration -= relief_[i];
  return true;
}

void SpringForces::set_no_flexibility(Eigen::Index count) {
  zero_.resize(count, count);
  none_.resize(count);
  zero_.setZero();
  none_.setZero();
}

// Newton's method for the active springs with the forces of the others fixed; relief_ is S F.
bool SpringForces::solve(const std::vector<LinkMotion>& motions, Eigen::VectorXd& force) {
  const int first = links_.contacts(), count = static_cast<int>(active_.size());
  std::vector<int> springs;
  for (const int link : active_) springs.push_back(link - first);
  flexibility_ = relief_among(links_.relief().flexibility(), springs);
  set_no_flexibility(count);
  Eigen::VectorXd own = force(active_);
  const Eigen::VectorXd by_own = flexibility_ * own;
  free_.resize(active_.size());
  for (int k = 0; k < count; ++k) {
    const LinkMotion& motion = motions[active_[k]];
    free_[k] = {motion.penetration - (relief_[springs[k]] - by_own[k]), motion.rate};
  }
  const CondensedLinks condensed{
      .active = active_, .free = free_, .free_acceleration = none_, .flexibility = zero_, .relief = &flexibility_};
  if (!solver_.solve(condensed, own)) return false;
  force(active_) = own;
  return true;
}

void SpringForces::relieve(Instant& x) const {
  x.relief.setZero(links_.springs());
  const auto forces = x.force.segment(links_.contacts(), links_.springs());
  if (forces.cwiseAbs().sum() != 0) links_.relief().add_relief(1, forces, x.relief);
}

void SpringForces::slopes(std::span<const LinkMotion> motions, int from, Eigen::MatrixXd& slopes) const {
  const int first = links_.contacts();
  slopes.setZero(links_.springs(), width_);
  for (int i = first; i < links_.frictions_from(); ++i)
    if (!links_.is_coupled(i)) slopes(i - first, 0) = links_.law(i, motions[i - from]).by_penetration;
  for (const CoupledElement& element : links_.coupled()) {
    const ElementResponse answer = links_.law(element, motions.subspan(element.first - from, element.count));
    for (int j = 0; j < element.count; ++j)
      for (int k = 0; k < element.count; ++k) slopes(element.first + j - first, k) = answer.by_deformation[j][k];
  }
}

Eigen::MatrixXd SpringForces::force_rates(const Eigen::MatrixXd& slopes, const Eigen::MatrixXd& of_springs) const {
  Eigen::MatrixXd rates = slopes.col(0).asDiagonal() * of_springs;
  for (const CoupledElement& element : links_.coupled()) {
    const int first = element.first - links_.contacts(), count = element.count;
    rates.middleRows(first, count) = slopes.block(first, 0, count, count) * of_springs.middleRows(first, count);
  }
  return rates;
}

void SpringForces::rates(const Eigen::MatrixXd& slopes, Eigen::MatrixXd& of_springs) {
  const SparseMatrix& s = links_.relief().flexibility();
  soft_.clear();
  for (int i = 0; i < slopes.rows(); ++i)
    if (!slopes.row(i).isZero(0) && s.outerIndexPtr()[i + 1] > s.outerIndexPtr()[i]) soft_.push_back(i);
  if (soft_.empty()) return;
  if (!links_.coupled().empty()) return rates_of_coupled(slopes, of_springs);
  const auto count = static_cast<Eigen::Index>(soft_.size());
  flexibility_ = relief_among(s, soft_);
  right_.resize(count, of_springs.cols());
  for (Eigen::Index i = 0; i < count; ++i) right_.row(i) = of_springs.row(soft_[i]);
  const Eigen::VectorXd own = slopes.col(0)(soft_);
  if (!answer_by_structure(own, right_)) {
    for (Eigen::Index i = 0; i < count; ++i) {
      flexibility_.col(i) *= own[i];
      flexibility_(i, i) += 1;
    }
    if (!lu_ || lu_->rows() != count) lu_.emplace(count);
    lu_->compute(flexibility_);
    solved_ = lu_->solve(right_);
    right_ = own.asDiagonal() * solved_;
  }
  change_.setZero(slopes.rows());
  for (Eigen::Index j = 0; j < of_springs.cols(); ++j) {
    for (Eigen::Index i = 0; i < count; ++i) change_[soft_[i]] = right_(i, j);
    links_.relief().add_relief(-1, change_, of_springs.col(j));
  }
}

// d' = (I + S phi')^-1 B^T v with all springs, for few of them.
void SpringForces::rates_of_coupled(const Eigen::MatrixXd& slopes, Eigen::MatrixXd& of_springs) {
  const auto count = slopes.rows();
  const Eigen::MatrixXd by_forces = links_.relief().flexibility();
  const Eigen::MatrixXd by_rates = force_rates(slopes, Eigen::MatrixXd::Identity(count, count));
  of_springs = (Eigen::MatrixXd::Identity(count, count) + by_forces * by_rates).partialPivLu().solve(of_springs).eval();
}

// Rates of the forces of the springs soft_ from the rates of deformation without them, if there are many springs and
// all of them yield.
bool SpringForces::answer_by_structure(const Eigen::VectorXd& slopes, Eigen::MatrixXd& rates) {
  if (slopes.size() < SoftSprings::min_by_structure || !(slopes.maxCoeff() < 0)) return false;
  set_no_flexibility(slopes.size());
  solved_ = rates;
  const CondensedLinks condensed{
      .active = soft_, .free = {}, .free_acceleration = none_, .flexibility = zero_, .relief = &flexibility_};
  if (!soft_springs_.answer(condensed, slopes, solved_)) return false;
  rates = solved_;
  return true;
}

void SpringForces::find_force_rates(Instant& x) {
  const int first = links_.contacts(), count = links_.springs();
  if (x.spring_slopes.isZero(0)) {
    x.force_rates.setZero(count, 2);
    return;
  }
  Eigen::MatrixXd moving = x.relative.block(first, Instant::v, count, 2);
  rates(x.spring_slopes, moving);
  x.force_rates = force_rates(x.spring_slopes, moving);
}

void SpringForces::find_rates(const Instant& begin, Trial& trial) {
  const int first = links_.contacts(), count = links_.springs();
  Instant& end = trial.end;
  slopes(trial.middle, 0, end.spring_slopes);
  trial.spring_rates.resize(count, 5);
  trial.spring_rates.leftCols(2) = begin.relative.block(first, Instant::v, count, 2);
  trial.spring_rates.rightCols(2) = end.relative.block(first, Instant::v, count, 2);
  for (int i = 0; i < count; ++i) trial.spring_rates(i, 2) = trial.middle[first + i].rate;
  if (links_.moved())
    for (int i = 0; i < count; ++i) {
      trial.spring_rates.row(i).head(2) += begin.by_ground.row(first + i).segment(Instant::v, 2);
      trial.spring_rates.row(i).tail(2) += end.by_ground.row(first + i).segment(Instant::v, 2);
    }
  if (end.spring_slopes.isZero(0)) {
    trial.force_rates_begin.setZero(count, 2);
    end.force_rates.setZero(count, 2);
    return;
  }
  rates(end.spring_slopes, trial.spring_rates);
  trial.force_rates_begin = force_rates(end.spring_slopes, trial.spring_rates.leftCols(2));
  end.force_rates = force_rates(end.spring_slopes, trial.spring_rates.rightCols(2));
  for (int i = 0; i < count; ++i) trial.middle[first + i].rate = trial.spring_rates(i, 2);
}

void SpringForces::follow_first_slopes(const Instant& begin, const Trial& trial, std::vector<LinkMotion>& first,
                                       std::vector<LinkMotion>& last) {
  const int from = links_.contacts(), count = links_.springs();
  first.resize(static_cast<std::size_t>(count));
  last.resize(first.size());
  Eigen::MatrixXd free(count, 3), way;  // rate at the beginning, displacement to the end, rate at the end
  for (int i = 0; i < count; ++i) {
    first[i] = links_.motion(from + i, begin);
    LinkMotion start, end;
    links_.without_relief(from + i, begin, start);
    links_.without_relief(from + i, trial.end, end);
    free.row(i) << first[i].rate, end.penetration - start.penetration, end.rate;
  }
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(count, width_), before;
  std::vector<LinkMotion> behind(first.size());
  way = free;
  for (int branch = 0; branch < max_branches; ++branch) {
    before = found;
    for (int i = 0; i < count; ++i) {
      const double rate = way(i, 0) + 0.5 * just_behind * (way(i, 2) - way(i, 0));
      behind[i] = {first[i].penetration + just_behind * trial.h * rate, rate};
    }
    slopes(behind, from, found);
    if (found == before) break;
    way = free;
    rates(found, way);
  }
  for (int i = 0; i < count; ++i) {
    first[i].rate = way(i, 0);
    last[i] = {first[i].penetration + way(i, 1), way(i, 2)};
  }
}

}  // namespace pounding
