#include <pounding/structures/coupled_bouc_wen.hpp>

#include <algorithm>
#include <cmath>

#include <pounding/base/runge_kutta.hpp>

namespace pounding {
namespace {

/// z/dy on a straight path: p along the path, q across it. With the length x of the path divided by dy,
/// p' = 1 - c p^2 r^(n-2), q' = -c p q r^(n-2), r^2 = p^2 + q^2, where c = 1 in loading (p > 0) and 2g - 1 in
/// unloading.
class BoucWenPath {
 public:
  BoucWenPath(double exponent, double unloading, double p, double q) noexcept
      : n_(exponent), unloading_(unloading), v_{.p = p, .q = q} {}

  void follow(double length) noexcept {
    double left = length;
    if (v_.p < 0) {
      left -= unload(length);
      if (!(left > 0)) return;
      v_.p = 0;
    }
    // A longer path does not change z.
    constexpr double saturated = 50;
    advance(std::min(left, saturated), 1);
    v_.lost += std::max(0.0, left - saturated);
  }

  double p() const noexcept { return v_.p; }
  double q() const noexcept { return v_.q; }
  /// Derivatives of p and q by the angle of the path, at constant length.
  double turned_p() const noexcept { return v_.turned_p; }
  double turned_q() const noexcept { return v_.turned_q; }
  /// Integral of c p r^n, divided by (1-a) k dy^2.
  double lost() const noexcept { return v_.lost; }
  /// Derivatives of p and q by the length of the path.
  std::array<double, 2> slope() const noexcept {
    const Values rate = rates(v_, v_.p < 0 ? unloading_ : 1);
    return {rate[0], rate[1]};
  }

 private:
  using Values = std::array<double, 5>;
  struct Point {
    double p = 0, q = 0, turned_p = 0, turned_q = 0, lost = 0;
    Values values() const noexcept { return {p, q, turned_p, turned_q, lost}; }
  };
  static constexpr double first_step = 0.1, accuracy = 1e-9;

  bool is_closed(double c) const noexcept { return n_ == 2 || c == 0; }

  /// Advances until p = 0, but at most by this length, and returns the length of the path.
  double unload(double length) noexcept {
    if (is_closed(unloading_)) {
      const double root = std::sqrt(-unloading_);
      const double x = std::min(length, root > 0 ? std::atan(-root * v_.p) / root : -v_.p);
      advance(x, unloading_);
      return x;
    }
    // With p as the variable. p' >= 1, so a shorter path than -p may end before.
    std::array<double, 6> to_zero{v_.p, v_.q, v_.turned_p, v_.turned_q, v_.lost, 0};
    const auto by_p = [&](const std::array<double, 6>& v) {
      const Values rate = rates({v[0], v[1], v[2], v[3], v[4]}, unloading_);
      return std::array<double, 6>{
          1, rate[1] / rate[0], rate[2] / rate[0], rate[3] / rate[0], rate[4] / rate[0], 1 / rate[0]};
    };
    runge_kutta(by_p, to_zero, -v_.p, first_step, accuracy);
    if (to_zero[5] < length) {
      v_ = {0, to_zero[1], to_zero[2], to_zero[3], to_zero[4]};
      return to_zero[5];
    }
    advance(length, unloading_);
    return length;
  }

  void advance(double x, double c) noexcept {
    if (is_closed(c)) {
      advance_closed(x, c);
      return;
    }
    Values v = v_.values();
    runge_kutta([&](const Values& at) { return rates({at[0], at[1], at[2], at[3], at[4]}, c); }, v, x, first_step,
                accuracy);
    v_ = {v[0], v[1], v[2], v[3], v[4]};
  }

  /// For n = 2 or c = 0, without cancellation for a short path.
  void advance_closed(double x, double c) noexcept {
    const double root = std::sqrt(std::abs(c)), half = std::sin(0.5 * root * x);
    const double t = c > 0 ? std::tanh(x) : c < 0 ? std::tan(root * x) / root : x;
    const double log_s = c > 0 ? std::log(2.0) - x - std::log1p(std::exp(-2 * x)) : -std::log1p(-2 * half * half);
    const double s = std::exp(log_s);  // s^2 = 1 - c t^2
    const double d = 1 + c * v_.p * t;
    const Point from = v_;
    v_.p = (from.p + t) / d;
    v_.q = from.q * s / d;
    v_.turned_p = s * (s * from.turned_p - from.q * c * t * (t / (1 + s) + from.p)) / (d * d);
    v_.turned_q = (s * from.turned_q + t * (from.p * c * t / (1 + s) + 1)) / d -
                  c * from.q * s * t * (from.turned_p + from.q) / (d * d);
    // Work of z minus the increase of its energy.
    if (c != 0)
      v_.lost += (std::log1p(c * from.p * t) - log_s) / c -
                 0.5 * ((v_.p - from.p) * (v_.p + from.p) + (v_.q - from.q) * (v_.q + from.q));
  }

  /// Derivatives by x.
  Values rates(const Point& v, double c) const noexcept {
    const double p = v.p, q = v.q, r2 = p * p + q * q;
    if (r2 == 0) return {1, 0, 0, 1, 0};
    const double m = c * (n_ == 2 ? 1 : std::pow(r2, 0.5 * n_ - 1)), bend = (n_ - 2) / r2;
    return {1 - m * p * p, -m * p * q, -m * p * ((2 + bend * p * p) * v.turned_p + (bend * p * v.turned_q + 1) * q),
            1 - m * (q * q + q * (1 + bend * p * p) * v.turned_p + p * (1 + bend * q * q) * v.turned_q), m * p * r2};
  }

  double n_, unloading_;
  Point v_;
};

}  // namespace

CoupledYielding::Flow CoupledBoucWen::flow(const State& state, const Pair& to, double) const noexcept {
  const double x = to[0] - state.deformation[0], y = to[1] - state.deformation[1], way = std::hypot(x, y);
  if (way == 0) return {.plastic = state.plastic};
  const double dy = law_.yield_deformation(), ex = x / way, ey = y / way;
  const double zx = (state.deformation[0] - state.plastic[0]) / dy, zy = (state.deformation[1] - state.plastic[1]) / dy;
  BoucWenPath path(law_.exponent, 2 * law_.gamma_share - 1, ex * zx + ey * zy, ex * zy - ey * zx);
  path.follow(way / dy);
  Flow end{.lost = lost_stiffness(0) * dy * dy * path.lost()};
  const double pz = dy * path.p(), qz = dy * path.q();
  end.plastic = {to[0] - ex * pz + ey * qz, to[1] - ey * pz - ex * qz};
  // Derivatives of z by a displacement along and across the path.
  const auto [pp, qp] = path.slope();
  const double pq = path.turned_p() * dy / way, qq = path.turned_q() * dy / way;
  const Pair along{ex * pp - ey * qp, ey * pp + ex * qp}, across{ex * pq - ey * qq, ey * pq + ex * qq};
  for (int i = 0; i < 2; ++i)
    end.by_deformation[i] = {(i == 0) - along[i] * ex + across[i] * ey, (i == 1) - along[i] * ey - across[i] * ex};
  return end;
}

}  // namespace pounding
