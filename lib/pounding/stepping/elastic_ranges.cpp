#include <pounding/stepping/elastic_ranges.hpp>

namespace pounding {
namespace {

using enum Instant::Column;

}  // namespace

// Springs that the ground moves by itself, and those with a dashpot inside, take the long way.
ElasticRanges::ElasticRanges(const LinkSet& links) : links_(links) {
  for (Eigen::VectorXd* values : {&low_, &high_, &forces_}) values->setZero(links.springs());
}

void ElasticRanges::read() {
  ++version_;
  all_ = links_.relief().any() && !links_.moved();
  for (int i = 0; i < links_.springs() && all_; ++i) {
    const std::optional<Spring::Elastic> range = links_.spring(links_.contacts() + i).elastic();
    all_ = range.has_value();
    if (!all_) break;
    low_[i] = range->low;
    high_[i] = range->high;
    forces_[i] = range->force;
  }
}

bool ElasticRanges::hold(const Instant& now, double ahead) const {
  if (!all_) return false;
  const auto u0 = springs(now.relative, u), v0 = springs(now.relative, v);
  bool inside = true;
  for (int i = 0; i < links_.springs(); ++i) {
    const double d = u0[i] - now.relief[i], then = d + ahead * v0[i];
    inside = inside && d > low_[i] && d < high_[i] && then > low_[i] && then < high_[i];
  }
  return inside;
}

bool ElasticRanges::stay(const Instant& x, Trial& trial) const {
  if (!all_ || trial.short_motions) return false;
  const int count = links_.springs();
  const Instant& y = trial.end;
  if (springs(x.force) != forces_ || springs(y.force) != forces_) return false;
  trial.spring_paths.resize(count, 4);
  const double third = trial.h / 3;
  const auto u0 = springs(x.relative, u), v0 = springs(x.relative, v), u1 = springs(y.relative, u), v1 = springs(y.relative, v);
  bool inside = true;
  for (int i = 0; i < count; ++i) {
    // Bezier's points: the cubic stays between the least and the largest of them.
    const double d0 = u0[i] - x.relief[i], d1 = u1[i] - y.relief[i], after = d0 + third * v0[i], before = d1 - third * v1[i];
    const double low = std::min(std::min(d0, after), std::min(before, d1)), high = std::max(std::max(d0, after), std::max(before, d1));
    inside = inside && low > low_[i] && high < high_[i];
    double* const path = trial.spring_paths.data() + i;
    path[0] = d0, path[count] = d1, path[2 * count] = low, path[3 * count] = high;
  }
  return inside;
}

}  // namespace pounding
