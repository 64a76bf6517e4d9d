#pragma once
/// A slider on a spherical surface with velocity-dependent friction.

#include <optional>

#include <pounding/structures/spring.hpp>

namespace pounding {

/// f = W d/R + q, |q| <= mu(v) W in series with a spring k0 = mu_fast W/u_y; mu = mu_fast - (mu_fast - mu_slow) exp(-r
/// |v|).
///
/// v is the rate of d. Constantinou, Mokha & Reinhorn 1990, J. Struct. Eng. 116:455. W is the static weight.
struct SlidingFriction {
  double weight = 0;                    ///< W > 0 [N]
  double radius = 0;                    ///< R > 0 [m]; infinite for a flat surface
  double slow = 0, fast = 0;            ///< mu_slow in (0, mu_fast], mu_fast [-]
  double rate = 0;                      ///< r > 0 [s/m]
  double sliding_deformation = 0.5e-3;  ///< u_y > 0 [m]

  /// Throws std::invalid_argument for a value out of range.
  void check() const;
  double coefficient(double velocity) const noexcept;                            ///< mu [-]
  double slope_of_coefficient(double velocity) const noexcept;                   ///< d mu/d v [s/m]
  double dish() const noexcept { return weight / radius; }                       ///< W/R [N/m]
  double stick() const noexcept { return fast * weight / sliding_deformation; }  ///< k0 [N/m]
};

/// The slider as a spring. Its k is W/R + k0. At reversals of the deformation it slides with mu_slow. It sticks when
/// its slip stops: at the reversal, or earlier if the friction increases faster than the force of k0 can. Its
/// deformation must consist of unknowns with mass.
class SlidingSpring final : public Spring {
 public:
  /// Undeformed. Throws std::invalid_argument like check().
  explicit SlidingSpring(const SlidingFriction& friction) : law_(friction) { law_.check(); }

  using Spring::accept, Spring::evaluate, Spring::load, Spring::stiffness, Spring::start, Spring::yield_deformation;
  std::size_t memory_size() const noexcept override { return sizeof(Memory); }
  void reset(ElementMemory memory) const noexcept override { reset_as<Memory>(memory); }
  laws::Response evaluate(ConstElementMemory memory, const LinkMotion& motion) const noexcept override;
  double stiffness() const noexcept override { return law_.dish() + law_.stick(); }
  double yield_deformation() const noexcept override { return law_.sliding_deformation; }
  bool bends_with_rate() const noexcept override { return true; }
  std::optional<double> bend(ConstElementMemory memory, const Quintic& path, double near) const noexcept override;
  void start(ElementMemory memory, const LinkMotion& motion) const override;
  /// Slides at the friction of a vanishing velocity.
  void load(ElementMemory memory, double deformation) const override;
  void accept(ElementMemory memory, const LinkStep& step) const override;
  Spring::Instant inside(ConstElementMemory memory, const LinkStep& step, double s,
                         double deformation) const noexcept override;
  /// True if it comes to rest.
  bool bends_sharply(const LinkStep& step) const noexcept override;
  ElementEnergy energy(ConstElementMemory memory) const noexcept override;

 private:
  // Last accepted state; by default undeformed.
  struct State {
    double deformation = 0, rate = 0, slip = 0, lost = 0;  // [m], [m/s], [m], [J]
  };
  struct Memory {
    State kept{}, before{};  // last accepted state, and the one at the beginning of that step
  };
  static Memory& of(ElementMemory memory) noexcept { return memory_as<Memory>(memory); }
  static const Memory& of(ConstElementMemory memory) noexcept { return memory_as<Memory>(memory); }

  // Sticks or slides up to this fraction of a step.
  struct Phase {
    bool slides = false;
    double end = 1;
  };

  double reach(double rate) const noexcept { return law_.coefficient(rate) * law_.weight / law_.stick(); }
  bool slides(const State& state, const Jet& at) const noexcept;
  double friction(const State& state, const LinkMotion& motion) const noexcept;
  State slid(State state, const LinkMotion& motion) const noexcept;
  double balanced_slip_rate(const Jet& at, double way) const noexcept {
    return at.v - way * law_.weight / law_.stick() * law_.slope_of_coefficient(at.v) * at.a;
  }
  Phase phase(State state, const Quintic& path, double from, double to) const noexcept;
  State follow(State state, const LinkStep& step, double to) const noexcept;

  SlidingFriction law_;
};

}  // namespace pounding
