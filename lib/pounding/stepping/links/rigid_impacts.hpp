#pragma once
/// Impulses at rigid contacts: Newton's law of impact, bodies at rest on each other, and the end of a series of
/// bounces.

#include <Eigen/Core>
#include <vector>

#include <pounding/stepping/links/link_set.hpp>

namespace pounding {

/// Instantaneous responses to forces at the contacts; empty if no contact is rigid.
struct RigidContacts {
  Eigen::MatrixXd response;     ///< M^-1 B, [coordinate, contact] [1/kg]
  Eigen::MatrixXd flexibility;  ///< B^T M^-1 B, [contact, contact] [1/kg]
};

/// Minimizes f.G f/2 - f.rate over f >= 0: the impulses [N s] of a simultaneous plastic impact. No impulse pulls, no
/// contact closes faster than `negligible` [m/s] afterwards, and a separating contact takes no impulse. Active-set
/// method (Lawson and Hanson 1974, chapter 23). `rate` > 0 closes.
Eigen::VectorXd plastic_impulses(const Eigen::MatrixXd& flexibility, const Eigen::VectorXd& rate, double negligible);

/// Rigid contacts in simultaneous impact. Those that have just touched come first.
struct Strikes {
  Eigen::MatrixXd flexibility;  ///< B^T M^-1 B of these contacts
  Eigen::VectorXd rate;         ///< closing rates before the impact [m/s]
  Eigen::VectorXd restitution;
  Eigen::VectorXd slowest;  ///< closing rates below which a contact does not bounce, see slowest_bounce() [m/s]
  double still = 0;         ///< rates up to this size are round-off [m/s]
  int parting = 0;          ///< those of the first `parting` contacts that already separate are brought to rest
};

/// Result of the impacts of rigid contacts at one instant, by contact.
struct RigidBounce {
  Eigen::VectorXd impulse;  ///< [N s]
  Eigen::VectorXd work;     ///< taken from the bodies [J]
  Eigen::VectorXd rate;     ///< closing rates after the impact [m/s]
};

/// Applies Newton's law of impact, rate after = -restitution times rate before, to one contact after the other until
/// none closes faster than its `slowest`, since an impulse may make a neighbour close. A simultaneous plastic impact of
/// all contacts absorbs the remaining closing rates.
RigidBounce bounce(const Strikes& strikes);

/// Closing rate [m/s] below which a bounce cannot be resolved: its height is below the round-off of the motion, or its
/// duration is below the resolution of time. `press` is the closing acceleration [m/s^2], `displacement` the
/// displacement scale [m].
double slowest_bounce(double press, double restitution, double displacement, double time);

/// Resets the rates of held contacts to zero and their penetrations to those of `begin`. The time integration preserves
/// both unless the ground moves the two ends of a link differently or is integrated differently for them; then its
/// error would separate or press the bodies. `relative` is B^T of the displacements and velocities at the end.
void hold_contacts(const RigidContacts& rigid, const LinkSet& links, const Instant& begin,
                   const Eigen::MatrixXd& relative, const std::vector<int>& held, Instant& end);

}  // namespace pounding
