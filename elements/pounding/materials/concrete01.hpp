#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <pounding/materials/compression.hpp>

namespace pounding::materials {

/// s = fpc r (2 - r), r = e/epsc0; a line from (epsc0, fpc) to (epsU, fpcu), constant beyond; no tension.
///
/// s [Pa] stress, e [-] strain, fpc [Pa] strength at the strain epsc0, fpcu [Pa] crushing strength at the strain epsU.
/// Unloading and reloading follow a straight line from the minimum strain to the residual strain of Karsan & Jirsa
/// 1969, at most as steep as 2 fpc/epsc0.
struct Concrete01 : KentPark, ByPieces<Concrete01> {
  static constexpr std::string_view name = "concrete01",
                                    shape = "s = fpc r (2 - r), r = e/epsc0; then linear to (epsU, fpcu)";
  static constexpr std::string_view summary = "concrete without tension (Concrete01)";
  static constexpr std::string_view source =
      "Kent & Park 1971; Karsan & Jirsa 1969; Scott, Park & Priestley 1982, ACI Journal 79(1)";
  static constexpr std::string_view symbols =
      "fpc [Pa] strength, epsc0 [-] its strain, fpcu [Pa] crushing strength, epsU [-] its strain";
  static constexpr std::string_view range = "fpc < 0, epsU < epsc0 < 0, fpc <= fpcu <= 0";
  static constexpr std::string_view beware =
      "the initial modulus is 2 fpc/epsc0. The residual strain jumps by 0.006 epsc0 at twice epsc0, as published";
  /// Upper bound on the energy gained at the jump of the residual strain, divided by stiffness times epsc0^2.
  static constexpr double gives_back = 0.002;
  static constexpr bool is_symmetric = false, is_cubic = true, forgets_small_reversals = true;

  static constexpr std::array parameters{
      Parameter<Concrete01>{fpc_info, &Concrete01::fpc}, Parameter<Concrete01>{epsc0_info, &Concrete01::epsc0},
      Parameter<Concrete01>{fpcu_info, &Concrete01::fpcu}, Parameter<Concrete01>{epsU_info, &Concrete01::epsU}};

  /// Accepted and minimum strain [-].
  struct State {
    double deformation = 0, minimum = 0;
  };
  /// Minimum strain, and the line of unloading from it.
  struct Branch {
    double minimum = 0, slope = 0, end = 0;
  };
  static constexpr std::array state{
      StateValue<Concrete01>{{"minimum", "", "minimum strain"}, [](const State& kept) { return kept.minimum; }}};

  using ByPieces::respond;
  Branch branch(const State& kept) const noexcept {
    const Unloading line = karsan_jirsa(kept.minimum, envelope(kept.minimum).force, stiffness(), epsc0, epsU);
    return {kept.minimum, line.slope, line.end};
  }
  Answer respond(const Branch& b, double strain) const noexcept {
    const Answer loading = envelope(strain);
    const bool is_loading = strain <= b.minimum, is_closed = strain < b.end;
    const double stress = is_closed ? b.slope * (strain - b.end) : 0, slope = is_closed ? b.slope : 0;
    return {is_loading ? loading.force : stress, is_loading ? loading.slope : slope};
  }
  State advance(const State& kept, double strain) const noexcept { return {strain, std::min(kept.minimum, strain)}; }
  std::array<double, 4> corners(const State& kept) const noexcept {
    return {branch(kept).end, kept.minimum, kept.minimum > epsc0 ? epsc0 : NAN, kept.minimum > epsU ? epsU : NAN};
  }
  double unloaded(const State& kept) const noexcept { return std::max(kept.deformation, branch(kept).end); }
};

}  // namespace pounding::materials
