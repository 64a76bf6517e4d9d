#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include <pounding/base/root.hpp>
#include <pounding/hysteresis/integral.hpp>
#include <pounding/hysteresis/law.hpp>
#include <pounding/hysteresis/table.hpp>
#include <pounding/laws/checks.hpp>

namespace pounding::hysteresis {

/// f = b k d + (1-b) k z; on each branch z = z_r + w x/(1 + x^R)^(1/R), x = (d - d_r)/w: curves between an elastic line
/// from the last reversal and the hardening line on the opposite side.
///
/// k [N/m] initial stiffness, Fy [N] yield force, b [-] hardening ratio, dy = Fy/k [m]; d_r, z_r [m] deformation and
/// its elastic part at the reversal, w = +-dy - z_r [m] from there to the intersection of the elastic line and the
/// hardening line; R = R0 [1 - c1 xi/(c2 + xi)] [-] sharpness of the transition, xi [-] distance, divided by dy, from
/// that intersection to the extreme earlier reversal on its side (dy if there is none). Menegotto & Pinto 1973;
/// Filippou, Popov & Bertero 1983, EERC 83-19, without the isotropic shift.
///
/// As published, every reversal erases the earlier history: after 4 dy, -4 dy, a reversal by 0.02 dy at -1.5 dy raises
/// the force by 0.22 Fy above the path without it. With memory "nested", a branch never rises above interrupted
/// branches of the same direction; where it meets one, the interrupted branch continues. An excursion beyond the start
/// of a branch erases it. With "last" the law is Steel02.
struct MenegottoPinto {
  static constexpr std::string_view name = "menegotto_pinto",
                                    shape = "f = b k d + (1-b) k z, z = z_r + w x/(1 + x^R)^(1/R), x = (d - d_r)/w";
  static constexpr std::string_view summary = "reinforcing steel with Bauschinger effect (Steel02)";
  static constexpr std::string_view source = "Menegotto & Pinto 1973; Filippou, Popov & Bertero 1983, EERC 83-19";
  static constexpr std::string_view symbols =
      "k [N/m] initial stiffness, Fy [N] yield force, b [-] hardening ratio, dy = Fy/k [m], d_r, z_r [m] deformation "
      "and its elastic part at the last reversal, w = +-dy - z_r [m], R = R0 [1 - c1 xi/(c2 + xi)] [-], xi [-] = "
      "|extreme reversal on the side of loading - d_r - w|/dy";
  static constexpr std::string_view range = "0 <= b < 1, R0 (1 - c1) >= 1";
  static constexpr std::string_view beware =
      "with memory last, which is Steel02, any small reversal raises the force by up to 0.25 Fy, and impacts cause "
      "many of them. An error tolerance is then met only if the steps resolve every reversal (two pounding buildings: "
      "error 1.2e-3 at tolerances 1e-3 to 1e-5, 2.5e-4 at 1e-7, converged at 1e-8). With nested, the default, small "
      "reversals do not raise the force. Ascending and descending branches differ in R, so a path can recover up to "
      "0.15 Fy dy more energy than direct unloading. Repeated cycles recover none";
  /// Upper bound on the energy that a path can recover beyond stored(), divided by Fy dy.
  static constexpr double gives_back = 0.15;

  /// Memory of the branches before a reversal: all that may continue, or none as in Steel02.
  enum class Memory { nested, last };

  double initial_stiffness = 0;  ///< k > 0 [N/m]
  double yield_force = 0;        ///< Fy > 0 [N]
  double hardening = 0;          ///< b in [0, 1) [-]
  double sharpness = 20;         ///< R0 [-]
  double rounding = 0.925;       ///< c1 in [0, 1) [-]
  double rounding_range = 0.15;  ///< c2 > 0 [-]
  Memory memory = Memory::nested;

  static constexpr std::array parameters{
      Parameter{{"stiffness", "N/m", "initial stiffness k", 1e7}, &MenegottoPinto::initial_stiffness},
      Parameter{yield_force_info, &MenegottoPinto::yield_force},
      Parameter{hardening_info("ratio b of post-yield to initial stiffness"), &MenegottoPinto::hardening},
      Parameter{{"R0", "", "sharpness of the first transition", 20, Need::optional}, &MenegottoPinto::sharpness},
      Parameter{{"cR1", "", "maximum relative reduction c1 of R0", 0.925, Need::optional}, &MenegottoPinto::rounding},
      Parameter{{"cR2", "", "plastic excursion c2, divided by dy, at half of that reduction", 0.15, Need::optional},
                &MenegottoPinto::rounding_range}};
  static constexpr std::array<std::string_view, 2> memories{"nested", "last"};
  /// Selects item i of `memories`. A function, because Clang 14 rejects an equivalent lambda here.
  static void choose_memory(MenegottoPinto& law, std::size_t i) { law.memory = static_cast<Memory>(i); }
  /// Index of the current choice.
  static std::size_t chosen_memory(const MenegottoPinto& law) { return static_cast<std::size_t>(law.memory); }
  static constexpr std::array choices{Choice<MenegottoPinto>{
      {"memory", "branches remembered at a reversal: all that may continue, or none (Steel02)", memories},
      &choose_memory,
      &chosen_memory}};

