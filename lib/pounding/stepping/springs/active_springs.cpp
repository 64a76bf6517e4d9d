#include <pounding/stepping/springs/active_springs.hpp>

namespace pounding {
namespace {

// A spring that yields within this fraction of the trial after its beginning is active from the beginning.
constexpr double shortly_after = 1e-3;

}  // namespace

void ActiveSprings::begin(const Instant& now, double h) {
  const int first = links_.contacts(), count = links_.springs();
  if (!links_.relief().any()) return;  // all are active
  if (ranges_.hold(now, shortly_after * h)) return rest();
  rests_ = -1;
  constant_.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    if (links_.is_coupled(first + i)) {
      is_active_[i] = true;
      continue;
    }
    const LinkMotion here = links_.motion(first + i, now);
    const laws::Response answer = links_.law(first + i, here);
    constant_[i] = answer.force;
    is_active_[i] =
        !links_.spring(first + i).has_corners() || answer.by_penetration != 0 || answer.by_rate != 0 ||
        leaves(first + i, links_.law(first + i, {here.penetration + shortly_after * h * here.rate, here.rate}).force);
  }
  hold();
}

// No spring is active.
void ActiveSprings::rest() {
  if (rests_ == ranges_.version()) return;
  rests_ = ranges_.version();
  constant_.assign(ranges_.forces().begin(), ranges_.forces().end());
  is_active_.assign(is_active_.size(), false);
  hold();
}

bool ActiveSprings::grow(const Trial& trial) {
  if (trial.springs_stay) return false;
  const int first = links_.contacts(), count = links_.springs();
  bool grown = false;
  for (int i = 0; i < count; ++i) {
    if (is_active_[i]) continue;
    const int link = first + i;
    if (!leaves(link, trial.force_middle[link]) &&
        !leaves(link, links_.law(link, links_.motion(link, trial.end)).force))
      continue;
    is_active_[i] = grown = true;
  }
  if (!grown) return false;
  rests_ = -1;
  hold();
  return true;
}

void ActiveSprings::hold() {
  const int first = links_.contacts(), count = links_.springs();
  held_.setZero(links_.size());
  holds_ = false;
  for (int i = 0; i < count; ++i) {
    if (is_active_[i] || constant_[i] == 0) continue;
    held_[first + i] = constant_[i];
    holds_ = true;
  }
}

}  // namespace pounding
