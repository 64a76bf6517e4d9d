"""Two oscillators of examples/02 in OpenSeesPy with a link of pounding.
python3 two_oscillators.py [STEPS]   prints the peak displacements [m], the peak force [N] and the number of impacts
"""

import math
import sys

import openseespy.opensees as ops
from pounding import opensees

steps = int(sys.argv[1]) if len(sys.argv) > 1 else 12000
ops.model("basic", "-ndm", 1, "-ndf", 1)
for foot, top, mass, period in ((1, 2, 100e3, 0.8), (3, 4, 150e3, 0.4)):
    w = 2 * math.pi / period
    ops.node(foot, 0.0)
    ops.node(top, 0.0)
    ops.fix(foot, 1)
    ops.mass(top, mass)
    ops.uniaxialMaterial("Elastic", foot, mass * w * w, 2 * 0.05 * w * mass)
    ops.element("zeroLength", foot, foot, top, "-mat", foot, "-dir", 1)
ops.timeSeries("Trig", 1, 0.0, 4.0, 0.6, "-factor", 3.0)
ops.pattern("UniformExcitation", 1, 1, "-accel", 1)

link = opensees.link(10, 2, 4, gap="20 mm", law="hertz_damped", stiffness=2.75e9, restitution=0.65)

ops.constraints("Plain")
ops.numberer("Plain")
ops.system("BandGeneral")
ops.test("NormDispIncr", 1e-12, 20)
ops.algorithm("Newton")
ops.integrator("Newmark", 0.5, 0.25)
ops.analysis("Transient")
peaks = [0.0, 0.0]
for _ in range(steps):
    if ops.analyze(1, 3.0 / steps) != 0:
        sys.exit(f"OpenSees stopped at {ops.getTime()} s")
    peaks = [max(peak, abs(ops.nodeDisp(node, 1))) for peak, node in zip(peaks, (2, 4))]
print(f"{peaks[0]:.9f} {peaks[1]:.9f} {link.impacts['peak_force'].max():.3f} {len(link.impacts)}")
