#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include <pounding/hysteresis/backbone.hpp>

namespace pounding::hysteresis {

/// Present piece of `hysteretic`: elastic before the first yield; unloading from a reversal and back; without force up
/// to the point at which the other side lost its force; reloading with the unloading stiffness, to the pinching point
/// and to the peak; on the backbone.
enum class HystereticRule : int { elastic, unloading, slack, climbing, to_pinch, to_peak, backbone };

/// State of this law. `side` is the sign of the force, `way` the direction of the last path, `end` the deformation at
/// which the piece ends, in the direction of its side, `crossing` the deformation at the last zero force. `peak` is D
/// of the positive and the negative side, 0 before the first path.
struct HystereticState {
  double deformation = 0, work = 0;
  double start = 0, force = 0, slope = 0;
  HystereticRule rule = HystereticRule::elastic;
  int side = 0, way = 0;
  double end = 0, crossing = 0;
  std::array<double, 2> peak{};
};

/// Backbone of three lines per side; reloading in two lines through a pinching point to the largest deformation D,
/// which grows with damage; unloading softens with D. The rules are those of the material Hysteretic of OpenSees,
/// applied at exact points.
///
/// Unloading has the slope k' = k (D/e1)^-beta, at most k. From the zero force at u, the path leads through (u + pinchX
/// (r - u), pinchY f(D)) to (D, f(D)), r = D - (1 - pinchY) f(D)/k', and is never steeper than k'. At a reversal after
/// yield, D of the side that is entered next is multiplied by 1 + damage1 (D/e1 - 1) + damage2 E/E0, with D/e1 of the
/// side of the reversal, E the work minus the recoverable energy, and E0 the area of both backbones up to their last
/// points. Where OpenSees jumps, as softened unloading may cross zero force beyond D of the other side, the force is
/// continuous here.
struct Hysteretic : Backbone<Hysteretic, HystereticState, 3> {
  using State = HystereticState;  ///< accepted state
  static constexpr std::string_view name = "hysteretic",
                                    shape = "backbone of three lines; reloading through a pinching point to (D, f(D))";
  static constexpr std::string_view summary = "backbone of points with pinching and damage (Hysteretic)";
  static constexpr std::string_view source =
      "Scott & Filippou, material Hysteretic of OpenSees; Takeda, Sozen & Nielsen 1970, J. Struct. Div. 96:2557";
  static constexpr std::string_view symbols =
      "s [N] and e [m] points of the backbone, p positive and n negative side, D [m] largest deformation of the side";
  static constexpr std::string_view range =
      "e1 < e2 < e3 in magnitude, e1p = s1p/stiffness; the first line is the steepest; 0 <= pinchX, pinchY <= 1";
  static constexpr std::string_view beware =
      "a falling backbone softens, so equilibrium may be lost. With damage, each reversal moves the target of "
      "reloading, also that of a ripple. Small inner cycles reload towards the largest deformation, not the last one";

  double pinchX = 1, pinchY = 1;    ///< in [0, 1] [-]
  double damage1 = 0, damage2 = 0;  ///< of ductility and of energy, >= 0 [-]
  double beta = 0;                  ///< exponent of the unloading stiffness >= 0 [-]

