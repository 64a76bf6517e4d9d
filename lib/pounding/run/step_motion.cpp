#include <pounding/run/step_motion.hpp>

#include <utility>

namespace pounding {

StepMotion::StepMotion(const FloorResponse& response, const Stepper& stepper) : response_(response), stepper_(stepper) {}

void StepMotion::take() {
  const OutputQuantities &first = stepper_.outputs_begin(), &last = stepper_.outputs_end_minus();
  begin_time = first.time;
  h = last.time - first.time;
  // A step begins with the motion that the one before left.
  if (std::exchange(taken_, true)) {
    begin.swap(jumps ? end_plus : end_minus);
  } else {
    begin = first.motion;
    response_.complete(begin, first.time, stepper_.ground_begin());
  }
  end_minus = last.motion;
  response_.complete(end_minus, last.time, stepper_.ground_end_minus());
  has_middle = stepper_.options().scheme.kind == Scheme::Kind::esdirk4 && h > 0;
  if (has_middle) {
    middle = stepper_.outputs_middle();
    response_.complete_accelerations(middle.col(0), stepper_.ground_middle());
  }
  jumps = &stepper_.outputs() != &last;
  if (jumps) {
    end_plus = stepper_.outputs().motion;
    response_.complete(end_plus, last.time, stepper_.ground());
  }
}

}  // namespace pounding
