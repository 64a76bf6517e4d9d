#pragma once
/// Linear structures in modal coordinates with penalty links: the model of the study kernel.

#include <vector>

#include <pounding/laws/all.hpp>

namespace pounding::study {

/// A contact: it closes by closing^T q and overlaps when this exceeds the gap.
struct LinkModes {
  double gap = 0;               ///< >= 0 [m]
  std::vector<double> closing;  ///< B, one factor per mode
  laws::AnyLaw law;             ///< any but a rigid one
};

/// A quantity whose peak is recorded.
struct Output {
  enum class Kind {
    displacement,  ///< factors^T q, relative to the ground; also a drift. Maximum absolute value [m]
    closing,       ///< factors^T q, maximum value, at least 0 [m]
    acceleration   ///< factors^T q'' + ground * ag, absolute. Maximum absolute value [m/s^2]
  };
  Kind kind = Kind::displacement;
  std::vector<double> factors;  ///< one per mode
  double ground = 1;            ///< only for an acceleration
};

/// q_j'' + damping_j q_j' + stiffness_j q_j = -load_j ag(t) - sum over links of closing_j F, every mode of unit mass.
///
/// Modes of different structures are stored one after the other. A free body is a mode of stiffness 0.
struct LinearModel {
  std::vector<double> stiffness;               ///< omega^2 >= 0 [1/s^2]
  std::vector<double> damping;                 ///< 2 zeta omega >= 0 [1/s]
  std::vector<double> load;                    ///< participation in the ground motion
  std::vector<double> displacement, velocity;  ///< initial values; empty at rest
  std::vector<LinkModes> links;                ///< all with the same law, each with its own parameters
  std::vector<Output> outputs;

  int modes() const { return static_cast<int>(stiffness.size()); }
  /// Throws std::invalid_argument for inconsistent sizes, numbers that are not finite or out of range, links that
  /// overlap at the start, links with different laws, rigid ones, and invalid parameters of a law.
  void check() const;
};

/// One oscillator of a pair.
struct Oscillator {
  double mass = 0;           ///< [kg]
  double period = 0;         ///< [s]
  double damping_ratio = 0;  ///< in [0, 1)
};

/// Two oscillators, the left one first, with a gap [m] between them. Outputs: both displacements and, if requested,
/// both absolute accelerations. Throws std::invalid_argument like check().
LinearModel pair_of(const Oscillator& left, const Oscillator& right, double gap, laws::AnyLaw law,
                    bool accelerations = false);

/// Structures of a model without their links. Outputs: closing of each link, which is the gap that would prevent
/// contact [m].
LinearModel without_links(const LinearModel& model);

}  // namespace pounding::study
