#pragma once
/// Free impact of two bodies, integrated in time from the touch to the end of the force; works for any law.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <pounding/base/extrapolation.hpp>
#include <pounding/base/root.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>

namespace pounding::laws {

/// Result of a free impact of two bodies.
struct FreeImpact {
  double restitution = 0;       ///< ratio of separation speed to closing speed [-]
  double peak_force = 0;        ///< [N]; infinite for an instantaneous law
  double time_of_peak = 0;      ///< time of the peak force, from the touch [s]
  double peak_penetration = 0;  ///< [m]
  double duration = 0;          ///< from the touch to the final release of the force [s]
  double energy_lost = 0;       ///< work done on the link and not recovered [J]
  double impulse = 0;           ///< integral of the force [N s]

  /// True for values in closed form; the others are integrated.
  struct Known {
    bool restitution = false, peak_force = false, time_of_peak = false, peak_penetration = false, duration = false;
    /// True if no value has to be integrated.
    bool all() const noexcept { return restitution && peak_force && time_of_peak && peak_penetration && duration; }
  } closed_form{};
};

/// Integrator behind integrated_free_impact. Penetration, rate, impulse and work are scaled by D, v, m v and m v^2.
template <class L>
class ImpactIntegration {
 public:
  ImpactIntegration(const L& law, double reduced_mass, double closing_speed)
      : law_(law), mass_(reduced_mass), speed_(closing_speed), impact_(touch(law, closing_speed)), length_(scale()) {}

  /// Integrates from the touch to the end of the force. Throws std::runtime_error if the maximum number of steps is
  /// reached, and std::domain_error on overflow.
  FreeImpact run() {
    note_peak({0, 1, 0, 0}, 0);
    approach();
    while (restitution() && resumes()) {
    }
    const double m = mass_, v = speed_;
    if (!std::isfinite(peak_ * m * v * v / length_) || !std::isfinite(deepest_ * length_)) beyond_numbers();
    return {.restitution = -state_[1],
            .peak_force = peak_ * m * v * v / length_,
            .time_of_peak = time_of_peak_ * length_ / v,
            .peak_penetration = deepest_ * length_,
            .duration = time_ * length_ / v,
            .energy_lost = state_[3] * m * v * v,
            .impulse = state_[2] * m * v};
  }

 private:
  using State = std::array<double, 4>;
  static constexpr double tolerance = 1e-13;
  static constexpr int max_steps = 20000;

  [[noreturn]] static void beyond_numbers() {
    throw std::domain_error(std::string(L::name) +
                            ": the forces of a free impact exceed the range of floating-point numbers");
  }

  /// Penetration at which the force stops the bodies, to a factor of two [m].
  double scale() const {
    const double energy = mass_ * speed_ * speed_;
    double d = 1;
    const auto stops = [&] { return law_.contact(d, speed_, impact_).force * d > energy; };
    while (stops() && d > 1e-30) d /= 2;
    while (!stops() && d < 1e30) d *= 2;
    return d;
  }

  Response uncut(const State& y) const noexcept { return law_.contact(y[0] * length_, y[1] * speed_, impact_); }
  double uncut_force(const State& y) const noexcept { return uncut(y).force * length_ / (mass_ * speed_ * speed_); }
  double force(const State& y) const noexcept {
    const double f = uncut_force(y);
    return may_pull<L> ? f : no_tension(f);
  }
  double force_rate(const State& y) const noexcept {
    const Response r = uncut(y);
    return r.by_penetration * y[1] * speed_ - r.by_rate * r.force / mass_;
  }

  State slope(const State& y, double time_slope) const noexcept {
    const double f = force(y) * time_slope;
    return {y[1] * time_slope, -f, f, f * y[1]};
  }

  void note_peak(const State& y, double time) {
    deepest_ = std::max(deepest_, y[0]);
    if (const double f = force(y); f > peak_) peak_ = f, time_of_peak_ = time;
  }

  // Advances to the end of a phase. `ended` examines a trial step and returns the length at which the phase ends, or
  // `nullopt`. The independent variable x corresponds to the time clock(x), with derivative clock_slope(x).
  template <class Clock, class ClockSlope, class Ended>
  void advance(double step, Clock&& clock, ClockSlope&& clock_slope, Ended&& ended) {
    const auto f = [&](double at, const State& y) { return slope(y, clock_slope(at)); };
    double x = 0;
    for (int i = 0; i < max_steps; ++i) {
      const auto try_step = [&](double h) { return extrapolated_step<4>(f, x, state_, h, tolerance); };
      auto trial = try_step(step);
      const auto shorten = [&](const std::optional<double>& to) {
        if (to) step = *to, trial = try_step(step);
        return to.has_value();
      };
      bool landed = shorten(ended(state_, step, trial.state, try_step));
      // Before the corner the force may have been released without pressing again.
      if (shorten(corner_inside(trial.state, step, try_step)))
        landed = shorten(ended(state_, step, trial.state, try_step));
      // For shorter steps, round-off dominates the error of the method.
      if (trial.error > 1 && step > 1e-12) {
        step *= std::clamp(0.8 * std::pow(trial.error, -1.0 / 11), 0.1, 0.7);
        continue;
      }
      if (force_rate(state_) > 0 && force_rate(trial.state) < 0 && x + step > x) {
        const auto rising = [&](double h) { return force_rate(try_step(h).state); };
        const double h = find_root(rising, 0, force_rate(state_), step, force_rate(trial.state));
        note_peak(try_step(h).state, clock(x + h));
      }
      x += step;
      state_ = trial.state;
      if (!std::isfinite(state_[1])) beyond_numbers();
      note_peak(state_, clock(x));
      if (landed) {
        // Within a phase the penetration is monotonic, so the memory of the law needs no earlier update.
        keep(law_, state_[0] * length_, state_[1] * speed_, impact_);
        time_ = clock(x);
        return;
      }
      step *= std::clamp(0.8 * std::pow(std::max(trial.error, 1e-12), -1.0 / 11), 0.5, 3.0);
    }
    throw std::runtime_error(std::string(L::name) +
                             ": the contact of a free impact does not end within the maximum number of steps");
  }

