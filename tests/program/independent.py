"""A second integrator for rows of bodies and oscillators, as a reference for the program. Every impact is located and
counted.

It shares no code with the program. Forces, formulas and damping follow the published laws; where the exact damping has
no closed form (kuwabara_kono, adams_impact, limited_damper) it is computed here by integrating free impacts. The motion
is advanced by scipy's DOP853 (order 8, relative tolerance 1e-11) from one instant where a force changes its formula to
the next: touch, reversal, release, corner, separation, jump of the ground. The integrated functions are therefore
smooth.

SI units. Penetration d > 0 is overlap, rate > 0 closes, force > 0 pushes apart. Displacements are relative to the
ground.
"""

import math
import time
from dataclasses import dataclass, field
from functools import lru_cache

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq, minimize_scalar

from independent_damping import FORMULAS, GIVEN, bilinear_curve, bilinear_exact

RELATIVE_TOLERANCE = 1e-11
#: Lower bound [m/s] on the closing speed in damping formulas that divide by it: the program's convention.
SLOWEST_CLOSING_SPEED = 1e-6
#: Number of points of a step at which signs are checked. Steps in free flight are at most a twentieth of the shortest
#: period.
LOOKS = 6


def _power(d, n):
    """d^n, continued as an odd function below zero, so that a trial step past the separation meets no corner; bounded
    for extreme trial values."""
    return math.copysign(min(abs(d), 1e3) ** n, d)


