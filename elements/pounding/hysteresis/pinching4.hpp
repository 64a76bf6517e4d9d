#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <pounding/hysteresis/backbone.hpp>

namespace pounding::hysteresis {

/// Present piece of `pinching4`: elastic before the first yield or reversal, on the backbone, or on one of the three
/// lines from a reversal to the target on the other side.
enum class PinchingRule : int { elastic, backbone, path };

/// State of this law. `way` is the direction of the last path, `line` the present one of the three lines, which end at
/// the points (x, f). `demand` is the largest deformation of the positive and the negative side, with damage; 0 before
/// it exceeds the first point. `used` are the damages in force, of stiffness and strength; `frozen` those of
/// stiffness, deformation and strength when the last point of the backbone was passed; `cycles` counts up to the
/// deformation `turned` at the last reversal.
struct PinchingState {
  double deformation = 0, work = 0;
  double start = 0, force = 0, slope = 0;
  PinchingRule rule = PinchingRule::elastic;
  int side = 0, way = 0, line = 0;
  double end = 0, turned = 0, cycles = 0;
  std::array<double, 3> x{}, f{}, frozen{};
  std::array<double, 2> demand{}, used{};
};

/// Backbone of four lines per side; three lines from each reversal to the target on the other side; damage of
/// stiffness, deformation and strength. The rules are those of the material Pinching4 of OpenSees, applied at exact
/// points.
///
/// From a reversal, the path leads with the stiffness k (1 - gK) to the force uForce f3 of the side that is entered,
/// to the pinching point (rDisp D, rForce f(D)), and to the target (D, f(D)), D = (1 + gD) times the largest
/// deformation, f = (1 - gF) times the backbone; f3 is the force of the third point, or of the fourth one beyond it.
/// Damages g = g1 (d/d4)^g3 + g2 q^g4, at most gLim, are those at the reversal: d is the largest deformation of both
/// sides before it, d4 that of the last points, q the dissipated energy over gE times the area of the larger backbone,
/// or the number of cycles. gK never reduces k below the secant stiffness of the side with the larger ratio.
struct Pinching4 : Backbone<Pinching4, PinchingState, 4> {
  using State = PinchingState;  ///< accepted state
  static constexpr std::string_view name = "pinching4",
                                    shape =
                                        "backbone of four lines; three lines from a reversal to (D, f(D)), through a "
                                        "pinching point";
  static constexpr std::string_view summary = "backbone of points with pinching and three kinds of damage (Pinching4)";
  static constexpr std::string_view source =
      "Lowes, Mitra & Altoontash 2003, PEER report 2003/10; material Pinching4 of OpenSees";
  static constexpr std::string_view symbols =
      "ePf [N] and ePd [m] points of the backbone, P positive and N negative side, D [m] largest deformation of the "
      "side with damage";
  static constexpr std::string_view range =
      "ePd1 = ePf1/stiffness; ePd1 < ePd2 < ePd3 < ePd4; the first line is the steepest; 0 <= rForce <= 1, -1 < rDisp "
      "<= 1, -1 < uForce < 1";
  static constexpr std::string_view beware =
      "pinches after any reversal, also before yield, unless all deformations stay below 1e-4 of the first point. Each "
      "reversal starts a new path, also that of a ripple. The rules do not conserve energy: lines to the target may "
      "return more than was stored, so the dissipated energy can fall. The backbone may fall, so equilibrium may be "
      "lost";
  /// With typical parameters.
  static constexpr double gives_back = 0.7, cycle_gives_back = 5e-5;

  double s4p = 0, e4p = 0;                                 ///< fourth point [N], [m]
  std::optional<double> s4n{}, e4n{};                      ///< of the negative side, negative [N], [m]
  double rDispP = 0, rForceP = 0, uForceP = 0;             ///< of reloading in the positive direction [-]
  std::optional<double> rDispN{}, rForceN{}, uForceN{};    ///< in the negative direction; default: as above [-]
  double gK1 = 0, gK2 = 0, gK3 = 1, gK4 = 1, gKLim = 0.9;  ///< damage of the stiffness [-]
  double gD1 = 0, gD2 = 0, gD3 = 1, gD4 = 1, gDLim = 0.9;  ///< damage of the deformation [-]
  double gF1 = 0, gF2 = 0, gF3 = 1, gF4 = 1, gFLim = 0.9;  ///< damage of the strength [-]
  double gE = 10;                                          ///< energy capacity over the area of the backbone > 0 [-]
  bool by_cycles = false;                                  ///< g2 and g4 act on cycles instead of energy
  bool is_mirrored = false;                                ///< directions exchanged by mirrored()

