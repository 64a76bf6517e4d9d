#!/usr/bin/env python3
"""Writes tests/support/axial_moment_references.hpp: hinges with axial force and moment on a cyclic path; needs scipy.

    python3 axial_moment_paths.py

Elastic up to the yield surface, then d(xi) = e - grad F (grad F.e)/|grad F|^2 in Cartesian coordinates by DOP853 to
1e-12, with located corners. `doubt` is the difference from a closest-point projection in 500 implicit increments per
leg, relative to the capacities: a method that shares nothing but the surface, of first order.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

HEADER = Path(__file__).parents[1] / "support/axial_moment_references.hpp"
AXIAL_STIFFNESS, ROTATIONAL_STIFFNESS = 5e8, 2e7
AXIAL_CAPACITY, PLASTIC_MOMENT = 1e6, 1.5e5
HARDENING = 0.03
# Elongations and rotations, divided by those at first yield.
PATH = [(0.5, 0.2), (2, 3), (-4, 2), (-3, -5), (1, -1), (8, 0.5), (7, -6), (0, 0.1), (-9, 0)]


def closest(surface: str, n0: float, point: np.ndarray, half_axes: np.ndarray) -> np.ndarray:
    """Point of the convex set that is closest to `point`, by golden sections along its boundary."""
    n, m = point / half_axes
    inside = abs(m) + n * n <= 1 if surface == "parabola" else m * m + (n - n0) ** 2 <= 1
    if inside:
        return point
    sign = 1.0 if m >= 0 else -1.0

    def boundary(t):
        if surface == "parabola":
            return half_axes * np.array([t, sign * (1 - t * t)])
        return half_axes * np.array([n0 + np.cos(t), np.sin(t)])

    def distance(t):
        d = boundary(t) - point
        return d @ d

    grid = np.linspace(-1, 1, 41) if surface == "parabola" else np.linspace(0, 2 * np.pi, 81)
    best = int(np.argmin([distance(t) for t in grid]))
    low, high = grid[max(best - 1, 0)], grid[min(best + 1, len(grid) - 1)]
    if surface == "ellipse" and best in (0, len(grid) - 1):
        low, high = -grid[1], grid[1]
    for _ in range(60):  # the slope of the distance changes sign once
        middle, h = 0.5 * (low + high), 1e-7
        if distance(middle + h) > distance(middle - h):
            high = middle
        else:
            low = middle
    t = 0.5 * (low + high)
    return boundary(np.clip(t, -1, 1) if surface == "parabola" else t)


class Surface:
    """F <= 0 in coordinates divided by the half axes; the parabola has two parts, one per sign of the moment."""

    def __init__(self, surface: str, n0: float, half_axes: np.ndarray) -> None:
        self.is_parabola, self.n0, self.half_axes = surface == "parabola", n0, half_axes

    def value(self, xi: np.ndarray, part: float) -> float:
        n, m = xi / self.half_axes
        return part * m + n * n - 1 if self.is_parabola else m * m + (n - self.n0) ** 2 - 1

    def gradient(self, xi: np.ndarray, part: float) -> np.ndarray:
        n, m = xi / self.half_axes
        return np.array([2 * n, part] if self.is_parabola else [2 * (n - self.n0), 2 * m]) / self.half_axes

    def worst(self, xi: np.ndarray) -> tuple[float, float]:
        return max((self.value(xi, part), part) for part in ([1.0, -1.0] if self.is_parabola else [1.0]))

    def rate(self, xi: np.ndarray, way: np.ndarray, part: float) -> np.ndarray:
        normal = self.gradient(xi, part)
        return way - normal * (normal @ way) / (normal @ normal)


def slide(surface: Surface, xi: np.ndarray, way: np.ndarray, part: float, done: float):
    """Path along one part of the surface, to the end or to a corner."""

    def corner(_, y):
        return part * y[1] if surface.is_parabola else 1.0

    corner.terminal, corner.direction = True, -1
    rate = surface.rate
    return solve_ivp(lambda _, y: rate(y, way, part), (done, 1), xi, "DOP853", rtol=1e-12, atol=1e-10, events=corner)


def leg(surface: Surface, xi: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Elastic deformation after the straight path `way`, divided into a unit length."""
    done = 0.0
    for s in np.linspace(0, 1, 4001)[1:]:
        if surface.worst(xi + s * way)[0] > 1e-11:
            before = max(s - 1 / 4000, 0.0)
            if surface.worst(xi + before * way)[0] < 0:
                done = brentq(lambda x: surface.worst(xi + x * way)[0], before, s, xtol=1e-15)
            else:
                done = before
            break
    else:
        return xi + way
    xi = xi + done * way
    part = surface.worst(xi + 1e-9 * way)[1]
    while True:
        if surface.is_parabola and abs(xi[1]) < 1e-9 * surface.half_axes[1]:
            # At a corner: continues on a part that the path leads into, otherwise stays.
            into = [p for p in (1.0, -1.0) if p * surface.rate(xi, way, p)[1] > 0]
            if not into:
                return xi
            part = into[0]
        path = slide(surface, xi, way, part, done)
        xi, done = path.y[:, -1], path.t[-1]
        if done == 1:
            return xi


