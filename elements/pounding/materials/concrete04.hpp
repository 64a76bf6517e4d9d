#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/materials/compression.hpp>

namespace pounding::materials {

/// s = fc x r/(r - 1 + x^r), x = e/epsc, r = Ec/(Ec - fc/epsc) to the strain epscu, zero beyond; in tension Ec e to ft,
/// then ft beta^((e - ft/Ec)/(et - ft/Ec)) to the strain et.
///
/// s [Pa] stress, e [-] strain, fc [Pa] strength at the strain epsc, Ec [Pa] initial modulus. Popovics 1973; unloading
/// in compression as concrete01, in tension along the secant to zero strain.
struct Concrete04 : ByPieces<Concrete04> {
  static constexpr std::string_view name = "concrete04",
                                    shape = "s = fc x r/(r - 1 + x^r), x = e/epsc, r = Ec/(Ec - fc/epsc)";
  static constexpr std::string_view summary = "concrete of Popovics with exponential tension softening (Concrete04)";
  static constexpr std::string_view source =
      "Popovics 1973, Cement and Concrete Research 3(5); Karsan & Jirsa 1969; Mander, Priestley & Park 1988";
  static constexpr std::string_view symbols =
      "fc [Pa] strength, epsc [-] its strain, epscu [-] crushing strain, Ec [Pa] modulus, ft [Pa] tensile strength, et "
      "[-] ultimate tensile strain, beta [-] ratio of the stress at et to ft";
  static constexpr std::string_view range = "fc < 0, epscu < epsc < 0, Ec > fc/epsc, et > ft/Ec, 0 < beta < 1";
  static constexpr std::string_view beware =
      "the stress drops to zero at epscu and from beta ft to zero at et. The residual strain jumps by 0.006 epsc at "
      "twice epsc, as published";
  /// Upper bound on the energy gained at the jump of the residual strain, divided by stiffness times epsc^2.
  static constexpr double gives_back = 0.002;
  static constexpr bool is_symmetric = false, forgets_small_reversals = true;

  double fc = 0;      ///< < 0 [Pa]
  double epsc = 0;    ///< < 0 [-]
  double epscu = 0;   ///< < epsc [-]
  double Ec = 0;      ///< > fc/epsc [Pa]
  double ft = 0;      ///< 0 or more [Pa]
  double et = 0;      ///< > ft/Ec if ft > 0 [-]
  double beta = 0.1;  ///< in (0, 1) [-]

  static constexpr std::array parameters{
      Parameter{{"fc", "Pa", "compressive strength (negative)", -30e6}, &Concrete04::fc},
      Parameter{{"epsc", "", "strain at the strength (negative)", -0.002}, &Concrete04::epsc},
      Parameter{{"epscu", "", "crushing strain (negative)", -0.01}, &Concrete04::epscu},
      Parameter{{"Ec", "Pa", "initial modulus", 26e9}, &Concrete04::Ec},
      Parameter{{"ft", "Pa", "tensile strength", 2.5e6, hysteresis::Need::optional}, &Concrete04::ft},
      Parameter{{"et", "", "ultimate tensile strain", 0.001, hysteresis::Need::optional}, &Concrete04::et},
      Parameter{{"beta", "", "ratio of the stress at et to ft", 0.1, hysteresis::Need::optional}, &Concrete04::beta}};

  /// Accepted, minimum and maximum strain [-].
  struct State {
    double deformation = 0, minimum = 0, maximum = 0;
  };
  /// Minimum strain, line of unloading from it, maximum strain, and secant to it.
  struct Branch {
    double minimum = 0, slope = 0, end = 0, maximum = 0, secant = 0;
  };
  static constexpr std::array state{
      StateValue<Concrete04>{{"minimum", "", "minimum strain"}, [](const State& kept) { return kept.minimum; }},
      StateValue<Concrete04>{{"maximum", "", "maximum strain"}, [](const State& kept) { return kept.maximum; }}};

  void check() const {
    require_negative("fc", fc);
    require_negative("epsc", epsc);
    require_below("epscu", epscu, "epsc", epsc);
    if (!(std::isfinite(Ec) && Ec > fc / epsc))
      laws::refuse("Ec", Ec, "above the secant modulus fc/epsc, which is " + laws::number_text(fc / epsc));
    laws::require_not_negative("ft", ft);
    if (!(beta > 0 && beta < 1)) laws::refuse("beta", beta, "in (0, 1)");
    if (!(std::isfinite(et) && et >= 0 && (ft == 0 || et > ft / Ec)))
      laws::refuse("et", et, "above ft/Ec, which is " + laws::number_text(ft / Ec));
  }
  double stiffness() const noexcept { return Ec; }
  double yield_deformation() const noexcept { return -epsc; }

  using ByPieces::respond;
  Branch branch(const State& kept) const noexcept {
    const Unloading line = karsan_jirsa(kept.minimum, compression(kept.minimum).force, Ec, epsc, epscu);
    return {kept.minimum, line.slope, line.end, kept.maximum,
            kept.maximum > 0 ? tension(kept.maximum).force / kept.maximum : Ec};
  }
  Answer respond(const Branch& b, double strain) const noexcept {
    if (strain > 0) return strain < b.maximum ? Answer{b.secant * strain, b.secant} : tension(strain);
    if (strain <= b.minimum) return compression(strain);
    return strain < b.end ? Answer{b.slope * (strain - b.end), b.slope} : Answer{};
  }
  State advance(const State& kept, double strain) const noexcept {
    return {strain, std::min(kept.minimum, strain), std::max(kept.maximum, strain)};
  }
  std::array<double, 7> corners(const State& kept) const noexcept {
    return {branch(kept).end,
            kept.minimum,
            kept.minimum > epscu ? epscu : NAN,
            0,
            kept.maximum,
            kept.maximum < ft / Ec ? ft / Ec : NAN,
            kept.maximum < et ? et : NAN};
  }
  double unloaded(const State& kept) const noexcept {
    return kept.deformation > 0 ? (ft > 0 ? 0 : kept.deformation) : std::max(kept.deformation, branch(kept).end);
  }

 private:
  Answer compression(double strain) const noexcept {
    if (strain < epscu) return {};
    const double r = Ec / (Ec - fc / epsc), x = strain / epsc, power = std::pow(x, r), sum = r - 1 + power;
    return {fc * x * r / sum, fc / epsc * r * (r - 1) * (1 - power) / (sum * sum)};
  }
  Answer tension(double strain) const noexcept {
    const double peak = ft / Ec;
    if (ft == 0 || strain > et) return {};
    if (strain <= peak) return {Ec * strain, Ec};
    const double decay = std::log(beta) / (et - peak), stress = ft * std::exp(decay * (strain - peak));
    return {stress, decay * stress};
  }
};

}  // namespace pounding::materials
