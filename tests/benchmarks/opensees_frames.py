#!/usr/bin/env python3
"""One run of a pair of frames in OpenSees, in this process: prints one JSON object.

    python3 opensees_frames.py plane LAW STEP MOTION
    python3 opensees_frames.py space SIZE SYSTEM ALGORITHM STEPS MOTION
    python3 opensees_frames.py towers CASE SYSTEM STEPS

plane: the pair of plane_frames.py, 20 s, BandGeneral, Newmark, Newton to increments of 1e-9; `wall_seconds` is the time
of the analysis loop only. The recorder of the largest forces (one number per link) is included. space: two regular 3D
frames facing each other with linear links, 0.02 mm apart and started during strong motion, so that links are in
contact; seconds of each step. MOTION: two columns, s and m/s^2, every 0.005 s. towers: those of towers.py with flexible
floors, in contact, Newton; one Rayleigh damping for all, whose cost is independent of its values.
"""

import json
import resource
import statistics
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

import plane_frames
import problem
from plane_frames import BAY, BEAM, COLUMN, ELASTICITY, HEIGHT

# Storeys of both frames and bays along and across: name -> number of equations.
SIZES = {"4536": ((12, 9), (5, 5)), "19440": ((20, 16), (9, 8))}
SPACE_STEP, SPACE_GAP, SPACE_START = 5e-3, 2e-5, 4.0


def plane_frame(storeys, bays, stiffer, x0, first_node, first_element):
    """Adds a plane frame; returns node(floor, line) and the next free element tag."""
    node = lambda floor, line: first_node + floor * (bays + 1) + line
    tag = first_element
    for floor in range(storeys + 1):
        for line in range(bays + 1):
            ops.node(node(floor, line), x0 + line * BAY, floor * HEIGHT)
            if floor == 0:
                ops.fix(node(floor, line), 1, 1, 1)
            else:
                m = problem.FLOOR_MASS * (0.5 if line in (0, bays) else 1.0)
                ops.mass(node(floor, line), m, m, 0.0)
    for floor in range(1, storeys + 1):
        for line in range(bays + 1):
            ops.element(
                "elasticBeamColumn",
                tag,
                node(floor - 1, line),
                node(floor, line),
                COLUMN[0],
                ELASTICITY,
                COLUMN[1] * stiffer,
                1,
            )
            tag += 1
        for line in range(bays):
            ops.element(
                "elasticBeamColumn",
                tag,
                node(floor, line),
                node(floor, line + 1),
                BEAM[0],
                ELASTICITY,
                BEAM[1] * stiffer,
                1,
            )
            tag += 1
    return node, tag


def space_frame(storeys, bays, stiffer, x0, first_node, first_element, y0=0.0):
    """Adds a 3D frame; returns node(floor, line, row) and the next free element tag."""
    along, across = bays
    node = lambda floor, line, row: first_node + (floor * (across + 1) + row) * (along + 1) + line
    shear, twist_column, twist_beam = ELASTICITY / 2.4, 0.141 * 0.55**4, 0.2 * 0.3**3 * 0.6
    weak = 0.5 * 0.6 * 0.3**3 / 12
    tag = first_element
    lines = [(line, row) for row in range(across + 1) for line in range(along + 1)]
    for floor in range(storeys + 1):
        for line, row in lines:
            ops.node(node(floor, line, row), x0 + line * BAY, y0 + row * BAY, floor * HEIGHT)
            if floor == 0:
                ops.fix(node(floor, line, row), *[1] * 6)
            else:
                m = problem.FLOOR_MASS * (0.5 if line in (0, along) else 1.0) * (0.5 if row in (0, across) else 1.0)
                ops.mass(node(floor, line, row), m, m, m, 0.0, 0.0, 0.0)
    for floor in range(1, storeys + 1):
        for line, row in lines:
            inertia = COLUMN[1] * stiffer
            ops.element(
                "elasticBeamColumn",
                tag,
                node(floor - 1, line, row),
                node(floor, line, row),
                COLUMN[0],
                ELASTICITY,
                shear,
                twist_column,
                inertia,
                inertia,
                1,
            )
            tag += 1
        beams = [(node(floor, line, row), node(floor, line + 1, row), 2) for line, row in lines if line < along]
        beams += [(node(floor, line, row), node(floor, line, row + 1), 3) for line, row in lines if row < across]
        for a, b, turn in beams:
            ops.element(
                "elasticBeamColumn", tag, a, b, BEAM[0], ELASTICITY, shear, twist_beam, weak, BEAM[1] * stiffer, turn
            )
            tag += 1
    return node, tag


