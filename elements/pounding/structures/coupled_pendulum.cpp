#include <pounding/structures/coupled_pendulum.hpp>

#include <algorithm>
#include <cmath>

namespace pounding {

CoupledYielding::Flow CoupledPendulum::flow(const State& state, const Pair& to, double speed) const noexcept {
  const double limit = reach(speed), k0 = law_.stick();
  const double by_speed = law_.slope_of_coefficient(speed) * law_.weight / k0;  // of the limit
  // Elastic deformation at the beginning, shortened if the limit is lower than it was.
  Pair elastic{state.deformation[0] - state.plastic[0], state.deformation[1] - state.plastic[1]};
  const double before = std::hypot(elastic[0], elastic[1]);
  const bool shrinks = before > limit;
  Flow end{.plastic = state.plastic};
  if (shrinks) {
    end.lost = 0.5 * k0 * (before - limit) * (before + limit);
    for (int i = 0; i < 2; ++i) {
      const double direction = elastic[i] / before;
      end.plastic[i] += elastic[i] - limit * direction;
      end.by_speed[i] = -by_speed * direction;
      elastic[i] = limit * direction;
    }
  }
  const double dx = to[0] - state.deformation[0], dy = to[1] - state.deformation[1], way = std::hypot(dx, dy);
  if (way == 0) return end;

  // Divided by the limit, with p along the path and q across it: it reaches the circle of radius 1 at p = rim, after
  // the length `stuck`; then p = tanh, q = sech of a path length.
  const double ex = dx / way, ey = dy / way, x = way / limit;
  const double p = (ex * elastic[0] + ey * elastic[1]) / limit, q = (ex * elastic[1] - ey * elastic[0]) / limit;
  const double rim = std::sqrt(std::max(0.0, 1 - q * q)), stuck = std::max(0.0, rim - p);
  if (x <= stuck) return end;
  const double sliding = x - stuck, t = std::tanh(sliding), s = 1 / std::cosh(sliding), d = 1 + rim * t;
  const double end_p = (rim + t) / d, end_q = q * s / d;
  const Pair normal{ex * end_p - ey * end_q, ey * end_p + ex * end_q}, tangent{-normal[1], normal[0]};
  // Derivatives of the elastic deformation: along and across the path, and by the limit.
  const double along = -end_q, across = ((t * t / (1 + s) + rim * t) + s * rim * stuck) / (d * x);
  const double by_limit = end_q * (shrinks ? x : sliding);
  for (int i = 0; i < 2; ++i) {
    end.plastic[i] = to[i] - limit * normal[i];
    end.by_deformation[i] = {(i == 0) - tangent[i] * (along * ex - across * ey),
                             (i == 1) - tangent[i] * (along * ey + across * ex)};
    end.by_speed[i] = -by_speed * (normal[i] + by_limit * tangent[i]);
  }
  // The mean friction times the slip: log cosh = x + log1p(exp(-2 x)) - log 2.
  const double slip = limit * (std::log(d) + sliding + std::log1p(std::exp(-2 * sliding)) - std::log(2.0));
  end.lost += 0.5 * k0 * (limit + reach(state.speed)) * slip;
  return end;
}

}  // namespace pounding
