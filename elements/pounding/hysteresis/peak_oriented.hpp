#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// Backbone of two or three lines; unloading with k_u, and reloading from zero force towards the extreme earlier
/// deformation on that side.
///
/// k [N/m] initial stiffness, Fy [N] yield force at dy = Fy/k, b [-] ratio of post-yield to initial stiffness. With a
/// cracking force Fc < Fy, the second line leads from Fc to Fy at a given dy. D [m] is the maximum deformation on a
/// side, at least that of the first corner (dc, Fc). k_u = (Fc + Fy)/(dc + dy) (dy/D)^e after yield, [Fc + f(D)]/(dc +
/// D) between cracking and yield, and never below f(D)/D. e = 0: Clough & Johnston 1966; e = 0.5: Takeda, Sozen &
/// Nielsen 1970, J. Struct. Div. 96:2557, simplified by Otani 1974.
///
/// After a reversal below an inner peak, the path leads straight to the earlier peak, as in the Hysteretic material of
/// OpenSees. A line towards the earlier peak is never steeper than k_u of its side; it then meets the backbone further
/// out, so the force is continuous.
struct PeakOriented {
  static constexpr std::string_view
      name = "peak_oriented",
      shape = "f towards (D, f(D)) on loading, k_u = k (dy/D)^e on unloading, backbone beyond D";
  static constexpr std::string_view summary =
      "reinforced concrete with stiffness degradation: Clough, Takeda (Hysteretic)";
  static constexpr std::string_view source =
      "Clough & Johnston 1966; Takeda, Sozen & Nielsen 1970, J. Struct. Div. 96:2557; Otani 1974";
  static constexpr std::string_view symbols =
      "k [N/m] initial stiffness, Fy [N] yield force, dy [m] yield deformation, D [m] maximum deformation on the side, "
      "e [-] unloading exponent, b [-] hardening ratio, Fc [N] cracking force";
  static constexpr std::string_view range =
      "0 <= b < 1, 0 <= e <= 1; Fc < Fy, and dy such that each line is flatter than the previous one";
  static constexpr std::string_view beware =
      "corners at every zero of the force and every earlier peak. Pinching and strength degradation are not modelled. "
      "Small inner cycles reload towards the maximum peak, not the last one";

