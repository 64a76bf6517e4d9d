#pragma once
/// A bilinear spring that yields at two forces.

#include <cmath>

#include <pounding/structures/bilinear_spring.hpp>

namespace pounding {

/// A BilinearSpring whose elastic range goes from -Fn to Fp: with k, the hardening a and the deformation u [m] or [rad], force
/// a k u + (1 - a) k clamp(u - s, -Fn/k, Fp/k) with the slip s, 0 at first. It is an even one with the yield force (Fp + Fn)/2 whose
/// deformation counts from the middle of the range, (Fp - Fn)/2k: the force on top of k u is the same for both.
class UnevenSpring final : public Spring {
 public:
  /// `parameters` with the positive yield force; `negative` > 0 is the size of the other one [N], [N m]. Throws std::invalid_argument.
  UnevenSpring(BilinearSpring::Parameters parameters, double negative)
      : even_({parameters.stiffness, (parameters.yield_force + negative) / 2, parameters.hardening}),
        middle_((parameters.yield_force - negative) / (2 * parameters.stiffness)),
        yielding_((1 - parameters.hardening) * parameters.stiffness) {}

  laws::Response evaluate(const LinkMotion& motion) const noexcept override { return even_.evaluate(from_middle(motion)); }
  double stiffness() const noexcept override { return even_.stiffness(); }
  /// On the weaker side.
  double yield_deformation() const noexcept override { return even_.yield_deformation() - std::abs(middle_); }
  std::optional<double> corner(double deformation) const noexcept override {
    const std::optional<double> found = even_.corner(deformation - middle_);
    return found ? std::optional(*found + middle_) : std::nullopt;
  }
  void start(const LinkMotion& motion) override { even_.start(from_middle(motion)); }
  void accept(const LinkStep& step) override {
    LinkStep moved = step;
    moved.motion_begin = from_middle(step.motion_begin);
    moved.motion_middle = from_middle(step.motion_middle);
    moved.motion_end = from_middle(step.motion_end);
    even_.accept(moved);
  }
  // The slip works against another force than that of the even spring, and the energy counts from another place.
  double lost() const noexcept override { return even_.lost() + yielding_ * middle_ * even_.slip(); }
  double stored_correction() const noexcept override { return even_.stored_correction() - yielding_ * middle_ * even_.slip(); }
  void archive(Archive& archive) override { even_.archive(archive); }

 private:
  LinkMotion from_middle(LinkMotion motion) const noexcept {
    motion.penetration -= middle_;
    return motion;
  }

  BilinearSpring even_;
  double middle_, yielding_;
};

}  // namespace pounding