  static constexpr BackboneNames<3> points{{"s1p", "e1p", "s2p", "e2p", "s3p", "e3p"},
                                           {"s1n", "e1n", "s2n", "e2n", "s3n", "e3n"},
                                           {1.5e5, 0.015, 2e5, 0.045, 6e4, 0.15}};
  static constexpr std::array parameters{
      Parameter<Hysteretic>{{"stiffness", "N/m", "slope of the first line, s1p/e1p", 1e7},
                            &Hysteretic::initial_stiffness},
      Parameter<Hysteretic>{points.force(0), &Hysteretic::yield_force},
      Parameter<Hysteretic>{points.force(1), &Hysteretic::s2p},
      Parameter<Hysteretic>{points.deformation(1), &Hysteretic::e2p},
      Parameter<Hysteretic>{points.force(2), &Hysteretic::s3p},
      Parameter<Hysteretic>{points.deformation(2), &Hysteretic::e3p},
      Parameter<Hysteretic>{points.negative_force(0), &Hysteretic::s1n},
      Parameter<Hysteretic>{points.negative_deformation(0), &Hysteretic::e1n},
      Parameter<Hysteretic>{points.negative_force(1), &Hysteretic::s2n},
      Parameter<Hysteretic>{points.negative_deformation(1), &Hysteretic::e2n},
      Parameter<Hysteretic>{points.negative_force(2), &Hysteretic::s3n},
      Parameter<Hysteretic>{points.negative_deformation(2), &Hysteretic::e3n},
      Parameter<Hysteretic>{{"pinchX", "", "deformation ratio of the pinching point", 0.7, Need::optional},
                            &Hysteretic::pinchX},
      Parameter<Hysteretic>{
          {"pinchY", "", "force ratio of the pinching point; 1 without pinching", 0.3, Need::optional},
          &Hysteretic::pinchY},
      Parameter<Hysteretic>{
          {"damage1", "", "growth of the target deformation with the ductility", 0.01, Need::optional},
          &Hysteretic::damage1},
      Parameter<Hysteretic>{
          {"damage2", "", "growth of the target deformation with the dissipated energy", 0.02, Need::optional},
          &Hysteretic::damage2},
      Parameter<Hysteretic>{{"beta", "", "exponent of the unloading stiffness", 0.4, Need::optional},
                            &Hysteretic::beta}};
  static constexpr std::array state{
      StateValue<Hysteretic>{{"rule", "", "0 elastic, 1 unloading, 2 without force, 3 to 5 reloading, 6 backbone"},
                             [](const State& kept) { return static_cast<double>(kept.rule); }},
      StateValue<Hysteretic>{{"largest", "m", "target deformation D, 0 before a reversal"},
                             [](const State& kept) { return kept.peak[0]; }},
      StateValue<Hysteretic>{{"least", "m", "that of the negative side, negative"},
                             [](const State& kept) { return -kept.peak[1]; }}};

  void check(Use use = Use::spring) const {
    check_points(use);
    if (!(pinchX >= 0 && pinchX <= 1)) laws::refuse("pinchX", pinchX, "in [0, 1]");
    if (!(pinchY >= 0 && pinchY <= 1)) laws::refuse("pinchY", pinchY, "in [0, 1]");
    laws::require_not_negative("damage1", damage1);
    laws::require_not_negative("damage2", damage2);
    laws::require_not_negative("beta", beta);
  }

  /// True before the first yield.
  bool is_elastic(const State& s) const noexcept { return s.rule == HystereticRule::elastic; }
  /// Deformation at the end of the present piece.
  double end_of_piece(const State& s, int way) const noexcept {
    switch (s.rule) {
      case HystereticRule::elastic: return end_of_elastic(way);
      case HystereticRule::unloading: return way == s.side ? s.start : s.start - s.force / s.slope;
      default: return s.side * s.end;
    }
  }
  /// Begins a path in the direction `way`: a reversal unloads, and damages the other side after yield.
  void turn(State& s, int way) const noexcept {
    if (way == s.way) return;
    if (s.way != 0) {
      const double force = force_at(s, s.deformation);
      double& before = s.peak[index(s.way)];
      double& ahead = s.peak[index(way)];
      before = peak_of(s, s.way);
      if (s.way * force >= 0) ahead *= 1 + damage(s, force);
      // Repeated damage grows without limit; reloading has no force long before this bound.
      ahead = std::clamp(ahead, side_of(way).e[0], 1e9 * side_of(way).e[2]);
      if (s.rule > HystereticRule::unloading) {
        if (force == 0)
          cross(s, way);
        else
          begin(s, HystereticRule::unloading, s.side * s.deformation, s.side * force, unloading_stiffness(s), 0);
      }
    }
    s.way = way;
  }
  /// Begins the piece beyond the present one.
  void arrive(State& s, int way) const noexcept {
    switch (s.rule) {
      case HystereticRule::elastic: s.side = way; return enter_backbone(s, way * s.deformation);
      case HystereticRule::unloading: return way == s.side ? load(s, way * s.start, way * s.force) : cross(s, way);
      case HystereticRule::slack: return load(s, s.end, 0);
      case HystereticRule::climbing: return follow(s, s.end, s.side * force_at(s, s.deformation));
      case HystereticRule::to_pinch: return follow(s, s.end, pinchY * peak_force(s));
      case HystereticRule::to_peak:
      case HystereticRule::backbone: return enter_backbone(s, s.end);
    }
  }
  /// Stiffness after a reversal here [N/m].
  double unloading_stiffness(const State& s) const noexcept {
    return s.rule == HystereticRule::unloading ? s.slope : softened(side_of(s.side), peak_of(s, s.side));
  }