class Law:
    """One contact law in one link, on the branch entered at the last located instant.

    margins(d, rate) are positive while the branch lasts; cross(i, ...) enters the branch beyond margin i; force(d,
    rate) is smooth on a branch. `parameters` are those of a link in an input file.
    """

    def __init__(self, name, parameters):
        self.name, self.parameters = name, parameters
        self.stiffness, self.mass = parameters.get("stiffness"), None
        self.coefficient = self.speed = None
        self.signs = []
        self.slip, self.branch, self.curve = 0.0, "stick", None
        # of elastoplastic, below the original surface: largest depth, crushed depth [m]
        self.deepest, self.left = 0.0, 0.0

    rigid = property(lambda self: self.name == "stereomechanical")
    ends_at_release = property(lambda self: self.name in ("komodromos", "elastoplastic"))

    def touch(self, speed):
        """An impact begins at this closing speed [m/s]."""
        p, k, m = self.parameters, self.stiffness, self.mass
        self.speed = max(p.get("impact_velocity", speed), SLOWEST_CLOSING_SPEED)
        e, formula = p.get("restitution"), p.get("formula", "exact")
        v, root = self.speed, math.sqrt(k * m)
        key, factor = GIVEN.get(self.name, (None, 0))
        if self.name in FORMULAS:
            number = factor * p[key] if key in p else FORMULAS[self.name][formula](e)
            self.coefficient = number / v if key == "damping_factor" else number * root
        elif key in p:
            self.coefficient = factor * p[key]
        elif self.name == "kuwabara_kono":
            self.coefficient = universal(self.name, e) * (m * v * v / k) ** 0.4 / v
        elif self.name == "limited_damper":
            self.coefficient = universal(self.name, e) * m * v / (m * v * v / k) ** 0.4
        elif self.name == "adams_impact":
            self.coefficient = adams_exact(e, k, m, v, p["depth"], self.coefficient)
        elif self.name == "elastoplastic":
            self.kept, self.branch = 1 - e * e, "core" if self.deepest > 0 else "crush"
        elif self.name == "bilinear_hertz":
            loss = bilinear_exact(e) if formula == "exact" else 1 - e * e
            self.curve, self.slip, self.branch = bilinear_curve(k, v, m, loss), 0.0, "stick"
        trace = 1e-9 * max(speed, SLOWEST_CLOSING_SPEED)
        self.signs = [1] * len(self._switches(0.0, speed))
        self.signs = [1 if s >= 0 else -1 for s in self._switches(0.0, max(speed, trace))]

    def _switches(self, d, rate):
        """Values whose signs choose the formula."""
        k, c = self.stiffness, self.coefficient
        name = self.name
        if name in ("kelvin_voigt_no_tension", "komodromos"):
            return (k * d + c * rate,)
        if name in ("modified_linear_viscoelastic", "jankowski"):
            return (rate,)
        if name in ("modified_kelvin", "hertz_damped"):
            return (1 + c * rate,)
        if name == "viscous_hertz":  # over d^(1/4)
            return (k * _power(d, 1.25) + c * rate,)
        if name == "kuwabara_kono":  # over d^(1/2)
            return (k * d + 1.5 * c * k * rate,)
        if name == "limited_damper":
            spring = k * _power(d, 1.5)
            return (spring - c * rate, spring + c * rate)
        if name == "adams_impact":
            depth = self.parameters["depth"]
            if self.signs and self.signs[-1] < 0:  # beyond the depth
                return (k * _power(d, 1.5) + c * rate, depth - d)
            # Over d^(3/2): the spring dominates in the end.
            return (k + c * math.sqrt(abs(d)) / depth**2 * (3 - 2 * d / depth) * rate, depth - d)
        return ()

    def margins(self, d, rate):
        if self.name == "bilinear_hertz":
            if self.branch == "stick":
                return (self.curve[2] - (d - self.slip), d - self.slip)
            return (rate,) if self.branch == "up" else (-rate,)
        if self.name == "elastoplastic":
            if self.branch == "crush":
                return (rate,)
            return (self.deepest - (d + self.left), d + self.left - self.kept * self.deepest)
        return tuple(s * g for s, g in zip(self.signs, self._switches(d, rate)))

    def cross(self, i, d, rate):
        if self.name == "elastoplastic":
            if self.branch == "crush":
                self.deepest, self.branch = d + self.left, "core"
            elif i == 0:
                self.branch = "crush"
            else:
                self.left, self.branch = self.left + d, "released"
        elif self.name != "bilinear_hertz":
            self.signs[i] = -self.signs[i]
        elif self.branch == "stick":
            self.branch = "up" if i == 0 else "down"
        else:
            self.slip = d - self.curve[2] if self.branch == "up" else d
            self.branch = "stick"

    @property
    def released(self):
        """The formula pulls and is therefore cut."""
        if self.name in ("kelvin_voigt", "modified_linear_viscoelastic", "jankowski", "limited_damper"):
            return False
        if self.name == "elastoplastic":
            return self.branch == "released"
        return bool(self.signs) and self.signs[0] < 0

    def force(self, d, rate):
        k, c, name = self.stiffness, self.coefficient, self.name
        if self.released:
            return 0.0
        if name == "linear_spring":
            return k * d
        if name == "hertz":
            return k * _power(d, 1.5)
        if name in ("kelvin_voigt", "kelvin_voigt_no_tension", "komodromos"):
            return k * d + c * rate
        if name == "modified_linear_viscoelastic":
            return k * d + (c * rate if self.signs[0] > 0 else 0.0)
        if name == "jankowski":
            return k * _power(d, 1.5) + (c * _power(d, 0.25) * rate if self.signs[0] > 0 else 0.0)
        if name == "modified_kelvin":
            return k * d * (1 + c * rate)
        if name == "hertz_damped":
            return k * _power(d, 1.5) * (1 + c * rate)
        if name == "viscous_hertz":
            return k * _power(d, 1.5) + c * _power(d, 0.25) * rate
        if name == "kuwabara_kono":
            return k * _power(d, 1.5) + 1.5 * c * k * _power(d, 0.5) * rate
        if name == "limited_damper":
            spring = k * _power(d, 1.5)
            return 2 * spring if self.signs[0] < 0 else 0.0 if self.signs[1] < 0 else spring + c * rate
        if name == "adams_impact":
            s = d / self.parameters["depth"]
            step = s * s * (3 - 2 * s) if self.signs[1] > 0 else 1.0
            return k * _power(d, 1.5) + c * step * rate
        if name == "elastoplastic":
            if self.branch == "crush":
                return k * _power(d + self.left, 1.5)
            part = (d + self.left - self.kept * self.deepest) / ((1 - self.kept) * self.deepest)
            return k * self.deepest**1.5 * _power(part, 1.5)
        k1, k2, d_y = self.curve
        return k2 * d + (k1 - k2) * (d - self.slip if self.branch == "stick" else d_y if self.branch == "up" else 0.0)


