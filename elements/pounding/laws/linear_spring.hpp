#pragma once
#include <array>
#include <string_view>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d: an elastic spring, restitution 1.
///
/// k [N/m] contact stiffness, d [m] penetration. Maison & Kasai 1990; paper Eq. 3. Any penetration.
struct LinearSpring {
  static constexpr std::string_view name = "linear_spring", shape = "F = k d";
  static constexpr std::string_view summary = "linear elastic spring, dissipates no energy";
  static constexpr std::string_view source = "Maison & Kasai 1990";
  static constexpr std::string_view symbols = "k [N/m] contact stiffness";
  static constexpr std::string_view range = "any penetration";
  static constexpr std::string_view beware = "restitution 1 for any bodies: only the structures dissipate energy";
  static constexpr bool is_linear = true;

  double stiffness = 0;  ///< k [N/m]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "contact stiffness k", 9.35e7}, &LinearSpring::stiffness}};

  void check() const { require_positive("stiffness", stiffness); }

  Response contact(double penetration, double, const Impact&) const noexcept {
    return {stiffness * penetration, stiffness, 0};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