 private:
  /// Deformations x and forces f of a side are measured in its direction.
  static void begin(State& s, HystereticRule rule, double x, double f, double slope, double end) noexcept {
    s.rule = rule;
    s.start = s.side * x;
    s.force = s.side * f;
    s.slope = slope;
    s.end = end;
  }
  /// D of a side, with the present deformation on the backbone.
  double peak_of(const State& s, int side) const noexcept {
    const double kept = s.peak[index(side)];
    const bool is_on_it = s.rule == HystereticRule::elastic || (s.rule == HystereticRule::backbone && s.side == side);
    return is_on_it ? std::max(kept, side * s.deformation) : kept;
  }
  double peak_force(const State& s) const noexcept { return side_of(s.side).force(s.peak[index(s.side)]); }
  double softened(const Side& side, double peak) const noexcept {
    return side.stiffness() * (peak > side.e[0] ? std::pow(peak / side.e[0], -beta) : 1);
  }
  /// Relative growth of D of the other side after a reversal at this force.
  double damage(const State& s, double force) const noexcept {
    const Side side = side_of(s.way);
    const double peak = s.peak[index(s.way)];
    if (!(peak > side.e[0])) return 0;
    const double energy = s.work - 0.5 * force * force / softened(side, peak);
    return damage1 * (peak / side.e[0] - 1) + damage2 * energy / (side_of(1).area() + side_of(-1).area());
  }
  /// Zero force: the side of the direction is entered, without force while the other side has lost its own.
  void cross(State& s, int way) const noexcept {
    s.side = way;
    s.crossing = s.deformation;
    const double x = way * s.deformation, free = way * origin(s);
    free > x ? begin(s, HystereticRule::slack, x, 0, 0, free) : load(s, x, 0);
  }
  /// Deformation at which reloading begins: at the last zero force, but not where the backbone of the other side is
  /// without force.
  double origin(const State& s) const noexcept {
    const Side other = side_of(-s.side);
    const auto lost = std::ranges::find(other.s, 0.0);
    if (lost == other.s.end()) return s.crossing;
    return s.side * std::max(s.side * s.crossing, -other.e[static_cast<std::size_t>(lost - other.s.begin())]);
  }
  /// Deformation of the pinching point.
  double pinch(const State& s) const noexcept {
    const double from = s.side * origin(s), peak = s.peak[index(s.side)];
    const double released = peak - (1 - pinchY) * peak_force(s) / softened(side_of(s.side), peak);
    return from + pinchX * (released - from);
  }
  /// Loads from (x, f) with the unloading stiffness until it meets the lines to the peak, or the backbone beyond it.
  void load(State& s, double x, double f) const noexcept {
    const Side side = side_of(s.side);
    const double peak = s.peak[index(s.side)], top = side.force(peak), k = softened(side, peak);
    if (x < peak) {
      const double from = s.side * origin(s), knee = pinch(s), low = pinchY * top;
      // Climbs to the line from (a, fa) to (b, fb), if it is met before b.
      const auto meets = [&](double a, double fa, double b, double fb) {
        const double at = std::max(a, x);
        if (!(b > at)) return false;
        const double slope = (fb - fa) / (b - a), above = fa + slope * (at - a) - f - k * (at - x);
        if (above >= -1e-12 * yield_force && !(fb - f < k * (b - x))) return false;
        const double end = above > 0 ? std::min(at + above / (k - slope), b) : at;
        end > x ? begin(s, HystereticRule::climbing, x, f, k, end) : follow(s, x, f);
        return true;
      };
      if (meets(from, 0, knee, low) || meets(knee, low, peak, top)) return;
    }
    if (x >= peak && side.force(x) - f <= 1e-12 * yield_force) return enter_backbone(s, x);
    for (std::size_t i = side.line(std::max(x, peak)); i <= 3; ++i) {
      const double end = x + (side.force(x, i) - f) / (k - side.slope(i));
      if (k > side.slope(i) && end <= side.end(i))
        return begin(s, HystereticRule::climbing, x, f, k, std::max(end, peak));
    }
    begin(s, HystereticRule::climbing, x, f, k, HUGE_VAL);
  }
  /// Continues on the lines to the peak, or on the backbone beyond it.
  void follow(State& s, double x, double f) const noexcept {
    const double peak = s.peak[index(s.side)], top = peak_force(s), knee = pinch(s);
    if (x < knee) return begin(s, HystereticRule::to_pinch, x, f, (pinchY * top - f) / (knee - x), knee);
    if (x < peak) return begin(s, HystereticRule::to_peak, x, f, (top - f) / (peak - x), peak);
    enter_backbone(s, x);
  }
  void enter_backbone(State& s, double x) const noexcept {
    const Side side = side_of(s.side);
    const std::size_t line = side.line(x);
    begin(s, HystereticRule::backbone, x, side.force(x, line), side.slope(line), side.end(line));
  }
};

}  // namespace pounding::hysteresis
