#include <pounding/stepping/springs/elastic_ranges.hpp>

namespace pounding {
namespace {

using enum Instant::Column;

}  // namespace

// Excludes springs of structures on different ground motions, and those with a series dashpot.
ElasticRanges::ElasticRanges(const LinkSet& links) : links_(links) {
  for (Eigen::VectorXd* values : {&low_, &high_, &forces_}) values->setZero(links.springs());
}

void ElasticRanges::read() {
  ++version_;
  all_ = links_.relief().any() && !links_.driven() && links_.coupled().empty();
  for (int i = 0; i < links_.springs() && all_; ++i) {
    const std::optional<Spring::Elastic> range =
        links_.spring(links_.contacts() + i).elastic(links_.of_spring(links_.contacts() + i));
    all_ = range.has_value();
    if (!all_) break;
    low_[i] = range->low;
    high_[i] = range->high;
    forces_[i] = range->force;
  }
}

bool ElasticRanges::hold(const Instant& now, double ahead) {
  if (!all_) return false;
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
  if (!all_ || trial.short_motions) return false;
  const Eigen::Index count = links_.springs();
  const Instant& y = trial.end;
  if (springs(x.force) != forces_ || springs(y.force) != forces_) return false;
  trial.spring_paths.resize(count, 4);
  const double third = trial.h / 3;
  double *const begin = trial.spring_paths.data(), *const end = begin + count, *const minimum = end + count,
                *const maximum = minimum + count;
  deformations(x, begin);
  deformations(y, end);
  const double *const v0 = of_springs(x.relative, v), *const v1 = of_springs(y.relative, v);
  // Bezier control points: the cubic lies between their minimum and maximum.
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < count; ++i) {
    const double after = begin[i] + third * v0[i], before = end[i] - third * v1[i];
    const double low0 = after < begin[i] ? after : begin[i], low1 = before < end[i] ? before : end[i];
    const double high0 = after > begin[i] ? after : begin[i], high1 = before > end[i] ? before : end[i];
    minimum[i] = low0 < low1 ? low0 : low1;
    maximum[i] = high0 > high1 ? high0 : high1;
  }
  int outside = 0;
  for (Eigen::Index i = 0; i < count; ++i) outside += !(minimum[i] > low_[i]) + !(maximum[i] < high_[i]);
  return outside == 0;
}

// As in LinkSet::motion().
void ElasticRanges::deformations(const Instant& x, double* d) const {
  const double *const moved = of_springs(x.relative, u), *const relief = x.relief.data();
  const Eigen::Index count = links_.springs();
  if (links_.moved()) {
    const double* const by_ground = of_springs(x.by_ground, u);
    for (Eigen::Index i = 0; i < count; ++i) d[i] = moved[i] + by_ground[i] - relief[i];
    return;
  }
#pragma GCC ivdep
  for (Eigen::Index i = 0; i < count; ++i) d[i] = moved[i] - relief[i];
}

}  // namespace pounding
