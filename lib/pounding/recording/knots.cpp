#include <pounding/recording/knots.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

// Steps need no knot while the cubic misses the displacements by less than this fraction of the largest ones, both as
// square roots of their strain energy. If the acceleration deviates from a straight line by da within a time t, the
// displacement error is da t^2/64. A limit three times as large causes errors above 1e-3 in axial forces of impacted
// beams.
constexpr double allowed_miss = 1e-5;

}  // namespace

Knots::Knots(const StepView& stepper)
    : stepper_(stepper), largest_(stepper.system().groups.size()), strayed_(largest_), norms_(largest_) {}

void Knots::set(const Instant& instant) {
  last_ = instant.time;
  acceleration_ = instant.motion.col(Instant::a);
  bend_ = instant.motion.col(Instant::u);
  take_norms(bend_);
  for (std::size_t g = 0; g < norms_.size(); ++g) largest_[g] = std::max(largest_[g], norms_[g]);
  std::fill(strayed_.begin(), strayed_.end(), 0.0);
}

// If the cubic were exact, the accelerations at the ends of the steps would lie on a straight line.
bool Knots::reach_over_step() {
  const Instant &begin = stepper_.instant_begin(), &end = stepper_.instant_end_minus();
  const double time = end.time - last_, part = time / (begin.time - last_);
  bend_ = end.motion.col(Instant::a) - part * begin.motion.col(Instant::a) - (1 - part) * acceleration_;
  take_norms(bend_);
  bool close = true;
  for (std::size_t g = 0; g < norms_.size(); ++g) {
    strayed_[g] += norms_[g];
    close = close && strayed_[g] * time * time / 64 <= allowed_miss * largest_[g];
  }
  return close;
}

void Knots::archive(Archive& archive) { archive(last_, acceleration_, largest_, strayed_); }

// By group: sqrt(x^T K x), over all processes.
void Knots::take_norms(const Eigen::VectorXd& x) {
  const StructureSolver& solver = stepper_.base();
  stiffness_times_.resize(x.size());
  solver.stiffness_times(x, stiffness_times_);
  std::fill(norms_.begin(), norms_.end(), 0.0);
  for (const StructureSolver::Segment& part : solver.layout().segments)
    norms_[part.group] += x.segment(part.first, part.count).dot(stiffness_times_.segment(part.first, part.count));
  solver.combine(norms_);
  for (double& norm : norms_) norm = std::sqrt(std::max(0.0, norm));
}

}  // namespace pounding