def links(pairs, law, tag):
    ops.uniaxialMaterial(law[0], 1, *law[1:])
    for i, (a, b) in enumerate(pairs):
        ops.element("twoNodeLink", tag + i, a, b, "-mat", 1, "-dir", 1)
    return list(range(tag, tag + len(pairs)))


def excite(file, start=0.0):
    """The motion from time `start` [s]."""
    a = np.loadtxt(file)[round(start / 0.005) :, 1]
    ops.timeSeries("Path", 1, "-dt", 0.005, "-values", *a.tolist())
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    a0, b0 = plane_frames.pair()[2]
    ops.rayleigh(a0, 0.0, b0, 0.0)


def analysis(system, algorithm):
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system(system)
    ops.test("NormDispIncr", 1e-9, 50, 0)
    ops.algorithm(algorithm)
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def plane(law, step, file):
    (s1, s2), (b1, b2), (k1, k2) = plane_frames.STOREYS, plane_frames.BAYS, plane_frames.STIFFER
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    left, tag = plane_frame(s1, b1, k1, 0.0, 1, 1)
    right, tag = plane_frame(s2, b2, k2, b1 * BAY + problem.GAP, 1001, tag)
    pairs = [(left(floor, b1), right(floor, 0)) for floor in range(1, min(s1, s2) + 1)]
    tags = links(pairs, problem.opensees_material(law, problem.FRAME_MASS), tag)
    excite(file)
    with tempfile.TemporaryDirectory() as folder:
        largest = Path(folder) / "largest"
        ops.recorder("EnvelopeElement", "-file", str(largest), "-precision", 12, "-ele", *tags, "material", 1, "stress")
        analysis("BandGeneral", "Newton")
        count, samples = round(problem.FRAME_SAMPLE / step), round(problem.FRAME_DURATION / problem.FRAME_SAMPLE)
        u = np.zeros((2, samples + 1))
        start = time.perf_counter()
        for i in range(1, samples + 1):
            if ops.analyze(count, step):
                return {"failed_at": ops.getTime(), "wall_seconds": time.perf_counter() - start}
            u[:, i] = ops.nodeDisp(left(s1, b1), 1), ops.nodeDisp(right(s2, 0), 1)
        wall = time.perf_counter() - start
        ops.wipe()
        peaks = [-float(word) for word in largest.read_text().splitlines()[0].split()]
    return {"wall_seconds": wall, "steps": count * samples, "peaks": peaks, "displacement": u.tolist()}