  /// A curve from a reversal: d_r, z_r - d_r, w [m], R [-].
  struct Branch {
    double start = 0, offset = 0, reach = 0, sharpness = 1;
  };
  /// Maximum number of branches per direction; beyond it, the branch of the smallest excursion is dropped.
  static constexpr int max_branches = 8;
  /// Branches of one direction, each bounded by the previous one. The last is the current branch, or the one
  /// interrupted last.
  struct Branches {
    int count = 0;
    std::array<Branch, max_branches> of{};
  };
  /// Extreme reversals in both directions [m], and branches.
  struct State {
    double deformation = 0, maximum = 0, minimum = 0;
    int way = 0;  // of the current branch: 1 up, -1 down, 0 before the first
    Branches up{}, down{};

    /// Branches of the current direction; not empty after the first loading.
    const Branches& present() const noexcept { return way < 0 ? down : up; }
    /// Current branch.
    const Branch& branch() const noexcept { return present().of[present().count - 1]; }
  };
  static constexpr std::array state{
      StateValue<MenegottoPinto>{{"turning_point", "m", "deformation d_r at the last reversal"},
                                 [](const State& kept) { return kept.way == 0 ? 0.0 : kept.branch().start; }},
      StateValue<MenegottoPinto>{
          {"knee", "m", "deformation d_r + w at the intersection of its two lines"},
          [](const State& kept) { return kept.way == 0 ? 0.0 : kept.branch().start + kept.branch().reach; }},
      StateValue<MenegottoPinto>{{"sharpness", "", "R of the current branch"},
                                 [](const State& kept) { return kept.way == 0 ? 0.0 : kept.branch().sharpness; }},
      StateValue<MenegottoPinto>{{"branches", "", "number of branches remembered"}, [](const State& kept) {
                                   return static_cast<double>(kept.up.count + kept.down.count);
                                 }}};

  void check() const {
    laws::require_positive("stiffness", initial_stiffness);
    laws::require_positive("yield_force", yield_force);
    if (!(hardening >= 0 && hardening < 1)) laws::refuse("hardening", hardening, "in [0, 1)");
    if (!(rounding >= 0 && rounding < 1)) laws::refuse("cR1", rounding, "in [0, 1)");
    laws::require_positive("cR2", rounding_range);
    if (!(std::isfinite(sharpness) && sharpness * (1 - rounding) >= 1))
      laws::refuse("R0", sharpness,
                   "at least 1/(1 - cR1) = " + laws::number_text(1 / (1 - rounding)) + ", so that R is at least 1");
  }
  double stiffness() const noexcept { return initial_stiffness; }
  double yield_deformation() const noexcept { return yield_force / initial_stiffness; }

