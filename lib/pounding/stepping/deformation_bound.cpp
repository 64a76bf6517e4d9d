#include <pounding/stepping/deformation_bound.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pounding {
namespace {

constexpr double round_off = 1e-12;

}  // namespace

void DeformationBound::set(const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  Eigen::VectorXd rooms(low.size());
  for (Eigen::Index i = 0; i < rooms.size(); ++i) {
    // Beside what rounding makes of the limits and of c.
    const double least = low[i] + round_off * std::abs(low[i]), most = high[i] - round_off * std::abs(high[i]);
    rooms[i] = std::isinf(low[i]) && std::isinf(high[i])
                   ? high[i]
                   : std::min(most - at_rest_[i], at_rest_[i] - least) - round_off * std::abs(at_rest_[i]);
  }
  parts_.resize(solver_.size());
  is_set_ = springs_.bound(rooms, parts_);
}

// Sums over the structures, of the largest one.
template <class Moved>
double DeformationBound::largest(const Moved& moved) const {
  if (!is_set_) return std::numeric_limits<double>::infinity();
  double most = 0;
  for (const StructureSolver::Segment& s : solver_.segments()) most = std::max(most, moved(s.first, s.count));
  return most;
}

DeformationBound::Reach DeformationBound::reach(const Instant& x) const {
  const auto part = [&](Instant::Column column) {
    return largest([&](int first, int count) {
      return parts_.segment(first, count).dot(x.motion.col(column).segment(first, count).cwiseAbs());
    });
  };
  return {part(Instant::u), part(Instant::v)};
}

}  // namespace pounding
