#pragma once
/// A storey, a hinge or a device that yields by one of the laws of hysteresis/.

#include <type_traits>

#include <pounding/hysteresis/law.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// A spring that follows a law of yielding. Its k is that of the law.
///
/// As a Spring it answers the force of the law minus k u. The law follows straight ways; where the deformation turns within a step,
/// accept() goes to the turning point of the cubic through both ends of the step first. There is no dashpot.
template <hysteresis::Law L>
class HystereticSpring : public Spring {
 public:
  /// Undeformed. Throws std::invalid_argument for a parameter that is out of range.
  explicit HystereticSpring(const L& law) : law_(law) { law_.check(); }

  laws::Response evaluate(const LinkMotion& motion) const noexcept override {
    const hysteresis::Answer answer = hysteresis::excess(law_, kept_, motion.penetration);
    return {answer.force, answer.slope, 0};
  }
  double stiffness() const noexcept override { return law_.stiffness(); }
  double yield_deformation() const noexcept override { return law_.yield_deformation(); }
  std::optional<double> corner(double deformation) const noexcept override { return law_.corner(kept_, deformation); }
  bool has_corners() const noexcept override { return hysteresis::has_corners<L>; }
  /// A spring that was never deformed is brought to where the run begins, which loses nothing that is counted.
  void start(const LinkMotion& motion) override {
    if (kept_.deformation == 0 && motion.penetration != 0) {
      kept_ = law_.advance(kept_, motion.penetration);
      if constexpr (!counts_loss) given_ = law_.stored(kept_);
    }
  }
  void accept(const LinkStep& step) override {
    if (step.motion_begin.rate * step.motion_end.rate < 0) {
      const CubicPenetration between(step.motion_begin, step.motion_end, step.end - step.begin);
      const double s = between.turn();
      if (s > 0 && s < 1) follow(between.at(s));
    }
    follow(step.motion_end.penetration);
  }
  double lost() const noexcept override {
    if constexpr (counts_loss) return given_;
    else return given_ - law_.stored(kept_);
  }
  double stored_correction() const noexcept override { return hysteresis::stored_excess(law_, kept_); }
  void archive(Archive& archive) override {
    archive(kept_);
    archive(given_);
  }

  const L& law() const noexcept { return law_; }
  /// At the last kept step.
  const typename L::State& kept() const noexcept { return kept_; }

 private:
  /// Whether the law says itself what it loses. Else the loss is the work less what is stored, which is asked for less often.
  static constexpr bool counts_loss =
      requires(const L& law, const typename L::State& kept, double d) { law.lost(kept, d); };

  void follow(double deformation) {
    if constexpr (counts_loss) given_ += law_.lost(kept_, deformation);
    else given_ += law_.work(kept_, deformation);
    kept_ = law_.advance(kept_, deformation);
  }

  L law_;
  typename L::State kept_{};
  double given_ = 0;  // energy that was lost, or all work done on it [J]
};

}  // namespace pounding
