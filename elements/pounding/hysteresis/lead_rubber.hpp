#pragma once
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <pounding/hysteresis/bilinear.hpp>
#include <pounding/hysteresis/bouc_wen.hpp>
#include <pounding/hysteresis/made_of.hpp>

namespace pounding::hysteresis {

/// Shear stiffness k2 of the rubber [N/m], given directly or as G A/t_r.
template <class L>
double rubber_stiffness(const L& law) noexcept {
  return law.post_yield_stiffness ? *law.post_yield_stiffness : *law.shear_modulus * *law.area / *law.rubber_thickness;
}

/// Throws std::invalid_argument for an invalid strength or yield deformation, and unless exactly one form of the
/// stiffness is given, complete and positive.
template <class L>
void check_rubber(const L& law) {
  laws::require_positive("strength", law.strength);
  laws::require_positive("yield_displacement", law.displacement_at_yield);
  const bool any = law.shear_modulus || law.area || law.rubber_thickness;
  const bool all = law.shear_modulus && law.area && law.rubber_thickness;
  if (law.post_yield_stiffness ? any : !all)
    throw std::invalid_argument(std::string(L::name) +
                                " needs either post_yield_stiffness, or shear_modulus, area and rubber_thickness");
  laws::require_positive("post_yield_stiffness", law.post_yield_stiffness);
  laws::require_positive("shear_modulus", law.shear_modulus);
  laws::require_positive("area", law.area);
  laws::require_positive("rubber_thickness", law.rubber_thickness);
}

/// f = k2 d + q, |q| <= Q in series with a spring Q/u_y: rubber with a yielding lead core, in one direction.
///
/// Q [N] characteristic strength, the force of the loop at d = 0; k2 = G A/t_r [N/m] stiffness of the rubber, G [Pa]
/// shear modulus, A [m^2] area, t_r [m] total rubber thickness; u_y [m] yield deformation. Kelly 1997,
/// Earthquake-Resistant Design with Rubber; Naeim & Kelly 1999. A bilinear law with k = k2 + Q/u_y and Fy = Q + k2 u_y.
struct LeadRubber : MadeOf<LeadRubber, Bilinear> {
  static constexpr std::string_view name = "lead_rubber",
                                    shape = "f = k2 d + q, |q| <= Q in series with a spring Q/u_y";
  static constexpr std::string_view summary = "lead-rubber isolator: bilinear, defined by Q, k2 and u_y";
  static constexpr std::string_view source = "Kelly 1997, Earthquake-Resistant Design with Rubber; Naeim & Kelly 1999";
  static constexpr std::string_view symbols =
      "Q [N] characteristic strength, k2 = G A/t_r [N/m] post-yield stiffness, u_y [m] yield deformation, G [Pa] shear "
      "modulus, A [m^2] area, t_r [m] total rubber thickness";
  static constexpr std::string_view range = "one direction; shear strains below about 200 %";
  static constexpr std::string_view beware =
      "heating and strength loss of the lead, and the effect of the axial force, are not modelled";

  double strength = 0;                                                ///< Q > 0 [N]
  double displacement_at_yield = 0;                                   ///< u_y > 0 [m]
  std::optional<double> post_yield_stiffness{};                       ///< k2 > 0 [N/m], or the next three
  std::optional<double> shear_modulus{}, area{}, rubber_thickness{};  ///< G [Pa], A [m^2], t_r [m]

  static constexpr std::array parameters{
      Parameter{{"strength", "N", "characteristic strength Q", 3.75e5}, &LeadRubber::strength},
      Parameter{{"yield_displacement", "m", "yield deformation u_y", 0.012}, &LeadRubber::displacement_at_yield},
      Parameter{{"post_yield_stiffness", "N/m", "post-yield stiffness k2, or G, A and t_r", 3.5e6, Need::instead},
                &LeadRubber::post_yield_stiffness},
      Parameter{{"shear_modulus", "Pa", "shear modulus G, instead of k2", 4e5, Need::extra},
                &LeadRubber::shear_modulus},
      Parameter{{"area", "m^2", "area A, together with G", 1.75, Need::extra}, &LeadRubber::area},
      Parameter{{"rubber_thickness", "m", "total rubber thickness t_r, together with G", 0.2, Need::extra},
                &LeadRubber::rubber_thickness}};
  static constexpr std::array state{StateValue<LeadRubber>{{"slip", "m", "plastic deformation of the lead"},
                                                           [](const Bilinear::State& kept) { return kept.slip; }}};

