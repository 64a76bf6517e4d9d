"""The models of this folder in OpenSees: the nodes, members, masses and motions of the YAML files. SI units.

In the plane OpenSees has x, y and a rotation from x to y; pounding has x, z and ry, which turns z into x: moments
change sign, shear forces do not. In space z is up in both, and the local axes are those of pounding: local z is upward
for beams and against x for columns.
"""

import math
import sys
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

FOLDER = Path(__file__).resolve().parent
sys.path.append(str(FOLDER.parents[1] / "benchmarks"))
from opensees_frames import plane_frame  # noqa: E402
from plane_frames import BAYS, STIFFER, STOREYS  # noqa: E402

STEP = 0.005  # of the record; stored peaks are maxima at its multiples [s]
DAMPING = 0.05


def record():
    """Accelerations [m/s^2] every STEP from t = 0."""
    return np.loadtxt(FOLDER / "motion.txt")[:, 1]


class Plane:
    """One of the two plane frames: `side` 0 is the left one. Nodes are named "S.I": storey, column line."""

    dimension, directions = 2, ("x", "z", "ry")
    components = [f"{end} {force}" for end in ("start", "end") for force in ("N", "Vz", "My")]
    duration, steps = 20.0, [1e-3, 5e-4, 2.5e-4, 1.25e-4]

    def __init__(self, side):
        self.side, self.storeys, self.bays = side, STOREYS[side], BAYS[side]
        self.reported_nodes = [f"{s}.{i}" for s in range(1, self.storeys + 1) for i in (0, self.bays)]
        self.reported_members = ["column 1.0", f"column {self.storeys // 2}.1", f"beam x {self.storeys}.0"]

    def build(self):
        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        ops.geomTransf("Linear", 1)
        self.node, _ = plane_frame(self.storeys, self.bays, STIFFER[self.side], 0.0, 1, 1)

    def tag(self, name):
        """Tag of a node or of a member."""
        *kind, place = name.split()
        s, i = map(int, place.split("."))
        if not kind:
            return self.node(s, i)
        return 1 + (s - 1) * (2 * self.bays + 1) + i + (self.bays + 1 if kind[0] == "beam" else 0)

    def constraints(self):
        ops.constraints("Plain")

    def rayleigh(self):
        """Sets the frequencies of Rayleigh damping to those of the pair, see `pair_periods`."""
        low, high = (2 * math.pi / t for t in pair_periods())
        self.frequencies = low, high

    def excite(self):
        ops.timeSeries("Path", 1, "-dt", STEP, "-values", *record().tolist())
        ops.pattern("UniformExcitation", 1, 1, "-accel", 1)

    def push(self):
        """Constant ground accelerations: 1 m/s^2 along x, g along z."""
        for node in ops.getNodeTags():
            m = ops.nodeMass(node, 1)
            if m > 0:
                ops.load(node, -m, -9.80665 * m, 0.0)

    def moved(self, name):
        ux, uz, turn = ops.nodeDisp(self.tag(name))
        return ux, uz, -turn

    def forces(self, name):
        n1, v1, m1, n2, v2, m2 = ops.eleResponse(self.tag(name), "localForce")
        return n1, v1, -m1, n2, v2, -m2

    def base_shear(self):
        return [sum(self.forces(f"column 1.{i}")[1] for i in range(self.bays + 1))]


class LinkedPlane:
    """Both plane frames in one model, with links of `pounding.opensees` between their facing nodes at every common
    floor."""

    def __init__(self, **link):
        """`link`: keyword arguments of pounding.opensees.link, including gap= and law=."""
        from pounding import opensees

        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        ops.geomTransf("Linear", 1)
        left, _ = plane_frame(STOREYS[0], BAYS[0], STIFFER[0], 0.0, 1, 1)
        right, _ = plane_frame(STOREYS[1], BAYS[1], STIFFER[1], 18.02, 1001, 1001)
        # Nodes from the ground up.
        self.faces = {
            "left": [left(s, BAYS[0]) for s in range(1, STOREYS[0] + 1)],
            "right": [right(s, 0) for s in range(1, STOREYS[1] + 1)],
        }
        self.links = [opensees.link(5000 + i, a, b, **link) for i, (a, b) in enumerate(zip(*self.faces.values()))]


