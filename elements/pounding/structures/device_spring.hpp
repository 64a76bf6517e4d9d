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

  using Spring::accept, Spring::evaluate, Spring::load, Spring::stiffness, Spring::start, Spring::yield_deformation;
  std::size_t memory_size() const noexcept override {
    return sizeof(Memory) + (yielding_ ? yielding_->memory_size() : 0);
  }
  void reset(ElementMemory memory) const noexcept override;
  laws::Response evaluate(ConstElementMemory memory, const LinkMotion& motion) const noexcept override;
  laws::Response evaluate_slowly(ConstElementMemory memory, double deformation) const noexcept override;
  double first_slope() const noexcept override;
  double slope_lost(ConstElementMemory memory, double deformation) const noexcept override {
    return yielding_ ? yielding_->slope_lost(of_law(memory), deformation) : 0;
  }
  double yield_deformation() const noexcept override {
    return yielding_ ? yielding_->yield_deformation() : Spring::yield_deformation();
  }
  double yields_towards(double way) const noexcept override {
    return yielding_ ? yielding_->yields_towards(way) : Spring::yield_deformation();
  }
  double yield_force() const noexcept override { return yielding_ ? yielding_->yield_force() : Spring::yield_force(); }
  std::optional<double> corner(ConstElementMemory memory, double deformation) const noexcept override {
    return yielding_ ? yielding_->corner(of_law(memory), deformation) : std::nullopt;
  }
  bool has_corners() const noexcept override { return yielding_ && yielding_->has_corners(); }
  bool slips() const noexcept override { return damper_ && damper_->has_stiffness(); }
  double slip_rate(const LinkMotion& motion) const noexcept override;
  /// Slip at which a damper in series with a spring is at rest.
  double first_slip(const LinkMotion& motion) const noexcept override { return motion.penetration; }
  void start(ElementMemory memory, const LinkMotion& motion) const override;
  void load(ElementMemory memory, double deformation) const override {
    if (yielding_) yielding_->load(of_law(memory), deformation);
  }
  void accept(ElementMemory memory, const LinkStep& step) const override;
  /// The loss includes that of the damper.
  Spring::Instant inside(ConstElementMemory memory, const LinkStep& step, double s,
                         double deformation) const noexcept override;
  /// The whole stored energy, because k is zero.
  ElementEnergy energy(ConstElementMemory memory) const noexcept override;

  /// Elongation at the last accepted state [m].
  static double elongation(ConstElementMemory memory) noexcept { return of(memory).elongation; }

 private:
  // Followed by the memory of the law.
  struct Memory {
    double elongation = 0, stretch = 0, damped = 0;
    double damped_before = 0;  // at the beginning of the last accepted step, for inside()
  };
  static Memory& of(ElementMemory memory) noexcept { return memory_as<Memory>(memory); }
  static const Memory& of(ConstElementMemory memory) noexcept { return memory_as<Memory>(memory); }
  static ElementMemory of_law(ElementMemory memory) noexcept { return memory.subspan(sizeof(Memory)); }
  static ConstElementMemory of_law(ConstElementMemory memory) noexcept { return memory.subspan(sizeof(Memory)); }

  laws::Response without_damper(ConstElementMemory memory, const LinkMotion& motion) const noexcept;
  double damper_power(const LinkMotion& motion) const noexcept;
  LinkMotion motion_inside(const LinkStep& step, double s) const noexcept;
  double damper_work(const LinkStep& step, double until) const noexcept;

  std::optional<Bar> bar_;
  std::optional<Damper> damper_;
  std::unique_ptr<const Spring> yielding_;  // its force in addition to k d, with the k of the law
};

}  // namespace pounding
