/// Locating the instants at which contacts change phase, and what happens there.

#include <algorithm>
#include <cmath>

#include <pounding/error.hpp>
#include <pounding/stepper.hpp>

namespace pounding {
namespace {

// Rounding noise of the motion, as part of its own scale.
constexpr double noise = 1e-12;
// A margin counts as zero when it has fallen to this part of the change that it makes over the trial.
constexpr double landed_part = 1e-12;
// Margins that are this close to zero at a landing end there too: nearly simultaneous contacts are handled in one go.
constexpr double grouped_part = 1e-9;

// Where in a trial to look for the time at which a phase lasts that seems to end where it begins.
constexpr double shortest_look = 1e-9;

// Impulses that go back and forth in a row of rigid bodies.
constexpr int most_rounds = 1000;

// A trial that was thrown away half solved must not be kept.
constexpr const char* lost_trial =
    "the link equations could not be solved while the instant of an impact was sought; try a smaller tolerance";

constexpr int reversal_or_touch = 0;

}  // namespace

// Rounding noise of a margin. A law's force is compared with zero; the force that holds a contact has the noise of a speed
// lost in the longest step.
double Stepper::noise_of(int link, int margin) const {
  const double size_u = largest_u(), size_v = largest_v();
  switch (system_.contacts[link]->phase()) {
    case ContactPhase::open: return noise * size_u;
    case ContactPhase::approach: return noise * size_v;
    case ContactPhase::restitution: return margin == 0 ? noise * size_u : margin == 2 ? noise * size_v : 0;
    case ContactPhase::slack: return margin == 0 ? noise * size_u : 0;
    case ContactPhase::resting: return noise * size_v / (rigid_flexibility_(link, link) * options_.first_rung);
  }
  return 0;
}

bool Stepper::ended(int link, int margin, double value) const { return value < 0 && value < -noise_of(link, margin); }

std::vector<Stepper::Ending> Stepper::endings() const {
  std::vector<Ending> found;
  for (int i = 0; i < system_.contact_count(); ++i) {
    const Contact& contact = *system_.contacts[i];
    const LinkMotion begin = motion(i, now_), end = motion(i, trial_.end);
    const Contact::Margins at_begin = contact.margins(begin, now_.force[i]);
    const Contact::Margins at_end = contact.margins(end, trial_.end.force[i]);
    for (int k = 0; k < Contact::max_margins; ++k) {
      if (!ended(i, k, at_end[k])) continue;
      const double guess = at_begin[k] <= 0 ? 0 : trial_.h * at_begin[k] / (at_begin[k] - at_end[k]);
      found.push_back({i, k, 0, at_begin[k], at_end[k], guess});
    }
  }
  return found;
}

// Bodies that close and part again within one trial: when they overlap between its ends, the trial is shortened to the time
// of least opening.
void Stepper::inner_touch(int link) {
  if (system_.contacts[link]->phase() != ContactPhase::open) return;
  const LinkMotion begin = motion(link, now_), end = motion(link, trial_.end);
  if (!(begin.rate > 0 && end.rate < 0 && begin.penetration <= 0 && end.penetration <= 0)) return;
  // Extremum of the cubic through both ends.
  const double h = trial_.h, slope = (end.penetration - begin.penetration) / h;
  const double a = 3 * (begin.rate + end.rate - 2 * slope), b = 2 * (3 * slope - 2 * begin.rate - end.rate);
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * begin.rate));
  const double s = -2 * begin.rate / (b - root);
  if (!(s > 0 && s < 1)) return;
  const double widest =
      begin.penetration + h * s * (begin.rate + s * (b / 2 + s * a / 3));
  const double reach = 0.25 * h * std::min(begin.rate, -end.rate);  // the cubic may miss a little
  if (widest < -reach) return;
  const double whole = trial_.h, end_time = trial_.end.time;
  const bool touches = attempt(s * whole) && ended(link, reversal_or_touch,
                                                   -motion(link, trial_.end).penetration);
  // The trial as it was, its end at the exact time of a corner of the ground motion included.
  if (!touches && !attempt(whole, end_time)) throw SolverError(lost_trial);
}

