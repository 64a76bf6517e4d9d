#pragma once
/// State and parameter table of the deteriorating laws of Ibarra, Medina & Krawinkler.

#include <array>
#include <string_view>

#include <pounding/hysteresis/table.hpp>

namespace pounding::hysteresis {

/// Backbone of one side, by magnitudes: hardening line `base + slope x`, softening line `top - soft x`, residual force.
/// The first point of reloading is the last reversal (turn, turn_force), the second one lies at the deformation `peak`.
struct ImkSide {
  double yield = 0, base = 0, slope = 0, top = 0, soft = 0, residual = 0;
  double peak = 0, turn = 0, turn_force = 0;
  double zero = 0;   // superseded laws: last zero force before loading
  double limit = 0;  // bilin: last reversal at the peak
  bool is_lost = false;
};

/// Present piece: elastic before the first yield; unloading from a reversal and back; reloading in one to three lines;
/// on the backbone, below the line that hardens, hardening, softening and residual; without force on one side or both.
enum class ImkRule : int {
  elastic,
  unloading,
  to_pinch,
  to_turn,
  reloading,
  below,
  hardening,
  softening,
  residual,
  lost,
  failed
};

/// State of these laws. `end` is the deformation at which a piece of loading ends, in the direction of its side; k is
/// the unloading stiffness, `begun` the work at the last zero force, `pinch` and `pinch_force` the pinching point.
struct ImkState {
  double deformation = 0, work = 0;
  double start = 0, force = 0, slope = 0;
  ImkRule rule = ImkRule::elastic;
  int side = 0;
  bool is_on_backbone = false, was_residual = false;
  double end = 0, k = 0, begun = 0, pinch = 0, pinch_force = 0;
  double ratio = 1;       // mod_imk laws: product of all 1 - beta_K
  bool is_due = false;    // the backbone was reached since the last deterioration
  bool is_final = false;  // bilin: no further deterioration
  std::array<ImkSide, 2> sides{};
};

/// Publications of these laws.
inline constexpr std::string_view imk_source =
    "Ibarra, Medina & Krawinkler 2005, Earthquake Eng. Struct. Dyn. 34:1489; Lignos & Krawinkler 2011, J. Struct. "
    "Eng. 137:1291";

/// Table of the parameters of law L, which may have more. Named as in OpenSees, where deformations of a hinge are
/// theta_p and theta_pc in the papers.
template <class L, class... More>
constexpr auto imk_parameters(const More&... more) {
  using P = Parameter<L>;
  const auto exponent = [](std::string_view name) {
    return ParameterInfo{name, "", "exponent of this deterioration", 1, Need::optional};
  };
  const auto capacity = [](std::string_view name, std::string_view meaning) {
    return ParameterInfo{name, "m", meaning, 1.5, Need::optional};
  };
  const auto negative = [](std::string_view name, std::string_view unit, std::string_view meaning, double typical,
                           std::string_view at_hinge) {
    return ParameterInfo{
        .name = name, .unit = unit, .meaning = meaning, .typical = typical, .need = Need::extra, .at_hinge = at_hinge};
  };
  const auto factor = [](std::string_view name, std::string_view meaning) {
    return ParameterInfo{name, "", meaning, 1, Need::optional};
  };
  return std::array{
      P{{"stiffness", "N/m", "initial stiffness Ke", 1e7}, &L::initial_stiffness},
      P{yield_force_info, &L::yield_force},
      P{hardening_info("ratio b of post-yield to initial stiffness, instead of FmaxFy"), &L::hardening},
      P{{.name = "FmaxFy",
         .unit = "",
         .meaning = "ratio of maximum to yield force, at least 1, instead of hardening",
         .typical = 1.08,
         .need = Need::extra},
        &L::FmaxFy},
      P{{.name = "dp",
         .unit = "m",
         .meaning = "deformation from yield to the maximum force",
         .typical = 0.06,
         .at_hinge = "theta_p"},
        &L::dp},
      P{{.name = "dpc",
         .unit = "m",
         .meaning = "deformation from the maximum force to zero force",
         .typical = 0.12,
         .at_hinge = "theta_pc"},
        &L::dpc},
      P{{.name = "du",
         .unit = "m",
         .meaning = "ultimate deformation, at which the force is lost (default none)",
         .typical = 0.5,
         .need = Need::extra,
         .at_hinge = "theta_u"},
        &L::du},
      P{{"FresFy", "", "ratio of residual to yield force", 0.2, Need::optional}, &L::FresFy},
      P{capacity("Lambda_S", "energy capacity Lambda of strength, Et = Lambda Fy (default: no deterioration)"),
        &L::Lambda_S},
      P{capacity("Lambda_C", "energy capacity Lambda of the softening line (default: no deterioration)"), &L::Lambda_C},
      P{capacity("Lambda_K", "energy capacity Lambda of the unloading stiffness (default: no deterioration)"),
        &L::Lambda_K},
      P{exponent("c_S"), &L::c_S},
      P{exponent("c_C"), &L::c_C},
      P{exponent("c_K"), &L::c_K},
      P{{"negative_yield_force", "N", "magnitude of the yield force in the negative direction (default yield_force)",
         1e5, Need::extra},
        &L::negative_yield_force},
      P{negative("hardening_neg", "", "hardening in the negative direction (default hardening)", 0.03,
                 "spring_hardening_neg"),
        &L::hardening_neg},
      P{negative("FmaxFy_neg", "", "FmaxFy in the negative direction (default FmaxFy)", 1.05, {}), &L::FmaxFy_neg},
      P{negative("dp_neg", "m", "dp in the negative direction (default dp)", 0.04, "theta_p_neg"), &L::dp_neg},
      P{negative("dpc_neg", "m", "dpc in the negative direction (default dpc)", 0.1, "theta_pc_neg"), &L::dpc_neg},
      P{negative("du_neg", "m", "du in the negative direction (default du)", 0.4, "theta_u_neg"), &L::du_neg},
      P{negative("FresFy_neg", "", "FresFy in the negative direction (default FresFy)", 0.1, {}), &L::FresFy_neg},
      P{factor("D_pos", "factor on the deterioration of strength and softening line in the positive direction"),
        &L::D_pos},
      P{factor("D_neg", "this factor in the negative direction"), &L::D_neg},
      P(more)...};
}

/// State variables of law L.
template <class L>
inline constexpr std::array imk_state{
    StateValue<L>{{"rule", "", "0 elastic, 1 unloading, 2 to 4 reloading, 5 to 8 backbone, 9 and 10 force lost"},
                  [](const ImkState& kept) { return static_cast<double>(kept.rule); }},
    StateValue<L>{{"strength", "N", "yield force in the positive direction; 0 before the first yield"},
                  [](const ImkState& kept) { return kept.sides[0].yield; }},
    StateValue<L>{{"negative_strength", "N", "its magnitude in the negative direction"},
                  [](const ImkState& kept) { return kept.sides[1].yield; }},
    StateValue<L>{{"unloading", "N/m", "unloading stiffness; 0 before the first yield"},
                  [](const ImkState& kept) { return kept.k; }}};

}  // namespace pounding::hysteresis
