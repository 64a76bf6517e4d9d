#pragma once
/// A gap link with a contact law: nothing until the gap is closed, then the law's force; impacts recorded one by one.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include <pounding/links/contact.hpp>
#include <pounding/links/impact_log.hpp>
#include <pounding/laws/all.hpp>

namespace pounding {

/// Law is any struct with the members of a contact law (see laws/law.hpp); a user's own works as well.
///
/// `evaluate` and `event_functions` are pure; the phase, the impact and the gap move in `accept` and `on_event` only.
template <class Law>
class GapLink final : public Contact {
 public:
  /// gap >= 0 [m]; throws std::invalid_argument otherwise, and for parameters that the law refuses.
  /// `link` is the index that the rows of its impacts carry.
  GapLink(Law law, double gap, int link = 0) : law_(std::move(law)), gap_(gap), log_(link) {
    if (!(gap >= 0) || std::isinf(gap)) throw std::invalid_argument("gap must be finite and not negative");
    law_.check();
  }

  /// The law with its parameters.
  const Law& law() const noexcept { return law_; }
  /// The present gap [m]; komodromos leaves its indentation in it.
  double gap() const noexcept { return gap_; }

  ContactPhase phase() const noexcept override { return phase_; }
  double penetration(double relative_displacement) const noexcept override { return relative_displacement - gap_; }

  laws::Response evaluate(const LinkMotion& motion) const noexcept override {
    if (phase_ != ContactPhase::approach && phase_ != ContactPhase::restitution) return {};
    const laws::Response r = law_.contact(motion.penetration, motion.rate, impact_);
    return {r.force, r.by_penetration, r.by_rate};
  }

  bool may_pull() const noexcept override { return laws::may_pull<Law>; }

  EventFunctions event_functions(const LinkMotion& motion, double /*force*/) const noexcept override {
    constexpr double never = std::numeric_limits<double>::infinity();
    switch (phase_) {
      case ContactPhase::open: return {-motion.penetration, never, never};
      case ContactPhase::approach: return {motion.rate, motion.penetration, never};
      case ContactPhase::restitution: return {motion.penetration, cut(motion), -motion.rate};
      case ContactPhase::slack: return {motion.penetration, -cut(motion), never};
      case ContactPhase::resting: break;
    }
    return {never, never, never};
  }

  double force_event_noise(const LinkMotion& motion, const LinkMotion& rounding) const noexcept override {
    const laws::Response r = law_.contact(traced(motion), motion.rate, impact_);
    const double all = terms(r, motion);
    return all > 0 ? (std::abs(r.by_penetration) * rounding.penetration + std::abs(r.by_rate) * rounding.rate) / all : 0;
  }

  void accept(const LinkStep& step) override {
    if (phase_ == ContactPhase::open) return;
    log_.add(step);
    follow_peak(step);
    laws::keep(law_, step.motion_end.penetration, step.motion_end.rate, impact_);
  }

  void on_event(int event, double time, const LinkMotion& motion) override {
    switch (phase_) {
      case ContactPhase::open:
        phase_ = ContactPhase::approach;
        impact_ = laws::touch(law_, std::max(0.0, motion.rate));
        log_.begin(time, std::max(0.0, motion.rate));
        return;
      case ContactPhase::approach:
        if (event == 1) return separate(time, motion);
        phase_ = ContactPhase::restitution;
        return;
      case ContactPhase::restitution:
        if (event == 0) return separate(time, motion);
        if (event == 2) {
          phase_ = ContactPhase::approach;
          return;
        }
        log_.release(time);
        if constexpr (laws::leaves_indentation<Law>) {
          gap_ += motion.penetration;
          return separate(time, motion);
        }
        phase_ = ContactPhase::slack;
        return;
      case ContactPhase::slack:
        if (event == 0) return separate(time, motion);
        log_.engage();
        phase_ = motion.rate > 0 ? ContactPhase::approach : ContactPhase::restitution;
        return;
      case ContactPhase::resting: return;
    }
  }

  double work() const noexcept override { return log_.work(); }
  std::span<const ImpactRow> impacts() const noexcept override { return log_.rows(); }
  void archive(Archive& archive) override {
    archive(gap_);
    archive(phase_);
    archive(impact_);
    log_.archive(archive);
  }

