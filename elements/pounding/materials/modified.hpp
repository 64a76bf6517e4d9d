#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include <pounding/base/root.hpp>
#include <pounding/materials/material.hpp>

namespace pounding::materials {

/// Low-cycle fatigue by Coffin-Manson, range = E0 N^m, with N cycles of a strain range to failure, and Miner's sum over
/// the cycles of rainflow counting. Parameters and defaults are those of the material Fatigue of OpenSees, for steel
/// braces (Uriz & Mahin 2008, PEER report 2008/08).
struct Fatigue {
  double E0 = 0.191;  ///< strain range at one cycle > 0 [-]
  double m = -0.458;  ///< slope of range over cycles on logarithmic scales < 0 [-]

  /// Throws std::invalid_argument for a value out of range.
  void check() const {
    laws::require_positive("E0", E0);
    if (!(std::isfinite(m) && m < 0)) laws::refuse("m", m, "finite and negative");
  }
  /// Damage of one cycle of this range.
  double damage(double range) const noexcept { return range > 0 ? std::pow(range / E0, -1 / m) : 0; }
};

/// Rainflow counting (ASTM E1049) along a path: turning points whose ranges are not counted yet, the first of them the
/// start, and the damage of those that are. If all places are taken, the last range counts as a cycle.
struct Rainflow {
  static constexpr std::size_t depth = 16;  ///< number of places
  std::array<double, depth> turns{};        ///< turning points [-]
  std::size_t count = 1;                    ///< their number
  double damage = 0;                        ///< of closed cycles [-]

  /// Adds a turning point and counts the cycles that it closes.
  void add(const Fatigue& law, double strain) noexcept {
    if (count == depth) {
      damage += law.damage(std::abs(strain - turns[count - 1]));
      --count;
      return;
    }
    turns[count++] = strain;
    while (count >= 3) {
      const double last = std::abs(turns[count - 1] - turns[count - 2]);
      const double range = std::abs(turns[count - 2] - turns[count - 3]);
      if (last < range) return;
      damage += (count == 3 ? 0.5 : 1) * law.damage(range);
      if (count == 3) turns[0] = turns[1];
      turns[count == 3 ? 1 : count - 3] = turns[count - 1];
      count -= count == 3 ? 1 : 2;
    }
  }
  /// Damage if the path turned at this strain; open ranges are half cycles.
  double damage_at(const Fatigue& law, double strain) const noexcept {
    Rainflow end = *this;
    end.add(law, strain);
    double sum = end.damage;
    for (std::size_t i = 1; i < end.count; ++i) sum += 0.5 * law.damage(std::abs(end.turns[i] - end.turns[i - 1]));
    return sum;
  }
};

/// A material with an initial strain, a strain at rupture in either direction, or fatigue: MinMax, Fatigue and
/// InitStrain of OpenSees, of any material of a variant. Beyond a strain at rupture, and in tension once the damage of
/// fatigue exceeds 1, the stress is zero for good. Materials in parallel are fibres at the same point.
template <class Any>
struct Modified;
template <class... M>
struct Modified<std::variant<M...>> {
  static constexpr std::string_view name = "modified";  ///< in reports

  std::variant<M...> base;             ///< the material
  double initial_strain = 0;           ///< added to the strain of the base, not to those of rupture [-]
  std::optional<double> min{}, max{};  ///< strains at rupture, < 0 and > 0 [-]
  std::optional<Fatigue> fatigue{};    ///< default: none

  /// Accepted state. The state of the base, as bytes, counts once it is started by a first path.
  struct State {
    double deformation = 0;
    bool is_started = false, is_ruptured = false;
    int way = 0;  // direction of the last path, 0 before the first
    Rainflow cycles{};
    alignas(std::max_align_t) std::array<std::byte, std::max({sizeof(typename M::State)...})> base{};
  };
  using Branch = State;  ///< responses are scalar
  static constexpr std::array state{
      StateValue<Modified>{{"ruptured", "", "1 if the material has ruptured, else 0"},
                           [](const State& kept) { return kept.is_ruptured ? 1.0 : 0.0; }},
      StateValue<Modified>{{"closed_damage", "", "damage of closed cycles"},
                           [](const State& kept) { return kept.cycles.damage; }}};

  /// Throws std::invalid_argument for a value out of range.
  void check() const {
    std::visit([](const auto& law) { law.check(); }, base);
    if (!std::isfinite(initial_strain)) laws::refuse("initial_strain", initial_strain, "finite");
    if (min && !(*min < 0)) laws::refuse("min", *min, "negative");
    if (max && !(*max > 0)) laws::refuse("max", *max, "positive");
    if (fatigue) fatigue->check();
  }
  /// Modulus of the base [Pa].
  double stiffness() const noexcept {
    return std::visit([](const auto& law) { return law.stiffness(); }, base);
  }
  /// Yield strain of the base [-].
  double yield_deformation() const noexcept {
    return std::visit([](const auto& law) { return law.yield_deformation(); }, base);
  }
  /// True if the base does.
  bool forgets_small_reversals() const noexcept {
    return std::visit([]<class L>(const L&) { return bool(L::forgets_small_reversals); }, base);
  }

