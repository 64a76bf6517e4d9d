#pragma once
/// Contact of rigid bodies: velocity jumps instead of a contact force.

#include <pounding/links/contact.hpp>

namespace pounding {

/// Rigid contact: Newton's impact law at each touch, and rest after the last bounce that can be resolved.
class RigidContact final : public Contact {
 public:
  /// Restitution in [0, 1] and initial gap >= 0 [m]; throws std::invalid_argument for other values. `link` is written
  /// into the rows of the impacts. With restitution 0 the first touch is the last.
  RigidContact(double restitution, double gap, int link = 0);

  ContactMemory initial() const override { return {.state = {.gap = gap_}, .log = ImpactLog(link_)}; }
  /// Zero in every phase: a touch is a velocity jump, and the force at rest follows from the equations of motion.
  laws::Response evaluate(const ContactMemory&, const LinkMotion&) const noexcept override { return {}; }
  EventFunctions event_functions(const ContactMemory& memory, const LinkMotion& motion,
                                 double force) const noexcept override;
  void accept(ContactMemory& memory, const LinkStep& step) const override {
    if (memory.phase() == ContactPhase::resting) memory.log.add(step);
  }
  void on_event(ContactMemory& memory, int event, double time, const LinkMotion& motion) const override;
  bool is_rigid() const noexcept override { return true; }
  double restitution() const noexcept override { return restitution_; }
  void jumped(ContactMemory& memory, double time, const Jump& jump, bool held) const override;

 private:
  double restitution_, gap_;
  int link_;
};

}  // namespace pounding
