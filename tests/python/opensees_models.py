"""Models in OpenSeesPy for the tests of pounding.opensees. SI units."""

import math

import numpy as np
import openseespy.opensees as ops

#: The numbers of examples/02_two_oscillators.
MASSES, PERIODS, RATIO, GAP = (100e3, 150e3), (0.8, 0.4), 0.05, 0.02
STIFFNESS, RESTITUTION = 2.75e9, 0.65
DURATION = 3.0


def two_oscillators():
    """Nodes 2 and 4 are the masses; links and analysis are still missing."""
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    for node in (1, 2, 3, 4):
        ops.node(node, 0.0)
    for i, (mass, period) in enumerate(zip(MASSES, PERIODS)):
        foot, top, w = 2 * i + 1, 2 * i + 2, 2 * math.pi / period
        ops.fix(foot, 1)
        ops.mass(top, mass)
        ops.uniaxialMaterial("Elastic", i + 1, mass * w * w, 2 * RATIO * w * mass)
        ops.element("zeroLength", i + 1, foot, top, "-mat", i + 1, "-dir", 1)
    ops.timeSeries("Trig", 1, 0.0, DURATION + 1, 0.6, "-factor", 3.0)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)


def newmark(system="BandGeneral", increment=1e-12):
    """Constant average acceleration and Newton."""
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system(system)
    ops.test("NormDispIncr", increment, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")


def analyse(step, duration, tops):
    """Largest displacements along x of these nodes [m], and the iterations of each step."""
    peaks, iterations = np.zeros(len(tops)), []
    for _ in range(round(duration / step)):
        if ops.analyze(1, step):
            raise RuntimeError(f"OpenSees stopped at {ops.getTime()} s")
        iterations.append(ops.testIter())
        peaks = np.maximum(peaks, [abs(ops.nodeDisp(node, 1)) for node in tops])
    return peaks, np.array(iterations)