  double initial_stiffness = 0;                  ///< k > 0 [N/m]
  double yield_force = 0;                        ///< Fy > 0 [N]
  double hardening = 0;                          ///< b in [0, 1) [-]
  double unloading = 0.5;                        ///< e in [0, 1] [-]
  std::optional<double> cracking_force{};        ///< Fc in (0, Fy) [N], together with
  std::optional<double> deformation_at_yield{};  ///< dy > Fy/k [m]

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "initial stiffness k", 1e7}, &PeakOriented::initial_stiffness},
      Parameter{yield_force_info, &PeakOriented::yield_force},
      Parameter{hardening_info("ratio b of post-yield to initial stiffness"), &PeakOriented::hardening},
      Parameter{{"unloading", "", "exponent e of the unloading stiffness", 0.5, Need::optional},
                &PeakOriented::unloading},
      Parameter{{.name = "cracking_force",
                 .unit = "N",
                 .meaning = "cracking force Fc, given together with the deformation at the yield force",
                 .typical = 5e4,
                 .need = Need::extra,
                 .at_hinge = "cracking_moment"},
                &PeakOriented::cracking_force},
      Parameter{{.name = "yield_deformation",
                 .unit = "m",
                 .meaning = "deformation at the yield force, given together with the cracking force",
                 .typical = 0.03,
                 .need = Need::extra,
                 .at_hinge = "yield_rotation"},
                &PeakOriented::deformation_at_yield}};

  /// Current rule: the first line, the backbone beyond it, unloading from a reversal, reloading towards the maximum
  /// deformation.
  enum class Rule : int { elastic, backbone, unloading, reloading };
  /// `start`, `force`, `slope`: line of the last two rules. `side` is the sign of the force. The array contains D in
  /// the positive and negative direction, 0 before cracking.
  struct State {
    double deformation = 0;
    Rule rule = Rule::elastic;
    int side = 0;
    double start = 0, force = 0, slope = 0;
    double maximum[2] = {0, 0};
  };
  static constexpr std::array state{
      StateValue<PeakOriented>{{"rule", "", "0 elastic, 1 backbone, 2 unloading, 3 reloading"},
                               [](const State& kept) { return static_cast<double>(kept.rule); }},
      StateValue<PeakOriented>{{"largest", "m", "maximum deformation, 0 before the first corner"},
                               [](const State& kept) { return kept.maximum[0]; }},
      StateValue<PeakOriented>{{"least", "m", "minimum deformation, negative"},
                               [](const State& kept) { return -kept.maximum[1]; }}};

  /// Messages contain the names of parameters in this use.
  void check(Use use = Use::spring) const {
    const auto name = [use](std::size_t row) { return std::string(name_at(use, parameters[row].info)); };
    const std::string yields = name(1), hardens = name(2), cracks = name(4), yields_at = name(5);
    laws::require_positive("stiffness", initial_stiffness);
    laws::require_positive(yields, yield_force);
    if (!(hardening >= 0 && hardening < 1)) laws::refuse(hardens, hardening, "in [0, 1)");
    if (!(unloading >= 0 && unloading <= 1)) laws::refuse("unloading", unloading, "in [0, 1]");
    if (cracking_force.has_value() != deformation_at_yield.has_value())
      throw std::invalid_argument("peak_oriented needs both " + cracks + " and " + yields_at + ", or neither");
    if (!cracking_force) return;
    laws::require_positive(cracks, cracking_force);
    laws::require_positive(yields_at, deformation_at_yield);
    if (*cracking_force >= yield_force)
      laws::refuse(cracks, *cracking_force, "below " + yields + ", " + laws::number_text(yield_force));
    const double slope = second_slope();
    if (!(slope < initial_stiffness) || !(slope > 0))
      laws::refuse(yields_at, *deformation_at_yield,
                   "above " + yields + "/stiffness, " + laws::number_text(yield_force / initial_stiffness));
    if (hardening * initial_stiffness >= slope)
      laws::refuse(hardens, hardening,
                   "below that of the line before yield, " + laws::number_text(slope / initial_stiffness));
  }
  double stiffness() const noexcept { return initial_stiffness; }
  double yield_deformation() const noexcept { return deformation_at_yield.value_or(yield_force / initial_stiffness); }

  Answer respond(const State& kept, double d) const noexcept {
    const State end = moved(kept, d);
    return {force_at(end, d), slope_at(end)};
  }
  Answer excess(const State& kept, double d) const noexcept {
    const State end = moved(kept, d);
    if (end.rule == Rule::elastic) return {0, 0};
    return {force_at(end, d) - initial_stiffness * d, slope_at(end) - initial_stiffness};
  }
  State advance(const State& kept, double d) const noexcept { return moved(kept, d); }
  /// Energy recovered by unloading to zero force.
  double stored(const State& kept) const noexcept {
    const double f = force_at(kept, kept.deformation);
    return f == 0 ? 0 : 0.5 * f * f / unloading_slope(kept);
  }
  double work(const State& kept, double d) const noexcept {
    double sum = 0;
    walk(kept, d, [&sum, this](const State& from, double to) {
      sum += 0.5 * (force_at(from, from.deformation) + force_at(from, to)) * (to - from.deformation);
      return true;
    });
    return sum;
  }
  std::optional<double> corner(const State& kept, double d) const noexcept {
    std::optional<double> found;
    double slope = 0;
    walk(kept, d, [&](State piece, double to) {
      const double from = std::exchange(piece.deformation, to);
      const bool jumps = is_strictly_between(from, kept.deformation, d) && slope_at(piece) != slope;
      slope = slope_at(piece);
      if (jumps) found = from;
      return !jumps;
    });
    return found;
  }

 private:
  // Deformations of a side are measured in the direction of its sign: a = side d.

  double first_force() const noexcept { return cracking_force.value_or(yield_force); }
  double first_break() const noexcept { return first_force() / initial_stiffness; }
  double second_slope() const noexcept { return (yield_force - first_force()) / (yield_deformation() - first_break()); }
  double backbone(double a) const noexcept {
    const double dy = yield_deformation();
    if (a >= dy) return yield_force + hardening * initial_stiffness * (a - dy);
    return a <= first_break() ? initial_stiffness * a : first_force() + second_slope() * (a - first_break());
  }
  static int index(int side) noexcept { return side > 0 ? 0 : 1; }
  double largest(const State& s, int side) const noexcept { return std::max(s.maximum[index(side)], first_break()); }

  double force_at(const State& s, double d) const noexcept {
    if (s.rule == Rule::elastic) return initial_stiffness * d;
    return s.rule == Rule::backbone ? s.side * backbone(s.side * d) : s.force + s.slope * (d - s.start);
  }
  /// Slope on the path that ends here.
  double slope_at(const State& s) const noexcept {
    if (s.rule == Rule::elastic) return initial_stiffness;
    if (s.rule != Rule::backbone) return s.slope;
    const double a = s.side * s.deformation;
    return a > yield_deformation() || !deformation_at_yield ? hardening * initial_stiffness : second_slope();
  }
  double unloading_slope(double largest) const noexcept {
    const double dc = first_break(), dy = yield_deformation();
    const double slope = largest >= dy ? (first_force() + yield_force) / (dc + dy) * std::pow(dy / largest, unloading)
                                       : (first_force() + backbone(largest)) / (dc + largest);
    return std::max(slope, backbone(largest) / largest);
  }
  double unloading_slope(const State& s) const noexcept {
    if (s.rule == Rule::elastic) return initial_stiffness;
    return s.rule == Rule::unloading ? s.slope : unloading_slope(largest(s, s.side));
  }

  /// True if the unloading began on the backbone.
  bool is_on_backbone(const State& s) const noexcept {
    const double a = s.side * s.start;
    return a >= largest(s, s.side) && s.side * s.force >= backbone(a) - 1e-12 * yield_force;
  }
  /// Starts the line from here towards the maximum deformation of a side.
  State reloaded(State s, int side, double force) const noexcept {
    const double a = side * s.deformation, f = side * force, target = largest(s, side), limit = unloading_slope(target);
    const double slope = target > a ? (backbone(target) - f) / (target - a) : limit;
    s.rule = Rule::reloading;
    s.side = side;
    s.start = s.deformation;
    s.force = force;
    s.slope = slope > 0 ? std::min(slope, limit) : limit;
    return s;
  }
  /// Intersection of that line with the backbone [m], as a deformation of the side.
  double end_of_reloading(const State& s) const noexcept {
    const double a = s.side * s.start, f = s.side * s.force, target = largest(s, s.side);
    const double miss = f + s.slope * (target - a) - backbone(target);
    if (!(miss < -1e-12 * yield_force)) return target;
    // The line passes below its target; beyond it the backbone is flatter still.
    const double dy = yield_deformation();
    if (target < dy) {
      const double meets = target - miss / (s.slope - second_slope());
      if (meets <= dy) return meets;
      return dy + (yield_force - f - s.slope * (dy - a)) / (s.slope - hardening * initial_stiffness);
    }
    return target - miss / (s.slope - hardening * initial_stiffness);
  }

  /// State at the start of a path: a reversal changes the rule.
  State begun(State s, int way) const noexcept {
    if (s.rule == Rule::elastic || s.rule == Rule::unloading || way == s.side) return s;
    const double force = force_at(s, s.deformation);
    if (s.rule == Rule::backbone) s.maximum[index(s.side)] = std::max(s.maximum[index(s.side)], s.side * s.deformation);
    s.slope = unloading_slope(largest(s, s.side));
    s.rule = Rule::unloading;
    s.start = s.deformation;
    s.force = force;
    return s;
  }
  /// End of the rule on an unbounded path; infinite if there is none.
  double end_of_rule(const State& s, int way) const noexcept {
    const double never = way * HUGE_VAL;
    switch (s.rule) {
      case Rule::elastic: return way * first_break();
      case Rule::backbone:
        return s.side * s.deformation < yield_deformation() && deformation_at_yield ? s.side * yield_deformation()
                                                                                    : never;
      case Rule::unloading: return way == s.side ? s.start : s.start - s.force / s.slope;
      case Rule::reloading: return s.side * end_of_reloading(s);
    }
    return never;
  }
  /// The rule that follows there.
  State next_rule(State s, int way) const noexcept {
    switch (s.rule) {
      case Rule::elastic:
        s.rule = Rule::backbone;
        s.side = way;
        break;
      case Rule::backbone: break;  // second line of the backbone
      case Rule::unloading:
        if (way != s.side) return reloaded(s, way, 0);
        if (!is_on_backbone(s)) return reloaded(s, s.side, s.force);
        s.rule = Rule::backbone;
        break;
      case Rule::reloading: s.rule = Rule::backbone; break;
    }
    return s;
  }
  /// Calls visit(state at the start, end) for every straight piece of the path, until it returns false.
  template <class Visit>
  void walk(const State& kept, double d, Visit&& visit) const noexcept {
    if (d == kept.deformation) return;
    const int way = d < kept.deformation ? -1 : 1;
    State s = begun(kept, way);
    // The maximum number of pieces is five: unloading, reloading and three lines of the backbone.
    for (int piece = 0; piece < 8; ++piece) {
      const double end = end_of_rule(s, way);
      if (!(way * (d - end) > 0)) {
        visit(s, d);
        return;
      }
      if (way * (end - s.deformation) > 0) {
        if (!visit(s, end)) return;
        s.deformation = end;
      }
      s = next_rule(s, way);
    }
  }
  State moved(const State& kept, double d) const noexcept {
    State end = kept;
    walk(kept, d, [&](const State& s, double) {
      end = s;
      return true;
    });
    end.deformation = d;
    if (end.rule == Rule::backbone) end.maximum[index(end.side)] = std::max(end.maximum[index(end.side)], end.side * d);
    return end;
  }
};

}  // namespace pounding::hysteresis
