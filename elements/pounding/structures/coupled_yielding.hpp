#pragma once
/// Elements with two deformations that yield together.

#include <array>

#include <pounding/structures/element.hpp>

namespace pounding {

/// Forces k_i d_i - h_i p_i: two linear springs k_i, and plastic deformations p_i that depend on the path of both
/// deformations. h_i <= k_i is the stiffness lost by yielding.
///
/// A derived class defines the flow of p on a straight path. evaluate() follows the straight path from the last
/// accepted state. accept() follows the cubic through both ends of the step, in straight pieces, from a reversal as
/// HystereticSpring does: so the direction of the path may turn within a step.
class CoupledYielding : public Element {
 public:
  using Pair = std::array<double, 2>;
  /// Memory: the last accepted state.
  struct State {
    Pair deformation{}, plastic{};  ///< d and p [m] or [rad]
    double speed = 0;               ///< norm of the rates [m/s]
    Pair lost{};                    ///< by direction [J]
  };

  int deformations() const noexcept override { return 2; }
  std::size_t memory_size() const noexcept override { return sizeof(State); }
  void reset(ElementMemory memory) const noexcept override { memory_as<State>(memory) = {}; }
  void evaluate(ConstElementMemory memory, std::span<const LinkMotion> motion,
                ElementResponse& response) const noexcept override;
  /// Brings an undeformed element to the initial motion of the run on a straight path; this counts no loss.
  void start(ElementMemory memory, std::span<const LinkMotion> motion) const override;
  void accept(ElementMemory memory, std::span<const LinkStep> step) const override;
  ElementEnergy energy(ConstElementMemory memory) const noexcept override;
  /// Divides the loss of each straight piece in proportion to the work of the mean forces on p.
  double dissipated(ConstElementMemory memory, int i) const noexcept override {
    return memory_as<State>(memory).lost[i];
  }

 protected:
  /// End of a straight path.
  struct Flow {
    Pair plastic{};                        ///< p there
    double lost = 0;                       ///< dissipated on the path [J]
    std::array<Pair, 2> by_deformation{};  ///< [i][j]: derivative of p_i by d_j
    Pair by_speed{};                       ///< derivative of p by the speed [s]
  };
  /// From the last accepted state to these deformations; `speed` is the norm of the rates there [m/s]. Pure.
  virtual Flow flow(const State& state, const Pair& deformation, double speed) const noexcept = 0;
  /// h_i [N/m].
  virtual double lost_stiffness(int i) const noexcept = 0;
  /// Minimum number of straight pieces per accepted step.
  virtual int min_pieces() const noexcept { return 1; }

 private:
  void follow(State& state, const Pair& deformation, double speed) const noexcept;
};

}  // namespace pounding
