/// Locating the instants at which contacts change phase, and what happens there.

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include <pounding/core/error.hpp>
#include <pounding/stepping/stepper.hpp>

namespace pounding {
namespace {

// Rounding noise of the motion, as part of its own scale.
constexpr double noise = 1e-12;
// Rounding of a law's force, as part of its terms.
constexpr double cut_noise = 1e-10;
// A margin counts as zero when it has fallen to this part of the change that it makes over the trial.
constexpr double landed_part = 1e-12;
// EventFunctions that are this close to zero at a landing end there too: nearly simultaneous contacts are handled in one go.
constexpr double grouped_part = 1e-9;

// Where in a trial to look for the time at which a phase lasts that seems to end where it begins.
constexpr double shortest_look = 1e-9;

// Impulses that go back and forth in a row of rigid bodies; what is left then is lost.
constexpr int max_rounds = 10000;
// A hop must be this much higher than the noise of the motion to be found in a step over it, and longer than this part of
// the time for time to pass.
constexpr double min_hop = 4;
constexpr double shortest_hop = 1e-13;

// A trial that was thrown away half solved must not be kept.
constexpr const char* lost_trial =
    "the link equations could not be solved while the instant of an impact was sought; try a smaller tolerance";

constexpr int reversal_or_touch = 0;

// Impulses between bodies that touch plastically, all at once: none pulls, no contact goes on to close, and one that parts
// takes no impulse. This is the least of f G f/2 - f rate over f >= 0; active sets (Lawson and Hanson 1974, chapter 23).
Eigen::VectorXd plastic_impulses(const Eigen::MatrixXd& g, const Eigen::VectorXd& rate, double negligible) {
  const int count = static_cast<int>(rate.size());
  Eigen::VectorXd f = Eigen::VectorXd::Zero(count);
  std::vector<int> pressed;
  // Each pass lowers the least; passes end of themselves but for rounding.
  for (int pass = 0; pass < 10 * count; ++pass) {
    const Eigen::VectorXd left = rate - g * f;
    int worst = -1;
    for (int i = 0; i < count; ++i)
      if (left[i] > negligible && (worst < 0 || left[i] > left[worst]) &&
          std::find(pressed.begin(), pressed.end(), i) == pressed.end())
        worst = i;
    if (worst < 0) return f;
    pressed.push_back(worst);
    while (!pressed.empty()) {
      const Eigen::VectorXd wanted = Eigen::MatrixXd(g(pressed, pressed)).completeOrthogonalDecomposition().solve(rate(pressed));
      double part = 1;
      for (std::size_t k = 0; k < pressed.size(); ++k)
        if (wanted[k] < 0) part = std::min(part, f[pressed[k]] / (f[pressed[k]] - wanted[k]));
      std::vector<int> stay;
      for (std::size_t k = 0; k < pressed.size(); ++k) {
        double& own = f[pressed[k]];
        own += part * (wanted[k] - own);
        if (part < 1 && wanted[k] < 0 && own <= 1e-14 * std::abs(wanted[k]))
          own = 0;
        else
          stay.push_back(pressed[k]);
      }
      if (stay.size() == pressed.size()) break;
      pressed = stay;
    }
  }
  return f;
}

// The corner of a spring this near an end of a step, as part of its length, lies at that end.
constexpr double corner_part = 1e-3;
constexpr int max_corner_trials = 8;

}  // namespace

// Rounding noise of a margin at this motion. The force that holds a contact has the noise of a speed lost in the longest step.
double Stepper::noise_of(int link, int margin, const LinkMotion& at) const {
  double size_u = largest_u(), size_v = largest_v();
  if (moving_) {
    size_u = std::max(size_u, std::abs(now_->by_ground(link, u)));
    size_v = std::max(size_v, std::abs(now_->by_ground(link, v)));
  }
  const auto cut = [&] {
    return cut_noise + system_.contacts[link]->force_event_noise(at, {noise * size_u, noise * size_v});
  };
  switch (system_.contacts[link]->phase()) {
    case ContactPhase::open: return noise * size_u;
    case ContactPhase::approach: return margin == 0 ? noise * size_v : noise * size_u;
    case ContactPhase::restitution: return margin == 0 ? noise * size_u : margin == 2 ? noise * size_v : cut();
    case ContactPhase::slack: return margin == 0 ? noise * size_u : cut();
    case ContactPhase::resting: return noise * size_v / (rigid_flexibility_(link, link) * options_.max_step);
  }
  return 0;
}

bool Stepper::ended(int link, int margin, double value, const LinkMotion& at) const {
  return value < 0 && value < -noise_of(link, margin, at);
}

std::vector<Stepper::EventBracket> Stepper::event_brackets() const {
  std::vector<EventBracket> found;
  for (int i = 0; i < system_.contact_count(); ++i) {
    const Contact& contact = *system_.contacts[i];
    const LinkMotion begin = motion(i, *now_), end = motion(i, trial_->end);
    const Contact::EventFunctions at_begin = contact.event_functions(begin, now_->force[i]);
    const Contact::EventFunctions at_end = contact.event_functions(end, trial_->end.force[i]);
    for (int k = 0; k < Contact::max_event_functions; ++k) {
      if (!ended(i, k, at_end[k], end)) continue;
      const double guess = at_begin[k] <= 0 ? 0 : trial_->h * at_begin[k] / (at_begin[k] - at_end[k]);
      found.push_back({i, k, 0, at_begin[k], at_end[k], guess});
    }
  }
  return found;
}

// Bodies that close and part again within one trial: when they overlap between its ends, the trial is shortened to the time
// of least opening.
void Stepper::inner_touch(int link) {
  if (system_.contacts[link]->phase() != ContactPhase::open) return;
  const LinkMotion begin = motion(link, *now_), end = motion(link, trial_->end);
  if (!(begin.rate > 0 && end.rate < 0 && begin.penetration <= 0 && end.penetration <= 0)) return;
  const CubicPenetration between(begin, end, trial_->h);
  const double s = between.turn();
  if (!(s > 0 && s < 1)) return;
  const double reach = 0.25 * trial_->h * std::min(begin.rate, -end.rate);  // the cubic may miss a little
  if (between.at(s) < -reach) return;
  const double whole = trial_->h, end_time = trial_->end.time;
  const bool touches = try_step(s * whole) && ended(link, reversal_or_touch,
                                                   -motion(link, trial_->end).penetration, motion(link, trial_->end));
  // The trial as it was, its end at the exact time of a corner of the ground motion included.
  if (!touches && !try_step(whole, end_time)) throw SolverError(lost_trial);
}

// Where in the trial, from 0 to 1, a spring begins to yield, or turns while it does: by the cubic through both ends.
std::optional<double> Stepper::corner(int link) const {
  const Spring& spring = *system_.springs[link - system_.contact_count()];
  const LinkMotion begin = motion(link, *now_), end = motion(link, trial_->end);
  const CubicPenetration between(begin, end, trial_->h);
  const auto yields = [&](double s) { return spring.evaluate({between.at(s), 0}).by_penetration != 0; };
  const double turn = begin.rate * end.rate < 0 ? std::clamp(between.turn(), 0.0, 1.0) : 1.0;
  const auto onset = [&](double low, double high) {
    while (high - low > 1e-6) (yields(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    return high;
  };
  const auto inside = [](double s) { return s > corner_part && s < 1 - corner_part; };
  if (yields(turn)) {
    const double s = onset(0, turn);
    if (inside(s)) return s;
    if (inside(turn)) return turn;
  } else if (turn < 1 && yields(1)) {
    const double s = onset(turn, 1);
    if (inside(s)) return s;
  }
  return std::nullopt;
}

// The force of a spring has corners; a step that ends there keeps its order.
void Stepper::stop_at_corner(int link) {
  const double whole = trial_->h, end_time = trial_->end.time;
  for (int trials = 0; trials < max_corner_trials; ++trials) {
    const std::optional<double> s = corner(link);
    if (!s) return;
    if (try_step(*s * trial_->h)) continue;
    if (!try_step(whole, end_time)) throw SolverError(lost_trial);
    return;
  }
}

std::optional<double> Stepper::locate_event() {
  for (int i = system_.contact_count(); i < frictions_from_; ++i) stop_at_corner(i);
  for (int i = 0; i < system_.contact_count(); ++i) inner_touch(i);
  std::vector<EventBracket> open = event_brackets();
  if (open.empty()) return std::nullopt;
  const std::vector<EventBracket> all = open;
  while (!open.empty()) {
    EventBracket first =
        *std::min_element(open.begin(), open.end(), [](const EventBracket& a, const EventBracket& b) { return a.guess < b.guess; });
    const double noise_here = noise_of(first.link, first.margin, motion(first.link, *now_)), longest = trial_->h;
    const bool at_zero = first.at_begin <= noise_here;
    const bool doubtful = at_zero || first.at_begin <= grouped_part * std::abs(first.at_end);
    if (doubtful && !begins_inside(first, longest) && at_zero) {
      located_.assign(1, first);
      if (!system_.contacts[first.link]->is_rigid())
        for (const EventBracket& other : all)
          if (other.link != first.link && touches_now(other)) located_.push_back(other);
      return 0.0;
    }
    if (!locate(first, longest)) throw SolverError(lost_trial);
    // Endings that came still earlier than the one just located.
    std::vector<EventBracket> earlier;
    for (const EventBracket& ending : event_brackets())
      if (!(ending.link == first.link && ending.margin == first.margin) &&
          std::abs(ending.at_end) > grouped_part * (std::abs(ending.at_begin) + std::abs(ending.at_end)))
        earlier.push_back(ending);
    if (!earlier.empty()) {
      open = earlier;
      continue;
    }
    located_.assign(1, first);
    for (const EventBracket& other : all) {
      if (other.link == first.link) continue;
      const double margin = margin_of_trial(other);
      const double change = std::abs(other.at_begin) + std::abs(other.at_end);
      const bool known = std::any_of(located_.begin(), located_.end(),
                                     [&](const EventBracket& e) { return e.link == other.link; });
      if (!known && margin <= grouped_part * change) located_.push_back(other);
    }
    return trial_->h;
  }
  return trial_->h;
}

// Bodies that stand face to face and close touch whatever the other contacts do, unless a velocity jumps.
bool Stepper::touches_now(const EventBracket& ending) const {
  const Contact& contact = *system_.contacts[ending.link];
  const LinkMotion here = motion(ending.link, *now_);
  return contact.phase() == ContactPhase::open && !contact.is_rigid() &&
         ending.at_begin <= noise_of(ending.link, ending.margin, here) && here.rate > noise * largest_v();
}

double Stepper::margin_of_trial(const EventBracket& ending) const {
  const LinkMotion end = motion(ending.link, trial_->end);
  return system_.contacts[ending.link]->event_functions(end, trial_->end.force[ending.link])[ending.margin];
}

// A phase that has just begun may do so on the wrong side of its margin by rounding, and end properly later in the trial:
// bodies that part and come back. Looks for a time at which it lasts; the trial is lost.
bool Stepper::begins_inside(EventBracket& ending, double longest) {
  for (double h = longest / 2; h > shortest_look * longest; h /= 4) {
    if (!try_step(h)) continue;
    const double margin = margin_of_trial(ending);
    if (ended(ending.link, ending.margin, -margin, motion(ending.link, trial_->end))) {  // clearly positive
      ending.from = h;
      ending.at_begin = margin;
      ending.guess = 0.5 * (h + longest);
      return try_step(longest);
    }
  }
  return false;
}

// Anderson and Bjorck's regula falsi on the length of the step; every value is a re-integrated step.
bool Stepper::locate(const EventBracket& ending, double longest) {
  const double noise_here = noise_of(ending.link, ending.margin, motion(ending.link, trial_->end)), change = ending.at_begin - ending.at_end;
  // Below the noise, so that the landing itself is not taken for an end of the next phase.
  const double landed = noise_here > 0 ? std::min(landed_part * change, 0.1 * noise_here) : landed_part * change;
  double low = ending.from, at_low = ending.at_begin, high = longest, at_high = ending.at_end;
  double guess = ending.guess;
  enum { lower, upper } replaced = upper;
  for (int iteration = 0; iteration < 100; ++iteration) {
    if (!(guess > low && guess < high)) guess = 0.5 * (low + high);
    if (!try_step(guess)) return false;
    const double value = margin_of_trial(ending);
    if (std::abs(value) <= landed || high - low <= 1e-16 * longest) return true;
    // An end that stays twice in a row is given a smaller value, so that the next guess moves towards it.
    const auto relieved = [](double m) { return m > 0 ? m : 0.5; };
    if (value < 0) {
      if (replaced == upper) at_low *= relieved(1 - value / at_high);
      high = guess;
      at_high = value;
      replaced = upper;
    } else {
      if (replaced == lower) at_high *= relieved(1 - value / at_low);
      low = guess;
      at_low = value;
      replaced = lower;
    }
    // Bisection now and then, should the false position crawl.
    guess = iteration % 8 == 7 ? 0.5 * (low + high) : low + (high - low) * at_low / (at_low - at_high);
  }
  return true;
}

void Stepper::enter_phases(bool without_step) {
  std::vector<int> rigid;
  for (const EventBracket& ending : located_) {
    Contact& contact = *system_.contacts[ending.link];
    const LinkMotion here = motion(ending.link, *now_);
    const bool touches = contact.phase() == ContactPhase::open;
    ++events_;
    if (touches && contact.is_rigid()) {
      rigid.push_back(ending.link);
      continue;
    }
    if (touches) {
      rate_scale_[ending.link] = std::abs(here.rate);
      penetration_scale_[ending.link] = 0;
    }
    contact.on_event(ending.margin, now_->time, here);
  }
  located_.clear();
  if (!rigid.empty()) {
    bounce(rigid, without_step);
    gather_now();
  }
  settle();
  balance_now();
}

// A jump of the velocities may end the phase of any compliant contact that presses on the same bodies.
void Stepper::settle() {
  for (int i = 0; i < system_.contact_count(); ++i) {
    Contact& contact = *system_.contacts[i];
    const LinkMotion here = motion(i, *now_);
    // From a reversal to a release, or to the separation, there are two changes at most.
    for (int change = 0; change < 2; ++change) {
      if (contact.phase() == ContactPhase::open || held(i)) break;
      const Contact::EventFunctions event_functions = contact.event_functions(here, now_->force[i]);
      for (int k = 0; k < Contact::max_event_functions; ++k) {
        if (!ended(i, k, event_functions[k], here)) continue;
        contact.on_event(k, now_->time, here);
        break;
      }
    }
  }
}

// Closing rates below which a bounce is not worth resolving, or cannot be: bodies that are pressed together hop ever lower
// and faster, and a hop lower than the noise of the motion is over before a step can see it.
Eigen::VectorXd Stepper::slowest_rates(const std::vector<int>& closed) const {
  Eigen::VectorXd slowest = Eigen::VectorXd::Constant(static_cast<int>(closed.size()), options_.tolerance * largest_v());
  for (std::size_t k = 0; k < closed.size(); ++k) {
    const double press = now_->relative(closed[k], a) + ground_part(now_->by_ground, closed[k], a), e = system_.contacts[closed[k]]->restitution();
    if (!(press > 0)) continue;
    const double lowest = std::sqrt(2 * press * min_hop * noise * largest_u());
    const double briefest = 0.5 * press * shortest_hop * std::max(1.0, now_->time);
    slowest[static_cast<int>(k)] = std::max({slowest[static_cast<int>(k)], lowest / e, briefest / e});
  }
  return slowest;
}

// Newton's impact law, one contact after the other until none closes faster than is worth resolving: an impulse may make a
// neighbour close. What is left is taken by all of them at once, plastically, and holds them.
void Stepper::bounce(const std::vector<int>& touching, bool without_step) {
  const double still = noise * largest_v();
  std::vector<int> closed = touching;
  for (int i = 0; i < system_.contact_count(); ++i) {
    const Contact& contact = *system_.contacts[i];
    const LinkMotion here = motion(i, *now_);
    if (!contact.is_rigid() || std::find(touching.begin(), touching.end(), i) != touching.end()) continue;
    if (held(i) || contact.event_functions(here, 0)[reversal_or_touch] <= noise_of(i, reversal_or_touch, here))
      closed.push_back(i);
  }
  const int count = static_cast<int>(closed.size());
  const Eigen::MatrixXd g = rigid_flexibility_(closed, closed);
  Eigen::VectorXd before = now_->relative.col(v)(closed);
  for (int k = 0; k < count; ++k) before[k] += ground_part(now_->by_ground, closed[k], v);
  const Eigen::VectorXd slowest = slowest_rates(closed);
  Eigen::VectorXd rate = before, impulse = Eigen::VectorXd::Zero(count), work = impulse;
  const auto strike = [&](int k, double after) {
    const double push = (rate[k] - after) / g(k, k);
    impulse[k] += push;
    work[k] += 0.5 * push * (rate[k] + after);
    rate -= push * g.col(k);
  };
  // A touch of bodies that part is the end of a hop that no step could see.
  if (without_step)
    for (std::size_t k = 0; k < touching.size(); ++k)
      if (rate[k] < -still) strike(static_cast<int>(k), 0);
  bool struck = true;
  for (int round = 0; round < max_rounds && struck; ++round) {
    struck = false;
    for (int k = 0; k < count; ++k) {
      if (rate[k] <= slowest[k]) continue;
      strike(k, -system_.contacts[closed[k]]->restitution() * rate[k]);
      struck = true;
    }
  }
  const Eigen::VectorXd last = plastic_impulses(g, rate, still), after = rate - g * last;
  work += 0.5 * last.cwiseProduct(rate + after);
  impulse += last;
  for (int k = 0; k < count; ++k) {
    const int i = closed[k];
    Contact& contact = *system_.contacts[i];
    const bool stays = after[k] >= -still, touches = k < static_cast<int>(touching.size());
    // Without an impulse: a touch at rest is held, a rest may end, and all else goes on.
    if (impulse[k] == 0 && !(touches && stays) && !(held(i) && !stays)) continue;
    change_now().motion.col(v) -= impulse[k] * rigid_response_.col(i);
    carried_work_ += impulse[k] * ground_part(now_->by_ground, i, v);
    contact.jumped(now_->time, {std::max(0.0, impulse[k]), work[k], before[k], after[k], motion(i, *now_).penetration}, stays);
  }
}

}  // namespace pounding
