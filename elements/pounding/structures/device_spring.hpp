#pragma once
/// A device as a spring between two points: a bar or a hysteretic law, a damper, or both in parallel.

#include <memory>
#include <optional>

#include <pounding/hysteresis/entry.hpp>
#include <pounding/structures/bar_and_damper.hpp>
#include <pounding/structures/spring.hpp>

namespace pounding {

/// Components of a device, in parallel.
struct DeviceParts {
  std::optional<Bar> bar{};
  std::optional<hysteresis::Settings> law{};  ///< hysteretic law including its stiffness, instead of a bar
  std::optional<Damper> damper{};

  /// Throws std::invalid_argument for a device without components, for a bar together with a law, and for invalid
  /// values of a component.
  void check() const;
};

/// Deformation and force are elongation and tension. The stiffness matrix does not contain the device, so evaluate()
/// returns the whole force.
class DeviceSpring final : public Spring {
 public:
  /// Undeformed. Throws like DeviceParts::check().
  explicit DeviceSpring(const DeviceParts& parts);

  laws::Response evaluate(const LinkMotion& motion) const noexcept override;
  laws::Response evaluate_slowly(double deformation) const noexcept override;
  double first_slope() const noexcept override;
  double slope_lost(double deformation) const noexcept override {
    return yielding_ ? yielding_->slope_lost(deformation) : 0;
  }
  double yield_deformation() const noexcept override {
    return yielding_ ? yielding_->yield_deformation() : Spring::yield_deformation();
  }
  double yields_towards(double way) const noexcept override {
    return yielding_ ? yielding_->yields_towards(way) : Spring::yield_deformation();
  }
  double yield_force() const noexcept override { return yielding_ ? yielding_->yield_force() : Spring::yield_force(); }
  std::optional<double> corner(double deformation) const noexcept override {
    return yielding_ ? yielding_->corner(deformation) : std::nullopt;
  }
  bool has_corners() const noexcept override { return yielding_ && yielding_->has_corners(); }
  bool slips() const noexcept override { return damper_ && damper_->has_stiffness(); }
  double slip_rate(const LinkMotion& motion) const noexcept override;
  /// Slip at which a damper in series with a spring is at rest.
  double first_slip(const LinkMotion& motion) const noexcept override { return motion.penetration; }
  void start(const LinkMotion& motion) override;
  void load(double deformation) override {
    if (yielding_) yielding_->load(deformation);
  }
  void accept(const LinkStep& step) override;
  /// The loss includes that of the damper.
  Spring::Instant inside(const LinkStep& step, double s, double deformation) const noexcept override;
  double lost() const noexcept override { return yielding_ ? yielding_->lost() : 0; }
  double damped() const noexcept override { return damped_; }
  /// The whole stored energy, because k is zero [J].
  double stored_correction() const noexcept override;
  void archive(Archive& archive) override;

  /// Elongation at the last accepted state [m].
  double elongation() const noexcept { return elongation_; }

 private:
  laws::Response without_damper(const LinkMotion& motion) const noexcept;
  double damper_power(const LinkMotion& motion) const noexcept;
  LinkMotion motion_inside(const LinkStep& step, double s) const noexcept;
  double damper_work(const LinkStep& step, double until) const noexcept;

  std::optional<Bar> bar_;
  std::optional<Damper> damper_;
  std::unique_ptr<Spring> yielding_;  // its force in addition to k d, with the k of the law
  double elongation_ = 0, stretch_ = 0, damped_ = 0;
  double damped_before_ = 0;  // at the beginning of the last accepted step, for inside()
};

}  // namespace pounding
