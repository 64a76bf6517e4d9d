#pragma once
/// Events of the links within a step in contact, and the peak force there.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <pounding/study/contact_step.hpp>
#include <pounding/study/cubic_top.hpp>
#include <pounding/study/flight.hpp>

namespace pounding::study {

/// First event within a step.
struct Found {
  LinkEvent event = LinkEvent::none;
  std::size_t link = 0;
  double part = 2;  ///< fraction of the step
};

/// Fraction of the step at which an open link touches; 2 for none. `path()` is the motion of the link over the step.
template <class Path>
double touch_inside(const LinkMoment& b, const LinkMoment& e, double h, const Path& path) noexcept {
  if (e.d < 0 && !may_dip(std::max(-b.d, 0.0), b.rate, -e.d, e.rate, h)) return 2;
  const auto way = path();
  double low = 0, high = 1;
  if (e.d < 0) {
    high = turn_on(way, b.rate, e.rate);
    if (way.at(high).x < 0) return 2;
  } else if (b.rate < 0 && e.rate > 0) {
    low = turn_on(way, b.rate, e.rate);
  }
  if (way.at(low).x >= 0) return low;
  return bracketed_root([&](double s) { return Graph{way.at(s).x, way.at(s).v * h}; }, low, high, true);
}

/// A quantity that vanishes at an event, and its rate.
template <class Law>
Graph way_to(const LinkContact<Law>& link, LinkEvent event, const LinkMoment& m) noexcept {
  switch (event) {
    case LinkEvent::touch:
    case LinkEvent::separation: return {m.d, m.rate};
    case LinkEvent::turn: return {m.rate, m.acceleration};
    case LinkEvent::corner: {
      constexpr double later = 1e-9;  // [s]
      const double value = link.before_corner(m.d, m.rate);
      return {value, (link.before_corner(m.d + later * m.rate, m.rate + later * m.acceleration) - value) / later};
    }
    default: {
      const laws::Response f = link.uncut(m.d, m.rate);
      return {f.force, f.by_penetration * m.rate + f.by_rate * m.acceleration};
    }
  }
}

/// Fraction of the step at which a closed link is farthest beyond an event whose margin is positive at both ends; 2 if
/// it stays before the event. Bodies may separate and meet again within a step.
template <class Law, class Path>
double dip(const LinkContact<Law>& link, LinkEvent event, const LinkMoment& b, const LinkMoment& e, double h,
           const Path& path) noexcept {
  if (event == LinkEvent::turn || event == LinkEvent::corner || std::isinf(link.margin(event, e.d, e.rate))) return 2;
  const double sign = event == LinkEvent::engage ? -1 : 1;
  const Graph first = way_to(link, event, b), last = way_to(link, event, e);
  if (!may_dip(sign * first.value, -sign * first.slope, sign * last.value, -sign * last.slope, h)) return 2;
  const auto way = path();
  const auto slope = [&](double s) {
    const Jet jet = way.at(s);
    const laws::Response f = link.uncut(jet.x, jet.v);
    return f.by_penetration * jet.v + f.by_rate * jet.a;
  };
  const double bottom = event == LinkEvent::separation
                            ? turn_on(way, b.rate, e.rate)
                            : flat_part(first.slope, last.slope,
                                        top_of_cubic(first.value, h * first.slope, last.value, h * last.slope), slope);
  const Jet jet = way.at(bottom);
  return link.margin(event, jet.x, jet.v) < 0 ? bottom : 2;
}

/// Fraction of the step at which a closed link meets an event whose margin is negative later in the step.
template <class Law, class Path>
double crossing(const LinkContact<Law>& link, LinkEvent event, const LinkMoment& b, const LinkMoment& e,
                const Path& path, double later = 1) noexcept {
  const auto way = path();
  const auto margin = [&](double s) {
    const Jet jet = way.at(s);
    return link.margin(event, jet.x, jet.v);
  };
  double low = 0, at_low = link.margin(event, b.d, b.rate), high = later, at_high = margin(later);
  // Bodies that have just touched first approach, however slowly.
  if (event == LinkEvent::separation && b.rate > 0 && e.rate < 0)
    low = turn_on(way, b.rate, e.rate), at_low = margin(low);
  // A margin that grows from zero, or from its round-off, is positive slightly later.
  const double trace = 1e-12 * std::abs(at_high);
  for (double s = 0.5 * later; !(at_low > trace) && s > 1e-3 * later; s *= 0.5)
    if (const double m = margin(s); m > trace)
      low = s, at_low = m;
    else
      high = s, at_high = m;
  if (!(at_low > 0)) return 0;
  if (!(at_high < 0)) return later;
  // Regula falsi with the Illinois modification: a side that is retained twice gets half the weight.
  int side = 0;
  for (int i = 0; i < 40 && high - low > 1e-9; ++i) {
    const double s = (low * at_high - high * at_low) / (at_high - at_low), m = margin(s);
    if (std::abs(m) < 1e-13 * (std::abs(at_low) + std::abs(at_high))) return s;
    if (m > 0) {
      if (side > 0) at_high *= 0.5;
      low = s, at_low = m, side = 1;
    } else {
      if (side < 0) at_low *= 0.5;
      high = s, at_high = m, side = -1;
    }
  }
  return 0.5 * (low + high);
}

/// First event of a step from `begin` to `end`; none if the phases of all links continue.
template <class Law, int M, int L, class Step>
Found first_event(const std::vector<LinkContact<Law>>& links, const Step& step, const Moment<M, L>& begin,
                  const Moment<M, L>& end) noexcept {
  static constexpr LinkEvent endings[] = {LinkEvent::turn, LinkEvent::corner, LinkEvent::release, LinkEvent::engage,
                                          LinkEvent::separation};
  const double h = end.time - begin.time;
  Found first;
  for (std::size_t l = 0; l < links.size(); ++l) {
    const LinkContact<Law>& link = links[l];
    const LinkMoment &b = begin.links[l], &e = end.links[l];
    const auto path = [&] { return step.path(l, begin, end); };
    if (!link.closed()) {
      if (const double part = touch_inside(b, e, h, path); part < first.part) first = {LinkEvent::touch, l, part};
      continue;
    }
    // A margin that is positive at the end can have been negative only if it decreases at the beginning and increases
    // at the end.
    const bool may_part = b.rate < 0 && e.rate > 0,
               may_cross = !link.pressed() || (b.force_rate < 0 && e.force_rate > 0);
    if (!may_part && !may_cross && link.goes_on(e.d, e.rate, e.force.force)) continue;
    for (const LinkEvent event : endings) {
      const double later = link.margin(event, e.d, e.rate) < 0 ? 1 : dip(link, event, b, e, h, path);
      if (later > 1) continue;
      if (const double part = crossing(link, event, b, e, path, later); part < first.part) first = {event, l, part};
    }
  }
  return first;
}

/// Records the peak of a force that increases at the beginning of a step and decreases at its end: the point of zero
/// slope on the path of the link.
template <class Law, class Path>
void record_top(LinkContact<Law>& link, const LinkMoment& b, const LinkMoment& e, double h, const Path& path) noexcept {
  const double p0 = h * b.force_rate, p1 = h * e.force_rate;
  // The tangents at both ends are upper bounds on the force.
  const double part = (e.force.force - p1 - b.force.force) / (p0 - p1);
  if (b.force.force + p0 * std::clamp(part, 0.0, 1.0) <= link.peaks().peak_force) return;
  const auto way = path();
  flat_part(p0, p1, top_of_cubic(b.force.force, p0, e.force.force, p1), [&](double s) {
    const Jet jet = way.at(s);
    const laws::Response f = link.force(jet.x, jet.v);
    link.record(f.force);
    return h * (f.by_penetration * jet.v + f.by_rate * jet.a);
  });
}

}  // namespace pounding::study
