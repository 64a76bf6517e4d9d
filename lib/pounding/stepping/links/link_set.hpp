#pragma once
/// The links of a system by their column of B.

#include <span>
#include <vector>

#include <pounding/linear/spring_relief.hpp>
#include <pounding/links/contact.hpp>
#include <pounding/model/system.hpp>
#include <pounding/stepping/interpolation.hpp>
#include <pounding/stepping/links/link_memory.hpp>
#include <pounding/stepping/step_state.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// An element with several deformations.
struct CoupledElement {
  const Element* element = nullptr;
  int index = 0;             ///< of its memory
  int first = 0, count = 0;  ///< links: one per deformation
};

/// Links in the order of the columns of B: contacts, then the deformations of elements, called springs here, then the
/// one or two directions of each friction element. With the memories of contacts and elements. Motions are B^T u plus
/// the contributions of ground and gravity, minus the relief of the springs.
class LinkSet {
 public:
  /// `system` has passed System::check(). `relief`: of its springs. Both must outlive this object.
  explicit LinkSet(const System& system, const SpringRelief& relief = none())
      : system_(system),
        relief_(relief),
        contacts_(system.contact_count()),
        frictions_from_(contacts_ + system.spring_count()),
        driven_(!system.gap_by_ground.isZero(0)),
        moved_(driven_ || !system.gravity_offset.isZero(0)),
        contact_of_friction_(static_cast<std::size_t>(system.links() - frictions_from_)),
        memory_(system) {
    for (const Element* const& element : system.elements) {
      const int index = static_cast<int>(&element - system.elements.data()), count = element->deformations();
      if (count > 1) coupled_.push_back({element, index, contacts_ + static_cast<int>(springs_.size()), count});
      for (int i = 0; i < count; ++i)
        springs_.push_back({count == 1 ? static_cast<const Spring*>(element) : nullptr, index, i});
    }
    for (const Friction& friction : system.frictions)
      for (int i = friction.first; i < friction.first + friction.count; ++i)
        contact_of_friction_[i - frictions_from_] = friction.contact;
  }

  /// Number of links, and of contacts among them.
  int size() const { return system_.links(); }
  int contacts() const { return contacts_; }
  int springs() const { return frictions_from_ - contacts_; }
  bool is_spring(int link) const { return link >= contacts_ && link < frictions_from_; }
  /// First link that is a friction direction; also the end of the springs.
  int frictions_from() const { return frictions_from_; }
  const std::vector<Friction>& frictions() const { return system_.frictions; }
  const Contact& contact(int link) const { return *system_.contacts[link]; }
  ContactPhase phase(int contact) const { return memory_.contacts[contact].phase(); }
  /// True for a deformation of an element that has several; and all such elements.
  bool is_coupled(int link) const { return is_spring(link) && !springs_[link - contacts_].spring; }
  const std::vector<CoupledElement>& coupled() const { return coupled_; }
  /// The element of a spring that is not coupled.
  const Spring& spring(int link) const { return *springs_[link - contacts_].spring; }

  /// Memories of all links, at the last accepted state; of one contact, and of the element of one spring.
  LinkMemory& memory() { return memory_; }
  const LinkMemory& memory() const { return memory_; }
  const ContactMemory& of_contact(int link) const { return memory_.contacts[link]; }
  ContactMemory& of_contact(int link) { return memory_.contacts[link]; }
  ConstElementMemory of_spring(int link) const { return memory_.elements[springs_[link - contacts_].element]; }
  ElementMemory of_spring(int link) { return memory_.elements[springs_[link - contacts_].element]; }

  /// Static response of massless degrees of freedom to spring forces.
  const SpringRelief& relief() const { return relief_; }
  /// True if ground motion or gravity contributes to the relative motion.
  bool moved() const { return moved_; }
  /// True if the ground motion moves the two ends of any link differently.
  bool driven() const { return driven_; }
  /// One entry of Instant::by_ground; zero if that is empty.
  double ground_part(const Eigen::MatrixXd& by_ground, int link, Instant::Column column) const {
    return moved_ ? by_ground(link, column) : 0;
  }

