#pragma once
/// Linear structures in modal coordinates, with penalty links between them: what the kernel of studies runs.

#include <vector>

#include <pounding/laws/all.hpp>

namespace pounding::study {

/// One contact: it closes by closing^T q, with an overlap when this is more than the gap.
struct LinkModes {
  double gap = 0;               ///< >= 0 [m]
  std::vector<double> closing;  ///< B, one factor a mode
  laws::AnyLaw law;             ///< any but a rigid one
};

/// A quantity whose peak is asked for.
struct Output {
  enum class Kind {
    displacement,  ///< factors^T q, relative to the ground; a drift likewise. Its largest absolute value [m]
    closing,       ///< factors^T q, its largest value, at least 0 [m]
    acceleration   ///< factors^T q'' + ground * ag, absolute. Its largest absolute value [m/s^2]
  };
  Kind kind = Kind::displacement;
  std::vector<double> factors;  ///< one a mode
  double ground = 1;            ///< of an acceleration alone
};

/// q_j'' + damping_j q_j' + stiffness_j q_j = -load_j ag(t) - sum over links of closing_j F, every mode of unit mass.
///
/// Modes of several structures stand one after the other. A body that nothing holds is a mode of stiffness 0.
struct LinearModel {
  std::vector<double> stiffness;               ///< omega^2 >= 0 [1/s^2]
  std::vector<double> damping;                 ///< 2 zeta omega >= 0 [1/s]
  std::vector<double> load;                    ///< participation in the ground's motion
  std::vector<double> displacement, velocity;  ///< at the start; empty at rest
  std::vector<LinkModes> links;                ///< all by the same law, each with parameters of its own
  std::vector<Output> outputs;

  int modes() const { return static_cast<int>(stiffness.size()); }
  /// Throws std::invalid_argument for counts that do not fit, numbers that are not finite or out of range, links that
  /// overlap at the start, links by different laws, rigid ones, and laws that refuse their parameters.
  void check() const;
};

/// One oscillator of a pair.
struct Oscillator {
  double mass = 0;           ///< [kg]
  double period = 0;         ///< [s]
  double damping_ratio = 0;  ///< in [0, 1)
};

/// Two oscillators, the left one first, that close a gap [m] between them. Outputs: both displacements, and, when asked
/// for, both absolute accelerations. Throws std::invalid_argument as check() does.
LinearModel pair_of(const Oscillator& left, const Oscillator& right, double gap, laws::AnyLaw law,
                    bool accelerations = false);

/// Structures of a model without their links. Outputs: how far each link would close, the gap that is enough to keep
/// them apart [m].
LinearModel without_links(const LinearModel& model);

}  // namespace pounding::study