class Space:
    """Four storeys, three bays by two, floors rigid in their plane, one corner heavier. Nodes are named "S.I.K"."""

    dimension, directions = 3, ("x", "y", "z", "rx", "ry", "rz")
    components = [f"{end} {force}" for end in ("start", "end") for force in ("N", "Vy", "Vz", "T", "My", "Mz")]
    duration, steps = 5.0, [2.5e-3, 1.25e-3, 6.25e-4, 3.125e-4]
    storeys = 4
    heights, widths_x, widths_y = [3.5, 3.0, 3.0, 3.0], [5.0, 6.0, 4.5], [6.0, 5.0]
    floor_mass, corner_mass = [120e3, 120e3, 120e3, 90e3], 25e3
    young, shear = 30e9, 12.5e9
    # area, shear areas along local y and z, torsion, inertia about local y and z: 0.4 x 0.6 m and 0.3 x 0.5 m.
    column = 0.24, 0.2, 0.2, 7.5e-3, 7.2e-3, 3.2e-3
    beam = 0.15, 0.125, 0.125, 2.8e-3, 3.125e-3, 1.125e-3
    y_amplitude, y_period = 1.5, 0.7
    reported_nodes = ["1.3.0", "2.0.2", "4.0.0", "4.3.2"]
    reported_members = ["column 1.0.0", "column 2.3.2", "beam x 3.1.1", "beam y 4.0.0"]

    def build(self):
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        for tag, leaning in enumerate([(-1, 0, 0), (0, 0, 1)], 1):
            ops.geomTransf("Linear", tag, *leaning)
        lines = [np.concatenate([[0], np.cumsum(widths)]) for widths in (self.heights, self.widths_x, self.widths_y)]
        shares = []
        for widths in (self.widths_x, self.widths_y):
            half = np.array(widths) / 2
            shares.append((np.append(half, 0) + np.append(0, half)) / sum(widths))
        self.tags = {}
        for s, z in enumerate(lines[0]):
            floor = []
            for i, x in enumerate(lines[1]):
                for k, y in enumerate(lines[2]):
                    tag = self.tags[f"{s}.{i}.{k}"] = len(self.tags) + 1
                    ops.node(tag, x, y, z)
                    if s == 0:
                        ops.fix(tag, *[1] * 6)
                        continue
                    floor.append(tag)
                    m = self.floor_mass[s - 1] * shares[0][i] * shares[1][k] + (self.corner_mass if i == k == 0 else 0)
                    ops.mass(tag, m, m, m, 0.0, 0.0, 0.0)
            if s:
                master = 10000 + s
                ops.node(master, lines[1][-1] / 2, lines[2][-1] / 2, z)
                ops.fix(master, 0, 0, 1, 1, 1, 0)
                ops.rigidDiaphragm(3, master, *floor)
        number = 0
        for s in range(1, self.storeys + 1):
            for i in range(len(lines[1])):
                for k in range(len(lines[2])):
                    here = f"{s}.{i}.{k}"
                    members = [(f"column {here}", f"{s - 1}.{i}.{k}", here, self.column, 1)]
                    if i + 1 < len(lines[1]):
                        members.append((f"beam x {here}", here, f"{s}.{i + 1}.{k}", self.beam, 2))
                    if k + 1 < len(lines[2]):
                        members.append((f"beam y {here}", here, f"{s}.{i}.{k + 1}", self.beam, 2))
                    for name, a, b, (area, along_y, along_z, torsion, about_y, about_z), axes in members:
                        number += 1
                        self.tags[name] = number
                        ops.element(
                            "ElasticTimoshenkoBeam",
                            number,
                            self.tags[a],
                            self.tags[b],
                            self.young,
                            self.shear,
                            area,
                            torsion,
                            about_y,
                            about_z,
                            along_y,
                            along_z,
                            axes,
                        )

    def constraints(self):
        ops.constraints("Transformation")

    def rayleigh(self):
        """Sets the frequencies of Rayleigh damping to those of the first two modes."""
        self.frequencies = tuple(np.sqrt(ops.eigen(6)[:2]))

    def excite(self):
        ops.timeSeries("Path", 1, "-dt", STEP, "-values", *record().tolist())
        ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
        ops.timeSeries("Trig", 2, 0.0, 2 * self.duration, self.y_period, "-factor", self.y_amplitude)
        ops.pattern("UniformExcitation", 2, 2, "-accel", 2)

    def push(self):
        """Constant ground accelerations: 1 m/s^2 along x, 0.5 along y, g along z."""
        for node in ops.getNodeTags():
            m = ops.nodeMass(node, 1)
            if m > 0:
                ops.load(node, -m, -0.5 * m, -9.80665 * m, 0.0, 0.0, 0.0)

    def moved(self, name):
        return ops.nodeDisp(self.tags[name])

    def forces(self, name):
        return ops.eleResponse(self.tags[name], "localForce")

    def base_shear(self):
        feet = [self.forces(name) for name in self.tags if name.startswith("column 1.")]
        return [sum(f[2] for f in feet), -sum(f[1] for f in feet)]


def periods(model, count=6):
    model.build()
    model.constraints()
    return [2 * math.pi / math.sqrt(x) for x in ops.eigen(count)]


def pair_periods():
    """Longest period of the pair of plane frames, and the shorter of its sixth period and 0.25 s [s]."""
    if not hasattr(pair_periods, "kept"):
        both = sorted([t for side in (0, 1) for t in periods(Plane(side))], reverse=True)
        pair_periods.kept = both[0], min(both[5], 0.25)
    return pair_periods.kept


def coefficients(frequencies):
    """Rayleigh damping a0 M + b0 K, 5 % at both frequencies [rad/s]: a0 [1/s], b0 [s]."""
    low, high = frequencies
    return 2 * DAMPING * low * high / (low + high), 2 * DAMPING / (low + high)


def statics(model):
    """Static response to the accelerations of `push`."""
    model.build()
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    model.push()
    model.constraints()
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.algorithm("Linear")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    if ops.analyze(1):
        raise RuntimeError("the static analysis failed")
    return {
        "nodes": {name: list(model.moved(name)) for name in model.reported_nodes},
        "members": {name: list(model.forces(name)) for name in model.reported_members},
        "base_shear": model.base_shear(),
    }


def history(model, step):
    """Newmark with constant average acceleration: all reported signals [signal, sample], one sample every STEP."""
    model.rayleigh()
    a0, b0 = coefficients(model.frequencies)
    model.build()
    model.constraints()
    model.excite()
    ops.rayleigh(a0, 0.0, b0, 0.0)
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.algorithm("Linear", False, False, True)  # factorized once
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    rows = []
    count = round(STEP / step)
    for sample in range(round(model.duration / STEP) + 1):
        if sample and ops.analyze(count, step):
            raise RuntimeError(f"OpenSees stopped at {ops.getTime()} s")
        row = [u for name in model.reported_nodes for u in model.moved(name)]
        row += [f for name in model.reported_members for f in model.forces(name)]
        rows.append(row + model.base_shear())
    return np.array(rows).T
