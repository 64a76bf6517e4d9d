#!/usr/bin/env python3
"""One run of the two oscillators in OpenSees, in this process: prints one JSON object.

    python3 opensees_oscillators.py LAW STEP REPEATS

Average acceleration (Newmark), Newton to increments of 1e-12 m. `wall_seconds` are the times of the analysis loop only,
one per repeat, without recorders; the forces of all impacts come from a separate run, which is not timed.
"""

import json
import math
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

import problem


def build(law):
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in (1, 2, 3, 4):  # bases 1 and 3, masses 2 and 4
        ops.node(node, 0.0)
    for i, (m, period) in enumerate(zip(problem.MASSES, problem.PERIODS)):
        base, mass, w = 2 * i + 1, 2 * i + 2, 2 * math.pi / period
        ops.fix(base, 1)
        ops.mass(mass, m)
        ops.uniaxialMaterial("Elastic", i + 1, m * w * w, 2 * problem.DAMPING * w * m)
        ops.element("zeroLength", i + 1, base, mass, "-mat", i + 1, "-dir", 1)
    name, *values = problem.opensees_material(law, problem.OSCILLATOR_MASS)
    ops.uniaxialMaterial(name, 3, *values)
    ops.element("zeroLength", 3, 2, 4, "-mat", 3, "-dir", 1)
    ops.timeSeries("Trig", 1, 0.0, problem.DURATION + 1.0, 1 / problem.FREQUENCY, "-factor", problem.AMPLITUDE)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-12, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def analyse(step):
    """Displacements [2, n] at the samples, wall seconds, and the time of a failure or None."""
    count, samples = round(problem.SAMPLE / step), round(problem.DURATION / problem.SAMPLE)
    kept = np.zeros((2, samples + 1))
    start = time.perf_counter()
    for i in range(1, samples + 1):
        if ops.analyze(count, step):
            return kept, time.perf_counter() - start, ops.getTime()
        kept[:, i] = ops.nodeDisp(2, 1), ops.nodeDisp(4, 1)
    return kept, time.perf_counter() - start, None


def impact_peaks(force):
    """Largest force of each sequence of steps in contact (an open link gives exactly zero)."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], force != 0, [0]])))
    return [float(force[a:b].max()) for a, b in zip(edges[::2], edges[1::2])]


def main(law, step, repeats):
    walls = []
    for _ in range(repeats):
        build(law)
        kept, wall, failed = analyse(step)
        walls.append(wall)
        if failed:
            return {"law": law, "step": step, "failed_at": failed}
    build(law)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "force"
        ops.recorder("Element", "-file", str(file), "-precision", 12, "-ele", 3, "material", 1, "stress")
        analyse(step)
        ops.wipe()
        peaks = impact_peaks(-np.fromfile(file, sep=" "))
    return {"law": law, "step": step, "wall_seconds": walls, "displacement": kept.tolist(), "peaks": peaks}


if __name__ == "__main__":
    print(json.dumps(main(sys.argv[1], float(sys.argv[2]), int(sys.argv[3]))))
