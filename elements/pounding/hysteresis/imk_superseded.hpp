#pragma once
/// Common part of the laws of Ibarra, Medina & Krawinkler that their authors have replaced.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <pounding/hysteresis/imk.hpp>

namespace pounding::hysteresis {

/// Base of these laws: the backbone of Imk, with the rules of the materials Bilin, ModIMKPeakOriented and
/// ModIMKPinching of OpenSees in the limit of small steps. Differences from the present laws:
///
/// - the capacity of the unloading stiffness is twice Lambda_K Fy, and the spring does not fail if a beta reaches 1;
/// - a zero force deteriorates only behind a side that has yielded; E is the work since then;
/// - the hardening line is followed below the residual force, which holds beyond the maximum only;
/// - if a capacity is exhausted, its beta is 1 and the others are 0.
///
/// Self provides
///
///     bool is_due(const State&) const noexcept;  // false if this zero force does not deteriorate
///     void deteriorate(State&, double beta_S, double beta_A, double beta_C) const noexcept;
template <class Self>
struct SupersededImk : Imk<Self> {
  using State = ImkState;  ///< accepted state
  static constexpr bool turns_everywhere = true, halves_after_residual = false, keeps_other_side = false,
                        hardens_below_residual = true;

  std::optional<double> Lambda_A{};  ///< energy capacity of accelerated reloading over Fy [m]; not of bilin
  double c_A = 1;                    ///< exponent > 0 [-]

  /// Zero force: the side of the direction is entered.
  void cross(State& s, int way) const noexcept {
    const ImkSide& left = this->of(s, -way);
    s.side = way;
    if (self().is_due(s) && left.peak > left.yield / this->initial_stiffness) {
      const std::array beta = betas(s);
      const double D = this->direction(way).D;
      const bool fails = Self::fails_at_beta_1 && std::ranges::max(beta) >= 1 && exhausted(s) == beta.size();
      s.begun = s.work;
      if (fails) return this->fail(s);
      self().deteriorate(s, D * beta[0], beta[1], D * beta[2]);
    }
    if (s.rule != ImkRule::failed) self().reload(s);
  }

 protected:
  using typename Imk<Self>::Direction;
  /// Deteriorated backbone of a side: the hardening line and the line of the initial softening slope through
  /// `intercept` at zero deformation, which turns to the slope `soft` where it meets the hardening or elastic line.
  void lower(ImkSide& a, const Direction& d, double yield, double slope, double intercept, double soft) const noexcept {
    const double k = this->initial_stiffness, dy = yield / k, steep = self().softening(d);
    const double elastic = intercept / (k + steep), hard = (intercept - yield + slope * dy) / (slope + steep);
    const double peak = std::max(elastic, hard), force = std::max(intercept - steep * peak, 0.0);
    a.yield = yield;
    a.slope = slope;
    a.soft = soft;
    a.base = force - slope * peak;
    a.top = force + soft * peak;
    a.residual = d.residual * (dy > peak ? force / d.yield : 1);
  }

 private:
  const Self& self() const noexcept { return static_cast<const Self&>(*this); }
  std::array<std::optional<double>, 3> capacities() const noexcept {
    return {this->Lambda_S, Lambda_A, this->Lambda_C};
  }
  /// Index of the first exhausted capacity, 3 if there is none.
  std::size_t exhausted(const State& s) const noexcept {
    const auto all = capacities();
    std::size_t i = 0;
    while (i < all.size() && !(all[i] && s.work >= *all[i] * this->yield_force)) ++i;
    return i;
  }
  std::array<double, 3> betas(const State& s) const noexcept {
    const auto all = capacities();
    const std::array exponents{this->c_S, c_A, this->c_C};
    std::array<double, 3> found{};
    const std::size_t one = exhausted(s);
    for (std::size_t i = 0; i < all.size(); ++i)
      found[i] = one < all.size() ? (i == one ? 1 : 0) : this->beta(s, all[i], exponents[i]);
    return found;
  }
};

}  // namespace pounding::hysteresis