  Answer respond(const State& kept, double d) const noexcept {
    const Point p = reached(kept, d);
    return {initial_stiffness * (d + (1 - hardening) * p.lag),
            initial_stiffness * (hardening + (1 - hardening) * p.slope)};
  }
  Answer excess(const State& kept, double d) const noexcept {
    const Point p = reached(kept, d);
    return {initial_stiffness * (1 - hardening) * p.lag, initial_stiffness * (1 - hardening) * (p.slope - 1)};
  }
  State advance(const State& kept, double d) const noexcept {
    State next = kept;
    if (turns(kept, d)) turn(next, d < kept.deformation ? -1 : 1);
    if (next.way != 0 && present(next).count > 1) present(next).count = 1 + lowest(next, d).index;
    // A reversal below the tolerance is round-off.
    if (next.way * (d - next.deformation) > 0) next.deformation = d;
    return next;
  }
  /// Energy recovered on a path back to z = 0, plus that of the spring b k.
  double stored(const State& kept) const noexcept {
    const double d = kept.deformation, z = d + at(branch(kept), d).lag;
    const double spring = 0.5 * hardening * initial_stiffness * d * d;
    if (kept.way == 0 || z == 0) return spring;
    const int way = z > 0 ? -1 : 1;
    State from = kept;
    if (from.way != way) turn(from, way);
    double given = 0, begin = d;
    for (;;) {
      const double zero = end_of_elastic(branch(from));
      const std::optional<double> met = meets(from, begin, zero);
      given -= elastic_work(branch(from), begin, met.value_or(zero));
      if (!met) break;
      begin = *met;
      go_on(from, begin);
    }
    return spring + (1 - hardening) * initial_stiffness * given;
  }
  double work(const State& kept, double d) const noexcept {
    if (d == kept.deformation) return 0;
    State from = kept;
    if (turns(kept, d)) turn(from, d < kept.deformation ? -1 : 1);
    double yielding = 0, begin = kept.deformation;
    for (;;) {
      const std::optional<double> met = meets(from, begin, d);
      yielding += elastic_work(branch(from), begin, met.value_or(d));
      if (!met) break;
      begin = *met;
      go_on(from, begin);
    }
    return initial_stiffness *
           (0.5 * hardening * (d - kept.deformation) * (d + kept.deformation) + (1 - hardening) * yielding);
  }
  /// The current branch meets an older one at an angle there.
  std::optional<double> corner(const State& kept, double d) const noexcept {
    if (d == kept.deformation) return {};
    State from = kept;
    if (turns(kept, d)) turn(from, d < kept.deformation ? -1 : 1);
    double begin = kept.deformation;
    while (const std::optional<double> met = meets(from, begin, d)) {
      const double jump = at(branch(from), *met).slope - lowest(from, *met, 1).point.slope;
      if (std::abs(jump) > 1e-9 && is_strictly_between(*met, kept.deformation, d)) return met;
      begin = *met;
      go_on(from, begin);
    }
    return {};
  }

 private:
  /// z - d, and dz/dd.
  struct Point {
    double lag = 0, slope = 1;
  };

  static Branches& present(State& s) noexcept { return s.way < 0 ? s.down : s.up; }
  static const Branch& branch(const State& s) noexcept {
    static constexpr Branch none{.reach = HUGE_VAL};
    return s.way == 0 ? none : s.branch();
  }
  static Point at(const Branch& b, double d) noexcept {
    const double way = d - b.start, x = b.reach == 0 ? HUGE_VAL : way / b.reach, R = b.sharpness;
    if (!(x > 0) && b.reach != 0) return {b.offset, 1};
    if (x <= 1) {
      const double p = std::pow(x, R);
      // Exactly elastic if the difference is below round-off.
      if (p < 1e-18) return {b.offset, 1};
      const double fall = std::expm1(-std::log1p(p) / R);
      return {b.offset + way * fall, (1 + fall) / (1 + p)};
    }
    const double p = std::pow(x, -R), part = std::exp(-std::log1p(p) / R);
    return {b.offset - way + b.reach * part, p / x * part / (1 + p)};
  }

  /// True if the direction changes; the first loading from rest counts as a change.
  bool turns(const State& kept, double d) const noexcept {
    const double back = kept.deformation - d;
    return kept.way == 0 ? back != 0 : kept.way * back > 1e-12 * yield_deformation();
  }
  Branch from_turning_point(const State& s, double start, double offset, int way) const noexcept {
    const double dy = yield_deformation(), z = start + offset;
    const double reach = way > 0 ? std::max(dy - z, 0.0) : std::min(-dy - z, 0.0);
    const double farthest = way > 0 ? std::max(s.maximum, dy) : std::min(s.minimum, -dy);
    const double xi = std::abs(farthest - start - reach) / dy;
    return {start, offset, reach, sharpness * (1 - rounding * xi / (rounding_range + xi))};
  }
  /// Reverses the direction to `way` at the current deformation.
  void turn(State& s, int way) const noexcept {
    const double d = s.deformation;
    if (s.way > 0) s.maximum = std::max(s.maximum, d);
    if (s.way < 0) s.minimum = std::min(s.minimum, d);
    const Branch next = from_turning_point(s, d, at(branch(s), d).lag, way);
    if (memory == Memory::last) s.up.count = s.down.count = 0;
    s.way = way;
    Branches& old = present(s);
    // Drops a branch that began nearer than here, and one that lies below the new branch from the start, which could
    // not bound it.
    const auto holds = [&](const Branch& b) {
      return way * (d - b.start) > 0 && rises_above(way, at(next, d), at(b, d)) <= 2e-13 * yield_deformation();
    };
    int kept = 0;
    for (int i = 0; i < old.count; ++i)
      if (holds(old.of[i])) old.of[kept++] = old.of[i];
    old.count = kept;
    if (old.count == max_branches) --old.count;
    old.of[old.count++] = next;
  }

