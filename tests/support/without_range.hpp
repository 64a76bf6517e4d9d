#pragma once
/// A spring that hides its elastic range, so that a run takes the slow path at every step.

#include <memory>
#include <utility>

#include <pounding/structures/spring.hpp>

namespace pounding::test {

class WithoutRange final : public Spring {
 public:
  explicit WithoutRange(std::unique_ptr<Spring> spring) : own_(std::move(spring)), spring_(*own_) {}
  /// `spring` must outlive it.
  explicit WithoutRange(Spring& spring) : spring_(spring) {}

  laws::Response evaluate(const LinkMotion& motion) const noexcept override { return spring_.evaluate(motion); }
  double stiffness() const noexcept override { return spring_.stiffness(); }
  double first_slope() const noexcept override { return spring_.first_slope(); }
  double yield_deformation() const noexcept override { return spring_.yield_deformation(); }
  std::optional<double> corner(double deformation) const noexcept override { return spring_.corner(deformation); }
  double slope_lost(double deformation) const noexcept override { return spring_.slope_lost(deformation); }
  bool has_corners() const noexcept override { return spring_.has_corners(); }
  void start(const LinkMotion& motion) override { spring_.start(motion); }
  void accept(const LinkStep& step) override { spring_.accept(step); }
  Instant inside(const LinkStep& step, double s, double deformation) const noexcept override {
    return spring_.inside(step, s, deformation);
  }
  bool bends_sharply(const LinkStep& step) const noexcept override { return spring_.bends_sharply(step); }
  double lost() const noexcept override { return spring_.lost(); }
  double damped() const noexcept override { return spring_.damped(); }
  double stored_correction() const noexcept override { return spring_.stored_correction(); }
  void archive(Archive& archive) override { spring_.archive(archive); }

 private:
  std::unique_ptr<Spring> own_;
  Spring& spring_;
};

}  // namespace pounding::test
