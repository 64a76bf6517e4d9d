#include <pounding/stepping/elastic_ranges.hpp>

#include <utility>

namespace pounding {
namespace {

using enum Instant::Column;

}  // namespace

// Springs of structures that the ground drives apart, and those with a dashpot inside, take the long way.
ElasticRanges::ElasticRanges(const LinkSet& links, const RelativeMotion& relative)
    : links_(links), relative_(relative), bound_(links.relief().any() ? relative.bound() : std::nullopt) {
  for (Eigen::VectorXd* values : {&low_, &high_, &forces_}) values->setZero(links.springs());
}

void ElasticRanges::read() {
  ++version_;
  all_ = links_.relief().any() && !links_.driven();
  for (int i = 0; i < links_.springs() && all_; ++i) {
    const std::optional<Spring::Elastic> range = links_.spring(links_.contacts() + i).elastic();
    all_ = range.has_value();
    if (!all_) break;
    low_[i] = range->low;
    high_[i] = range->high;
    forces_[i] = range->force;
  }
  untouched_ = untouched_ && all_ && forces_.isZero(0);
  for (int i = 0; i < links_.springs() && untouched_; ++i) {
    const Spring& spring = links_.spring(links_.contacts() + i);
    untouched_ = spring.lost() == 0 && spring.damped() == 0 && spring.stored_correction() == 0;
  }
  let_wait_ = untouched_ && bound_;
  if (let_wait_) bound_->set(low_, high_);
}

bool ElasticRanges::hold(const Instant& now, double ahead) const {
  if (let_wait_) {
    reach_ = bound_->reach(now);
    if (DeformationBound::inside(reach_.after(ahead))) return true;
  }
  if (all_ && inside(now, ahead)) return true;
  bring(now);
  return false;
}

bool ElasticRanges::inside(const Instant& now, double ahead) const {
  relative_.gather_springs(now, v + 1);
  const double *const v0 = of_springs(now.relative, v), *const low = low_.data(), *const high = high_.data();
  room_.resize(low_.size());
  double* const d = room_.data();
  deformations(now, d);
  bool inside = true;
  for (Eigen::Index i = 0; i < low_.size(); ++i) {
    const double then = d[i] + ahead * v0[i];
    inside = inside & (d[i] > low[i]) & (d[i] < high[i]) & (then > low[i]) & (then < high[i]);
  }
  return inside;
}

bool ElasticRanges::stay(const Instant& x, Trial& trial) const {
  const Instant& y = trial.end;
  trial.has_spring_paths = false;
  if (all_ && !trial.short_motions && have_forces(x) && have_forces(y)) {
    const double third = trial.h / 3;
    if (let_wait_ && DeformationBound::inside(reach_.after(third)) &&
        DeformationBound::inside(bound_->reach(y).after(third)))
      return true;
    make_paths(x, trial);
    const double *const least = trial.spring_paths.col(2).data(), *const most = trial.spring_paths.col(3).data();
    int outside = 0;
    for (Eigen::Index i = 0; i < low_.size(); ++i) outside += !(least[i] > low_[i]) + !(most[i] < high_[i]);
    if (outside == 0) return true;
  }
  bring(x);
  relative_.gather_springs(y);
  return false;
}

// Whether every spring has the force of its range.
bool ElasticRanges::have_forces(const Instant& x) const {
  // A sum goes by vectors, comparisons do not.
  return (x.force.segment(links_.contacts(), links_.springs()) - forces_).cwiseAbs().sum() == 0;
}

void ElasticRanges::make_paths(const Instant& x, const Trial& trial) const {
  if (std::exchange(trial.has_spring_paths, true)) return;
  const Eigen::Index count = links_.springs();
  const Instant& y = trial.end;
  for (const Instant* end : {&x, &y}) relative_.gather_springs(*end, v + 1);
  trial.spring_paths.resize(count, 4);
  const double third = trial.h / 3;
  double *const begin = trial.spring_paths.data(), *const end = begin + count, *const least = end + count,
                *const most = least + count;
  deformations(x, begin);
  deformations(y, end);
  const double *const v0 = of_springs(x.relative, v), *const v1 = of_springs(y.relative, v);
  // Bezier's points: the cubic stays between the least and the largest of them.
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < count; ++i) {
    const double after = begin[i] + third * v0[i], before = end[i] - third * v1[i];
    const double low0 = after < begin[i] ? after : begin[i], low1 = before < end[i] ? before : end[i];
    const double high0 = after > begin[i] ? after : begin[i], high1 = before > end[i] ? before : end[i];
    least[i] = low0 < low1 ? low0 : low1;
    most[i] = high0 > high1 ? high0 : high1;
  }
}

void ElasticRanges::deformations_at(const Instant& x, Eigen::VectorXd& d) const {
  relative_.gather_springs(x, u + 1);
  d.resize(links_.springs());
  deformations(x, d.data());
}

// Makes the motions of the springs at the present instant and brings them there.
void ElasticRanges::bring(const Instant& now) const {
  relative_.gather_springs(now);
  if (!std::exchange(behind_, false)) return;
  deformations_at(now, room_);
  for (int i = 0; i < links_.springs(); ++i) links_.spring(links_.contacts() + i).stay(room_[i]);
}

void ElasticRanges::keep(const Trial& kept) const {
  behind_ = let_wait_;
  for (int i = 0; i < links_.springs() && !behind_; ++i)
    links_.spring(links_.contacts() + i).stay(kept.spring_paths(i, 1));
}

void ElasticRanges::follow(const Instant& begin, const Trial& kept) const {
  make_paths(begin, kept);
  if (!std::exchange(behind_, false)) return;
  for (const int end : {0, 1})
    for (int i = 0; i < links_.springs(); ++i) links_.spring(links_.contacts() + i).stay(kept.spring_paths(i, end));
}

// As LinkSet::motion().
void ElasticRanges::deformations(const Instant& x, double* d) const {
  const double *const moved = of_springs(x.relative, u), *const relief = x.relief.data();
  const Eigen::Index count = links_.springs();
  if (x.relief.size() == 0) {
    for (Eigen::Index i = 0; i < count; ++i)
      d[i] = moved[i] + links_.ground_part(x.by_ground, links_.contacts() + static_cast<int>(i), u);
    return;
  }
  if (links_.moved()) {
    const double* const by_ground = of_springs(x.by_ground, u);
    for (Eigen::Index i = 0; i < count; ++i) d[i] = moved[i] + by_ground[i] - relief[i];
    return;
  }
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < count; ++i) d[i] = moved[i] - relief[i];
}

}  // namespace pounding