  static constexpr BackboneNames<4> points{{"ePf1", "ePd1", "ePf2", "ePd2", "ePf3", "ePd3", "ePf4", "ePd4"},
                                           {"eNf1", "eNd1", "eNf2", "eNd2", "eNf3", "eNd3", "eNf4", "eNd4"},
                                           {1.5e5, 0.015, 2e5, 0.04, 2.1e5, 0.08, 6e4, 0.16}};
  using P = Parameter<Pinching4>;  ///< a row of the table
  static constexpr std::array parameters{
      P{{"stiffness", "N/m", "slope of the first line, ePf1/ePd1", 1e7}, &Pinching4::initial_stiffness},
      P{points.force(0), &Pinching4::yield_force},
      P{points.force(1), &Pinching4::s2p},
      P{points.deformation(1), &Pinching4::e2p},
      P{points.force(2), &Pinching4::s3p},
      P{points.deformation(2), &Pinching4::e3p},
      P{points.force(3), &Pinching4::s4p},
      P{points.deformation(3), &Pinching4::e4p},
      P{points.negative_force(0), &Pinching4::s1n},
      P{points.negative_deformation(0), &Pinching4::e1n},
      P{points.negative_force(1), &Pinching4::s2n},
      P{points.negative_deformation(1), &Pinching4::e2n},
      P{points.negative_force(2), &Pinching4::s3n},
      P{points.negative_deformation(2), &Pinching4::e3n},
      P{points.negative_force(3), &Pinching4::s4n},
      P{points.negative_deformation(3), &Pinching4::e4n},
      P{{"rDispP", "", "deformation of the pinching point over that of the target", 0.5}, &Pinching4::rDispP},
      P{{"rForceP", "", "force of the pinching point over that of the target", 0.25}, &Pinching4::rForceP},
      P{{"uForceP", "", "force at the end of unloading over the strength", 0.05}, &Pinching4::uForceP},
      P{{"rDispN", "", "rDispP in the negative direction (default the same)", 0.5, Need::extra}, &Pinching4::rDispN},
      P{{"rForceN", "", "rForceP in the negative direction (default the same)", 0.25, Need::extra},
        &Pinching4::rForceN},
      P{{"uForceN", "", "uForceP in the negative direction (default the same)", 0.05, Need::extra},
        &Pinching4::uForceN},
      P{{"gK1", "", "damage of the stiffness at the last deformation", 0.3, Need::optional}, &Pinching4::gK1},
      P{{"gK2", "", "damage of the stiffness at the energy capacity, or after one cycle", 0.2, Need::optional},
        &Pinching4::gK2},
      P{{"gK3", "", "exponent of the deformation", 0.3, Need::optional}, &Pinching4::gK3},
      P{{"gK4", "", "exponent of the energy or of the cycles", 0.2, Need::optional}, &Pinching4::gK4},
      P{{"gKLim", "", "limit of the damage of the stiffness", 0.9, Need::optional}, &Pinching4::gKLim},
      P{{"gD1", "", "damage of the deformation at the last deformation", 0.2, Need::optional}, &Pinching4::gD1},
      P{{"gD2", "", "damage of the deformation at the energy capacity, or after one cycle", 0.2, Need::optional},
        &Pinching4::gD2},
      P{{"gD3", "", "exponent of the deformation", 0.3, Need::optional}, &Pinching4::gD3},
      P{{"gD4", "", "exponent of the energy or of the cycles", 0.3, Need::optional}, &Pinching4::gD4},
      P{{"gDLim", "", "limit of the damage of the deformation", 0.5, Need::optional}, &Pinching4::gDLim},
      P{{"gF1", "", "damage of the strength at the last deformation", 0.1, Need::optional}, &Pinching4::gF1},
      P{{"gF2", "", "damage of the strength at the energy capacity, or after one cycle", 0.1, Need::optional},
        &Pinching4::gF2},
      P{{"gF3", "", "exponent of the deformation", 0.3, Need::optional}, &Pinching4::gF3},
      P{{"gF4", "", "exponent of the energy or of the cycles", 0.3, Need::optional}, &Pinching4::gF4},
      P{{"gFLim", "", "limit of the damage of the strength", 0.5, Need::optional}, &Pinching4::gFLim},
      P{{"gE", "", "energy capacity over the area of the larger backbone", 10, Need::optional}, &Pinching4::gE}};
  static constexpr std::array<std::string_view, 2> damage_words{"energy", "cycle"};
  static constexpr std::array choices{Choice<Pinching4>{
      {"dmgType", "quantity of damage besides the deformation: energy, or cycle for the number of cycles",
       damage_words},
      [](Pinching4& law, std::size_t i) { law.by_cycles = i == 1; },
      [](const Pinching4& law) -> std::size_t { return law.by_cycles ? 1 : 0; }}};
  static constexpr std::array state{
      StateValue<Pinching4>{{"rule", "", "0 elastic, 1 backbone, 2 path after a reversal"},
                            [](const State& kept) { return static_cast<double>(kept.rule); }},
      StateValue<Pinching4>{{"stiffness_damage", "", "relative loss of unloading stiffness"},
                            [](const State& kept) { return kept.used[0]; }},
      StateValue<Pinching4>{{"strength_damage", "", "relative loss of strength"},
                            [](const State& kept) { return kept.used[1]; }}};

