#include <pounding/stepping/event_locator.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pounding {
namespace {

// An event function counts as zero at this fraction of its change over the trial.
constexpr double zero_part = 1e-12;
// Event functions that are this close to zero at a located event also end there: they form one group of events.
constexpr double grouped_part = 1e-9;
// Minimum step, relative to the trial, in the search for a phase that seems to end at its beginning.
constexpr double shortest_look = 1e-9;
constexpr int max_corner_trials = 8;
// Inside a good step, a shorter step with an error ratio above this value has converged to a wrong solution of the
// stage equations: with strong dashpots there are several.
constexpr double beyond_belief = 1e3;

// A partly solved trial must not be accepted.
constexpr const char* lost_trial =
    "the link equations could not be solved while locating an impact; try a smaller tolerance";

// An event function that is negative at the end of the trial.
struct EventBracket {
  EventId id;
  double from = 0;  // positive here [s after the beginning], unless at_begin is not positive
  double at_begin = 0, at_end = 0;
  double guess = 0;  // linear estimate of the zero [s after the beginning]
};

std::vector<EventBracket> brackets_in(const EventFunctions& functions, const Instant& now, const Trial& trial) {
  const LinkSet& links = functions.links();
  std::vector<EventBracket> found;
  for (int i = 0; i < links.contacts(); ++i) {
    const LinkMotion end = links.motion(i, trial.end);
    const Contact::EventFunctions at_end = functions.values(i, end, trial.end.force[i]);
    if (std::none_of(at_end.begin(), at_end.end(), [](double value) { return value < 0; })) continue;
    const Contact::EventFunctions at_begin = functions.values(i, links.motion(i, now), now.force[i]);
    for (int k = 0; k < Contact::max_event_functions; ++k) {
      if (!functions.has_ended({i, k}, at_end[k], end, now)) continue;
      const double guess = at_begin[k] <= 0 ? 0 : trial.h * at_begin[k] / (at_begin[k] - at_end[k]);
      found.push_back({{i, k}, 0, at_begin[k], at_end[k], guess});
    }
  }
  return found;
}

}  // namespace

// State of one search; `trial` changes with every call of try_step.
struct EventLocator::Search {
  const EventFunctions& functions;
  const SpringCorners& corners;
  const LinkSet& links;
  const Instant& now;
  const Trial& trial;
  const TryStep& solve_step;
  const bool was_good;  // the initial trial had an acceptable error

  bool try_step(double h, std::optional<double> end) const {
    return solve_step(h, end) && !(was_good && trial.error > beyond_belief);
  }
  std::vector<EventBracket> brackets() const { return brackets_in(functions, now, trial); }
  void look_for_inner_touch(int link) const;
  void stop_at_corner() const;
  bool begins_inside(EventBracket& bracket, double longest) const;
  double zero_on_path(const EventId& id, double part) const;
  bool solve(const EventBracket& bracket, double longest) const;
  bool touches_now(const EventBracket& bracket) const;
  void restore(double h, double end) const {
    if (!try_step(h, end)) throw LostTrial(lost_trial);
  }
  LinkMotion at_end(int link) const { return links.motion(link, trial.end); }
  // Value below which an event function with this change counts as zero at the end of the trial. A compliant contact
  // must begin with its gap closed to round-off. With an open gap it would pull, or separate immediately and leave a
  // spurious impact.
  double together(const EventId& id, double change) const {
    const bool touches = links.phase(id.link) == ContactPhase::open && !links.contact(id.link).is_rigid();
    return touches ? functions.noise(id, at_end(id.link), now) : grouped_part * change;
  }
};

// Detects bodies that touch and separate within one trial: if they overlap between its ends, the trial is shortened to
// the time of the minimum opening.
void EventLocator::Search::look_for_inner_touch(int link) const {
  const auto rate = [&](const Instant& x) {
    return x.relative(link, Instant::v) + links.ground_part(x.by_ground, link, Instant::v);
  };
  if (!(rate(now) > 0 && rate(trial.end) < 0) || links.phase(link) != ContactPhase::open) return;
  const LinkMotion begin = links.motion(link, now), end = at_end(link);
  if (!(begin.penetration <= 0 && end.penetration <= 0)) return;
  const CubicPenetration between(begin, end, trial.h);
  const double s = between.turn();
  if (!(s > 0 && s < 1)) return;
  const double reach = 0.25 * trial.h * std::min(begin.rate, -end.rate);  // margin for the error of the cubic
  if (between.at(s) < -reach) return;
  const double whole = trial.h, end_time = trial.end.time;
  const bool touches = try_step(s * whole, std::nullopt) &&
                       functions.has_ended({link, EventFunctions::touch}, -at_end(link).penetration, at_end(link), now);
  // Repeat the trial with its exact end time, which may be a breakpoint of the ground motion.
  if (!touches) restore(whole, end_time);
}

