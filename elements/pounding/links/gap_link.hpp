#pragma once
/// A contact together with its memory, for a host program that steps its links itself.

#include <span>
#include <utility>

#include <pounding/links/gap_contact.hpp>
#include <pounding/links/rigid_contact.hpp>

namespace pounding {

/// The functions of the contact C (see Contact) with the memory of one link. Copies are independent links.
template <class C>
class LinkOf {
 public:
  explicit LinkOf(C contact) : contact_(std::move(contact)), memory_(contact_.initial()) {}

  /// The contact; all its functions are const.
  const C& contact() const noexcept { return contact_; }
  const ContactMemory& memory() const noexcept { return memory_; }
  /// Current gap [m]: laws that leave an indentation add it.
  double gap() const noexcept { return memory_.state.gap; }
  /// Current phase, from the last accepted state.
  ContactPhase phase() const noexcept { return memory_.phase(); }
  /// Penetration [m] for an approach of the two ends by `relative_displacement` [m] since the undeformed state.
  double penetration(double relative_displacement) const noexcept {
    return memory_.state.penetration(relative_displacement);
  }
  /// See the functions of Contact with these names.
  laws::Response evaluate(const LinkMotion& motion) const noexcept { return contact_.evaluate(memory_, motion); }
  double acting_force(double law_force) const noexcept { return contact_.acting_force(law_force); }
  Contact::EventFunctions event_functions(const LinkMotion& motion, double force) const noexcept {
    return contact_.event_functions(memory_, motion, force);
  }
  double force_event_noise(const LinkMotion& motion, const LinkMotion& rounding) const noexcept {
    return contact_.force_event_noise(memory_, motion, rounding);
  }
  void press(double penetration) { contact_.press(memory_, penetration); }
  void accept(const LinkStep& step) { contact_.accept(memory_, step); }
  void on_event(int event, double time, const LinkMotion& motion) { contact_.on_event(memory_, event, time, motion); }
  void jumped(double time, const Jump& jump, bool held) { contact_.jumped(memory_, time, jump, held); }
  /// Work done on the link since the beginning, stored and lost [J].
  double work() const noexcept { return memory_.log.work(); }
  /// One row per impact, see ContactMemory::impacts().
  std::span<const ImpactRow> impacts() const noexcept { return memory_.impacts(); }
  void archive(Archive& archive) { memory_.archive(archive); }

 private:
  C contact_;
  ContactMemory memory_;
};

/// Link with a contact law. Arguments and errors are those of GapContact.
template <class Law>
class GapLink : public LinkOf<GapContact<Law>> {
 public:
  GapLink(Law law, double gap, int link = 0) : LinkOf<GapContact<Law>>(GapContact<Law>(std::move(law), gap, link)) {}

  /// The law with its parameters.
  const Law& law() const noexcept { return this->contact().law(); }
};

/// Link of rigid bodies. Arguments and errors are those of RigidContact.
class RigidGapLink : public LinkOf<RigidContact> {
 public:
  RigidGapLink(double restitution, double gap, int link = 0) : LinkOf(RigidContact(restitution, gap, link)) {}
};

}  // namespace pounding