  void check(Use use = Use::spring) const {
    check_points(use);
    for (const int way : {1, -1}) {
      const Pinch pinch = pinch_of(way);
      const auto key = [way](std::string_view base) { return std::string(base) + (way > 0 ? "P" : "N"); };
      if (!(pinch.deformation > -1 && pinch.deformation <= 1))
        laws::refuse(key("rDisp"), pinch.deformation, "in (-1, 1]");
      if (!(pinch.force >= 0 && pinch.force <= 1)) laws::refuse(key("rForce"), pinch.force, "in [0, 1]");
      if (!(pinch.unloaded > -1 && pinch.unloaded < 1)) laws::refuse(key("uForce"), pinch.unloaded, "in (-1, 1)");
    }
    for (const Damage& d : {stiffness_damage(), deformation_damage(), strength_damage()}) {
      const std::string g = "g" + std::string(1, d.letter);
      laws::require_not_negative(g + "1", d.of_deformation);
      laws::require_not_negative(g + "2", d.of_energy);
      laws::require_positive(g + "3", d.exponent);
      laws::require_positive(g + "4", d.exponent_of_energy);
      if (d.letter == 'D')
        laws::require_not_negative(g + "Lim", d.limit);
      else if (!(d.limit >= 0 && d.limit < 1))
        laws::refuse(g + "Lim", d.limit, "in [0, 1)");
    }
    laws::require_positive("gE", gE);
  }
  /// The law with the positive and the negative direction exchanged.
  Pinching4 mirrored() const noexcept {
    Pinching4 law = Backbone::mirrored();
    const Pinch negative = pinch_of(-1);
    law.rDispN = rDispP, law.rForceN = rForceP, law.uForceN = uForceP;
    law.is_mirrored = !is_mirrored;
    law.rDispP = negative.deformation, law.rForceP = negative.force, law.uForceP = negative.unloaded;
    return law;
  }

