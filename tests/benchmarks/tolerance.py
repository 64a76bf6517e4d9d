#!/usr/bin/env python3
"""Errors at a requested tolerance: two oscillators (100 t, 0.8 s; 150 t, 0.4 s), 3 s of harmonic motion, five impacts,
every law.

    python3 tests/benchmarks/tolerance.py build/pounding

Prints a Markdown table for each scheme: for each law and requested tolerance the largest relative error of the peak
force (for a rigid law the impulse) and the separation speed of every impact against tests/program/independent.py, an
integrator that shares no code with the program, and of both peak displacements against a run at 1e-9; then steps and
milliseconds of the solve (median of five) at each tolerance for all laws. Needs numpy, scipy and h5py.
"""

import json
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "program"))
import independent  # noqa: E402
import judging  # noqa: E402

LINEAR = "stiffness: 9.35e7"
HERTZ = "stiffness: 2.75e9"
LAWS = {
    "linear_spring": LINEAR,
    "kelvin_voigt": f"{LINEAR}, restitution: 0.65",
    "kelvin_voigt_no_tension": f"{LINEAR}, restitution: 0.65",
    "komodromos": f"{LINEAR}, restitution: 0.65",
    "modified_linear_viscoelastic": f"{LINEAR}, restitution: 0.65",
    "modified_kelvin": f"{LINEAR}, restitution: 0.65",
    "hertz": HERTZ,
    "hertz_damped": f"{HERTZ}, restitution: 0.65",
    "jankowski": f"{HERTZ}, restitution: 0.65",
    "bilinear_hertz": f"{HERTZ}, restitution: 0.65",
    "viscous_hertz": f"{HERTZ}, restitution: 0.65",
    "kuwabara_kono": f"{HERTZ}, restitution: 0.65",
    "adams_impact": f"{HERTZ}, depth: 1 mm, restitution: 0.65",
    "limited_damper": f"{HERTZ}, restitution: 0.65",
    "stereomechanical": "restitution: 0.65",
    "elastoplastic": f"{HERTZ}, restitution: 0.65",
}
TOLERANCES = ["1e-3", "1e-4", "1e-5", "1e-6"]
SCHEMES = ["generalized_alpha", "esdirk4"]
MODEL = """\
ground_motion: {{harmonic: {{amplitude: 3.0, period: 0.6, duration: 3.0}}}}
structures:
  left:  {{oscillator: {{mass: 100 t, period: 0.8, damping: 5 %}}}}
  right: {{oscillator: {{mass: 150 t, period: 0.4, damping: 5 %}}}}
links: [{{between: [left, right], gap: 20 mm, law: {law}, {parameters}}}]
analysis: {{duration: 3.0, tolerance: {tolerance}, integrator: {scheme}}}
"""


def reference(law):
    """Value (peak force or impulse) and separation speed of every impact."""
    given = {"law": law}
    for word in LAWS[law].split(", "):
        name, value = word.split(": ")
        given[name] = 1e-3 if value == "1 mm" else float(value)
    w = [2 * math.pi / 0.8, 2 * math.pi / 0.4]
    masses = [(m, m * x * x, 0.1 * m * x, 0.0, 0.0) for m, x in zip((1e5, 1.5e5), w)]
    ground, corners, longest = judging.ground_of({"kind": "harmonic", "amplitude": 3.0, "period": 0.6, "duration": 3.0})
    row = independent.Row(masses, [independent.Link(0, 1, 0.02, independent.Law(law, given))], ground, corners, longest)
    row.run(3.0)
    return [values for _, _, values in judging.measure(row)[0]]


def run(program, folder, law, tolerance, scheme):
    """Summary, and values of every impact as in reference()."""
    model, results = Path(folder) / "model.yaml", Path(folder) / "results.h5"
    model.write_text(MODEL.format(law=law, parameters=LAWS[law], tolerance=tolerance, scheme=scheme))
    done = subprocess.run(
        [program, "run", str(model), "--json", "-o", str(results)], capture_output=True, text=True, check=True
    )
    with h5py.File(results) as file:
        rows = file["impacts"][()]
        seconds = float(file["solver/wall_solve"][()])
    value = "impulse" if law == "stereomechanical" else "peak_force"
    return json.loads(done.stdout), [(r[value], r["v_separation"]) for r in rows], seconds


def displacements(summary):
    return [s["peak_displacement"][0] for s in summary["structures"].values()]


def table(program, folder, scheme, truths):
    steps = {t: [] for t in TOLERANCES}
    milliseconds = {t: [] for t in TOLERANCES}
    print(f"| {scheme} | " + " | ".join(TOLERANCES) + " |\n|---" + "|---:" * len(TOLERANCES) + "|")
    for law, (impacts, moved) in truths.items():
        largest = [max(values) for values in zip(*impacts)]
        row = []
        for tolerance in TOLERANCES:
            runs = [run(program, folder, law, tolerance, scheme) for _ in range(5)]
            summary, mine, _ = runs[0]
            if len(mine) != len(impacts):
                sys.exit(f"{law}, {scheme}, {tolerance}: {len(mine)} impacts, not {len(impacts)}")
            errors = [abs(a - b) / top for one, other in zip(mine, impacts) for a, b, top in zip(one, other, largest)]
            errors += [abs(a / b - 1) for a, b in zip(displacements(summary), moved)]
            row.append(max(errors))
            steps[tolerance].append(summary["solver"]["steps"])
            milliseconds[tolerance].append(1e3 * statistics.median(seconds for _, _, seconds in runs))
        print(f"| `{law}` | " + " | ".join(f"{error:.1e}" for error in row) + " |", flush=True)
    print("| steps, median | " + " | ".join(f"{statistics.median(steps[t]):.0f}" for t in TOLERANCES) + " |")
    print(
        "| solve, median (ms) | " + " | ".join(f"{statistics.median(milliseconds[t]):.1f}" for t in TOLERANCES) + " |"
    )


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "build/pounding"
    with tempfile.TemporaryDirectory() as folder:
        truths = {
            law: (reference(law), displacements(run(program, folder, law, "1e-9", SCHEMES[0])[0])) for law in LAWS
        }
        for k, scheme in enumerate(SCHEMES):
            if k:
                print()
            table(program, folder, scheme, truths)


if __name__ == "__main__":
    main()
