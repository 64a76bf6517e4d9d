#include <pounding/structures/device_spring.hpp>

#include <stdexcept>

#include <pounding/base/gauss.hpp>
#include <pounding/structures/make_spring.hpp>

namespace pounding {
void DeviceParts::check() const {
  if (!bar && !law && !damper) throw std::invalid_argument("a device needs a bar, a hysteretic law or a damper");
  if (bar && law) throw std::invalid_argument("a device takes a bar or a hysteretic law, not both; remove one of them");
  if (bar) bar->check();
  if (law) make_spring(*law);
  if (damper) damper->check();
}

DeviceSpring::DeviceSpring(const DeviceParts& parts) : bar_(parts.bar), damper_(parts.damper) {
  parts.check();
  if (parts.law) yielding_ = make_spring(*parts.law);
}

void DeviceSpring::reset(ElementMemory memory) const noexcept {
  reset_as<Memory>(memory);
  if (yielding_) yielding_->reset(of_law(memory));
}

laws::Response DeviceSpring::evaluate_slowly(ConstElementMemory memory, double deformation) const noexcept {
  return without_damper(memory, {deformation, 0});
}

laws::Response DeviceSpring::without_damper(ConstElementMemory memory, const LinkMotion& motion) const noexcept {
  laws::Response response;
  if (bar_) {
    response.force = bar_->force(motion.penetration);
    response.by_penetration = bar_->stiffness;
  } else if (yielding_) {
    const double k = yielding_->stiffness();
    response = yielding_->evaluate(of_law(memory), motion);
    response.force += k * motion.penetration;
    response.by_penetration += k;
  }
  return response;
}

laws::Response DeviceSpring::evaluate(ConstElementMemory memory, const LinkMotion& motion) const noexcept {
  laws::Response response = without_damper(memory, motion);
  if (!damper_) return response;
  if (damper_->has_stiffness()) {
    const double stretch = damper_->stretch(motion.penetration - motion.slip, motion.lag);
    response.force += damper_->stiffness * stretch;
    response.by_penetration += damper_->stiffness * damper_->stretch_slope(stretch, motion.lag);
  } else {
    response.force += damper_->force(motion.rate);
    response.by_rate = damper_->slope(motion.rate);
  }
  return response;
}

double DeviceSpring::first_slope() const noexcept {
  return bar_ ? bar_->stiffness : yielding_ ? yielding_->stiffness() : 0;
}

double DeviceSpring::slip_rate(const LinkMotion& motion) const noexcept {
  return damper_->slip_rate(damper_->stretch(motion.penetration - motion.slip, motion.lag));
}

void DeviceSpring::start(ElementMemory memory, const LinkMotion& motion) const {
  Memory& own = of(memory);
  own.elongation = motion.penetration;
  if (slips()) own.stretch = motion.penetration - motion.slip;
  if (yielding_) yielding_->start(of_law(memory), motion);
}

void DeviceSpring::accept(ElementMemory memory, const LinkStep& step) const {
  Memory& own = of(memory);
  own.elongation = step.motion_end.penetration;
  if (slips()) own.stretch = step.motion_end.penetration - step.motion_end.slip;
  if (yielding_) yielding_->accept(of_law(memory), step);
  own.damped_before = own.damped;
  own.damped += damper_work(step, 1);
}

// Power dissipated by the damper.
double DeviceSpring::damper_power(const LinkMotion& motion) const noexcept {
  if (!damper_->has_stiffness()) return damper_->force(motion.rate) * motion.rate;
  const double stretch = motion.penetration - motion.slip;
  return damper_->stiffness * stretch * damper_->slip_rate(stretch);
}

// The slip is interpolated by the cubic through both ends.
LinkMotion DeviceSpring::motion_inside(const LinkStep& step, double s) const noexcept {
  LinkMotion motion = interpolate(step, s);
  if (!slips()) return motion;
  const LinkMotion begin{step.motion_begin.slip, slip_rate(step.motion_begin)},
      end{step.motion_end.slip, slip_rate(step.motion_end)};
  motion.slip = CubicPenetration(begin, end, step.end - step.begin).at(s);
  return motion;
}

// Up to this fraction of the step, from 0 to 1.
double DeviceSpring::damper_work(const LinkStep& step, double until) const noexcept {
  if (!damper_) return 0;
  // Exact for a linear damper and the motion of interpolate().
  return (step.end - step.begin) *
         gauss_integral([&](double s) { return damper_power(motion_inside(step, s)); }, 0, until);
}

Spring::Instant DeviceSpring::inside(ConstElementMemory memory, const LinkStep& step, double s,
                                     double deformation) const noexcept {
  LinkMotion motion = motion_inside(step, s);
  motion.penetration = deformation;
  Spring::Instant answer{evaluate(memory, motion).force, of(memory).damped_before + damper_work(step, s)};
  if (yielding_) {
    // The law has been updated since: replace its current response by that inside the step.
    const Spring::Instant yielded = yielding_->inside(of_law(memory), step, s, deformation);
    answer.force += yielded.force - yielding_->evaluate(of_law(memory), motion).force;
    answer.lost += yielded.lost;
  }
  return answer;
}

ElementEnergy DeviceSpring::energy(ConstElementMemory memory) const noexcept {
  const Memory& own = of(memory);
  ElementEnergy energy = yielding_ ? yielding_->energy(of_law(memory)) : ElementEnergy{};
  energy.damped = own.damped;
  energy.stored_correction += 0.5 * first_slope() * own.elongation * own.elongation;
  if (slips()) energy.stored_correction += 0.5 * damper_->stiffness * own.stretch * own.stretch;
  return energy;
}

}  // namespace pounding
