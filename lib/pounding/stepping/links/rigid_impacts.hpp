#pragma once
/// Impulses at rigid contacts: Newton's law of impact, bodies that rest on each other, and the limit of hops.

#include <Eigen/Core>
#include <vector>

#include <pounding/stepping/links/link_set.hpp>

namespace pounding {

/// Responses to forces at the contacts without time passing; empty where no contact is rigid.
struct RigidContacts {
  Eigen::MatrixXd response;     ///< M^-1 B, [coordinate, contact] [1/kg]
  Eigen::MatrixXd flexibility;  ///< B^T M^-1 B, [contact, contact] [1/kg]
};

/// Least f >= 0 of f.G f/2 - f.rate: the impulses [N s] between bodies that touch plastically, all at once. None pulls,
/// no contact closes faster than `negligible` [m/s] afterwards, and a contact that parts takes no impulse. By active
/// sets (Lawson and Hanson 1974, chapter 23). `rate` > 0 closes.
Eigen::VectorXd plastic_impulses(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& rate, double negligible);

/// Rigid contacts that strike at one instant. Those that have just touched come first.
struct Strikes {
  Eigen::MatrixXd flexibility;  ///< B^T M^-1 B of these contacts
  Eigen::VectorXd rate;         ///< closing rates before [m/s]
  Eigen::VectorXd restitution;
  Eigen::VectorXd slowest;  ///< at lower closing rates a contact does not bounce, see slowest_bounce() [m/s]
  double still = 0;         ///< rates of this size are round-off [m/s]
  int parting = 0;          ///< of the first `parting` contacts, those that already part are brought to rest
};

/// Outcome of the impacts of rigid contacts at one instant, by contact.
struct RigidBounce {
  Eigen::VectorXd impulse;  ///< [N s]
  Eigen::VectorXd work;     ///< taken from the bodies [J]
  Eigen::VectorXd rate;     ///< closing rates afterwards [m/s]
};

/// Newton's law of impact, rate after = -restitution times rate before, one contact after the other until none closes
/// faster than its `slowest`, as an impulse may make a neighbour close. The rest is taken plastically by all of them
/// together.
RigidBounce bounce(const Strikes& strikes);

/// Closing rate [m/s] below which a bounce cannot be resolved: the hop after it is lower than the round-off of the
/// motion, or shorter than time can pass. `press` is the closing acceleration [m/s^2], `displacement` the scale of
/// motion [m].
double slowest_bounce(double press, double restitution, double displacement, double time);

/// Sets the rates of held contacts back to zero and their penetrations back to those of `begin`. A scheme keeps them
/// itself unless the ground moves the two ends of a link differently, or is integrated differently for them; then its
/// error would part or press the bodies. `relative` is B^T of the displacements and velocities at the end.
void hold_contacts(const RigidContacts& rigid, const LinkSet& links, const Instant& begin,
                   const Eigen::MatrixXd& relative, const std::vector<int>& held, Instant& end);

}  // namespace pounding
