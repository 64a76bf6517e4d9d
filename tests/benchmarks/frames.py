#!/usr/bin/env python3
"""Plane and 3D frames in OpenSees, and in the program `frames` of this folder if its path is given.

    python3 tests/benchmarks/frames.py OUT.json [FRAMES] [--quick]

plane: error against time for six laws; the error is the larger of the links' peak forces (relative, 1 if contact is
missed) and the top displacements (OpenSees: every 0.1 s over the largest; pounding: the peaks, unless it prints
"displacement"). space: seconds per step in contact against the number of equations.

FRAMES is called as
    frames plane --law LAW --tolerance T --motion FILE [--integrator esdirk4]
      -> {"wall_seconds", "steps", "peaks": [six], "impacts": [six], "peak_displacement": {"left", "right"}}
    frames space --storeys N --bays N --steps K
      -> {"unknowns", "seconds_per_step", "seconds_per_solve", "memory_mb"}
The masses, stiffnesses and Rayleigh damping are those of plane_frames.py (the coefficients are also in
reference/plane_frames.json), the laws those of problem.py with a reduced mass of 43.2 t, the tops the roof nodes of the
facing columns. FILE has two columns, s and m/s^2, linear in between.
"""

import json
import statistics
import sys
from pathlib import Path

import numpy as np

import problem
from measure import FOLDER, displacement_error, peak_error, reference, run_json
from motion import motion

STEPS = [5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5]
TOLERANCES = ["1e-2", "3e-3", "1e-3", "3e-4", "1e-4", "3e-5", "1e-5", "1e-6"]
INTEGRATORS = ("generalized_alpha", "esdirk4")
SYSTEMS = ("SparseSYM", "Mumps", "UmfPack")
ALGORITHMS = ("Newton", "ModifiedNewton")
# Equations in OpenSees -> the sizes run by pounding, and the number of timed steps.
SPACE = {
    "4536": (["--storeys", "12", "--bays", "5"], 20),
    "19440": (["--storeys", "20", "--bays", "9", "--bays-y", "8"], 4),
}


def opensees_plane(law, step, record, truth):
    run = run_json([sys.executable, FOLDER / "opensees_frames.py", "plane", law, step, record])
    if "failed" in run or "failed_at" in run:
        return {"step": step, "failed": run.get("failed", f"Newton failed at {run.get('failed_at', 0):.3f} s")}
    return {
        "step": step,
        "steps": run["steps"],
        "seconds": run["wall_seconds"],
        **errors(run["peaks"], displacement_error(run["displacement"], truth["displacement"]), truth),
    }


def pounding_plane(program, law, integrator, tolerance, record, truth, repeats):
    command = [program, "plane", "--law", law, "--tolerance", tolerance, "--motion", record, "--integrator", integrator]
    runs = [run_json(command) for _ in range(repeats)]
    if "failed" in runs[0]:
        return {"tolerance": float(tolerance), "failed": runs[0]["failed"]}
    one = runs[0]
    if "displacement" in one:
        moved = displacement_error(one["displacement"], truth["displacement"])
    else:
        moved = peak_error([one["peak_displacement"][side] for side in ("left", "right")], truth["peak_displacement"])
    return {
        "tolerance": float(tolerance),
        "steps": one["steps"],
        "impacts": one["impacts"],
        "seconds": statistics.median(r["wall_seconds"] for r in runs),
        **errors(one["peaks"], moved, truth),
    }


def errors(peaks, moved, truth):
    by_peaks = peak_error(peaks, [max(p, default=0.0) for p in truth["peaks"]])
    return {"error": max(moved, by_peaks), "displacement_error": moved, "peak_error": by_peaks}


def plane(program, record, quick):
    truth, laws = reference("plane_frames"), {}
    if abs((motion()[1] ** 2).sum() / truth["record_square_sum"] - 1) > 1e-9:
        sys.exit("motion.py no longer generates the record of reference/plane_frames.json")
    truth = truth["laws"]
    for law in problem.LAWS:
        points = []
        for step in STEPS[:3] if quick else STEPS:
            points.append(opensees_plane(law, step, record, truth[problem.OPENSEES_REFERENCE[law]]))
            if points[-1].get("error", 1) < 5e-4:
                break  # beyond the compared error
        laws[law] = {"opensees": points, "pounding": {}}
        for integrator in INTEGRATORS if program else ():
            runs = [
                pounding_plane(program, law, integrator, t, record, truth[law], 1 if quick else 3) for t in TOLERANCES
            ]
            if all("failed" in r for r in runs):
                print(f"plane {law} {integrator}: {runs[0]['failed']}")
            else:
                laws[law]["pounding"][integrator] = runs
        print("plane", law, flush=True)
    return laws


def space(program, record, quick):
    rows = []
    for size, (asked, steps) in SPACE.items():
        if quick and size != "4536":
            continue
        for system in SYSTEMS:
            for algorithm in ALGORITHMS:
                row = run_json(
                    [sys.executable, FOLDER / "opensees_frames.py", "space", size, system, algorithm, steps, record]
                )
                rows.append({"program": "opensees", "size": size, "system": system, "algorithm": algorithm, **row})
                print("space", size, system, algorithm, row.get("failed") or row.get("seconds_per_step"), flush=True)
        if program:
            rows.append({"program": "pounding", "size": size, **run_json([program, "space", *asked, "--steps", 200])})
    return rows


def main(out, program, quick):
    record = Path(out).with_name("motion.txt")
    np.savetxt(record, np.column_stack(motion()), fmt="%.15e")
    if not program:
        print("the program `frames` is not built (tests/benchmarks/frames.cpp): only OpenSees is measured")
    Path(out).write_text(
        json.dumps(
            {"plane": plane(program, record, quick), "space": space(program, record, quick), "quick": quick}, indent=1
        )
    )


if __name__ == "__main__":
    words = [w for w in sys.argv[1:] if w != "--quick"]
    main(words[0], words[1] if len(words) > 1 else None, "--quick" in sys.argv)
