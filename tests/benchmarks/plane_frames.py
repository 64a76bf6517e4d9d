"""Matrices of the two plane frames, for the reference only.

Elastic frames of 3.2 m storeys and 6 m bays, columns 0.55 x 0.55 m (70 % of I), beams 0.30 x 0.60 m (50 % of I), E = 25
GPa, the second frame 1.7 times stiffer in bending; mass at the nodes, both directions, no rotational mass; fixed bases.
Rayleigh damping of 5 % at the first and sixth frequency of the pair (at 4 Hz if that is higher).
"""

import math

import numpy as np
from scipy.linalg import eigh

import problem

STOREYS, BAYS, STIFFER = (8, 6), (3, 2), (1.0, 1.7)
HEIGHT, BAY, ELASTICITY = 3.2, 6.0, 25e9
COLUMN = 0.55**2, 0.7 * 0.55**4 / 12
BEAM = 0.3 * 0.6, 0.5 * 0.3 * 0.6**3 / 12


def beam(length, area, inertia, vertical):
    """Stiffness [6, 6] of a beam-column in global axes (ux, uy, rotation at both ends)."""
    a, i, h = ELASTICITY * area / length, ELASTICITY * inertia / length**3, length
    k = np.zeros((6, 6))
    k[np.ix_([0, 3], [0, 3])] = a * np.array([[1, -1], [-1, 1]])
    k[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] = i * np.array(
        [
            [12, 6 * h, -12, 6 * h],
            [6 * h, 4 * h * h, -6 * h, 2 * h * h],
            [-12, -6 * h, 12, -6 * h],
            [6 * h, 2 * h * h, -6 * h, 4 * h * h],
        ]
    )
    if vertical:
        turn = np.kron(np.eye(2), np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 1]]))
        k = turn.T @ k @ turn
    return k


def frame(storeys, bays, stiffer):
    """Mass [n] and condensed stiffness [n, n] of the translations (ux, uy of node after node, storey after storey)."""
    columns = bays + 1
    node = lambda floor, line: floor * columns + line
    k = np.zeros((3 * columns * (storeys + 1),) * 2)

    def add(a, b, element):
        at = [3 * a, 3 * a + 1, 3 * a + 2, 3 * b, 3 * b + 1, 3 * b + 2]
        k[np.ix_(at, at)] += element

    for floor in range(1, storeys + 1):
        for line in range(columns):
            add(node(floor - 1, line), node(floor, line), beam(HEIGHT, COLUMN[0], COLUMN[1] * stiffer, True))
        for line in range(bays):
            add(node(floor, line), node(floor, line + 1), beam(BAY, BEAM[0], BEAM[1] * stiffer, False))
    k = k[3 * columns :, 3 * columns :]  # fixed bases
    turning = np.arange(2, len(k), 3)
    moving = np.setdiff1d(np.arange(len(k)), turning)
    share = np.array([0.5 if line in (0, bays) else 1.0 for line in range(columns)])
    mass = np.repeat(np.tile(problem.FLOOR_MASS * share, storeys), 2)
    across = k[np.ix_(turning, moving)]
    return mass, k[np.ix_(moving, moving)] - across.T @ np.linalg.solve(k[np.ix_(turning, turning)], across)


def pair():
    """Mass [n], stiffness [n, n], Rayleigh coefficients (a0, b0), facing degrees of freedom of the six links, the two
    tops."""
    (m1, k1), (m2, k2) = (frame(*each) for each in zip(STOREYS, BAYS, STIFFER))
    mass = np.concatenate([m1, m2])
    stiffness = np.zeros((len(mass),) * 2)
    stiffness[: len(m1), : len(m1)], stiffness[len(m1) :, len(m1) :] = k1, k2
    w = np.sqrt(eigh(stiffness, np.diag(mass), eigvals_only=True, subset_by_index=(0, 5)))
    low, high = w[0], max(w[5], 2 * math.pi * 4)
    coefficients = 2 * problem.DAMPING * low * high / (low + high), 2 * problem.DAMPING / (low + high)
    left = lambda floor: 2 * ((floor - 1) * (BAYS[0] + 1) + BAYS[0])
    right = lambda floor: len(m1) + 2 * (floor - 1) * (BAYS[1] + 1)
    faces = [(left(floor), right(floor)) for floor in range(1, min(STOREYS) + 1)]
    return mass, stiffness, coefficients, faces, (left(STOREYS[0]), right(STOREYS[1]))