  /// True before the first yield or reversal.
  bool is_elastic(const State& s) const noexcept { return s.rule == PinchingRule::elastic; }
  /// Deformation at the end of the present piece, or at the last point of the backbone, where damages are frozen.
  double end_of_piece(const State& s, int way) const noexcept {
    const double end = s.rule == PinchingRule::elastic ? end_of_elastic(way) : s.end, last = last_deformation();
    return way * s.deformation < last ? way * std::min(way * end, last) : end;
  }
  /// Begins a path in the direction `way`: a reversal applies damage and starts the lines to the other side.
  void turn(State& s, int way) const noexcept {
    if (way == s.way) return;
    const bool keeps = s.way == 0 || (is_elastic(s) && std::abs(s.deformation) <= 1e-4 * yield_deformation());
    if (!keeps) {
      const std::array<double, 3> now = damages(s);
      s.cycles = cycles(s);
      const double target = (1 + now[1]) * demand(s, way);
      if (s.rule != PinchingRule::path)
        s.demand[index(s.way)] = std::max(s.way * s.deformation, (1 + now[1]) * demand(s, s.way));
      s.used = {now[0], now[2]};
      go_back(s, way, target);
    } else {
      s.cycles = cycles(s);
    }
    s.turned = s.deformation;
    s.way = way;
  }
  /// Begins the piece beyond the present one.
  void arrive(State& s, int way) const noexcept {
    if (way * s.deformation == last_deformation()) s.frozen = damages_inside(s);
    const double end = s.rule == PinchingRule::elastic ? end_of_elastic(way) : s.end;
    if (way * s.deformation < way * end) return;
    if (s.rule == PinchingRule::path && s.line < 2)
      begin_line(s, s.line + 1);
    else
      enter_backbone(s, way);
  }
  /// Stiffness after a reversal here [N/m].
  double unloading_stiffness(const State& s) const noexcept {
    const bool loads = s.way * force_at(s, s.deformation) > 0;
    return side_of(s.deformation).stiffness() * (1 - (loads ? damages(s)[0] : s.used[0]));
  }

 private:
  struct Pinch {
    double deformation, force, unloaded;
  };
  struct Damage {
    char letter;
    double of_deformation, of_energy, exponent, exponent_of_energy, limit;
    double at(double deformation, double energy) const noexcept {
      return of_deformation * std::pow(deformation, exponent) + of_energy * std::pow(energy, exponent_of_energy);
    }
  };
  Damage stiffness_damage() const noexcept { return {'K', gK1, gK2, gK3, gK4, gKLim}; }
  Damage deformation_damage() const noexcept { return {'D', gD1, gD2, gD3, gD4, gDLim}; }
  Damage strength_damage() const noexcept { return {'F', gF1, gF2, gF3, gF4, gFLim}; }
  Pinch pinch_of(int way) const noexcept {
    if (way > 0) return {rDispP, rForceP, uForceP};
    return {rDispN.value_or(rDispP), rForceN.value_or(rForceP), uForceN.value_or(uForceP)};
  }

  double last_deformation() const noexcept { return std::max(side_of(1).e[3], side_of(-1).e[3]); }
  double demand(const State& s, int side) const noexcept { return std::max(s.demand[index(side)], side_of(side).e[0]); }
  double largest_demand(const State& s) const noexcept { return std::max(demand(s, 1), demand(s, -1)); }
  double cycles(const State& s) const noexcept {
    return s.cycles + std::abs(s.deformation - s.turned) / (4 * largest_demand(s));
  }
  /// Damages of stiffness, deformation and strength at this state.
  std::array<double, 3> damages(const State& s) const noexcept {
    return std::abs(s.deformation) < last_deformation() ? damages_inside(s) : s.frozen;
  }
  std::array<double, 3> damages_inside(const State& s) const noexcept {
    double secant = 0;
    for (const int way : {1, -1}) {
      const Side side = side_of(way);
      const double d = demand(s, way);
      secant = std::max(secant, (1 - s.used[1]) * side.force(d) / d / side.stiffness());
    }
    const double capacity = gE * std::max(side_of(1).area(), side_of(-1).area());
    const double force = force_at(s, s.deformation), k = side_of(s.deformation).stiffness() * (1 - s.used[0]);
    // Powers of round-off would be noise.
    const double lost = is_elastic(s) ? 0 : (s.work - 0.5 * force * force / k) / capacity - 1e-13;
    const double other = by_cycles ? cycles(s) : std::max(lost, 0.0);
    const auto limited = [&, ratio = largest_demand(s) / last_deformation()](const Damage& d) {
      return s.work < capacity ? std::min(d.at(ratio, other), d.limit) : d.limit;
    };
    return {std::min(limited(stiffness_damage()), std::max(1 - secant, 0.0)), limited(deformation_damage()),
            limited(strength_damage())};
  }