  Branch branch(const State& kept) const noexcept { return kept; }
  Answer respond(const State& kept, double strain) const noexcept {
    if (ruptures_before(kept, strain)) return {};
    return with(kept, [&](const auto& law, const auto& state) { return law.respond(state, strain + initial_strain); });
  }
  State advance(const State& kept, double strain) const noexcept {
    State end = kept;
    end.deformation = strain;
    if (kept.is_ruptured || strain == kept.deformation) return end;
    end.cycles = cycles(kept, strain);
    end.way = way_to(kept, strain);
    end.is_ruptured = ruptures_before(kept, strain);
    if (end.is_ruptured) return end;
    end.is_started = true;
    with(kept, [&](const auto& law, const auto& state) {
      const auto next = law.advance(state, strain + initial_strain);
      std::memcpy(end.base.data(), &next, sizeof next);
      return 0;
    });
    return end;
  }
  double stored(const State& kept) const noexcept {
    if (kept.is_ruptured) return 0;
    return with(kept, [](const auto& law, const auto& state) { return law.stored(state); });
  }
  double work(const State& kept, double strain) const noexcept {
    if (kept.is_ruptured) return 0;
    const double end = rupture(kept, strain).value_or(strain);
    return with(kept, [&](const auto& law, const auto& state) { return law.work(state, end + initial_strain); });
  }
  std::optional<double> corner(const State& kept, double strain) const noexcept {
    if (kept.is_ruptured) return {};
    const std::optional<double> ruptures = rupture(kept, strain);
    const double end = ruptures.value_or(strain);
    const std::optional<double> of_base =
        with(kept, [&](const auto& law, const auto& state) { return law.corner(state, end + initial_strain); });
    if (of_base && hysteresis::is_strictly_between(*of_base - initial_strain, kept.deformation, end))
      return *of_base - initial_strain;
    return ruptures && hysteresis::is_strictly_between(end, kept.deformation, strain) ? ruptures : std::nullopt;
  }
  /// Damage of fatigue so far, 1 at failure; 0 without fatigue.
  double damage(const State& kept) const noexcept {
    return fatigue ? kept.cycles.damage_at(*fatigue, kept.deformation) : 0;
  }

 private:
  static int way_to(const State& kept, double strain) noexcept { return strain < kept.deformation ? -1 : 1; }
  /// Calls a function with the base and its state.
  template <class Function>
  decltype(auto) with(const State& kept, Function&& function) const noexcept {
    return std::visit(
        [&]<class L>(const L& law) {
          typename L::State state;
          if (kept.is_started)
            std::memcpy(static_cast<void*>(&state), kept.base.data(), sizeof state);
          else if (initial_strain != 0)
            state = law.advance(state, initial_strain);
          return function(law, state);
        },
        base);
  }
  /// Turning points of a path to a strain, without that strain.
  Rainflow cycles(const State& kept, double strain) const noexcept {
    Rainflow all = kept.cycles;
    if (fatigue && kept.way != 0 && way_to(kept, strain) != kept.way) all.add(*fatigue, kept.deformation);
    return all;
  }
  double stress(const State& kept, double strain) const noexcept {
    return with(kept,
                [&](const auto& law, const auto& state) { return law.respond(state, strain + initial_strain).force; });
  }
  bool ruptures_before(const State& kept, double strain) const noexcept {
    if (kept.is_ruptured) return true;
    const std::optional<double> at = rupture(kept, strain);
    return at && *at != strain;
  }
  /// First strain at which the material ruptures on the path to a strain; `nullopt` if there is none.
  std::optional<double> rupture(const State& kept, double strain) const noexcept {
    std::optional<double> first;
    if (max && strain > *max) first = *max;
    if (min && strain < *min) first = *min;
    if (!fatigue) return first;
    const Rainflow before = cycles(kept, strain);
    const auto excess = [&](double at) { return before.damage_at(*fatigue, at) - 1; };
    const double end = first.value_or(strain), at_end = excess(end);
    if (!(at_end > 0)) return first;
    const double at_begin = excess(kept.deformation);
    double failed = at_begin < 0 ? find_root(excess, kept.deformation, at_begin, end, at_end) : kept.deformation;
    // Fibres in compression still carry.
    const auto tension = [&](double at) { return stress(kept, at); };
    if (const double force = tension(failed); !(force > 0)) {
      const double last = tension(end);
      if (!(last > 0)) return first;
      failed = find_root(tension, failed, force, end, last);
    }
    return failed;
  }
};

}  // namespace pounding::materials
