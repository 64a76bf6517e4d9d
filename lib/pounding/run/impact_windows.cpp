#include <pounding/run/impact_windows.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {
namespace {

// A structure still vibrates from an impact for this time after it [s].
constexpr double after = 2e-3;
// Maximum length of a window, for contacts at rest that press permanently [s].
constexpr double longest = 0.1;

bool acts(const LinkStep& step) { return step.force_begin != 0 || step.force_middle != 0 || step.force_end != 0; }

}  // namespace

void ImpactWindow::Step::archive(Archive& archive) { archive(begin, end, forces); }

void ImpactWindow::archive(Archive& archive) { archive(force, u, v, steps); }

bool ImpactWindows::presses() const {
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i] &&
        (stepper_.memory().contacts[i].phase() != ContactPhase::open || acts(stepper_.link_step(static_cast<int>(i)))))
      return true;
  return false;
}

void ImpactWindows::step() {
  const bool now = presses();
  if (!now && present_.steps.empty()) return;
  if (present_.steps.empty()) {
    present_.u = stepper_.instant_begin().motion.col(Instant::u);
    present_.v = stepper_.instant_begin().motion.col(Instant::v);
  }
  record();
  if (now) last_pressed_ = present_.end();
  if (present_.end() - last_pressed_ >= after || present_.end() - present_.begin() >= longest) end();
}

void ImpactWindows::record() {
  const Instant &x = stepper_.instant_begin(), &y = stepper_.instant_end_minus();
  ImpactWindow::Step& step =
      present_.steps.emplace_back(ImpactWindow::Step{.begin = x.time, .end = y.time, .forces = {}});
  const System& system = stepper_.system();
  for (int i = 0; i < system.links(); ++i) {
    const LinkStep& link = stepper_.link_step(i);
    if (!acts(link)) continue;
    ImpactWindow::Force force{i, link.force_begin, link.force_middle, link.force_end};
    if (i < system.contact_count()) {
      const laws::Response law = stepper_.links().law(i, link.motion_end);
      if (std::isfinite(law.by_penetration)) force.by_penetration = law.by_penetration;
      if (std::isfinite(law.by_rate)) force.by_rate = law.by_rate;
      if (counts_[static_cast<std::size_t>(i)])
        present_.force = std::max({present_.force, force.begin, force.middle, force.end});
    }
    step.forces.push_back(force);
  }
}

void ImpactWindows::end() {
  if (present_.steps.empty()) return;
  const auto place =
      std::ranges::find_if(hardest_, [&](const ImpactWindow& other) { return other.force < present_.force; });
  hardest_.insert(place, std::exchange(present_, {}));
  if (hardest_.size() > maximum) hardest_.pop_back();
}

void ImpactWindows::archive(Archive& archive) { archive(hardest_, present_, last_pressed_); }

}  // namespace pounding
