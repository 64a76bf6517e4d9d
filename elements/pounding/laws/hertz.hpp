#pragma once
#include <array>
#include <string_view>

#include <pounding/base/power.hpp>
#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// F = k d^n: Hertz contact for n = 1.5, elastic, restitution 1.
///
/// k [N/m^n], n >= 1 [-], d [m] penetration. Jing & Young 1991; Chau & Wei 2001. Any penetration.
struct Hertz {
  static constexpr std::string_view name = "hertz", shape = "F = k d^n";
  static constexpr std::string_view summary = "nonlinear elastic Hertz spring, dissipates no energy";
  static constexpr std::string_view source = "Hertz 1882; Jing & Young 1991; Chau & Wei 2001";
  static constexpr std::string_view symbols = "k [N/m^n] contact stiffness, n [-] exponent";
  static constexpr std::string_view range = "any penetration, n >= 1; n = 1.5 is the Hertz contact of spheres";
  static constexpr std::string_view beware = "restitution 1 for any bodies: only the structures dissipate energy";

  double stiffness = 0;   ///< k [N/m^n]
  double exponent = 1.5;  ///< n [-]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m^n", "contact stiffness k", 2.06e9}, &Hertz::stiffness},
      Parameter{{"exponent", "", "exponent n", 1.5, Need::optional}, &Hertz::exponent}};

  void check() const {
    require_positive("stiffness", stiffness);
    require_exponent(exponent);
  }

  Response contact(double penetration, double, const Impact&) const noexcept {
    const Power p = power(penetration, exponent);
    return {stiffness * p.value, stiffness * p.slope, 0};
  }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
