#pragma once
/// Devices that join two points of different structures, always and both ways: an elastic bar, a damper, or both beside each other.

#include <optional>

#include <pounding/structures/spring.hpp>

namespace pounding {

/// An elastic bar: f = k d. d [m] elongation, f > 0 is tension [N].
struct Bar {
  double stiffness = 0;  ///< k > 0 [N/m]

  double force(double elongation) const noexcept { return stiffness * elongation; }  ///< [N]
  /// Throws std::invalid_argument for a stiffness that is not positive and finite.
  void check() const;
};

/// A viscous damper: f = c |v|^a sign v. v [m/s] rate of elongation, f > 0 is tension [N].
///
/// With a = 1 it is linear. Below a = 1 the slope at v = 0 would be infinite, so every other power is rounded there,
///
///   f = c v (v^2 + v0^2)^((a-1)/2),
///
/// which is c |v|^a but for a part (a-1)/2 (v0/v)^2: with a = 0.35 and v0 = 1 mm/s the force is 1.3 % smaller at 5 mm/s and 0.003 % at 100 mm/s
/// (Constantinou & Symans 1993, The Structural Design of Tall Buildings 2, 93-132, for the power law).
struct Damper {
  static constexpr double least_exponent = 0.2, largest_exponent = 2;

  double coefficient = 0;           ///< c > 0 [N (s/m)^a]
  double exponent = 1;              ///< a in [0.2, 2]
  double rounding_velocity = 1e-3;  ///< v0 > 0 [m/s]; without a part where a = 1

  bool is_linear() const noexcept { return exponent == 1; }  ///< and not rounded
  double force(double rate) const noexcept;  ///< [N]
  double slope(double rate) const noexcept;  ///< of the force, positive [N s/m]
  /// Throws std::invalid_argument for a number that is out of range.
  void check() const;
};

/// A bar, a damper or both beside each other, as a spring between two points: deformation and force are elongation and tension.
class BarAndDamper final : public Spring {
 public:
  /// Undeformed. Throws std::invalid_argument for none of the two, and for numbers that they refuse.
  BarAndDamper(std::optional<Bar> bar, std::optional<Damper> damper);

  laws::Response evaluate(const LinkMotion& motion) const noexcept override;
  bool has_corners() const noexcept override { return false; }
  void start(const LinkMotion& motion) override { elongation_ = motion.penetration; }
  void accept(const LinkStep& step) override;
  double lost() const noexcept override { return 0; }
  double damped() const noexcept override { return damped_; }
  /// Energy of the bar [J].
  double stored_correction() const noexcept override;
  void archive(Archive& archive) override;

  /// Elongation at the last kept state [m].
  double elongation() const noexcept { return elongation_; }

 private:
  std::optional<Bar> bar_;
  std::optional<Damper> damper_;
  double elongation_ = 0, damped_ = 0;
};

}  // namespace pounding
