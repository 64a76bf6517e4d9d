"""Contact laws as phases between events, and the reference integration that lands on every event.

Written from the equations of the laws; shares no code with pounding or OpenSees. Opening is negative penetration d [m],
rate v = d' [m/s] closes, force F [N] pushes apart.
"""

import math

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

import problem


class Contact:
    """One link: phase `free` or a phase of its law; `events` end the phase.

    hertz_damped pulls if bodies separate faster than v/a. OpenSees keeps the tension, pounding cuts it. Both equations
    are here, the first under the name hertz_damped_pulling.
    """

    def __init__(self, law, mass):
        self.pulls = law.endswith("_pulling")
        self.law, self.mass = law.removesuffix("_pulling"), mass
        self.phase, self.speed, self.slip = "free", 0.0, 0.0
        self.c = problem.kelvin_coefficient(mass)
        self.ratio = problem.jankowski_ratio()
        self.factor = problem.ye_factor() if self.law == "hertz_damped" else 0.0
        self.k1, self.k2, self.yielding = problem.bilinear_curve(mass)

    def force(self, d, v):
        k, kh, n = problem.LINEAR_STIFFNESS, problem.HERTZ_STIFFNESS, problem.EXPONENT
        deep = max(d, 0.0)
        if self.phase in ("free", "slack"):
            return 0.0
        if self.law == "linear_spring":
            return k * d
        if self.law == "kelvin_voigt":
            return k * d + self.c * v
        if self.law in ("hertz", "hertz_damped"):
            return kh * deep**n * (1 + self.factor * v / self.speed)
        if self.law == "jankowski":
            dashpot = 2 * self.ratio * math.sqrt(kh * math.sqrt(deep) * self.mass) if self.phase == "approach" else 0.0
            return kh * deep**n + dashpot * v
        stretch = {"elastic": d - self.slip, "yielding": self.yielding, "lower": 0.0}[self.phase]
        return self.k2 * d + (self.k1 - self.k2) * stretch

    def events(self):
        """(function of d and v, direction of its zero, next phase) for the present phase."""
        if self.phase == "free":
            return [(lambda d, v: d, 1, "touch")]
        events = [(lambda d, v: d, -1, "free")]
        if self.factor and not self.pulls:
            slack = self.phase == "slack"
            events.append(
                (lambda d, v: self.speed + self.factor * v, 1 if slack else -1, "pressed" if slack else "slack")
            )
        if self.phase == "approach":
            events.append((lambda d, v: v, -1, "restitution"))
        if self.phase == "restitution":
            events.append((lambda d, v: v, 1, "approach"))
        if self.phase == "elastic":
            slip, end = self.slip, self.slip + self.yielding
            events.append((lambda d, v: d - end, 1, "yielding"))
            if slip > 0:  # from zero slip the lower line begins at the end of contact
                events.append((lambda d, v: d - slip, -1, "lower"))
        if self.phase == "yielding":
            events.append((lambda d, v: v, -1, "elastic"))
        if self.phase == "lower":
            events.append((lambda d, v: v, 1, "elastic"))
        return events

    def enter(self, phase, d, v):
        if phase == "touch":
            self.speed, self.slip = v, 0.0
            phase = {"jankowski": "approach", "bilinear_hertz": "elastic"}.get(self.law, "pressed")
        elif phase == "elastic":
            self.slip = d - self.yielding if self.phase == "yielding" else d
        self.phase = phase


def largest_force(contact, motion, start, end):
    """Largest force of a phase; motion(t) gives d and v."""
    times = np.linspace(start, end, 61)
    forces = [contact.force(*motion(t)) for t in times]
    best = int(np.argmax(forces))
    if 0 < best < 60:
        found = minimize_scalar(
            lambda t: -contact.force(*motion(t)),
            bounds=(times[best - 1], times[best + 1]),
            method="bounded",
            options={"xatol": 1e-12},
        )
        return max(forces[best], -found.fun)
    return forces[best]


def integrate(slope, contacts, relative, start, breaks, samples, rtol, atol, max_step):
    """Integrates from y = start and returns samples [n, size], peak forces [link][impact], and the largest |y| [size].

    slope(t, y, forces) -> y'; relative(y, link) -> (d, v). `breaks` are times of corners of the load; the last one is
    the end.
    """
    y, t, step = np.array(start, dtype=float), 0.0, None
    kept = [y.copy()]
    peaks = [[] for _ in contacts]
    largest = np.abs(y)
    samples = list(samples[1:])
    for stop in breaks:
        while t < stop - 1e-13:
            active = [i for i, c in enumerate(contacts) if c.phase != "free"]

            def rate(time, state):
                return slope(time, state, {i: contacts[i].force(*relative(state, i)) for i in active})

            functions, follow = [], []
            for i, c in enumerate(contacts):
                for function, direction, phase in c.events():

                    def event(time, state, function=function, i=i):
                        return function(*relative(state, i))

                    event.terminal, event.direction = True, direction
                    functions.append(event)
                    follow.append((i, phase))
            r = solve_ivp(
                rate,
                (t, stop),
                y,
                method="DOP853",
                rtol=rtol,
                atol=atol,
                max_step=max_step,
                events=functions,
                dense_output=True,
                first_step=min(step or 1e-6, stop - t),
            )
            if r.status < 0:
                raise RuntimeError(r.message)
            for i in active:
                force = largest_force(contacts[i], lambda time: relative(r.sol(time), i), t, r.t[-1])
                peaks[i][-1] = max(peaks[i][-1], force)
            inside = np.linspace(t, r.t[-1], 9)
            largest = np.maximum(largest, np.abs(r.sol(inside)).max(axis=1))
            while samples and samples[0] <= r.t[-1] + 1e-12:
                kept.append(r.sol(min(samples.pop(0), r.t[-1])))
            t, y = r.t[-1], r.y[:, -1].copy()
            step = None if r.status == 1 else max_step
            for zeros, (i, phase) in zip(r.t_events, follow):
                if r.status == 1 and len(zeros):
                    if phase == "touch":
                        peaks[i].append(0.0)
                    contacts[i].enter(phase, *relative(y, i))
    return np.array(kept), peaks, largest
