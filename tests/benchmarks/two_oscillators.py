#!/usr/bin/env python3
"""Error against time of two oscillators in pounding and in OpenSees, six laws.

    python3 tests/benchmarks/two_oscillators.py build/pounding OUT.json [--quick]

The error of a run is the larger of: displacements at every 0.05 s relative to the largest one; peak force of every
impact, relative to itself (1 if impacts are missing). Seconds are medians: OpenSees' analysis loop, pounding's own
`solver/wall_solve` (stepping and recording) and, as process_seconds, the whole of `pounding run MODEL --json -o FILE`
from start to exit. Runs in the environment with openseespy, numpy and h5py created by run.py.
"""

import json
import statistics
import sys
import tempfile
from pathlib import Path

import h5py

import problem
from measure import FOLDER, displacement_error, peak_error, reference, run_json

STEPS = [1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5]
QUICK_STEPS = [5e-3, 1e-3, 2e-4, 5e-5, 2e-5]
TOLERANCES = ["1e-2", "3e-3", "1e-3", "3e-4", "1e-4", "3e-5", "1e-5", "3e-6", "1e-6", "3e-7", "1e-7", "1e-8"]
INTEGRATORS = ("generalized_alpha", "esdirk4")
MODEL = """\
ground_motion: {{harmonic: {{amplitude: {amplitude}, period: {period!r}, duration: {end}}}}}
structures:
  left:  {{oscillator: {{mass: {m[0]}, period: {t[0]}, damping: {damping}}}}}
  right: {{oscillator: {{mass: {m[1]}, period: {t[1]}, damping: {damping}}}}}
links: [{{between: [left, right], gap: {gap}, law: {law}, {parameters}}}]
analysis: {{duration: {end}, tolerance: {tolerance}, integrator: {integrator}, output_step: {sample}}}
"""


def pounding(program, law, integrator, tolerance, repeats, truth):
    with tempfile.TemporaryDirectory() as folder:
        model, results = Path(folder) / "model.yaml", Path(folder) / "results.h5"
        model.write_text(
            MODEL.format(
                amplitude=problem.AMPLITUDE,
                period=1 / problem.FREQUENCY,
                end=problem.DURATION,
                m=problem.MASSES,
                t=problem.PERIODS,
                damping=problem.DAMPING,
                gap=problem.GAP,
                law=law,
                parameters=problem.LAWS[law],
                tolerance=tolerance,
                integrator=integrator,
                sample=problem.SAMPLE,
            )
        )
        once = run_json([program, "run", model, "--json", "-o", results])
        if "failed" in once:
            return {"tolerance": float(tolerance), "failed": once["failed"]}
        with h5py.File(results) as file:
            u = [file[f"structures/{side}/displacement"][:, 0, 0] for side in ("left", "right")]
            peaks = file["impacts"]["peak_force"]
        runs = []
        for _ in range(repeats):
            runs.append(run_json([program, "run", model, "--json", "-o", results]))
            with h5py.File(results) as file:
                runs[-1]["solve_seconds"] = float(file["solver/wall_solve"][()])
    return {
        "tolerance": float(tolerance),
        "steps": once["solver"]["steps"],
        **errors(u, peaks, truth),
        "seconds": statistics.median(r["solve_seconds"] for r in runs),
        "process_seconds": statistics.median(r["process_seconds"] for r in runs),
    }


def opensees(law, step, repeats, truth):
    run = run_json([sys.executable, FOLDER / "opensees_oscillators.py", law, step, repeats])
    if "failed" in run or "failed_at" in run:
        return {"step": step, "failed": run.get("failed", f"Newton failed at {run.get('failed_at', 0):.3f} s")}
    return {
        "step": step,
        "steps": round(problem.DURATION / step),
        **errors(run["displacement"], run["peaks"], truth),
        "seconds": statistics.median(run["wall_seconds"]),
    }


def errors(u, peaks, truth):
    by_displacement = displacement_error(u, truth["displacement"])
    by_peaks = peak_error(peaks, truth["peaks"][0])
    return {
        "error": max(by_displacement, by_peaks),
        "displacement_error": by_displacement,
        "peak_error": by_peaks,
        "impacts": len(peaks),
    }


def main(program, out, quick):
    truth = reference("two_oscillators")["laws"]
    steps = QUICK_STEPS if quick else STEPS
    tolerances = TOLERANCES[::2] if quick else TOLERANCES
    laws, refused = {}, {}
    for law in problem.LAWS:
        peer = problem.OPENSEES_REFERENCE[law]
        laws[law] = {"opensees": [opensees(law, s, 1 if quick else 3, truth[peer]) for s in steps], "pounding": {}}
        for integrator in INTEGRATORS:
            if integrator in refused:
                continue
            points = []
            for tolerance in tolerances:
                points.append(pounding(program, law, integrator, tolerance, 3 if quick else 5, truth[law]))
                if "unknown integrator" in points[-1].get("failed", ""):
                    refused[integrator] = points[-1]["failed"].split(": ", 2)[-1]
                    print(f"{integrator} left out: {refused[integrator]}")
                    break
            if integrator not in refused:
                laws[law]["pounding"][integrator] = points
        print(law, flush=True)
    Path(out).write_text(json.dumps({"laws": laws, "refused": refused, "quick": quick}, indent=1))


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], "--quick" in sys.argv)
