#!/usr/bin/env python3
"""What a tolerance gives: two oscillators (100 t, 0.8 s; 150 t, 0.4 s), 3 s of harmonic motion, five impacts, every law.

    python3 tests/benchmarks/tolerance.py build/pounding

Prints a Markdown table: for each law and asked tolerance the largest relative error of both peak displacements and the peak
force against a run at 1e-9, then steps and milliseconds of the solve (median of five) at each tolerance for all laws.
"""
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

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
}
TOLERANCES = ["1e-3", "1e-4", "1e-5", "1e-6"]
MODEL = """\
ground_motion: {{harmonic: {{amplitude: 3.0, period: 0.6, duration: 3.0}}}}
structures:
  left:  {{oscillator: {{mass: 100 t, period: 0.8, damping: 5 %}}}}
  right: {{oscillator: {{mass: 150 t, period: 0.4, damping: 5 %}}}}
links: [{{between: [left, right], gap: 20 mm, law: {law}, {parameters}}}]
analysis: {{duration: 3.0, tolerance: {tolerance}}}
"""


def run(program, folder, law, tolerance):
    model = Path(folder) / "model.yaml"
    model.write_text(MODEL.format(law=law, parameters=LAWS[law], tolerance=tolerance))
    done = subprocess.run([program, "run", str(model), "--json"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def peaks(summary):
    force = summary["links"][0]["peak_force"]
    return [s["peak_displacement"][0] for s in summary["structures"].values()] + ([force] if force else [])


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else "build/pounding"
    steps = {t: [] for t in TOLERANCES}
    seconds = {t: [] for t in TOLERANCES}
    print("| law | " + " | ".join(TOLERANCES) + " |\n|---" * 1 + "|---:" * len(TOLERANCES) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for law in LAWS:
            truth = peaks(run(program, folder, law, "1e-9"))
            row = []
            for tolerance in TOLERANCES:
                runs = [run(program, folder, law, tolerance) for _ in range(5)]
                row.append(max(abs(a / b - 1) for a, b in zip(peaks(runs[0]), truth)))
                steps[tolerance].append(runs[0]["solver"]["steps"])
                seconds[tolerance].append(statistics.median(r["solver"]["wall_seconds"] for r in runs))
            print(f"| `{law}` | " + " | ".join(f"{error:.1e}" for error in row) + " |", flush=True)
    print("| steps, median | " + " | ".join(f"{statistics.median(steps[t]):.0f}" for t in TOLERANCES) + " |")
    print("| run, median (ms) | " + " | ".join(f"{1e3 * statistics.median(seconds[t]):.1f}" for t in TOLERANCES) + " |")


if __name__ == "__main__":
    main()