  void check() const { check_rubber(*this); }
  /// The equivalent bilinear law.
  Bilinear made() const noexcept {
    const double k2 = rubber_stiffness(*this), k = k2 + strength / displacement_at_yield;
    return {.initial_stiffness = k, .yield_force = k * displacement_at_yield, .hardening = k2 / k};
  }
};

/// f = k2 d + Q z/u_y: high-damping rubber, with the smooth Bouc-Wen transition, n = 2 and linear unloading, in one
/// direction.
///
/// Symbols as in LeadRubber. Equivalent to one direction of elastomericBearingBoucWen of OpenSees with eta = 2 and beta
/// = gamma = 1/2.
struct Elastomeric : MadeOf<Elastomeric, BoucWen> {
  static constexpr std::string_view name = "elastomeric",
                                    shape = "f = k2 d + Q z/u_y, dz/dd = 1 - |z/u_y|^n [1 + sign(z dd)]/2";
  static constexpr std::string_view summary =
      "high-damping rubber isolator: Bouc-Wen, defined by Q, k2 and u_y (elastomericBearingBoucWen)";
  static constexpr std::string_view source =
      "Kelly 1997, Earthquake-Resistant Design with Rubber; Park, Wen & Ang 1986, EESD 14:543";
  static constexpr std::string_view symbols =
      "Q [N] characteristic strength, k2 = G A/t_r [N/m] post-yield stiffness, u_y [m] yield deformation, n [-] "
      "sharpness of the transition, G [Pa] shear modulus, A [m^2] area, t_r [m] total rubber thickness";
  static constexpr std::string_view range =
      "one direction; shear strains below about 150 %, where rubber begins to stiffen";
  static constexpr std::string_view beware =
      "small cycles about a constant force ratchet, see bouc_wen. The effect of the axial force is not modelled";

  double strength = 0;                                                ///< Q > 0 [N]
  double displacement_at_yield = 0;                                   ///< u_y > 0 [m]
  std::optional<double> post_yield_stiffness{};                       ///< k2 > 0 [N/m], or the next three
  std::optional<double> shear_modulus{}, area{}, rubber_thickness{};  ///< G [Pa], A [m^2], t_r [m]
  double exponent = 2;                                                ///< n >= 1 [-]

  static constexpr std::array parameters{
      Parameter{{"strength", "N", "characteristic strength Q", 3.75e5}, &Elastomeric::strength},
      Parameter{{"yield_displacement", "m", "yield deformation u_y", 0.012}, &Elastomeric::displacement_at_yield},
      Parameter{{"post_yield_stiffness", "N/m", "post-yield stiffness k2, or G, A and t_r", 3.5e6, Need::instead},
                &Elastomeric::post_yield_stiffness},
      Parameter{{"shear_modulus", "Pa", "shear modulus G, instead of k2", 4e5, Need::extra},
                &Elastomeric::shear_modulus},
      Parameter{{"area", "m^2", "area A, together with G", 1.75, Need::extra}, &Elastomeric::area},
      Parameter{{"rubber_thickness", "m", "total rubber thickness t_r, together with G", 0.2, Need::extra},
                &Elastomeric::rubber_thickness},
      Parameter{{"exponent", "", "sharpness n of the transition", 2, Need::optional}, &Elastomeric::exponent}};
  static constexpr std::array state{StateValue<Elastomeric>{{"elastic", "m", "elastic part of the deformation z"},
                                                            [](const BoucWen::State& kept) { return kept.elastic; }}};

  void check() const {
    check_rubber(*this);
    laws::require_exponent(exponent);
  }
  /// The equivalent Bouc-Wen law.
  BoucWen made() const noexcept {
    const double k2 = rubber_stiffness(*this), k = k2 + strength / displacement_at_yield;
    return {
        .initial_stiffness = k, .yield_force = k * displacement_at_yield, .hardening = k2 / k, .exponent = exponent};
  }
};

}  // namespace pounding::hysteresis
