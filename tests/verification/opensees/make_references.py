#!/usr/bin/env python3
"""Writes the references of this folder; needs openseespy, numpy and scipy.

    python3 make_references.py plane           # plane.json: two minutes
    python3 make_references.py space           # space.json: two minutes
    python3 make_references.py pounding        # plane_pounding.json: a few minutes
    python3 make_references.py linked STEP     # adds OpenSees' own runs with links to plane_pounding.json

plane, space: periods, static responses and histories of OpenSees. The histories are by Newmark at four halved steps and
Richardson extrapolation, which removes the error up to step^8; `doubt` is the change by the last halving. pounding: mass
and stiffness of the plane frames from OpenSees, integrated by DOP853 with steps that end at every touch, separation and
corner of a law. Newmark in OpenSees has errors of about 1e-3 there at practical steps.
"""

import json
import sys

import numpy as np
import openseespy.opensees as ops

import frames  # first: adds the folder of the benchmarks to the path
import problem
from contact import Contact, integrate
from frames import FOLDER, STEP, Plane, Space

KEPT = 0.5  # histories are stored at its multiples [s]


def digits(values):
    return [float(f"{x:.11g}") for x in values]


def richardson(coarse_to_fine):
    """Richardson extrapolation of results with an error in even powers of the step, which is halved each time."""
    table = list(coarse_to_fine)
    for power in range(1, len(table)):
        factor = 4.0**power
        table = [(factor * fine - coarse) / (factor - 1) for coarse, fine in zip(table, table[1:])]
    return table[-1]


def scales(model):
    """Signals that share a scale: (name, rows)."""
    size, at, groups = len(model.directions), 0, []
    for name in model.reported_nodes:
        turning = [at + i for i, d in enumerate(model.directions) if d.startswith("r")]
        groups += [sorted(set(range(at, at + size)) - set(turning)), turning]
        at += size
    for name in model.reported_members:
        moments = [at + i for i, c in enumerate(model.components) if c.split()[1][0] in "TM"]
        groups += [sorted(set(range(at, at + len(model.components))) - set(moments)), moments]
        at += len(model.components)
    return groups + [list(range(at, at + len(model.base_shear())))]


def linear(model):
    store = {"periods": digits(frames.periods(model)), "static": frames.statics(model)}
    runs = [frames.history(model, step) for step in model.steps]
    best, before = richardson(runs), richardson(runs[:-1])
    store["doubt"] = max(float(np.abs(best[g] - before[g]).max() / np.abs(best[g]).max()) for g in scales(model))
    store["newmark_error"] = {
        f"{step:g}": max(float(np.abs(best[g] - run[g]).max() / np.abs(best[g]).max()) for g in scales(model))
        for step, run in zip(model.steps, runs)
    }
    store["rayleigh_frequencies"] = list(model.frequencies)
    store["rayleigh"] = list(frames.coefficients(model.frequencies))
    every = round(KEPT / STEP)
    at = 0
    for kind, names, parts in (
        ("nodes", model.reported_nodes, model.directions),
        ("members", model.reported_members, model.components),
    ):
        store[kind] = {"parts": list(parts)}
        for name in names:
            rows = best[at : at + len(parts)]
            store[kind][name] = {
                "history": [digits(row[::every]) for row in rows],
                "peak": digits(np.abs(rows).max(axis=1)),
            }
            at += len(parts)
    store["base_shear"] = {
        "history": [digits(row[::every]) for row in best[at:]],
        "peak": digits(np.abs(best[at:]).max(axis=1)),
    }
    print(type(model).__name__, f"doubt {store['doubt']:.1e}", store["newmark_error"], flush=True)
    return store


def write(name, store):
    text = json.dumps(store, indent=1)
    # One line per list of numbers.
    out, depth, line = [], 0, ""
    for piece in text.split("\n"):
        word = piece.strip()
        if word.endswith("[") and depth == 0:
            line, depth = piece, 1
        elif depth:
            depth += word.endswith("[") - word.startswith("]")
            line += (" " if not line.endswith("[") and not word.startswith("]") else "") + word
            if depth == 0:
                out.append(line)
        else:
            out.append(piece)
    (FOLDER / name).write_text("\n".join(out) + "\n")


def header(words):
    return {
        "command": "python3 tests/verification/opensees/make_references.py " + words,
        "program": f"OpenSees {ops.version()}",
        "record": "motion.txt",
        "history_step": KEPT,
        "peaks_at_multiples_of": STEP,
    }


def make_linear(name, **models):
    steps = next(iter(models.values())).steps
    write(
        f"{name}.json",
        header(name)
        | {"method": f"Newmark, steps {steps} s, Richardson"}
        | {structure: linear(model) for structure, model in models.items()},
    )


def matrices(model):
    """Masses [n] of all degrees of freedom, stiffness [n, n] and the index of (node, direction), from OpenSees."""
    model.build()
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.algorithm("Linear")
    ops.integrator("GimmeMCK", 0.0, 0.0, 1.0)
    ops.analysis("Transient")
    ops.analyze(1, 0.0)
    size = ops.systemSize()
    stiffness = np.array(ops.printA("-ret")).reshape(size, size)
    mass = np.zeros(size)
    places = {node: ops.nodeDOFs(node) for node in ops.getNodeTags()}
    for node, its in places.items():
        for direction, place in enumerate(its):
            if place >= 0:
                mass[place] = ops.nodeMass(node, direction + 1)
    return mass, stiffness, lambda name, direction: places[model.tag(name)][direction]


