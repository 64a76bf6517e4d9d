#pragma once
#include <pounding/laws/linear_dashpot.hpp>

namespace pounding::laws {

/// Texts and formulas of Komodromos.
struct KomodromosTraits {
  static constexpr std::string_view name = "komodromos",
                                    shape = "F = k d + c d' until F = 0, then the contact ends; c = 2 zeta sqrt(k m)";
  static constexpr std::string_view summary =
      "linear spring and dashpot; ends at zero force, indentation widens the gap";
  static constexpr std::string_view source = "Komodromos et al. 2007, EESD 36:1917";
  static constexpr std::string_view range = "any zeta >= 0";
  static constexpr std::string_view beware =
      "the force jumps to c v at the touch. The penetration left at F = 0 is added to the gap for the rest of the run";
  static constexpr bool leaves_indentation = true;
  static constexpr auto& formulas = cut_dashpot_formulas;
};

/// F = k d + c d' while positive, c = 2 zeta sqrt(k m); the contact ends at F = 0, and the remaining penetration is
/// added to the gap.
///
/// k [N/m], c [N s/m], zeta [-], m [kg] reduced mass, d [m], d' [m/s]. Komodromos, Polycarpou, Papaloizou & Phocas
/// 2007, EESD 36:1917. A single free impact is the same as with kelvin_voigt_no_tension; the indentation affects later
/// impacts.
using Komodromos = LinearDashpotLaw<KomodromosTraits>;

}  // namespace pounding::laws
