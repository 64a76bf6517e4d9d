#pragma once
/// Storeys, hinges and devices with a hysteretic law.

#include <cmath>

#include <pounding/hysteresis/law.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// A spring with a hysteretic law. Its k is that of the law.
///
/// As a Spring it returns the force of the law minus k u. The law follows straight paths: if the deformation reverses
/// within a step, accept() first advances to the reversal of the cubic through both ends of the step. Without a
/// dashpot.
template <hysteresis::Law L>
class HystereticSpring : public Spring {
 public:
  /// Undeformed. Throws std::invalid_argument for a parameter out of range.
  explicit HystereticSpring(const L& law) : law_(law) { law_.check(); }

  using Spring::accept, Spring::evaluate, Spring::load, Spring::stiffness, Spring::start, Spring::yield_deformation;
  std::size_t memory_size() const noexcept override { return sizeof(Memory); }
  void reset(ElementMemory memory) const noexcept override { reset_as<Memory>(memory); }
  laws::Response evaluate(ConstElementMemory memory, const LinkMotion& motion) const noexcept override {
    const hysteresis::Answer answer = hysteresis::excess(law_, of(memory).kept, motion.penetration);
    return {answer.force, answer.slope, 0};
  }
  double stiffness() const noexcept override { return law_.stiffness(); }
  double yield_deformation() const noexcept override { return law_.yield_deformation(); }
  double yields_towards(double way) const noexcept override {
    if constexpr (requires { law_.yield_deformation(way); })
      return law_.yield_deformation(way);
    else
      return law_.yield_deformation();
  }
  double yield_force() const noexcept override {
    if constexpr (requires { law_.yield_force(); })
      return law_.yield_force();
    else
      return Spring::yield_force();
  }
  std::optional<double> corner(ConstElementMemory memory, double deformation) const noexcept override {
    return law_.corner(of(memory).kept, deformation);
  }
  /// Evaluates the slope after the reversal: it differs from k where an elastically unloaded force reloads on a curve.
  double slope_lost(ConstElementMemory memory, double deformation) const noexcept override {
    const typename L::State& kept_ = of(memory).kept;
    const double yield = law_.yield_deformation();
    // A law without yield has no such scale; the reversal is then relative to the path.
    const double scale = std::isfinite(yield) ? yield : std::abs(kept_.deformation - deformation);
    const double back = deformation + std::copysign(turned_part * scale, kept_.deformation - deformation);
    return hysteresis::excess(law_, law_.advance(kept_, deformation), back).slope -
           hysteresis::excess(law_, kept_, deformation).slope;
  }
  std::optional<Spring::Elastic> elastic(ConstElementMemory memory) const noexcept override {
    const typename L::State& kept_ = of(memory).kept;
    if constexpr (requires { law_.elastic(kept_); }) {
      const hysteresis::Range range = law_.elastic(kept_);
      return Spring::Elastic{range.low, range.high,
                             hysteresis::excess(law_, kept_, 0.5 * (range.low + range.high)).force};
    }
    return {};
  }
  void stay(ElementMemory memory, double deformation) const override {
    Memory& own = of(memory);
    own.begin_step();
    own.kept.deformation = deformation;
  }
  /// Brings an undeformed spring to the initial motion of the run; this counts no loss.
  void start(ElementMemory memory, const LinkMotion& motion) const override {
    Memory& own = of(memory);
    if (own.kept.deformation == 0 && motion.penetration != 0) {
      own.kept = law_.advance(own.kept, motion.penetration);
      if constexpr (!counts_loss) own.given = law_.stored(own.kept);
    }
  }
  void load(ElementMemory memory, double deformation) const override {
    follow(of(memory).kept, of(memory).given, deformation);
  }
  void accept(ElementMemory memory, const LinkStep& step) const override {
    Memory& own = of(memory);
    own.begin_step();
    if (step.motion_begin.rate * step.motion_end.rate < 0) {
      const CubicPenetration between(step.motion_begin, step.motion_end, step.end - step.begin);
      const double s = between.turn();
      if (s > 0 && s < 1) follow(own.kept, own.given, between.at(s));
    }
    follow(own.kept, own.given, step.motion_end.penetration);
  }
  Spring::Instant inside(ConstElementMemory memory, const LinkStep& step, double s,
                         double deformation) const noexcept override {
    typename L::State state = of(memory).before;
    double given = of(memory).given_before;
    if (step.motion_begin.rate * step.motion_end.rate < 0) {
      const CubicPenetration between(step.motion_begin, step.motion_end, step.end - step.begin);
      if (const double turn = between.turn(); turn > 0 && turn < s) follow(state, given, between.at(turn));
    }
    const double force = hysteresis::excess(law_, state, deformation).force;
    follow(state, given, deformation);
    return {force, lost(state, given)};
  }
  ElementEnergy energy(ConstElementMemory memory) const noexcept override {
    const Memory& own = of(memory);
    return {.lost = lost(own.kept, own.given), .stored_correction = hysteresis::stored_excess(law_, own.kept)};
  }

  /// The law with its parameters.
  const L& law() const noexcept { return law_; }
  /// State at the last accepted step.
  static const typename L::State& kept(ConstElementMemory memory) noexcept { return of(memory).kept; }

 private:
  /// Relative size of a reversal that determines the slope behind it, as a fraction of the yield deformation.
  static constexpr double turned_part = 1e-9;
  /// True if the law computes its loss itself. Otherwise the loss is the work minus the stored energy, which is
  /// evaluated less often.
  static constexpr bool counts_loss =
      requires(const L& law, const typename L::State& kept, double d) { law.lost(kept, d); };

  struct Memory {
    typename L::State kept{};
    double given = 0;  // dissipated energy, or all work done on the spring [J]
    // At the beginning of the last accepted step, for inside().
    typename L::State before{};
    double given_before = 0;

    void begin_step() {
      before = kept;
      given_before = given;
    }
  };
  static Memory& of(ElementMemory memory) noexcept { return memory_as<Memory>(memory); }
  static const Memory& of(ConstElementMemory memory) noexcept { return memory_as<Memory>(memory); }

  void follow(typename L::State& state, double& given, double deformation) const {
    if constexpr (counts_loss)
      given += law_.lost(state, deformation);
    else
      given += law_.work(state, deformation);
    state = law_.advance(state, deformation);
  }
  double lost(const typename L::State& state, double given) const noexcept {
    if constexpr (counts_loss)
      return given;
    else
      return given - law_.stored(state);
  }

  L law_;
};

}  // namespace pounding
