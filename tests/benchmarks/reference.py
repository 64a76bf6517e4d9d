#!/usr/bin/env python3
"""References for both programs: DOP853 between located events.

    python3 tests/benchmarks/reference.py oscillators     # rewrites reference/two_oscillators.json, half a minute
    python3 tests/benchmarks/reference.py frames          # rewrites reference/plane_frames.json, five minutes

Each law is integrated twice, the second time with a hundredfold tolerance; `doubt` is the larger of the relative
changes of displacements and peak forces.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np

import plane_frames
import problem
from contact import Contact, integrate
from motion import STEP, motion

FOLDER = Path(__file__).parent / "reference"


def oscillators(law, rtol):
    m = np.array(problem.MASSES)
    w = 2 * np.pi / np.array(problem.PERIODS)

    def slope(t, y, forces):
        ground = problem.AMPLITUDE * math.sin(2 * math.pi * problem.FREQUENCY * t)
        f = forces.get(0, 0.0)
        return np.concatenate(
            [y[2:], -ground - 2 * problem.DAMPING * w * y[2:] - w * w * y[:2] - np.array([f, -f]) / m]
        )

    relative = lambda y, link: (y[0] - y[1] - problem.GAP, y[2] - y[3])
    samples = np.arange(round(problem.DURATION / problem.SAMPLE) + 1) * problem.SAMPLE
    kept, peaks, _ = integrate(
        slope,
        [Contact(law, problem.OSCILLATOR_MASS)],
        relative,
        np.zeros(4),
        [problem.DURATION],
        samples,
        rtol,
        1e-2 * rtol,
        2e-3,
    )
    return {"displacement": kept[:, :2].T, "peaks": peaks}


def frames(law, rtol):
    mass, stiffness, (a0, b0), faces, tops = plane_frames.pair()
    n = len(mass)
    # Rotations have neither mass nor load, so that K (u + b0 v) condenses like K u.
    system = np.zeros((2 * n, 2 * n))
    system[:n, n:] = np.eye(n)
    system[n:, :n] = -stiffness / mass[:, None]
    system[n:, n:] = -b0 * stiffness / mass[:, None] - a0 * np.eye(n)
    times, record = motion()
    along = np.zeros(2 * n)
    along[n::2] = 1.0

    def slope(t, y, forces):
        part = min(int(t / STEP), len(record) - 2)
        y1 = system @ y - along * (record[part] + (record[part + 1] - record[part]) * (t / STEP - part))
        for link, f in forces.items():
            a, b = faces[link]
            y1[n + a] -= f / mass[a]
            y1[n + b] += f / mass[b]
        return y1

    relative = lambda y, link: (
        y[faces[link][0]] - y[faces[link][1]] - problem.GAP,
        y[n + faces[link][0]] - y[n + faces[link][1]],
    )
    samples = np.arange(round(problem.FRAME_DURATION / problem.FRAME_SAMPLE) + 1) * problem.FRAME_SAMPLE
    contacts = [Contact(law, problem.FRAME_MASS) for _ in faces]
    kept, peaks, largest = integrate(
        slope, contacts, relative, np.zeros(2 * n), times[1:], samples, rtol, 1e-3 * rtol, STEP / 2
    )
    return {"displacement": kept[:, list(tops)].T, "peaks": peaks, "peak_displacement": largest[list(tops)]}


def difference(a, b):
    u = np.abs(a["displacement"] - b["displacement"]).max() / np.abs(b["displacement"]).max()
    if [len(p) for p in a["peaks"]] != [len(p) for p in b["peaks"]]:
        return 1.0
    return float(max([u] + [abs(p / q - 1) for x, y in zip(a["peaks"], b["peaks"]) for p, q in zip(x, y)]))


def main(which):
    solve, rtol, name = {
        "oscillators": (oscillators, 1e-12, "two_oscillators"),
        "frames": (frames, 1e-10, "plane_frames"),
    }[which]
    store = {
        "command": f"python3 tests/benchmarks/reference.py {which}",
        "method": f"scipy DOP853, rtol {rtol:g}, every touch, separation and corner of the law located",
    }
    if which == "frames":
        a0, b0 = plane_frames.pair()[2]
        store |= {"rayleigh": [a0, b0], "record_square_sum": float((motion()[1] ** 2).sum())}
    store["laws"] = {}
    for law in [*problem.LAWS, problem.OPENSEES_REFERENCE["hertz_damped"]]:
        tight = solve(law, rtol)
        doubt = difference(solve(law, 100 * rtol), tight)
        print(law, [len(p) for p in tight["peaks"]], f"doubt {doubt:.1e}", flush=True)
        digits = lambda values: [float(f"{x:.11g}") for x in values]
        store["laws"][law] = {
            "doubt": doubt,
            "displacement": [digits(u) for u in tight["displacement"]],
            "peaks": [digits(p) for p in tight["peaks"]],
        }
        if "peak_displacement" in tight:
            store["laws"][law]["peak_displacement"] = digits(tight["peak_displacement"])
    (FOLDER / f"{name}.json").write_text(json.dumps(store).replace('"displacement"', '\n"displacement"') + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
