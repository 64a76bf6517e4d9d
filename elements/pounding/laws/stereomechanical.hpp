#pragma once
#include <array>
#include <string_view>

#include <pounding/laws/checks.hpp>
#include <pounding/laws/law.hpp>
#include <pounding/laws/table.hpp>

namespace pounding::laws {

/// No force: the relative velocity changes from v to -e v at the instant of touch.
///
/// e in [0, 1] restitution: v1+ = v1 - (1+e) m2 (v1-v2)/(m1+m2), v2+ = v2 + (1+e) m1 (v1-v2)/(m1+m2). Goldsmith 1960.
/// Provides neither force nor duration. For e = 0 the bodies move together after the touch until a force pulls them
/// apart.
struct Stereomechanical {
  static constexpr std::string_view name = "stereomechanical", shape = "v+ = -e v-";
  static constexpr std::string_view summary = "rigid impact: a velocity jump at the touch, no force history";
  static constexpr std::string_view source = "Goldsmith 1960";
  static constexpr std::string_view symbols = "e [-] restitution, v- and v+ [m/s] relative velocity before and after";
  static constexpr std::string_view range = "impacts that are short compared with the periods of the structures";
  static constexpr std::string_view beware =
      "no force, duration or penetration: peak forces are not available, and accelerations at the touch are infinite. "
      "For e = 0 the bodies move together after the touch until a force pulls them apart";
  static constexpr bool instantaneous = true, sticks_at_zero = true;

  double restitution = 0;  ///< e in [0, 1]

  static constexpr std::array<Parameter<Stereomechanical>, 0> parameters{};

  void check() const { require_restitution(restitution, sticks_at_zero); }

  Response contact(double, double, const Impact&) const noexcept { return {}; }
  Response respond(double d, double rate, const Impact& at) const noexcept { return pressed(*this, d, rate, at); }
};

}  // namespace pounding::laws