 private:
  // The force as the law writes it, as part of its terms: near the separation all of them vanish, but its sign is as clear
  // as elsewhere. Just past the separation it is asked at a trace of penetration, so that a release shortly before it is not
  // missed, nor the sign of a law that continues to negative penetrations taken for a new press.
  double cut(const LinkMotion& motion) const noexcept {
    if constexpr (laws::may_pull<Law>) return std::numeric_limits<double>::infinity();
    const laws::Response r = law_.contact(traced(motion), motion.rate, impact_);
    const double all = terms(r, motion);
    return all > 0 ? r.force / all : 0;
  }
  double traced(const LinkMotion& motion) const noexcept {
    return std::max(motion.penetration, 1e-9 * impact_.largest_penetration);
  }
  double terms(const laws::Response& r, const LinkMotion& motion) const noexcept {
    return std::abs(r.by_penetration * traced(motion)) + std::abs(r.by_rate * motion.rate);
  }

  // A force that rises at the beginning of a step and falls at its end has its peak inside: that of the law on the
  // polynomial of degree five through the motion at both ends.
  void follow_peak(const LinkStep& step) {
    const auto rises = [&](const LinkMotion& motion, double acceleration) {
      const laws::Response f = evaluate(motion);
      return f.by_penetration * motion.rate + f.by_rate * acceleration > 0;
    };
    if (!rises(step.motion_begin, step.acceleration_begin) || rises(step.motion_end, step.acceleration_end)) return;
    const auto force = [&](double s) { return evaluate(interpolate(step, s)).force; };
    const double top = place_of_peak(force);
    log_.follow_peak(step.begin + top * (step.end - step.begin), force(top));
  }

  // Golden section on [0, 1].
  template <class Force>
  static double place_of_peak(const Force& force) {
    constexpr double golden = 0.6180339887498949;
    double low = 0, high = 1, a = 1 - golden, b = golden, at_a = force(a), at_b = force(b);
    while (high - low > 1e-7) {
      if (at_a > at_b) {
        high = b, b = a, at_b = at_a;
        at_a = force(a = high - golden * (high - low));
      } else {
        low = a, a = b, at_a = at_b;
        at_b = force(b = low + golden * (high - low));
      }
    }
    return 0.5 * (low + high);
  }

  void separate(double time, const LinkMotion& motion) {
    phase_ = ContactPhase::open;
    log_.end(time, motion.rate);
  }

  Law law_;
  double gap_;
  ContactPhase phase_ = ContactPhase::open;
  laws::Impact impact_;
  ImpactLog log_;
};

/// Rigid bodies that bounce by Newton's impact law and rest on each other after the last bounce worth resolving.
class RigidGapLink final : public Contact {
 public:
  /// restitution in (0, 1], gap >= 0 [m]; throws std::invalid_argument otherwise.
  RigidGapLink(double restitution, double gap, int link = 0);

  ContactPhase phase() const noexcept override { return phase_; }
  double penetration(double relative_displacement) const noexcept override { return relative_displacement - gap_; }
  laws::Response evaluate(const LinkMotion&) const noexcept override { return {}; }
  EventFunctions event_functions(const LinkMotion& motion, double force) const noexcept override;
  void accept(const LinkStep& step) override;
  void on_event(int event, double time, const LinkMotion& motion) override;
  bool is_rigid() const noexcept override { return true; }
  double restitution() const noexcept override { return restitution_; }
  void jumped(double time, const Jump& jump, bool held) override;
  double work() const noexcept override { return log_.work(); }
  std::span<const ImpactRow> impacts() const noexcept override { return log_.rows(); }
  void archive(Archive& archive) override;

 private:
  double restitution_, gap_;
  double drift_ = 0;  // overlap by rounding when the last rest ended; a touch goes on from there [m]
  ContactPhase phase_ = ContactPhase::open;
  ImpactLog log_;
};

/// The link for a law chosen by name: a RigidGapLink for stereomechanical, else a GapLink.
std::unique_ptr<Contact> make_gap_link(const laws::AnyLaw& law, double gap, int link = 0);

}  // namespace pounding