  // Steps end at corners of the law, where its slopes jump: the error estimate can miss one.
  template <class TryStep>
  std::optional<double> corner_inside(const State& end, double step, TryStep&& try_step) const {
    if constexpr (requires { law_.corner(0.0, 0.0, impact_); }) {
      const auto corner = [&](const State& y) { return law_.corner(y[0] * length_, y[1] * speed_, impact_); };
      const double before = corner(state_), after = corner(end);
      if (before * after < 0) {
        const double h = find_root([&](double at) { return corner(try_step(at).state); }, 0, before, step, after);
        if (h > 1e-12) return h;
      }
    }
    return std::nullopt;
  }

  // Some forces start with an infinite slope in time (d^0.25 of Jankowski). They are smooth in x with t = x^4.
  void approach() {
    const auto reversal = [](const State&, double step, const State& end, auto&& try_step) -> std::optional<double> {
      if (end[1] > 0) return std::nullopt;
      return find_root([&](double h) { return try_step(h).state[1]; }, 0, 1, step, end[1]);
    };
    advance(0.1, [](double x) { return x * x * x * x; }, [](double x) { return 4 * x * x * x; }, reversal);
    state_[1] = 0;
  }

  // Advances until the force is released or the penetration is zero; true if the release comes first.
  bool restitution() {
    bool released = false;
    const auto end_of_force = [&](const State& start, double step, const State& end,
                                  auto&& try_step) -> std::optional<double> {
      released = false;  // an earlier trial may have been rejected
      if (start[0] <= 0) return 0.0;
      const auto penetration = [&](double h) { return try_step(h).state[0]; };
      const auto pressing = [&](double h) { return uncut_force(try_step(h).state); };
      double until = step;
      if (end[0] <= 0) until = find_root(penetration, 0, state_[0], step, end[0]);
      if constexpr (!may_pull<L>) {
        // A release shortly before the separation is visible only close to it.
        double low = 0;
        for (int j = 0; j <= 48; ++j) {
          const double h = end[0] <= 0 ? until * (1 - std::ldexp(1.0, -j)) : step;
          if (h > 0 && try_step(h).state[0] > 0) {
            if (const double f = pressing(h); f <= 0) {
              released = true;
              return find_root(pressing, low, low > 0 ? pressing(low) : uncut_force(state_), h, f);
            }
            low = h;
          }
          if (end[0] > 0) break;
        }
      }
      if (end[0] <= 0) return until;
      return std::nullopt;
    };
    const double begin = time_;
    advance(0.05, [begin](double x) { return begin + x; }, [](double) { return 1.0; }, end_of_force);
    return released && !leaves_indentation<L>;
  }

  // After a release the bodies drift apart at constant speed; some laws press again before the penetration is zero.
  bool resumes() {
    const auto pressing = [&](double d) { return uncut_force({d, state_[1], 0, 0}); };
    const double released = state_[0];
    double before = released;
    for (int j = 1; j < 160; ++j) {
      const double d = j < 100 ? released * (1 - 0.01 * j) : released * 0.01 * std::ldexp(1.0, 99 - j);
      if (pressing(d) > 1e-30 && pressing(before) < 0) {
        const double resumed = find_root(pressing, before, pressing(before), d, pressing(d));
        time_ += (released - resumed) / -state_[1];
        state_[0] = resumed * (1 - 1e-14);
        return true;
      }
      before = d;
    }
    return false;
  }

  const L& law_;
  double mass_, speed_;
  Impact impact_;
  double length_;
  State state_{0, 1, 0, 0};
  double time_ = 0, peak_ = 0, time_of_peak_ = 0, deepest_ = 0;
};

/// Free impact of two bodies with reduced mass m1 m2/(m1+m2) [kg] and this closing speed [m/s], integrated with
/// tolerance 1e-10 for any law. Throws std::invalid_argument unless mass and speed are finite and positive, and
/// std::runtime_error if the contact does not end. With kelvin_voigt and a damping ratio of 1 or more, the bodies never
/// separate: round-off ends the contact, with restitution 0 and a meaningless duration.
template <class L>
  requires(!instantaneous<L>)
FreeImpact integrated_free_impact(const L& law, double reduced_mass, double closing_speed) {
  require_positive("reduced_mass", reduced_mass);
  require_positive("closing_speed", closing_speed);
  return ImpactIntegration<L>(law, reduced_mass, closing_speed).run();
}

/// Damping number for a restitution e in (0, 1], to 1e-12, from integrated impacts of unit mass and speed.
/// `law_with(number)` creates the law in units in which its stiffness, the mass and the closing speed are one. The
/// restitution must decrease from 1 as the number increases from 0.
template <class MakeLaw>
double number_of_restitution(double e, MakeLaw&& law_with) {
  if (e >= 1) return 0;
  const auto miss = [&](double number) { return integrated_free_impact(law_with(number), 1, 1).restitution - e; };
  double low = 0, at_low = 1 - e, high = 1, at_high = miss(high);
  while (at_high > 0 && high < 1e9) {
    low = std::exchange(high, 4 * high), at_low = at_high;
    at_high = miss(high);
  }
  if (at_high > 0) refuse("restitution", e, "larger: no damping of this law yields this value");
  return find_root(miss, low, at_low, high, at_high);
}

}  // namespace pounding::laws