def exact_forces(surface: str, n0: float) -> np.ndarray:
    """Forces N, M at the points of the path."""
    root = np.sqrt([AXIAL_STIFFNESS, ROTATIONAL_STIFFNESS])
    capacity = np.array([AXIAL_CAPACITY, PLASTIC_MOMENT])
    domain, elastic, before, found = Surface(surface, n0, capacity / root), np.zeros(2), np.zeros(2), []
    for corner in PATH:
        to = np.array(corner) * capacity / root
        elastic = leg(domain, elastic, to - before)
        before = to
        found.append(root * (HARDENING * to + (1 - HARDENING) * elastic))
    return np.array(found)


def forces(surface: str, n0: float, increments: int) -> np.ndarray:
    """Forces N, M at the points of the path."""
    root = np.sqrt([AXIAL_STIFFNESS, ROTATIONAL_STIFFNESS])
    capacity = np.array([AXIAL_CAPACITY, PLASTIC_MOMENT])
    elastic, before, found = np.zeros(2), np.zeros(2), []
    for corner in PATH:
        to = np.array(corner) * capacity / root
        for _ in range(increments):
            elastic = closest(surface, n0, elastic + (to - before) / increments, capacity / root)
        before = to
        found.append(root * (HARDENING * to + (1 - HARDENING) * elastic))
    return np.array(found)


def main() -> None:
    lines = []
    for name, surface, n0 in [("parabola", "parabola", 0.0), ("ellipse", "ellipse", 0.0), ("offset", "ellipse", -0.3)]:
        exact = exact_forces(surface, n0)
        doubt = np.abs((forces(surface, n0, 500) - exact) / [AXIAL_CAPACITY, PLASTIC_MOMENT]).max()
        print(name, doubt, flush=True)
        rows = ",\n    ".join("{" + f"{n:.9g}, {m:.9g}" + "}" for n, m in exact)
        lines.append(f"/// Doubt {doubt:.1e}.\ninline constexpr AxialMomentPath {name}_forces{{{{{{\n    {rows}}}}}}};")
    HEADER.write_text(
        "#pragma once\n/// Hinges on a cyclic path, written by tests/verification/axial_moment_paths.py.\n\n"
        "#include <array>\n\nnamespace pounding::test {\n\n"
        "struct AxialMomentPath {\n  std::array<std::array<double, 2>, " + str(len(PATH)) + "> points;\n};\n"
        "/// Elongations and rotations, divided by capacity/stiffness.\ninline constexpr AxialMomentPath axial_moment_path{{{\n    "
        + ",\n    ".join("{" + f"{e}, {r}" + "}" for e, r in PATH)
        + "}}};\n// Forces N [N] and moments M [N m] there.\n"
        + "\n".join(lines)
        + "\n\n}  // namespace pounding::test\n"
    )


if __name__ == "__main__":
    main()