std::optional<double> Stepper::land() {
  for (int i = 0; i < system_.contact_count(); ++i) inner_touch(i);
  std::vector<Ending> open = endings();
  if (open.empty()) return std::nullopt;
  const std::vector<Ending> all = open;
  while (!open.empty()) {
    Ending first =
        *std::min_element(open.begin(), open.end(), [](const Ending& a, const Ending& b) { return a.guess < b.guess; });
    const double noise_here = noise_of(first.link, first.margin), longest = trial_.h;
    const bool at_zero = first.at_begin <= noise_here;
    const bool doubtful = at_zero || first.at_begin <= grouped_part * std::abs(first.at_end);
    if (doubtful && !begins_inside(first, longest) && at_zero) {
      landed_.assign(1, first);
      return 0.0;
    }
    if (!locate(first, longest)) throw SolverError(lost_trial);
    // Endings that came still earlier than the one just located.
    std::vector<Ending> earlier;
    for (const Ending& ending : endings())
      if (!(ending.link == first.link && ending.margin == first.margin) &&
          std::abs(ending.at_end) > grouped_part * (std::abs(ending.at_begin) + std::abs(ending.at_end)))
        earlier.push_back(ending);
    if (!earlier.empty()) {
      open = earlier;
      continue;
    }
    landed_.assign(1, first);
    for (const Ending& other : all) {
      if (other.link == first.link) continue;
      const double margin = margin_of_trial(other);
      const double change = std::abs(other.at_begin) + std::abs(other.at_end);
      const bool known = std::any_of(landed_.begin(), landed_.end(),
                                     [&](const Ending& e) { return e.link == other.link; });
      if (!known && margin <= grouped_part * change) landed_.push_back(other);
    }
    return trial_.h;
  }
  return trial_.h;
}

double Stepper::margin_of_trial(const Ending& ending) const {
  const LinkMotion end = motion(ending.link, trial_.end);
  return system_.contacts[ending.link]->margins(end, trial_.end.force[ending.link])[ending.margin];
}

// A phase that has just begun may do so on the wrong side of its margin by rounding, and end properly later in the trial:
// bodies that part and come back. Looks for a time at which it lasts; the trial is lost.
bool Stepper::begins_inside(Ending& ending, double longest) {
  for (double h = longest / 2; h > shortest_look * longest; h /= 4) {
    if (!attempt(h)) continue;
    const double margin = margin_of_trial(ending);
    if (ended(ending.link, ending.margin, -margin)) {  // clearly positive
      ending.from = h;
      ending.at_begin = margin;
      ending.guess = 0.5 * (h + longest);
      return attempt(longest);
    }
  }
  return false;
}

// Anderson and Bjorck's regula falsi on the length of the step; every value is a re-integrated step.
bool Stepper::locate(const Ending& ending, double longest) {
  const double noise_here = noise_of(ending.link, ending.margin), change = ending.at_begin - ending.at_end;
  // Below the noise, so that the landing itself is not taken for an end of the next phase.
  const double landed = noise_here > 0 ? std::min(landed_part * change, 0.1 * noise_here) : landed_part * change;
  double low = ending.from, at_low = ending.at_begin, high = longest, at_high = ending.at_end;
  double guess = ending.guess;
  enum { lower, upper } replaced = upper;
  for (int iteration = 0; iteration < 100; ++iteration) {
    if (!(guess > low && guess < high)) guess = 0.5 * (low + high);
    if (!attempt(guess)) return false;
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

void Stepper::enter_phases() {
  std::vector<int> rigid;
  for (const Ending& ending : landed_) {
    Contact& contact = *system_.contacts[ending.link];
    const LinkMotion here = motion(ending.link, now_);
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
    contact.crossed(ending.margin, now_.time, here);
  }
  landed_.clear();
  if (!rigid.empty()) bounce(rigid);
  balance_now();
}

// Newton's impact law, one contact after the other until no rigid contact closes: an impulse may make a neighbour close.
// A touch too slow for the tolerance is held.
void Stepper::bounce(const std::vector<int>& touching) {
  const double speed = largest_v();
  const double slowest = options_.tolerance * speed;
  const auto strike = [&](int i, double rate, bool held) {
    Contact& contact = *system_.contacts[i];
    const double restitution = held ? 0 : contact.restitution();
    const double impulse = (1 + restitution) * rate / rigid_flexibility_(i, i);
    now_.motion.col(v) -= impulse * rigid_response_.col(i);
    gather_now();
    contact.jumped(now_.time, impulse, rate, -restitution * rate, held);
  };
  const auto rate_of = [&](int i) { return now_.closings(i, v); };
  std::vector<int> links = touching;
  for (const int i : touching) {
    const double rate = rate_of(i);
    if (rate < -noise * speed) continue;  // an earlier impulse has parted them
    strike(i, std::max(0.0, rate), rate < slowest);
  }
  for (int i = 0; i < system_.contact_count(); ++i)
    if (system_.contacts[i]->phase() == ContactPhase::resting) links.push_back(i);
  for (int round = 0; round < most_rounds; ++round) {
    bool closing = false;
    for (const int i : links) {
      const double rate = rate_of(i);
      if (rate <= noise * speed) continue;
      closing = true;
      strike(i, rate, rate < slowest);
    }
    if (closing) continue;
    release_parting();
    return;
  }
  throw SolverError("rigid bodies hand an impulse back and forth without end; give one of their links a compliant law");
}

// An impulse on one body may tear it from another that it rested on.
void Stepper::release_parting() {
  const double speed = largest_v();
  for (int i = 0; i < system_.contact_count(); ++i) {
    Contact& contact = *system_.contacts[i];
    const LinkMotion here = motion(i, now_);
    if (contact.phase() == ContactPhase::resting && here.rate < -noise * speed) contact.crossed(0, now_.time, here);
  }
}

}  // namespace pounding
