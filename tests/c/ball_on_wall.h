/* In C, as a host would: a ball flies against a wall and back, in semi-implicit Euler steps. */
#ifndef BALL_ON_WALL_H
#define BALL_ON_WALL_H

#include <pounding.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The speed at which it comes back [m/s] from a closing speed [m/s], by steps [s]; -1 when a call fails. */
double speed_after(const pnd_law* law, double mass, double closing_speed, double step, pnd_contact* contact);

#ifdef __cplusplus
}
#endif

#endif
