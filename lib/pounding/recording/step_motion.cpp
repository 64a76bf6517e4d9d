#include <pounding/recording/step_motion.hpp>

#include <cmath>
#include <utility>

namespace pounding {
namespace {

constexpr double shortest_before = 0.25, max_missed = 0.1;

}  // namespace

StepMotion::StepMotion(const FloorResponse& response, const StepView& stepper)
    : response_(response), stepper_(stepper) {}

void StepMotion::take() {
  const OutputQuantities &first = stepper_.outputs_begin(), &last = stepper_.outputs_end_minus();
  begin_time = first.time;
  h = last.time - first.time;
  // A step begins with the final motion of the previous one.
  if (std::exchange(taken_, true)) {
    begin.swap(jumps ? end_plus : end_minus);
  } else {
    begin = first.motion;
    response_.complete(begin, first.time, stepper_.ground_begin());
  }
  end_minus = last.motion;
  response_.complete(end_minus, last.time, stepper_.ground_end_minus());
  has_middle = stepper_.options().scheme.kind == Scheme::Kind::esdirk4 && h > 0;
  presses = has_middle && (stepper_.system().elements.empty() || stepper_.springs_stayed()) && any_link_presses();
  if (has_middle) {
    middle = stepper_.outputs_middle();
    if (presses) find_missed_area(first.motion, last.motion);
    response_.complete_accelerations(middle.col(0), stepper_.ground_middle());
    if (presses) find_missed_bend();
  }
  jumps = &stepper_.outputs() != &last;
  before_.h = presses && !jumps ? h : 0;
  if (before_.h > 0) before_.middle = middle;
  if (jumps) {
    end_plus = stepper_.outputs().motion;
    response_.complete(end_plus, last.time, stepper_.ground());
  }
}

bool StepMotion::any_link_presses() const {
  for (int i = 0; i < stepper_.system().contact_count(); ++i)
    if (stepper_.link_step(i).force_middle != 0) return true;
  return false;
}

// The velocities at both ends determine the integral of the acceleration over the step. Relative to the ground, whose
// own acceleration is linear or almost linear in a step.
void StepMotion::find_missed_area(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y) {
  missed_.resize(x.rows(), 2);
  for (Eigen::Index r = 0; r < x.rows(); ++r)
    missed_(r, 1) = 20 * (x(r, 2) + 4 * middle(r, 0) + y(r, 2)) - 120 * (y(r, 1) - x(r, 1)) / h;
}

// The previous step determines the curvature of the acceleration, unless it is short compared with this one.
// Displacements would determine it as well, but with an error proportional to the third power of the step ratio. A path
// that deviates from its parabola by a tenth of the change is not smooth.
void StepMotion::find_missed_bend() {
  const double t = -0.5 * before_.h / h - 0.5, w = t * (t * t - 0.25);
  const bool is_known = before_.h > shortest_before * h;
  for (int r = 0; r < missed_.rows(); ++r) {
    double &alpha = missed_(r, 0), &beta = missed_(r, 1);
    const Quartic parabola{begin(r, 2), middle(r, 0), end_minus(r, 2), 0, 0};
    alpha = is_known ? (before_.middle(r, 0) - parabola.at(0.5 + t)) / w - t * beta : 0;
    const double way =
        std::abs(parabola.end - parabola.begin) + std::abs(parabola.begin - 2 * parabola.middle + parabola.end);
    if (!(Quartic{0, 0, 0, alpha, beta}.bounds().second < max_missed * way)) alpha = beta = 0;
  }
}

}  // namespace pounding
