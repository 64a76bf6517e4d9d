#!/usr/bin/env python3
"""One run of the frames with hinges of yielding_frames.py in OpenSees, in this process: prints one JSON object.

    python3 opensees_yielding.py frame STEP RECORD
    python3 opensees_yielding.py pair STEP MOTION

elasticBeamColumn and zeroLength hinges of Steel01, Newmark, Newton to increments of 1e-10, BandGeneral. RECORD and
MOTION: two columns, s and m/s^2, at a fixed step. `wall_seconds` is the time of the analysis loop only, including
recorders of the peaks.
"""

import json
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

import plane_frames
import problem
import yielding_frames as of
from plane_frames import BAY, BEAM, COLUMN, ELASTICITY, HEIGHT


class Builder:
    """Nodes and elements of frames with hinges at the ends of beams and at feet."""

    def __init__(self):
        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        ops.geomTransf("Linear", 1)
        self.tag = self.hinge_node = 100000

    def hinge(self, node, place, material):
        """A node at the position of this one with its own rotation."""
        self.hinge_node += 1
        self.tag += 1
        ops.node(self.hinge_node, *place)
        ops.equalDOF(node, self.hinge_node, 1, 2)
        ops.element("zeroLength", self.tag, node, self.hinge_node, "-mat", material, "-dir", 6)
        return self.hinge_node

    def beam(self, a, b, young, area, inertia):
        self.tag += 1
        ops.element("elasticBeamColumn", self.tag, a, b, area, young, inertia, 1)

    def frame(self, storeys, bays, x0, first, young, column, beam, node_mass, moments):
        """node(floor, line)."""
        node = lambda floor, line: first + floor * (bays + 1) + line
        place = lambda floor, line: (x0 + line * BAY, floor * HEIGHT)
        for material, moment, inertia, length in (
            (first, moments[0], beam[1], BAY),
            (first + 1, moments[1], column[1], HEIGHT),
        ):
            ops.uniaxialMaterial(
                "Steel01", material, moment, of.STIFFER_THAN_MEMBERS * 6 * young * inertia / length, of.HARDENING
            )
        for floor in range(storeys + 1):
            for line in range(bays + 1):
                ops.node(node(floor, line), *place(floor, line))
                if floor == 0:
                    ops.fix(node(floor, line), 1, 1, 1)
                else:
                    mass = node_mass * (0.5 if line in (0, bays) else 1.0)
                    ops.mass(node(floor, line), mass, mass, 0.0)
        for line in range(bays + 1):
            foot = self.hinge(node(0, line), place(0, line), first + 1)
            for floor in range(1, storeys + 1):
                self.beam(foot if floor == 1 else node(floor - 1, line), node(floor, line), young, *column)
        for floor in range(1, storeys + 1):
            for line in range(bays):
                ends = [self.hinge(node(floor, at), place(floor, at), first) for at in (line, line + 1)]
                self.beam(*ends, young, *beam)
        return node


def analysis(record, scale, period):
    ops.rayleigh(of.by_mass(period), 0.0, 0.0, 0.0)
    motion = np.loadtxt(record)
    ops.timeSeries("Path", 1, "-dt", float(motion[1, 0] - motion[0, 0]), "-values", *(scale * motion[:, 1]).tolist())
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-10, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def envelope(file, kind, *words):
    ops.recorder(kind, "-file", str(file), "-precision", 14, *words)


def read(file):
    """The largest magnitudes, which are the last row of an envelope."""
    return [float(word) for word in file.read_text().splitlines()[-1].split()]


def frame(step, record, folder):
    node = Builder().frame(
        of.FRAME_STOREYS, 1, 0.0, 1, of.FRAME_E, of.FRAME_COLUMN, of.FRAME_BEAM, 2 * of.FRAME_MASS, of.FRAME_MOMENTS
    )
    floors = [node(floor, 0) for floor in range(1, of.FRAME_STOREYS + 1)]
    envelope(folder / "peaks", "EnvelopeNode", "-node", *floors, "-dof", 1, "disp")
    analysis(record, of.FRAME_SCALE, of.FRAME_PERIOD)
    start = time.perf_counter()
    if ops.analyze(round(of.FRAME_END / step), step):
        return {"failed_at": ops.getTime()}
    seconds = time.perf_counter() - start
    ends = [ops.nodeDisp(floor, 1) for floor in floors]
    ops.wipe()
    return {"wall_seconds": seconds, "peaks": read(folder / "peaks"), "ends": ends}


def pair(step, record, folder):
    builder, nodes = Builder(), []
    for k in range(2):
        stiffer = plane_frames.STIFFER[k]
        nodes.append(
            builder.frame(
                plane_frames.STOREYS[k],
                plane_frames.BAYS[k],
                k * (plane_frames.BAYS[0] * BAY + problem.GAP),
                1 + 1000 * k,
                ELASTICITY,
                (COLUMN[0], COLUMN[1] * stiffer),
                (BEAM[0], BEAM[1] * stiffer),
                problem.FLOOR_MASS,
                of.PAIR_MOMENTS[k],
            )
        )
    ops.uniaxialMaterial(
        *problem.opensees_material("linear_spring", problem.FRAME_MASS)[:1],
        5000,
        *problem.opensees_material("linear_spring", problem.FRAME_MASS)[1:],
    )
    tags = []
    for floor in range(1, min(plane_frames.STOREYS) + 1):
        builder.tag += 1
        tags.append(builder.tag)
        ops.element(
            "twoNodeLink",
            builder.tag,
            nodes[0](floor, plane_frames.BAYS[0]),
            nodes[1](floor, 0),
            "-mat",
            5000,
            "-dir",
            1,
        )
    tops = [nodes[0](plane_frames.STOREYS[0], plane_frames.BAYS[0]), nodes[1](plane_frames.STOREYS[1], 0)]
    envelope(folder / "peaks", "EnvelopeElement", "-ele", *tags, "material", 1, "stress")
    analysis(record, 1.0, of.PAIR_PERIOD)
    count, samples = round(problem.FRAME_SAMPLE / step), round(problem.FRAME_DURATION / problem.FRAME_SAMPLE)
    u, iterations = np.zeros((2, samples + 1)), 0
    start = time.perf_counter()
    for i in range(1, samples + 1):
        if ops.analyze(count, step):
            return {"failed_at": ops.getTime()}
        u[:, i] = [ops.nodeDisp(top, 1) for top in tops]
        iterations += ops.testIter()
    seconds = time.perf_counter() - start
    ops.wipe()
    return {
        "wall_seconds": seconds,
        "peaks": read(folder / "peaks"),
        "displacement": u.tolist(),
        "iterations_per_step": iterations / samples,
    }


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as made:
        print(json.dumps({"frame": frame, "pair": pair}[sys.argv[1]](float(sys.argv[2]), sys.argv[3], Path(made))))