// The force of a spring has corners; a step that ends at one preserves the order of the scheme.
void EventLocator::Search::stop_at_corner() const {
  const double whole = trial.h, end_time = trial.end.time;
  for (int trials = 0; trials < max_corner_trials; ++trials) {
    const std::optional<double> s = corners.first(now, trial, functions.longest_step());
    if (!s) return;
    if (try_step(*s * trial.h, std::nullopt)) continue;
    return restore(whole, end_time);
  }
}

// Facing bodies with closed gaps that approach will touch regardless of other contacts, unless a velocity jumps.
bool EventLocator::Search::touches_now(const EventBracket& bracket) const {
  const LinkMotion here = links.motion(bracket.id.link, now);
  return links.phase(bracket.id.link) == ContactPhase::open && !links.contact(bracket.id.link).is_rigid() &&
         bracket.at_begin <= functions.noise(bracket.id, here, now) &&
         here.rate > motion_noise * functions.scales().max_velocity();
}

// Because of round-off, a phase may begin on the wrong side of its event function and end properly later in the trial,
// for example when bodies separate and return. Searches for a time at which the phase lasts; if there is none, the
// trial is invalid. The sign alone decides in two cases. A compliant contact may be so slow that its phase ends before
// its event function exceeds round-off; otherwise it would begin and end without time advancing and keep its speed.
// Rigid bodies may separate from rest without a bounce; otherwise they would separate and rest endlessly while the
// force that presses them together starts to grow.
bool EventLocator::Search::begins_inside(EventBracket& bracket, double longest) const {
  const auto from = [&](double h, double value) {
    bracket.from = h;
    bracket.at_begin = value;
    bracket.guess = 0.5 * (h + longest);
    return try_step(longest, std::nullopt);
  };
  std::optional<std::pair<double, double>> by_sign;
  for (double h = longest / 2; h > shortest_look * longest; h /= 4) {
    if (!try_step(h, std::nullopt)) continue;
    const double value = functions.value(bracket.id, trial.end);
    if (functions.has_ended(bracket.id, -value, at_end(bracket.id.link), now))
      return from(h, value);  // clearly positive
    if (value > 0 && h > no_time(now.time) && !by_sign) by_sign = {h, value};
  }
  const double rate = links.motion(bracket.id.link, now).rate;
  const bool rebounds =
      links.contact(bracket.id.link).is_rigid() && std::abs(rate) > motion_noise * functions.scales().max_velocity();
  return by_sign && !rebounds && from(by_sign->first, by_sign->second);
}

// Time after the beginning at which the event function is zero on the polynomial of degree five through the motions at
// both ends of the trial. Secant iteration from the end and from fraction `part` of the trial. A small change of the
// end hardly changes the rest of this path.
double EventLocator::Search::zero_on_path(const EventId& id, double part) const {
  constexpr int secants = 4;
  const Quintic path(links.jet(id.link, now), links.jet(id.link, trial.end), trial.h);
  const auto value = [&](double s) {
    const Jet at = path.at(s);
    return functions.values(id.link, {at.x, at.v}, trial.end.force[id.link])[id.event];
  };
  double before = 1, at_before = functions.value(id, trial.end), s = part;
  for (int i = 0; i < secants; ++i) {
    const double at = value(s), next = s - at * (s - before) / (at - at_before);
    before = s;
    at_before = at;
    if (!(next > 0 && next < 2)) return -1;
    s = next;
    if (std::abs(s - before) < zero_part) break;
  }
  return s * trial.h;
}

