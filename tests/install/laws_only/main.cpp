// A separate code with our laws: semi-implicit Euler, one ball on a wall.
#include <pounding/laws.hpp>

#include <cmath>
#include <cstdio>

int main() {
  const pounding::laws::HertzDamped law{.stiffness = 2.75e9, .restitution = 0.65};
  law.check();
  const double mass = 6e4, dt = 1e-7;
  double d = 0, v = 1;
  pounding::laws::Impact impact = pounding::laws::touch(law, v);
  do {
    v -= dt * law.respond(d, v, impact).force / mass;
    d += dt * v;
    pounding::laws::keep(law, d, v, impact);
  } while (d > 0);
  std::printf("restitution %.5f\n", -v);
  return std::abs(-v - 0.65) < 1e-4 ? 0 : 1;
}