  /// Starts the lines from here to the target on the side of the direction `way`. Deformations x and forces f are
  /// measured in this direction; the points are the start, the end of unloading, the pinching point and the target.
  void go_back(State& s, int way, double target) const noexcept {
    const Side side = side_of(way);
    const Pinch pinch = pinch_of(way);
    const double left = 1 - s.used[1], stiff = 1 - s.used[0];
    const double k = side.stiffness() * stiff, start = way * s.deformation;
    const double released = start > 0 ? k : side_of(-way).stiffness() * stiff;
    std::array<double, 4> x{start, 0, 0, target}, f{way * force_at(s, s.deformation), 0, 0, left * side.force(target)};
    const auto straight = [&] {
      for (const std::size_t i : {1, 2}) {
        x[i] = x[0] + (x[3] - x[0]) * static_cast<double>(i) / 3;
        f[i] = f[0] + (f[3] - f[0]) * static_cast<double>(i) / 3;
      }
    };
    const auto halve = [&](std::size_t a, std::size_t at, std::size_t b) {
      x[at] = 0.5 * (x[a] + x[b]);
      f[at] = 0.5 * (f[a] + f[b]);
    };
    const auto slope = [&](std::size_t i) { return (f[i + 1] - f[i]) / (x[i + 1] - x[i]); };
    const bool is_far = demand(s, way) > side.e[2];
    const double unloaded = pinch.unloaded * left * (is_far ? side.s[3] : side.s[2]);
    if (start < 0) {
      x[2] = pinch.deformation * target;
      f[2] = pinch.force - pinch.unloaded > 1e-8
                 ? pinch.force * f[3]
                 : std::max(is_far ? pinch.unloaded * f[3] : unloaded, left * side.s[3]) * (1 + 1e-6);
      if (slope(2) > k) x[2] = x[3] - (f[3] - f[2]) / k;
      if (x[2] < x[0]) {
        straight();
      } else {
        f[1] = unloaded;
        x[1] = x[0] + (f[1] - f[0]) / released;
        if (x[1] < x[0])
          halve(0, 1, 2);
        else if (slope(1) > std::max(k, released))
          straight();
        else if (x[1] > x[2] || slope(1) < 0) {
          if (x[1] > 0)
            halve(0, 1, 2);
          else if (x[2] < 0)
            halve(1, 2, 3);
          else
            meet_between(x, f, slope(0), slope(2));
        }
      }
    } else {
      straight();
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (x[i + 1] < x[i] || f[i + 1] < f[i]) {
        straight();
        // As in OpenSees, through the origin if the straight line is softer than the secant of the negative end.
        const std::size_t end = (way < 0) != is_mirrored ? 3 : 0;
        if (const double chord = slope(0); chord > 1e-8 && chord < f[end] / x[end])
          x[2] = f[2] = 0, x[1] = 0.5 * x[0], f[1] = 0.5 * f[0];
        break;
      }
    for (std::size_t i = 0; i < 3; ++i) s.x[i] = way * x[i + 1], s.f[i] = way * f[i + 1];
    s.side = way;
    begin_line(s, 0);
  }
  /// Replaces the two middle points by points on their lines, at 1 % below and above their mean force.
  static void meet_between(std::array<double, 4>& x, std::array<double, 4>& f, double unloading,
                           double reloading) noexcept {
    const double mean = 0.5 * (f[1] + f[2]), half = std::abs(mean) / 100;
    f[1] = mean - half;
    f[2] = mean + half;
    x[1] = x[0] + (f[1] - f[0]) / unloading;
    x[2] = x[3] - (f[3] - f[2]) / reloading;
  }
  void begin_line(State& s, int line) const noexcept {
    const double force = line > 0 ? s.f[line - 1] : force_at(s, s.deformation), length = s.x[line] - s.deformation;
    s.rule = PinchingRule::path;
    s.line = line;
    s.slope = length != 0 ? (s.f[line] - force) / length : 0;
    s.start = s.deformation;
    s.force = force;
    s.end = s.x[line];
  }
  void enter_backbone(State& s, int way) const noexcept {
    const Side side = side_of(way);
    const double x = way * s.deformation, left = 1 - s.used[1];
    const std::size_t line = side.line(x);
    s.rule = PinchingRule::backbone;
    s.side = way;
    s.start = s.deformation;
    s.force = way * left * side.force(x, line);
    s.slope = left * side.slope(line);
    s.end = way * side.end(line);
  }
};

}  // namespace pounding::hysteresis
