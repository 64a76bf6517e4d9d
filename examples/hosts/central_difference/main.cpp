// Two oscillators of examples/02 in a separate central-difference code, with a contact law from the headers.
//   two_oscillators [STEPS]     prints the peak displacements [m], the peak force [N] and the number of impacts
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

#include <pounding/laws.hpp>

namespace laws = pounding::laws;
using std::numbers::pi;

struct Oscillator {
  double mass, stiffness, damping;       // [kg], [N/m], [N s/m]
  double u = 0, v = 0, a = 0, peak = 0;  // u and a at t, v half a step later

  Oscillator(double m, double period, double ratio)
      : mass(m), stiffness(m * std::pow(2 * pi / period, 2)), damping(2 * ratio * std::sqrt(stiffness * m)) {}
  double velocity(double h) const { return v + 0.5 * h * a; }  // at t, from the half step before; an error of order two
};

int main(int count, char** words) {
  const int steps = count > 1 ? std::atoi(words[1]) : 300000;
  if (steps < 1) return std::fputs("STEPS must be a positive number\n", stderr), 2;
  const double gap = 0.02, duration = 3, h = duration / steps;
  Oscillator left(1e5, 0.8, 0.05), right(1.5e5, 0.4, 0.05);

  const laws::Jankowski law{.stiffness = 2.75e9, .restitution = 0.65, .reduced_mass = 6e4};
  law.check();
  laws::Impact impact;
  bool touching = false;
  int impacts = 0;
  double peak_force = 0;

  for (int n = 0; n < steps; ++n) {
    const double ground = 3 * std::sin(2 * pi / 0.6 * n * h);
    const double penetration = left.u - right.u - gap, rate = left.velocity(h) - right.velocity(h);

    // An impact begins once, is kept at every step while it lasts, and ends.
    if (penetration > 0 && !touching) {
      impact = laws::touch(law, std::max(rate, 0.0));
      ++impacts;
    }
    touching = penetration > 0;
    double force = 0;
    if (touching) {
      laws::keep(law, penetration, rate, impact);
      force = law.respond(penetration, rate, impact).force;
    }
    peak_force = std::max(peak_force, force);

    const auto advance = [&](Oscillator& o, double pushed) {
      o.a = (pushed - o.damping * o.velocity(h) - o.stiffness * o.u) / o.mass - ground;
      o.v += (n == 0 ? 0.5 : 1) * h * o.a;
      o.u += h * o.v;
      o.peak = std::max(o.peak, std::abs(o.u));
    };
    advance(left, -force);
    advance(right, force);
  }
  std::printf("%.9f %.9f %.3f %d\n", left.peak, right.peak, peak_force, impacts);
}
