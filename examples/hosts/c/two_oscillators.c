/* Two oscillators of examples/02 in C: fourth-order Runge-Kutta steps, and each touch located by cutting the step.
 *   two_oscillators [STEPS [LAW]]   prints the peak displacements [m], the peak force [N] and the number of impacts */
#include <math.h>
#include <pounding.h>
#include <stdio.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846, gap = 0.02, mass[2] = {1e5, 1.5e5}, period[2] = {0.8, 0.4},
                    ratio = 0.05;

typedef struct {
  double u[2], v[2]; /* [m], [m/s] */
} state;

static void stop(int status) {
  if (status == PND_OK) return;
  fprintf(stderr, "%s\n", pnd_error_text());
  exit(2);
}

static double penetration(const state* s) { return s->u[0] - s->u[1] - gap; }
static double rate(const state* s) { return s->v[0] - s->v[1]; }

static double force(const pnd_law* law, const pnd_contact* contact, const state* s) {
  pnd_response r;
  stop(pnd_respond(law, contact, penetration(s), rate(s), &r));
  return r.force;
}

static state slope(const pnd_law* law, const pnd_contact* contact, double t, const state* s) {
  const double ground = 3 * sin(2 * pi * t / 0.6), f = force(law, contact, s);
  state d;
  for (int i = 0; i < 2; ++i) {
    const double w = 2 * pi / period[i];
    d.u[i] = s->v[i];
    d.v[i] = -ground - 2 * ratio * w * s->v[i] - w * w * s->u[i] + (i == 0 ? -f : f) / mass[i];
  }
  return d;
}

static state moved(state s, double h, const state* d) {
  for (int i = 0; i < 2; ++i) s.u[i] += h * d->u[i], s.v[i] += h * d->v[i];
  return s;
}

static state step(const pnd_law* law, const pnd_contact* contact, double t, double h, state s) {
  const state a = slope(law, contact, t, &s), sa = moved(s, h / 2, &a);
  const state b = slope(law, contact, t + h / 2, &sa), sb = moved(s, h / 2, &b);
  const state c = slope(law, contact, t + h / 2, &sb), sc = moved(s, h, &c);
  const state d = slope(law, contact, t + h, &sc);
  s = moved(s, h / 6, &a), s = moved(s, h / 3, &b), s = moved(s, h / 3, &c);
  return moved(s, h / 6, &d);
}

int main(int count, char** words) {
  const int steps = count > 1 ? atoi(words[1]) : 30000;
  const char* name = count > 2 ? words[2] : "jankowski";
  const pnd_value values[] = {{"stiffness", 2.75e9}, {"restitution", 0.65}, {"reduced_mass", 6e4}};
  const double h = 3.0 / steps;
  pnd_law* law = NULL;
  pnd_contact contact = {0};
  state s = {{0, 0}, {0, 0}};
  double peak[2] = {0, 0}, peak_force = 0;
  int impacts = 0;

  stop(pnd_create(name, "exact", values, sizeof values / sizeof *values, &law));
  for (int n = 0; n < steps; ++n) {
    double t = n * h, left = h;
    state next = step(law, &contact, t, h, s);
    if (contact.touching == 0 && penetration(&next) > 0) {
      double low = 0, high = h;
      for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        next = step(law, &contact, t, middle, s);
        *(penetration(&next) > 0 ? &high : &low) = middle;
      }
      s = step(law, &contact, t, low, s);
      t += low, left -= low;
      stop(pnd_touch(law, rate(&s), &contact));
      ++impacts;
      next = step(law, &contact, t, left, s);
    }
    s = next;
    stop(pnd_accept(law, penetration(&s), rate(&s), &contact));
    peak_force = fmax(peak_force, force(law, &contact, &s));
    for (int i = 0; i < 2; ++i) peak[i] = fmax(peak[i], fabs(s.u[i]));
  }
  pnd_destroy(law);
  printf("%.9f %.9f %.3f %d\n", peak[0], peak[1], peak_force, impacts);
  return 0;
}
