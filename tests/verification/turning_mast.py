"""Reference numbers for tests/stepping/turning_test.cpp: a mast of corotational members with an initial velocity,
from its energy alone.

    .venv/bin/python3 tests/verification/turning_mast.py

Plane beams with linear strains about their chord: E = EA/(2 L) (l - L)^2 + 2 EI/L (a^2 + a b + b^2), where a and b are
the rotations of the ends relative to the chord. Rotations are massless and minimize the energy, which is a linear system
for given chords. Masses at the nodes move by the gradient of the energy; SciPy integrates them (DOP853, 1e-13).
"""

import numpy as np
from scipy.integrate import solve_ivp

MEMBERS, LENGTH, EA, EI, MASS = 4, 1.0, 2e6, 4e4, 50.0
SPEED, END, GRAVITY = 6.0, 1.0, 9.80665

# Stiffness of the rotations with a fixed foot: 2 EI/L (2 own + other) at both ends of each member.
COUPLING = np.zeros((MEMBERS + 1, MEMBERS + 1))
for _i in range(MEMBERS):
    COUPLING[_i : _i + 2, _i : _i + 2] += 2 * EI / LENGTH * np.array([[2, 1], [1, 2]])


def slope(place):
    """Gradient of the strain energy with respect to the coordinates (x, z) of the free nodes, the energy, and the
    rotations."""
    nodes = np.vstack([[0.0, 0.0], place.reshape(-1, 2)])
    chord = np.diff(nodes, axis=0)
    length = np.hypot(*chord.T)
    turn = np.arctan2(chord[:, 0], chord[:, 1])  # from the vertical, towards x
    load = np.zeros(MEMBERS + 1)
    load[:-1] += 6 * EI / LENGTH * turn
    load[1:] += 6 * EI / LENGTH * turn
    rotation = np.zeros(MEMBERS + 1)
    rotation[1:] = np.linalg.solve(COUPLING[1:, 1:], load[1:])
    a, b = rotation[:-1] - turn, rotation[1:] - turn
    energy = (EA / (2 * LENGTH) * (length - LENGTH) ** 2 + 2 * EI / LENGTH * (a * a + a * b + b * b)).sum()
    along = chord / length[:, None]
    across = np.column_stack([along[:, 1], -along[:, 0]])
    end = (EA / LENGTH * (length - LENGTH))[:, None] * along - (6 * EI / LENGTH * (a + b) / length)[:, None] * across
    force = np.zeros_like(nodes)
    force[1:] += end
    force[:-1] -= end
    return force[1:].ravel(), energy, rotation


def throw(gravity):
    upright = np.column_stack([np.zeros(MEMBERS), LENGTH * np.arange(1, MEMBERS + 1)]).ravel()
    weight = np.tile([0, MASS * gravity], MEMBERS)
    rest = upright.copy()
    above = MASS * gravity * np.arange(MEMBERS, 0, -1)
    rest[1::2] -= np.cumsum(above * LENGTH / EA)
    assert np.abs(slope(rest)[0] + weight).max() < 1e-6
    speed = np.tile([SPEED, 0.0], MEMBERS)
    motion = solve_ivp(
        lambda t, y: np.concatenate([y[2 * MEMBERS :], -(slope(y[: 2 * MEMBERS])[0] + weight) / MASS]),
        (0, END),
        np.concatenate([rest, speed]),
        method="DOP853",
        rtol=1e-13,
        atol=1e-13,
        dense_output=True,
    )
    y = motion.y[:, -1]

    def energy(y):
        return slope(y[: 2 * MEMBERS])[1] + weight @ y[: 2 * MEMBERS] + MASS / 2 * y[2 * MEMBERS :] @ y[2 * MEMBERS :]

    kept = abs(energy(y) / energy(motion.y[:, 0]) - 1)
    turns = [np.abs(slope(column[: 2 * MEMBERS])[2]).max() for column in motion.y.T]
    tip = [*(y[2 * MEMBERS - 2 : 2 * MEMBERS] - upright[-2:]), *y[-2:], slope(y[: 2 * MEMBERS])[2][-1]]
    print(f"gravity {gravity}: energy conserved to {kept:.1e}, largest rotation {max(turns):.4f} rad")
    print("  tip at the end, x z vx vz rotation:", ", ".join(f"{value:.15g}" for value in tip))


throw(0.0)
throw(GRAVITY)