def space(size, system, algorithm, steps, file):
    (s1, s2), bays = SIZES[size]
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.geomTransf("Linear", 1, 0, 1, 0)
    ops.geomTransf("Linear", 2, 0, -1, 0)
    ops.geomTransf("Linear", 3, 1, 0, 0)
    left, tag = space_frame(s1, bays, 1.0, 0.0, 1, 1)
    right, tag = space_frame(s2, bays, 1.7, bays[0] * BAY + SPACE_GAP, 100001, tag)
    pairs = [
        (left(floor, bays[0], row), right(floor, 0, row))
        for floor in range(1, min(s1, s2) + 1)
        for row in range(bays[1] + 1)
    ]
    tags = links(pairs, ("ElasticPPGap", problem.LINEAR_STIFFNESS, -1e15, -SPACE_GAP, 0.0), tag)
    excite(file, SPACE_START)
    analysis(system, algorithm)
    seconds, iterations, touching = [], [], []
    for _ in range(steps):
        start = time.perf_counter()
        if ops.analyze(1, SPACE_STEP):
            return {"failed_at": ops.getTime()}
        seconds.append(time.perf_counter() - start)
        iterations.append(ops.testIter())
        touching.append(sum(ops.eleResponse(tag, "material", 1, "stress")[0] != 0 for tag in tags))
    # The first step also orders the equations, and the first factorization analyses them.
    return {
        "unknowns": ops.systemSize(),
        "links": len(tags),
        "seconds_per_step": statistics.median(seconds[1:]),
        "iterations_per_step": statistics.mean(iterations[1:]),
        "links_in_contact": statistics.mean(touching[1:]),
    }


def towers(case, system, steps):
    import towers as of_program  # which measures the program

    count, bays, _ = of_program.CASES[case]
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.geomTransf("Linear", 1, 0, 1, 0)
    ops.geomTransf("Linear", 2, 0, -1, 0)
    ops.geomTransf("Linear", 3, 1, 0, 0)
    nodes, tag, width = {}, 1, bays * BAY
    for k in range(of_program.ROWS[count][1]):
        for i in range(of_program.ROWS[count][0]):
            place = i * width, k * (width + of_program.ACROSS)
            nodes[i, k], tag = space_frame(
                of_program.STOREYS,
                (bays, bays),
                of_program.stiffer(i, k),
                place[0],
                1 + 100000 * len(nodes),
                tag,
                place[1],
            )
            for floor in range(1, of_program.STOREYS + 1):
                for row in range(bays + 1):
                    for line in range(bays + 1):
                        ops.setNodeVel(nodes[i, k](floor, line, row), 1, of_program.speed(count, i), "-commit")
    tags = []
    for axis, gap in enumerate((0.0, of_program.ACROSS)):
        ops.uniaxialMaterial("ElasticPPGap", 1 + axis, of_program.BUMPER, -1e15, -gap, 0.0)
        for a, b in ((a, b) for a, b, along in of_program.neighbours(count) if along == axis):
            for floor in range(1, of_program.STOREYS + 1):
                for edge in (0, bays):
                    ends = (bays, edge), (0, edge)
                    one, other = (nodes[t](floor, *(end if axis == 0 else end[::-1])) for t, end in zip((a, b), ends))
                    # Nodes at the same position need explicit axes.
                    ops.element(
                        "twoNodeLink", tag, one, other, "-mat", 1 + axis, "-dir", 1 + axis, "-orient", 1, 0, 0, 0, 1, 0
                    )
                    tags.append(tag)
                    tag += 1
    a0, b0 = plane_frames.pair()[2]
    ops.rayleigh(a0, 0.0, b0, 0.0)
    analysis(system, "Newton")
    seconds, iterations = [], []
    for _ in range(steps):
        start = time.perf_counter()
        if ops.analyze(1, of_program.STEP):
            return {"failed_at": ops.getTime()}
        seconds.append(time.perf_counter() - start)
        iterations.append(ops.testIter())
    touching = sum(ops.eleResponse(tag, "force")[0] != 0 for tag in tags)
    return {
        "unknowns": ops.systemSize(),
        "links": len(tags),
        "seconds_per_step": of_program.quarter(seconds[1:]),
        "iterations_per_step": statistics.mean(iterations[1:]),
        "pressed": touching,
        "memory_mb": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024,
    }


if __name__ == "__main__":
    kind, *rest = sys.argv[1:]
    if kind == "plane":
        result = plane(rest[0], float(rest[1]), rest[2])
    elif kind == "towers":
        result = towers(rest[0], rest[1], int(rest[2]))
    else:
        result = space(rest[0], rest[1], rest[2], int(rest[3]), rest[4])
    print(json.dumps(result))