class Pair:
    """The two plane frames with static condensation of the massless, unloaded rotations: K (u + b0 v) condenses like K u."""

    def __init__(self):
        self.models = Plane(0), Plane(1)
        parts = [matrices(model) for model in self.models]
        masses, stiffnesses, places, n = [], [], [], 0
        for mass, k, place in parts:
            moving, turning = np.nonzero(mass)[0], np.nonzero(mass == 0)[0]
            across = k[np.ix_(turning, moving)]
            stiffnesses.append(
                k[np.ix_(moving, moving)] - across.T @ np.linalg.solve(k[np.ix_(turning, turning)], across)
            )
            masses.append(mass[moving])
            at = {dof: n + j for j, dof in enumerate(moving)}
            places.append(lambda name, place=place, at=at: at[place(name, 0)])
            n += len(moving)
        self.mass, self.places, self.n = np.concatenate(masses), places, n
        self.stiffness = np.zeros((n, n))
        first = len(masses[0])
        self.stiffness[:first, :first], self.stiffness[first:, first:] = stiffnesses
        self.along = np.zeros(n)
        for model, place in zip(self.models, places):
            for s in range(1, model.storeys + 1):
                for i in range(model.bays + 1):
                    self.along[place(f"{s}.{i}")] = 1
        self.left = [places[0](f"{s}.{self.models[0].bays}") for s in range(1, self.models[0].storeys + 1)]
        self.right = [places[1](f"{s}.0") for s in range(1, self.models[1].storeys + 1)]

    def run(self, law, rtol):
        n, m = self.n, self.mass
        a0, b0 = frames.coefficients([2 * np.pi / t for t in frames.pair_periods()])
        system = np.zeros((2 * n, 2 * n))
        system[:n, n:] = np.eye(n)
        system[n:, :n] = -self.stiffness / m[:, None]
        system[n:, n:] = -b0 * self.stiffness / m[:, None] - a0 * np.eye(n)
        ground = frames.record()
        faces = list(zip(self.left, self.right))
        along = np.concatenate([np.zeros(n), self.along])

        def slope(t, y, forces):
            part = min(int(t / STEP), len(ground) - 2)
            rate = system @ y - along * (ground[part] + (ground[part + 1] - ground[part]) * (t / STEP - part))
            for link, f in forces.items():
                a, b = faces[link]
                rate[n + a] -= f / m[a]
                rate[n + b] += f / m[b]
            return rate

        def relative(y, link):
            a, b = faces[link]
            return y[a] - y[b] - problem.GAP, y[n + a] - y[n + b]

        times = np.arange(len(ground)) * STEP
        contacts = [Contact(law, problem.FRAME_MASS) for _ in faces]
        kept, peaks, _ = integrate(
            slope, contacts, relative, np.zeros(2 * n), times[1:], times, rtol, 1e-3 * rtol, STEP / 2
        )
        moved = {"left": kept[:, self.left].T, "right": kept[:, self.right].T}
        drift = {side: np.abs(np.diff(u, axis=0, prepend=0)).max(axis=1) for side, u in moved.items()}
        return {
            "peaks": peaks,
            "drift": drift,
            "displacement": {side: np.abs(u).max(axis=1) for side, u in moved.items()},
        }


def difference(a, b):
    if [len(p) for p in a["peaks"]] != [len(p) for p in b["peaks"]]:
        return 1.0
    worst = [abs(p / q - 1) for x, y in zip(a["peaks"], b["peaks"]) for p, q in zip(x, y)]
    for kind in ("drift", "displacement"):
        worst += [np.abs(a[kind][side] / b[kind][side] - 1).max() for side in ("left", "right")]
    return float(max(worst))


def make_pounding():
    path = FOLDER / "plane_pounding.json"
    store = json.loads(path.read_text()) if path.exists() else {"laws": {}}
    store = header("pounding") | {
        "method": "matrices of OpenSees, scipy DOP853, rtol 1e-10; doubt: change from rtol 1e-8",
        "rayleigh_periods": list(frames.pair_periods()),
        "laws": store["laws"],
    }
    pair = Pair()
    for law in problem.LAWS:
        tight = pair.run(law, 1e-10)
        entry = store["laws"].setdefault(law, {})
        entry |= {
            "doubt": difference(pair.run(law, 1e-8), tight),
            "impacts": [len(p) for p in tight["peaks"]],
            "peak_force": digits(max(p, default=0.0) for p in tight["peaks"]),
        }
        for kind in ("drift", "displacement"):
            entry[f"peak_{kind}"] = {side: digits(values) for side, values in tight[kind].items()}
        print(law, entry["impacts"], f"doubt {entry['doubt']:.1e}", flush=True)
        write(path.name, store)


def make_linked(step):
    """OpenSees' own links and Newmark: peak forces, or the time at which Newton's method fails."""
    import opensees_frames

    path = FOLDER / "plane_pounding.json"
    store = json.loads(path.read_text())
    for law in problem.LAWS:
        run = opensees_frames.plane(law, step, FOLDER / "motion.txt")
        reason = (
            {"failed_at": run["failed_at"]}
            if "failed_at" in run
            else {"peak_force": digits(p + 0.0 for p in run["peaks"])}
        )
        store["laws"][law]["opensees"] = {"command": f"make_references.py linked {step:g}", "step": step} | reason
        print(law, store["laws"][law]["opensees"], store["laws"][law]["peak_force"], flush=True)
        write(path.name, store)


if __name__ == "__main__":
    what, *rest = sys.argv[1:]
    {
        "plane": lambda: make_linear("plane", left=Plane(0), right=Plane(1)),
        "space": lambda: make_linear("space", tower=Space()),
        "pounding": make_pounding,
        "linked": lambda: make_linked(float(rest[0])),
    }[what]()
