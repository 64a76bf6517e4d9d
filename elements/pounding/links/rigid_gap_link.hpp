#pragma once
/// Gap link of rigid bodies: velocity jumps instead of a contact force.

#include <span>

#include <pounding/links/contact.hpp>
#include <pounding/links/impact_log.hpp>

namespace pounding {

/// Rigid contact: Newton's impact law at each touch, and rest after the last bounce that can be resolved.
class RigidGapLink final : public Contact {
 public:
  /// Restitution in [0, 1] and initial gap >= 0 [m]; throws std::invalid_argument for other values. `link` is written
  /// into the rows of the impacts. With restitution 0 the first touch is the last.
  RigidGapLink(double restitution, double gap, int link = 0);

  ContactPhase phase() const noexcept override { return phase_; }
  double penetration(double relative_displacement) const noexcept override { return relative_displacement - gap_; }
  /// Zero in every phase: a touch is a velocity jump, and the force at rest follows from the equations of motion.
  laws::Response evaluate(const LinkMotion&) const noexcept override { return {}; }
  EventFunctions event_functions(const LinkMotion& motion, double force) const noexcept override;
  void accept(const LinkStep& step) override {
    if (phase_ == ContactPhase::resting) log_.add(step);
  }
  void on_event(int event, double time, const LinkMotion& motion) override;
  bool is_rigid() const noexcept override { return true; }
  double restitution() const noexcept override { return restitution_; }
  void jumped(double time, const Jump& jump, bool held) override;
  void record_force(double time, double force) override { log_.record_peak(time, force); }
  double work() const noexcept override { return log_.work(); }
  std::span<const ImpactRow> impacts() const noexcept override { return log_.rows(); }
  void archive(Archive& archive) override;

 private:
  double restitution_, gap_;
  double drift_ = 0;  // overlap by round-off at the end of the last rest, the reference for the next touch [m]
  ContactPhase phase_ = ContactPhase::open;
  ImpactLog log_;
};

}  // namespace pounding
