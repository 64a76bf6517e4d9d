#pragma once
/// Energy balance of a run.

#include <span>
#include <vector>

#include <pounding/stepping/equations.hpp>

namespace pounding {

/// Energies at the present state [J]. input = kinetic + strain + damping + hysteretic + impact + devices, up to the
/// error of the steps.
struct Energies {
  double input = 0;    ///< work of ground motion, applied forces, and link forces on moving ground; plus initial energy
  double kinetic = 0;  ///< of the motion relative to the ground
  double strain = 0;   ///< stored in the structures and in the devices between them
  double damping = 0;  ///< dissipated by the damping of the structures
  double hysteretic = 0;  ///< dissipated by yielding
  double impact = 0;      ///< work done on the contacts: dissipated (including friction) and stored during contact
  double devices = 0;     ///< dissipated by the dampers between structures

  /// Energy input that no other term accounts for.
  double imbalance() const { return input - (kinetic + strain + damping + hysteretic + impact + devices); }
};

/// Six times the mean over a step of the product of force and rate, by Simpson's rule from the values at its
/// beginning, middle and end. Multiplied by h/6 of the step, the sum is the work.
constexpr double simpson_sum(double f0, double v0, double fm, double vm, double f1, double v1) {
  return f0 * v0 + 4 * fm * vm + f1 * v1;
}

/// Accumulates the work of every accepted step by Simpson's rule, with mid-step rates from the cubic. The work of short
/// ground motions is integrated as described in ShortMotions.
class EnergyLedger {
 public:
  explicit EnergyLedger(const System& system) : friction_(system.frictions.size(), 0.0) {}

  /// Adds the initial energy, or the energy injected by a modified state on restart [J].
  void give(double energy) { given_ += energy; }
  /// Adds the work on the moving ground of an impulse at a link [J].
  void add_impulse(double impulse, double ground_rate) { on_ground_ += impulse * ground_rate; }
  /// Adds an accepted step; `links` has one entry per link.
  void add_step(const Equations& equations, const Instant& begin, const Trial& kept, std::span<const LinkStep> links);

  /// Present energies. Collective.
  Energies energies(const Equations& equations, const Instant& now) const;
  /// Work done on each friction element, lost and stored [J].
  const std::vector<double>& friction() const { return friction_; }

  /// Writes or reads the sums.
  void archive(Archive& archive);

 private:
  double input_ = 0, damping_ = 0;  // of the coordinates on this process
  double on_ground_ = 0;            // work of the link forces on moving ground
  double given_ = 0;
  std::vector<double> friction_;
  // Workspace.
  Eigen::VectorXd vm_, cvm_;  // rates and damping forces at mid-step
};

}  // namespace pounding