// Guesses from the paths of the trials; if these fail, regula falsi of Anderson and Bjorck (1973) on the step length.
bool EventLocator::Search::solve(const EventBracket& bracket, double longest) const {
  const double noise = functions.noise(bracket.id, at_end(bracket.id.link), now),
               change = bracket.at_begin - bracket.at_end;
  // Below round-off, so that the located event does not count as an end of the next phase.
  const double zero = noise > 0 ? std::min(zero_part * change, 0.1 * noise) : zero_part * change;
  double low = bracket.from, at_low = bracket.at_begin, high = longest, at_high = bracket.at_end;
  const bool along_paths = low == 0;  // otherwise a hop much shorter than the trial, whose path does not resolve it
  double guess = along_paths ? zero_on_path(bracket.id, bracket.guess / longest) : bracket.guess;
  double before = 0, at_before = change;  // previous guess and the value there
  int crawling = 0;                       // consecutive guesses with little progress
  enum { lower, upper } replaced = upper;
  // Enough for bisection to the last digit if the function jumps.
  for (int iteration = 0; iteration < 200; ++iteration) {
    if (!(guess > low && guess < high) && iteration == 0) guess = bracket.guess;
    if (!(guess > low && guess < high)) guess = 0.5 * (low + high);
    if (!try_step(guess, std::nullopt)) return false;
    const double value = functions.value(bracket.id, trial.end);
    // An instant early in the trial is located to the resolution of its time.
    if (std::abs(value) <= zero || high - low <= std::min(1e-16 * longest, 4e-16 * high)) return true;
    // If the same end is kept twice in a row, its value is reduced so that the next guess moves towards it.
    const auto reduction = [](double m) { return m > 0 ? m : 0.5; };
    if (value < 0) {
      if (replaced == upper) at_low *= reduction(1 - value / at_high);
      high = guess;
      at_high = value;
      replaced = upper;
    } else {
      if (replaced == lower) at_high *= reduction(1 - value / at_low);
      low = guess;
      at_low = value;
      replaced = lower;
    }
    const double here = trial.h;
    crawling = std::abs(value) > 0.5 * std::abs(at_before) ? crawling + 1 : 0;
    if (crawling < 2) {
      guess = low + (high - low) * at_low / (at_low - at_high);
      if (along_paths) {
        const double nearer = iteration == 0 ? zero_on_path(bracket.id, guess / trial.h)
                                             : here + value * (before - here) / (value - at_before);
        if (nearer > low && nearer < high) guess = nearer;
      }
    } else {
      // A hop may be shorter than the trial by many orders of magnitude.
      guess = low > 0 && high > 16 * low ? std::sqrt(low * high) : 0.5 * (low + high);
      crawling = 0;
    }
    before = here;
    at_before = value;
  }
  return false;
}

// Quick check: in most trials, no event function has changed sign, and no bodies approach and then separate.
bool EventLocator::may_find(const Instant& now, const Trial& trial) const {
  if (links_.springs() > 0 && !trial.springs_stay) return true;
  for (int i = 0; i < links_.contacts(); ++i) {
    const LinkMotion end = links_.motion(i, trial.end);
    for (const double value : functions_.values(i, end, trial.end.force[i]))
      if (value < 0) return true;
    if (end.rate < 0 && links_.motion(i, now).rate > 0) return true;
  }
  return false;
}

std::optional<double> EventLocator::expected_end(const Instant& now, const Trial& trial) const {
  std::optional<double> first;
  for (const EventBracket& bracket : brackets_in(functions_, now, trial))
    if (links_.phase(bracket.id.link) != ContactPhase::open && bracket.guess > 0 && !(first && *first <= bracket.guess))
      first = bracket.guess;
  return first;
}

std::optional<LocatedEvents> EventLocator::locate(const Instant& now, const Trial& trial, bool at_corners,
                                                  const TryStep& try_step) const {
  const Search search{functions_, corners_, links_, now, trial, try_step, trial.error <= 1};
  if (at_corners && links_.springs() > 0 && !trial.springs_stay) search.stop_at_corner();
  for (int i = 0; i < links_.contacts(); ++i) search.look_for_inner_touch(i);
  std::vector<EventBracket> open = search.brackets();
  if (open.empty()) return std::nullopt;
  const std::vector<EventBracket> all = open;
  for (;;) {
    EventBracket first = *std::min_element(
        open.begin(), open.end(), [](const EventBracket& a, const EventBracket& b) { return a.guess < b.guess; });
    const double noise = functions_.noise(first.id, links_.motion(first.id.link, now), now), longest = trial.h;
    const bool at_zero = first.at_begin <= noise;
    const bool doubtful = at_zero || first.at_begin <= grouped_part * std::abs(first.at_end);
    if (doubtful && !search.begins_inside(first, longest) && at_zero) {
      LocatedEvents located{0, {first.id}};
      if (!links_.contact(first.id.link).is_rigid())
        for (const EventBracket& other : all)
          if (other.id.link != first.id.link && search.touches_now(other)) located.events.push_back(other.id);
      return located;
    }
    if (!search.solve(first, longest)) throw LostTrial(lost_trial);
    // Events earlier than the one just located.
    open.clear();
    for (const EventBracket& bracket : search.brackets())
      if (!(bracket.id.link == first.id.link && bracket.id.event == first.id.event) &&
          std::abs(bracket.at_end) > grouped_part * (std::abs(bracket.at_begin) + std::abs(bracket.at_end)))
        open.push_back(bracket);
    if (!open.empty()) continue;
    LocatedEvents located{trial.h, {first.id}};
    for (const EventBracket& other : all) {
      if (other.id.link == first.id.link) continue;
      const double value = functions_.value(other.id, trial.end);
      const double change = std::abs(other.at_begin) + std::abs(other.at_end);
      const bool known = std::any_of(located.events.begin(), located.events.end(),
                                     [&](const EventId& e) { return e.link == other.id.link; });
      if (!known && value <= search.together(other.id, change)) located.events.push_back(other.id);
    }
    return located;
  }
}

}  // namespace pounding
