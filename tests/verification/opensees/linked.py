"""Links of pounding.opensees in the two plane frames, under the record, against the stored references.

    PYTHONPATH=build/python python3 tests/verification/opensees/linked.py LAW STEP

Prints the row of README.md: impacts of each link, and the largest differences of a link's peak force and of a floor's
peak displacement, relative to the reference.
"""

import json
import sys

import numpy as np
import openseespy.opensees as ops

import pounding
from frames import FOLDER, STEP, LinkedPlane, coefficients, record


def main(law, step):
    stored = json.loads((FOLDER / "plane_pounding.json").read_text())
    wanted = stored["laws"][law]
    [link] = pounding.Model.from_file(FOLDER / f"plane_{law}.yaml").links
    frames = LinkedPlane(**{name: value for name, value in link.items() if name not in ("between", "floors")})
    ops.rayleigh(*coefficients([2 * np.pi / period for period in stored["rayleigh_periods"]]), 0.0, 0.0)
    ops.timeSeries("Path", 1, "-dt", STEP, "-values", *record().tolist())
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    ops.test("NormDispIncr", 1e-10, 50, 0)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")

    peaks = {side: np.zeros(len(nodes)) for side, nodes in frames.faces.items()}
    iterations = []
    for _ in range(round(20.0 / STEP)):
        for _ in range(round(STEP / step)):
            if ops.analyze(1, step):
                raise SystemExit(f"Newton failed at {ops.getTime():.3f} s")
            iterations.append(ops.testIter())
        for side, nodes in frames.faces.items():
            peaks[side] = np.maximum(peaks[side], [abs(ops.nodeDisp(node, 1)) for node in nodes])
    impacts = [each.impacts for each in frames.links]
    force = [abs(each["peak_force"].max() / peak - 1) for each, peak in zip(impacts, wanted["peak_force"]) if peak > 0]
    moved = [np.abs(peaks[side] / wanted["peak_displacement"][side] - 1).max() for side in peaks]
    print(
        f"| `{law}` | {1e3 * step:g} ms | {[len(each) for each in impacts]} | {wanted['impacts']} | {max(force):.1e} | "
        f"{max(moved):.1e} | {np.mean(iterations):.2f}, {max(iterations)} |"
    )


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]))