  Point reached(const State& kept, double d) const noexcept {
    if (kept.way == 0 && d == 0) return {};
    if (!turns(kept, d)) return lowest(kept, d).point;
    State turned = kept;
    turn(turned, d < kept.deformation ? -1 : 1);
    return lowest(turned, d).point;
  }
  /// Height of a point of a branch above that of another one of its direction [m]; positive within round-off.
  double rises_above(int way, const Point& point, const Point& old) const noexcept {
    return way * (point.lag - old.lag) + 1e-13 * yield_deformation();
  }
  /// A branch of the current direction, by index, and its point at a deformation.
  struct Lowest {
    int index = 0;
    Point point{};
  };
  /// Branch of the current direction that applies at d: the current one, or an older one that it has met. Ignores the
  /// newest `newer` branches.
  Lowest lowest(const State& s, double d, int newer = 0) const noexcept {
    const Branches& all = s.present();
    Lowest lowest{0, at(all.of[0], d)};
    for (int i = 1; i < all.count - newer; ++i)
      if (const Point point = at(all.of[i], d); rises_above(s.way, point, lowest.point) < 0) lowest = {i, point};
    return lowest;
  }
  /// Ends the current branch at the deformation at which it meets an older one.
  void go_on(State& s, double d) const noexcept { present(s).count = 1 + lowest(s, d, 1).index; }
  /// Deformation at which the current branch, on the path from `begin` to d, meets an older one.
  std::optional<double> meets(const State& s, double begin, double d) const noexcept {
    if (s.present().count < 2) return {};
    const auto above = [&](double x) { return rises_above(s.way, at(branch(s), x), lowest(s, x, 1).point); };
    const double at_end = above(d);
    if (at_end < 0) return {};
    const double at_begin = above(begin);
    if (at_begin >= 0) return begin;
    return find_root(above, begin, at_begin, d, at_end);
  }

  /// Deformation at z = 0 on a branch that approaches it.
  static double end_of_elastic(const Branch& b) noexcept {
    const double part = b.reach == 0 ? 0 : -(b.start + b.offset) / b.reach;  // fraction of the reach at which z = 0
    if (!(part > 0)) return b.start;
    return b.start + b.reach * std::pow(std::pow(part, -b.sharpness) - 1, -1 / b.sharpness);
  }
  /// Integral of z along a branch [m^2].
  static double elastic_work(const Branch& b, double from, double to) noexcept {
    const double turn = b.start + b.offset, straight = turn * (to - from);
    if (b.reach == 0) return straight;
    return straight + b.reach * b.reach * curve_area((from - b.start) / b.reach, (to - b.start) / b.reach, b.sharpness);
  }
  /// Integral of x/(1 + x^R)^(1/R) between two x. On each side of the intersection it is a hypergeometric function: by
  /// Pfaff's transformation a series in u = x^R/(1 + x^R), or in 1 - u beyond it (Abramowitz & Stegun, 15.3.4).
  static double curve_area(double from, double to, double R) noexcept {
    if (R < 1.1)
      return integral([R](double x) { return x > 0 ? x * std::pow(1 + std::pow(x, R), -1 / R) : x; }, from, to, 1e-13);
    if (from <= 1 && to <= 1) return area_before_knee(to, R) - area_before_knee(from, R);
    if (from >= 1 && to >= 1) return area_beyond_knee(to, R) - area_beyond_knee(from, R);
    return curve_area(from, 1, R) + curve_area(1, to, R);
  }
  static double area_before_knee(double x, double R) noexcept {
    if (!(x > 0)) return 0.5 * x * x;
    const double p = std::pow(x, R);
    return 0.5 * x * x * std::exp(-std::log1p(p) / R) * series(1 / R, 1 + 2 / R, p / (1 + p));
  }
  /// As area_before_knee() beyond the intersection, up to a constant.
  static double area_beyond_knee(double x, double R) noexcept {
    const double p = std::pow(x, -R);
    return x * std::exp(-std::log1p(p) / R) * series(1 / R, 1 - 1 / R, p / (1 + p));
  }
  /// Hypergeometric function with parameters a, 1 and c at u in [0, 1/2].
  static double series(double a, double c, double u) noexcept {
    double sum = 1, term = 1;
    for (int n = 0; term > 1e-17 * sum; ++n) sum += term *= (a + n) / (c + n) * u;
    return sum;
  }
};

}  // namespace pounding::hysteresis