class TooLong(Exception):
    """The run was abandoned for its length."""


@dataclass
class Impact:
    start: float  #: touch [s]
    approach: float  #: closing speed at touch [m/s]
    deceleration: float  #: opening acceleration of the two bodies just before the touch [m/s^2]
    end: float = math.nan  #: separation [s]; nan while pressed
    separation: float = math.nan  #: opening speed at separation [m/s]
    return_acceleration: float = math.nan  #: closing acceleration just after the separation [m/s^2]
    peak: float = 0.0  #: largest force [N]; nan for a rigid impact


@dataclass
class Link:
    """left and right are indices of masses; None is a wall."""

    left: int | None
    right: int | None
    gap: float
    law: Law
    pressed: bool = False
    impacts: list = field(default_factory=list)
    #: (time, distance) of approaches that reverse without a touch, and of partings that reverse without a separation
    #: [s, m]
    near_misses: list = field(default_factory=list)


class Row:
    """Masses (mass, stiffness, damping, displacement, velocity) and links, on accelerating ground.

    ground(t) [m/s^2] must be smooth between `corners` [s].
    """

    def __init__(self, masses, links, ground=None, corners=(), longest_step=math.inf):
        self.m, self.k, self.c, u, v = (np.array(column, float) for column in zip(*masses))
        self.links, self.ground, self.corners = links, ground or (lambda t: 0.0), sorted(corners)
        self.y, self.t, self.n = np.concatenate([u, v]), 0.0, len(masses)
        periods = [2 * math.pi * math.sqrt(m / k) for m, k in zip(self.m, self.k) if k > 0]
        self.longest_step = min([longest_step] + [p / 20 for p in periods])
        self.stopped = None  #: why the run ended early
        self.slowest_rigid = 0.0  #: rigid touches slower than this end the run [m/s]
        self.reach = 0.0  #: largest displacement until now [m]
        self.deadline = math.inf  #: time.monotonic() at which TooLong is raised
        for link in links:
            ends = [i for i in (link.left, link.right) if i is not None]
            link.law.mass = 1 / sum(1 / self.m[i] for i in ends)

    def motion(self, link, y):
        n, i, j = self.n, link.left, link.right
        d = (y[i] if i is not None else 0.0) - (y[j] if j is not None else 0.0) - link.gap
        rate = (y[n + i] if i is not None else 0.0) - (y[n + j] if j is not None else 0.0)
        return float(d), float(rate)

    def slope(self, t, y):
        n = self.n
        u, v = y[:n], y[n:]
        f = -self.k * u - self.c * v - self.m * self.ground(min(max(t, self.begin), self.finish))
        for link in self.links:
            if link.pressed:
                force = link.law.force(*self.motion(link, y))
                if link.left is not None:
                    f[link.left] -= force
                if link.right is not None:
                    f[link.right] += force
        return np.concatenate([v, f / self.m])

    def margins(self, y):
        """Event functions that end the present branches: (link, index, value); index -1 is the gap."""
        found = []
        for link in self.links:
            d, rate = self.motion(link, y)
            found.append((link, -1, d if link.pressed else -d))
            if link.pressed:
                found += [(link, i, value) for i, value in enumerate(link.law.margins(d, rate))]
        return found

    def run(self, end):
        """Integrates to the time `end`, or until `stopped`."""
        stops = [t for t in self.corners if self.t < t < end] + [end]
        for stop in stops:
            self.begin, self.finish = self.t + 1e-15 * stop, stop - 1e-15 * stop
            still = 0
            while self.t < stop and not self.stopped:
                before = self.t
                self._smooth(stop)
                still = still + 1 if self.t == before else 0
                if still > 200:
                    self.stopped = "events without end"
            self.t = max(self.t, stop) if not self.stopped else self.t

    def _smooth(self, stop):
        """Integrates to the next change of a branch, or to `stop`."""
        scale = np.concatenate([np.full(self.n, 1e-14), np.full(self.n, 1e-13)])
        solver = DOP853(
            self.slope, self.t, self.y, stop, rtol=RELATIVE_TOLERANCE, atol=scale, max_step=self.longest_step
        )
        self._watch_force(lambda t: self.y, [self.t])
        while solver.status == "running":
            if time.monotonic() > self.deadline:
                raise TooLong
            with np.errstate(over="ignore", invalid="ignore"):  # number of rejected steps
                message = solver.step()
            if solver.status == "failed":
                raise RuntimeError(message)
            path = solver.dense_output()
            times = np.linspace(solver.t_old, solver.t, LOOKS + 1)
            first = self._first_change(path, times)
            self.reach = max(self.reach, float(np.max(np.abs(solver.y[: self.n]))))
            if first:
                t, link, index = first
                self._watch_force(path, [*times[times < t], t])
                self.t, self.y = t, path(t)
                self._change(link, index)
                return
            self._watch_force(path, times)
        self.t, self.y = solver.t, solver.y

    def _first_change(self, path, times):
        """The earliest (time, link, index) of a margin that falls below zero in a step."""
        values = [self.margins(path(t)) for t in times]
        first = None
        for j, (link, index, _) in enumerate(values[0]):
            series = [v[j][2] for v in values]
            crossing = self._crossing(path, times, series, link, index, j)
            if crossing is not None and (first is None or crossing < first[0]):
                first = (crossing, link, index)
        return first

    def _crossing(self, path, times, series, link, index, j):
        def margin(t):
            return self.margins(path(t))[j][2]

        for a in range(len(times) - 1):
            low, high = times[a], times[a + 1]
            if series[a + 1] < 0:
                if series[a] > 0:
                    return brentq(margin, low, high, xtol=1e-15 * max(1.0, high)) if margin(low) > 0 else low
                # It begins at zero: it either falls immediately, or first rises and then falls in this piece.
                for part in np.geomspace(1e-6, 0.9, 12):
                    inside = low + part * (high - low)
                    if margin(inside) > 0:
                        return brentq(margin, inside, high, xtol=1e-15 * max(1.0, high))
                return low
            if index == -1:
                # Closing at one point, opening at the next: the closest approach between them may overlap. Or the
                # reverse.
                sign = -1 if link.pressed else 1
                rates = [sign * self.motion(link, path(t))[1] for t in (low, high)]
                if rates[0] > 0 > rates[1]:
                    turn = brentq(lambda t: self.motion(link, path(t))[1], low, high, xtol=1e-15 * max(1.0, high))
                    if margin(turn) < 0:
                        return brentq(margin, low, turn, xtol=1e-15 * max(1.0, high)) if margin(low) > 0 else low
                    link.near_misses.append((turn, margin(turn)))
        return None

    def _watch_force(self, path, times):
        """Tracks the largest force of each impact; the largest sample is refined when the impact is over."""
        for link in self.links:
            if not link.pressed:
                continue
            impact = link.impacts[-1]

            def force(t):
                return link.law.force(*self.motion(link, path(t)))

            forces = [force(t) for t in times]
            best = int(np.argmax(forces))
            if forces[best] < 0.9 * impact.peak:
                continue  # the largest force is at most one sample away from the largest sample
            impact.peak = max(impact.peak, forces[best])
            low, high = times[max(best - 1, 0)], times[min(best + 1, len(times) - 1)]
            if high > low:
                found = minimize_scalar(
                    lambda t: -force(t), bounds=(low, high), method="bounded", options={"xatol": 1e-6 * (high - low)}
                )
                impact.peak = max(impact.peak, -found.fun)

    def _change(self, link, index):
        d, rate = self.motion(link, self.y)
        if index >= 0:
            link.law.cross(index, d, rate)
            if link.law.ends_at_release and link.law.released:
                link.gap += d
                self._separate(link, rate)
        elif link.pressed:
            self._separate(link, rate)
        else:
            self._touch(link, rate)

    def _separate(self, link, rate):
        link.pressed = False
        impact = link.impacts[-1]
        impact.end, impact.separation, impact.return_acceleration = self.t, -rate, -self._opening_acceleration(link)

    def _opening_acceleration(self, link):
        acceleration = self.slope(self.t, self.y)[self.n :]
        return float(sum(sign * acceleration[i] for sign, i in ((-1, link.left), (1, link.right)) if i is not None))

    def _touch(self, link, rate):
        rate = max(rate, 0.0)
        impact = Impact(self.t, rate, self._opening_acceleration(link))
        if not link.law.rigid:
            link.law.touch(rate)
            link.pressed = True
            link.impacts.append(impact)
            return
        if rate <= self.slowest_rigid:
            self.stopped = "a rigid touch too slow to be distinguished from rest"
            return
        for other in self.links:
            shared = {link.left, link.right} & {other.left, other.right} - {None}
            d, closing = self.motion(other, self.y)
            if other is not link and other.law.rigid and shared and abs(d) < 1e-12 and closing > 0:
                self.stopped = "two rigid touches at one instant, whose order decides"
                return
        e = link.law.parameters["restitution"]
        impulse = link.law.mass * (1 + e) * rate
        if link.left is not None:
            self.y[self.n + link.left] -= impulse / self.m[link.left]
        if link.right is not None:
            self.y[self.n + link.right] += impulse / self.m[link.right]
        impact.end, impact.separation, impact.peak = self.t, e * rate, math.nan
        link.impacts.append(impact)