  /// Penetration of a contact or elongation of a spring [m] for a relative displacement of its ends [m].
  double deformation(int link, double relative_displacement) const {
    return link < contacts_ ? memory_.contacts[link].state.penetration(relative_displacement) : relative_displacement;
  }
  LinkMotion motion(int link, const Instant& x) const {
    LinkMotion motion;
    this->motion(link, x, motion);
    return motion;
  }
  /// Writes to the result in place: copying freshly stored values would cause a store-forwarding stall.
  void motion(int link, const Instant& x, LinkMotion& motion) const {
    without_relief(link, x, motion);
    if (is_spring(link) && x.relief.size() > 0) motion.penetration -= x.relief[link - contacts_];
  }
  /// Time derivative of the rate [m/s^2].
  double acceleration(int link, const Instant& x) const {
    return x.relative(link, Instant::a) + ground_part(x.by_ground, link, Instant::a);
  }
  /// Motion including the acceleration.
  Jet jet(int link, const Instant& x) const {
    const LinkMotion at = motion(link, x);
    return {at.penetration, at.rate, acceleration(link, x)};
  }
  /// Motion without relief by spring forces. The rate of a spring is that at constant forces in either case.
  void without_relief(int link, const Instant& x, LinkMotion& motion) const {
    double relative_displacement = x.relative(link, Instant::u), rate = x.relative(link, Instant::v);
    if (moved_) {
      relative_displacement += x.by_ground(link, Instant::u);
      rate += x.by_ground(link, Instant::v);
    }
    motion.penetration = deformation(link, relative_displacement);
    motion.rate = rate;
    motion.slip = x.slip.size() > 0 && link >= contacts_ ? x.slip[link - contacts_] : 0;
    motion.lag = 0;
  }
  /// Force and slopes of a contact, or of a spring that is not coupled.
  laws::Response law(int link, const LinkMotion& motion) const {
    return link < contacts_ ? system_.contacts[link]->evaluate(memory_.contacts[link], motion)
                            : spring(link).evaluate(of_spring(link), motion);
  }
  /// Forces and slopes of an element at the motions of its links.
  ElementResponse law(const CoupledElement& of, std::span<const LinkMotion> motions) const {
    ElementResponse response;
    of.element->evaluate(memory_.elements[of.index], motions, response);
    return response;
  }

  /// Force and slopes of friction at this motion and response of its contact.
  FrictionForce friction(const Friction& friction, const LinkMotion& normal, const laws::Response& response,
                         const TangentialMotion& along) const {
    return friction_force(friction, *system_.contacts[friction.contact], normal, response, along);
  }

  /// Energy dissipated by a spring [J].
  double lost(int link) const {
    const OneSpring& of = springs_[link - contacts_];
    return system_.elements[of.element]->dissipated(of_spring(link), of.direction);
  }
  /// Force and loss of a spring inside its last accepted step, s from 0 to 1, at this deformation [m]. That of a
  /// coupled element is interpolated.
  Spring::Instant inside(int link, const LinkStep& step, double s, double deformation) const {
    if (!is_coupled(link)) return spring(link).inside(of_spring(link), step, s, deformation);
    return {force_inside(step, s), lost(link)};
  }

  /// True if the link may have a force in its current phase: contacts that press, their friction, all springs.
  bool is_active(int link) const {
    if (link >= frictions_from_) link = contact_of_friction_[link - frictions_from_];
    return link >= contacts_ || presses(phase(link));
  }
  /// True for a rigid contact at rest: its force keeps its rate at zero.
  bool is_held(int link) const { return link < contacts_ && phase(link) == ContactPhase::resting; }

 private:
  static const SpringRelief& none() {
    static const SpringRelief nothing;
    return nothing;
  }

  const System& system_;
  const SpringRelief& relief_;
  int contacts_, frictions_from_;
  bool driven_, moved_;
  std::vector<int> contact_of_friction_;  // by link, from frictions_from_ on
  // By spring: its element, null if it is coupled, and the index of its memory.
  struct OneSpring {
    const Spring* spring;
    int element, direction;
  };
  std::vector<OneSpring> springs_;
  std::vector<CoupledElement> coupled_;
  LinkMemory memory_;
};

}  // namespace pounding
