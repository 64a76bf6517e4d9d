#pragma once
/// Energy balance of a run.

#include <span>
#include <vector>

#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Energies at the present state [J]. input = kinetic + strain + damping + hysteretic + impact + devices, up to the
/// error of the steps.
struct Energies {
  double input = 0;  ///< work of the ground motion and of forces over time, with that of link forces on moving ground,
                     ///< plus the energy at the start
  double kinetic = 0;     ///< of the motion relative to the ground
  double strain = 0;      ///< stored in the structures and in the bars between them
  double damping = 0;     ///< dissipated by the damping of the structures
  double hysteretic = 0;  ///< dissipated by yielding
  double impact = 0;      ///< work done on the contacts: lost, friction included, and stored while they press
  double devices = 0;     ///< dissipated by the dampers between structures

  /// Energy that was put in and is found nowhere.
  double imbalance() const { return input - (kinetic + strain + damping + hysteretic + impact + devices); }
};

/// Three times the mean of a product of force and rate over a step, by Simpson's rule from values at its beginning,
/// middle and end: h/6 times it is the work.
constexpr double simpson_sum(double f0, double v0, double fm, double vm, double f1, double v1) {
  return f0 * v0 + 4 * fm * vm + f1 * v1;
}

/// Sums of the work in every kept step, by Simpson's rule with the rates of the cubic at mid-step; short motions of the
/// ground count as ShortMotions says.
class EnergyLedger {
 public:
  explicit EnergyLedger(const System& system) : friction_(system.frictions.size(), 0.0) {}

  /// Energy that was there at the start or came by a motion that somebody changed [J].
  void give(double energy) { given_ += energy; }
  /// Work on the moving ground of an impulse at a link [J].
  void add_impulse(double impulse, double ground_rate) { on_ground_ += impulse * ground_rate; }
  /// A step was kept; `links` has one entry a link.
  void add_step(const Equations& equations, const Instant& begin, const Trial& kept, std::span<const LinkStep> links);

  /// Present energies. Collective.
  Energies energies(const Equations& equations, const Instant& now) const;
  /// Work that each friction has dissipated [J].
  const std::vector<double>& friction() const { return friction_; }

  /// Writes the sums, or reads them back.
  void archive(Archive& archive);

 private:
  double input_ = 0, damping_ = 0;  // of the coordinates on this process
  double on_ground_ = 0;            // of the link forces on the motion of the ground
  double given_ = 0;
  std::vector<double> friction_;
  // Room to work in.
  Eigen::VectorXd vm_, cvm_;  // rates and damping forces at mid-step
  mutable Eigen::VectorXd momentum_;
};

}  // namespace pounding
