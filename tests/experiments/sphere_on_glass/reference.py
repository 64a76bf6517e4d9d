"""Oblique impacts of the sphere on glass, integrated independently of pounding with short equal steps.

    python3 reference.py > computed.csv

The columns are those of the test in C++, at the angles of measured.csv. See there for the data and their sources.
"""

from __future__ import annotations

import math
from pathlib import Path

RADIUS, DENSITY, SPEED, RESTITUTION, FRICTION = 2.5e-3, 4000.0, 3.9, 0.98, 0.092
YOUNG, POISSON = (380e9, 70e9), (0.23, 0.25)
MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY
INERTIA = 0.4 * MASS * RADIUS**2
PLANE = 1 / sum((1 - nu**2) / e for e, nu in zip(YOUNG, POISSON, strict=True))
SHEAR = 1 / sum((2 - nu) * 2 * (1 + nu) / e for e, nu in zip(YOUNG, POISSON, strict=True))
STIFFNESS = 4 / 3 * PLANE * math.sqrt(RADIUS)
RATIO = 4 * SHEAR / PLANE  # of Mindlin's tangential stiffness 8 G* a to the normal one, 2 E* a
STEPS = 20000  # per duration of an elastic impact


def normal_force(depth: float, rate: float, damping: float) -> float:
    """Hertz with the damping of Hunt and Crossley; no tension."""
    return max(STIFFNESS * max(depth, 0.0) ** 1.5 * (1 + damping * rate), 0.0)


def normal_step(depth: float, rate: float, damping: float, h: float) -> tuple[float, float]:
    """Penetration and its rate after a step of the explicit midpoint rule."""
    middle = rate - h / 2 * normal_force(depth, rate, damping) / MASS
    return depth + h * middle, rate - h * normal_force(depth + h / 2 * rate, middle, damping) / MASS


def duration(speed: float) -> float:
    """Of an elastic impact [s]."""
    return 2.9432 * (1.25 * MASS / STIFFNESS) ** 0.4 * speed**-0.2


def restitution(product: float) -> float:
    """For damping times speed, of which alone it is a function."""
    depth, rate = 0.0, 1.0
    while depth >= 0:
        depth, rate = normal_step(depth, rate, product, duration(1) / 4000)
    return -rate


def damping_product() -> float:
    """Damping times speed for the restitution, by bisection."""
    low, high = 0.0, 0.2
    for _ in range(40):
        middle = (low + high) / 2
        low, high = (middle, high) if restitution(middle) > RESTITUTION else (low, middle)
    return low


PRODUCT = damping_product()


def impact(degrees: float, kind: str) -> tuple[float, float, float]:
    """Tangential restitution of the centre, spin [rad/s], and rebound angle of the contact point [degrees].

    `kind`: mindlin, constant (the stiffness at the peak of an elastic impact) or none (Coulomb friction alone)."""
    normal, along = SPEED * math.cos(math.radians(degrees)), SPEED * math.sin(math.radians(degrees))
    damping, h = PRODUCT / normal, duration(normal) / STEPS
    peak = (1.25 * MASS * normal**2 / STIFFNESS) ** 0.4
    depth, rate, sliding, spin, force = 0.0, normal, along, 0.0, 0.0
    before = 0.0
    while depth >= 0:
        depth, rate = normal_step(depth, rate, damping, h)
        limit, slip = FRICTION * normal_force(depth, rate, damping), sliding + RADIUS * spin
        stiffness = RATIO * 1.5 * STIFFNESS * math.sqrt(peak if kind == "constant" else max(depth, 0.0))
        if kind == "none":
            force = limit * slip / math.hypot(slip, 1e-3)
        elif stiffness >= before:
            force += 0.5 * (before + stiffness) * slip * h
        else:
            force = stiffness * (force / before + slip * h)
        force = max(-limit, min(limit, force))
        before = stiffness
        sliding -= h * force / MASS
        spin -= h * force * RADIUS / INERTIA
    return sliding / along, spin, math.degrees(math.atan2(sliding + RADIUS * spin, -rate))


def main() -> None:
    """Prints the table."""
    print("# Computed by reference.py at the angles of measured.csv: with Mindlin's tangential stiffness,")
    print("# with a constant one (that of the peak of an elastic impact) and without.")
    names = [f"{kind}_{what}" for kind in ("mindlin", "constant", "none") for what in ("tangential", "spin", "angle")]
    print(",".join(names))
    for line in (Path(__file__).parent / "measured.csv").read_text().splitlines():
        if not line[0].isdigit():
            continue
        angles = [float(cell) for cell in line.split(",")][::2]
        cells = []
        for kind in ("mindlin", "constant", "none"):
            values = [impact(angle, kind)[i] for i, angle in enumerate(angles)]
            cells += [f"{values[0]:.4f}", f"{-values[1]:.2f}", f"{values[2]:.3f}"]
        print(",".join(cells), flush=True)


if __name__ == "__main__":
    main()
