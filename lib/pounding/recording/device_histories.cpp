#include <pounding/recording/device_histories.hpp>

#include <pounding/recording/headings.hpp>

namespace pounding {
DeviceHistories::DeviceHistories(const Model& model, const StepView& stepper, std::vector<DeviceHistory>& histories)
    : stepper_(stepper),
      histories_(histories),
      first_(stepper.system().contact_count() + stepper.system().spring_count() - model.devices.size()) {
  for (const Device& device : model.devices) histories_.push_back(heading(device, model));
}

void DeviceHistories::begin() {
  for (std::size_t i = 0; i < histories_.size(); ++i) {
    histories_[i].extremes.update(0, stepper_.time(), stepper_.link_motion(static_cast<int>(first_ + i)).penetration);
    histories_[i].extremes.update(1, stepper_.time(), force_now(i));
  }
}

void DeviceHistories::step() {
  for (std::size_t i = 0; i < histories_.size(); ++i) {
    const LinkStep& step = step_of(i);
    const double h = step.end - step.begin;
    Extremes& extremes = histories_[i].extremes;
    extremes.update(0, step.begin, h, step.motion_begin.penetration, step.motion_begin.rate,
                    step.motion_end.penetration, step.motion_end.rate);
    extremes.update(1, step.begin, h, step.force_begin, step.force_middle, step.force_end);
    extremes.update(1, step.end, force_now(i));  // the velocity may have jumped
  }
}

void DeviceHistories::sample(double time, bool inside) {
  for (std::size_t i = 0; i < histories_.size(); ++i) {
    const int link = static_cast<int>(first_ + i);
    double elongation = stepper_.link_motion(link).penetration, force = force_now(i);
    if (inside) {
      const LinkStep& step = step_of(i);
      const double s = (time - step.begin) / (step.end - step.begin);
      elongation = interpolate(step, s).penetration;
      force = stepper_.links().inside(link, step, s, elongation).force;
    }
    histories_[i].elongation.push_back(elongation);
    histories_[i].force.push_back(force);
  }
}

std::vector<DeviceSummary> DeviceHistories::summary() const {
  std::vector<DeviceSummary> all;
  for (std::size_t i = 0; i < histories_.size(); ++i)
    all.push_back({histories_[i].name, histories_[i].extremes, stepper_.links().lost(static_cast<int>(first_ + i))});
  return all;
}

void DeviceHistories::archive(Archive& archive) {
  for (DeviceHistory& history : histories_) archive(history.extremes);
}

}  // namespace pounding