def free_restitution(law, k, m, v):
    """Restitution of one free impact, by integration."""
    row = Row([(m, 0.0, 0.0, 0.0, v)], [Link(0, None, 0.0, law)])
    law.stiffness, law.mass = k, m
    reach = (5 * m * v * v / (4 * k)) ** 0.4 / v
    time = 0.0
    while time < 1e4:
        time += 40 * reach
        row.run(time)
        if row.links[0].impacts and math.isfinite(row.links[0].impacts[0].end):
            return row.links[0].impacts[0].separation / v
    raise RuntimeError("the free impact does not end")


@lru_cache(maxsize=None)
def universal(name, e):
    """c* of limited_damper or A* of kuwabara_kono: the coefficient that gives e for k = m = v = 1, where D = 1."""
    if e == 1:
        return 0.0

    def miss(log_c):
        return free_restitution(Law(name, {GIVEN[name][0]: math.exp(log_c)}), 1.0, 1.0, 1.0) - e

    low, high = math.log(1e-3), math.log(1.0)
    while miss(high) > 0:
        low, high = high, high + 1
    return math.exp(brentq(miss, low, high, xtol=1e-12, rtol=1e-13))


def adams_exact(e, k, m, v, depth, near=None):
    """c of adams_impact at one closing speed. near [N s/m]: a guess."""
    if e == 1:
        return 0.0
    d_c = (m * v * v / k) ** 0.4
    scaled = depth / d_c

    def miss(log_c):
        law = Law("adams_impact", {"damping_coefficient": math.exp(log_c), "depth": scaled})
        return free_restitution(law, 1.0, 1.0, 1.0) - e

    middle = math.log(near * d_c / (m * v)) if near else math.log(0.5 * (1 - e) / e * max(1.0, scaled**2))
    low, high, width = middle, middle, 0.3
    while miss(low) < 0:
        low -= width
        width *= 2
    width = 0.3
    while miss(high) > 0:
        high += width
        width *= 2
    return math.exp(brentq(miss, low, high, xtol=1e-11, rtol=1e-13)) * m * v / d_c
