#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/materials/compression.hpp>

namespace pounding::materials {

/// As concrete01 in compression, with a hysteretic band on unloading and linear softening in tension.
///
/// E0 = 2 fpc/epsc0 [Pa]. With (e_w, s_w) the point of minimum strain, Er the slope from it to the focus e_f = (fpcu -
/// lambda E0 epsU)/(E0 (1 - lambda)), s_f = E0 e_f, and e_r = e_w - s_w/Er, unloading and reloading have the slope E0
/// between the lines s_w + Er (e - e_w) and Er (e - e_r)/2. Tension starts at e_r: slope E0 to ft, then -Ets to zero;
/// reloading along the secant. Mohd Yassin 1994, PhD thesis, University of California, Berkeley.
struct Concrete02 : KentPark, ByPieces<Concrete02> {
  static constexpr std::string_view name = "concrete02",
                                    shape =
                                        "s = fpc r (2 - r), r = e/epsc0; then linear to (epsU, fpcu); tension to ft";
  static constexpr std::string_view summary = "concrete with linear tension softening (Concrete02)";
  static constexpr std::string_view source = "Mohd Yassin 1994, PhD thesis, University of California, Berkeley";
  static constexpr std::string_view symbols =
      "fpc [Pa] strength, epsc0 [-] its strain, fpcu [Pa] crushing strength, epsU [-] its strain, lambda [-] ratio of "
      "unloading slope at epsU to 2 fpc/epsc0, ft [Pa] tensile strength, Ets [Pa] softening slope";
  static constexpr std::string_view range = "fpc < 0, epsU < epsc0 < 0, fpc <= fpcu <= 0, 0 <= lambda < 1, Ets > 0";
  static constexpr std::string_view beware =
      "the initial modulus is 2 fpc/epsc0, not the code value: 18 GPa for a confined core of 36 MPa at 0.004";
  static constexpr bool is_symmetric = false, is_cubic = true, forgets_small_reversals = true;

  double lambda = 0.1;  ///< in [0, 1) [-]
  double ft = 0;        ///< tensile strength, 0 or more [Pa]
  double Ets = 0;       ///< slope of softening in tension, > 0 [Pa]

  static constexpr std::array parameters{
      Parameter<Concrete02>{fpc_info, &Concrete02::fpc},
      Parameter<Concrete02>{epsc0_info, &Concrete02::epsc0},
      Parameter<Concrete02>{fpcu_info, &Concrete02::fpcu},
      Parameter<Concrete02>{epsU_info, &Concrete02::epsU},
      Parameter<Concrete02>{{"lambda", "", "ratio of the unloading slope at epsU to the initial modulus", 0.1},
                            &Concrete02::lambda},
      Parameter<Concrete02>{{"ft", "Pa", "tensile strength", 2.5e6}, &Concrete02::ft},
      Parameter<Concrete02>{{"Ets", "Pa", "slope of the tension softening", 1.5e9}, &Concrete02::Ets}};

  /// Accepted strain [-] and stress [Pa], minimum strain, maximum opening of the crack beyond e_r [-].
  struct State {
    double deformation = 0, stress = 0, minimum = 0, crack = 0;
  };
  /// The state, the line through (e_w, s_w) that ends at e_r, and the secant in tension.
  struct Branch {
    double strain = 0, stress = 0, minimum = 0, stress_at_minimum = 0, slope = 0, end = 0, crack = 0, secant = 0;
  };
  static constexpr std::array state{
      StateValue<Concrete02>{{"minimum", "", "minimum strain"}, [](const State& kept) { return kept.minimum; }},
      StateValue<Concrete02>{{"crack", "", "maximum tensile strain beyond the residual strain"},
                             [](const State& kept) { return kept.crack; }}};

  void check() const {
    KentPark::check();
    if (!(lambda >= 0 && lambda < 1)) laws::refuse("lambda", lambda, "in [0, 1)");
    laws::require_not_negative("ft", ft);
    laws::require_positive("Ets", Ets);
  }

  using ByPieces::respond;
  Branch branch(const State& kept) const noexcept {
    const double E0 = stiffness(), focus = (fpcu - lambda * E0 * epsU) / (E0 * (1 - lambda));
    const double lowest = envelope(kept.minimum).force, slope = (lowest - E0 * focus) / (kept.minimum - focus);
    return {kept.deformation,
            kept.stress,
            kept.minimum,
            lowest,
            slope,
            kept.minimum - lowest / slope,
            kept.crack,
            kept.crack > 0 ? tension(kept.crack).force / kept.crack : E0};
  }
  Answer respond(const Branch& b, double strain) const noexcept {
    const double E0 = stiffness(), opening = strain - b.end;
    const Answer loading = envelope(strain), softening = tension(opening);
    const double low = b.stress_at_minimum + b.slope * (strain - b.minimum), high = 0.5 * b.slope * opening;
    double inside = b.stress + E0 * (strain - b.strain), slope = E0;
    slope = inside <= low ? b.slope : slope;
    inside = inside <= low ? low : inside;
    slope = inside >= high ? 0.5 * b.slope : slope;
    inside = inside >= high ? high : inside;
    const bool is_old = opening <= b.crack, is_closed = opening <= 0, is_loading = strain <= b.minimum;
    const double pull = is_old ? b.secant * opening : softening.force, pull_slope = is_old ? b.secant : softening.slope;
    return {is_loading  ? loading.force
            : is_closed ? inside
                        : pull,
            is_loading  ? loading.slope
            : is_closed ? slope
                        : pull_slope};
  }
  State advance(const State& kept, double strain) const noexcept {
    const Branch b = branch(kept);
    return {strain, respond(b, strain).force, std::min(kept.minimum, strain), std::max(kept.crack, strain - b.end)};
  }
  std::array<double, 9> corners(const State& kept) const noexcept {
    const Branch b = branch(kept);
    const double E0 = stiffness(), peak = ft / E0, cracked = peak + ft / Ets;
    return {b.end,
            b.minimum,
            b.minimum > epsc0 ? epsc0 : NAN,
            b.minimum > epsU ? epsU : NAN,
            (b.stress_at_minimum - b.slope * b.minimum - b.stress + E0 * b.strain) / (E0 - b.slope),
            (E0 * b.strain - b.stress - 0.5 * b.slope * b.end) / (E0 - 0.5 * b.slope),
            b.crack > peak && b.crack < cracked ? b.end + b.crack : NAN,
            b.crack < peak ? b.end + peak : NAN,
            b.crack < cracked ? b.end + cracked : NAN};
  }
  double unloaded(const State& kept) const noexcept { return branch(kept).end; }

 private:
  /// Envelope in tension at an opening of 0 or more.
  Answer tension(double opening) const noexcept {
    const double E0 = stiffness(), peak = ft / E0, cracked = peak + ft / Ets;
    const bool is_elastic = opening <= peak, is_softening = opening <= cracked;
    return {is_elastic     ? E0 * opening
            : is_softening ? ft - Ets * (opening - peak)
                           : 0,
            is_elastic     ? E0
            : is_softening ? -Ets
                           : 0};
  }
};

}  // namespace pounding::materials
