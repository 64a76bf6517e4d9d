#!/usr/bin/env python3
"""Space buildings in the program, from their YAML to their last step, and the same equations in OpenSees.

    python3 tests/benchmarks/towers.py OUT.json PROGRAM [--quick]
    python3 tests/benchmarks/towers.py yaml CASE [--apart | --stiff]     # prints the model of a case, such as "8
    flexible"

Towers of 20 storeys: one next to a wall, two side by side, or eight as four along x by two along y. Neighbours are
linked at every floor by two points, those along y 50 mm apart, those along x in touch. The towers start towards each
other with 0.2 m/s between neighbours along x, and the links are rubber bumpers, soft enough to remain in contact
without an event during the timed steps. `--apart` widens the gaps so that nothing touches; `--stiff` uses contacts of
93.5 MN/m, which touch and separate.

Steps are generalized-alpha steps of at most 5 ms with one solve each. Their cost is measured from the lines of
-pounding_ts_monitor: the lower quartile of the wall time of steps of the most common length, which is robust against
other load. Locating a touch or a reversal takes several shorter steps, which are included in the time of the whole run.
Fractions are of the whole process, by -log_view.

Reduced structures (`reduction: {links: 5, ground: 20}`) are listed next to them. A monitor would request the
displacements of all unknowns. The cost of a step is therefore given twice: as measured by `model_steps` (target
`benchmarks`), and as the mean over a run of many more steps, including impacts and recording.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from measure import FOLDER, ONE_THREAD, run_json
from plane_frames import BAY, BEAM, COLUMN, ELASTICITY, HEIGHT
from problem import FLOOR_MASS, LINEAR_STIFFNESS

STOREYS, STEP, SPEED = 20, 5e-3, 0.2  # [s], [m/s] between neighbours
BUMPER = 5e6  # N/m
FAR, ACROSS = 2.0, 0.05  # gaps out of reach, along y [m]
STEPS = {1: 60, 2: 60, 8: 20}
ROWS = {1: (1, 1), 2: (2, 1), 8: (4, 2)}
# Name -> towers, bays along x and along y, rigid floors.
CASES = {f"{count} {floors}": (count, 5, floors == "rigid") for floors in ("rigid", "flexible") for count in ROWS}
CASES["8 wide"] = (8, 8, False)
# Solvers tried in OpenSees, and its number of steps: more would take minutes per case.
OPENSEES = {"2 flexible": ("SparseSYM", "Mumps"), "8 flexible": ("Mumps",), "8 wide": ("Mumps",)}
REDUCED, REDUCED_WORDS, LONGER = ("2 flexible", "8 wide"), "{links: 5, ground: 20}", 20
# run lengthened by this factor, in which steps without an event are timed: bumpers are in contact for most of it
ALONE = {"2 flexible": 4, "8 wide": 20}
OPENSEES_STEPS = {"2 flexible": 6, "8 flexible": 3, "8 wide": 3}


def stiffer(i, k):
    """A tower's bending stiffness relative to the first."""
    return 1.15**i * 1.3**k


def speed(count, i):
    """Initial velocity along x of the towers of column i: neighbours close at SPEED [m/s]."""
    return SPEED * (1 if count == 1 else (ROWS[count][0] - 1) / 2 - i)


def neighbours(count):
    """((i, k), (i, k), axis): towers with facing sides, the one at smaller coordinates first."""
    along, across = ROWS[count]
    pairs = [((i, k), (i + 1, k), 0) for k in range(across) for i in range(along - 1)]
    return pairs + [((i, k), (i, k + 1), 1) for k in range(across - 1) for i in range(along)]


def links(count, bays, apart, stiff):
    contact = f"law: linear_spring, stiffness: {LINEAR_STIFFNESS if stiff else BUMPER!r}"
    if count == 1:
        ends = [f"{{structure: t00, node: {storey}.{bays}.{k}}}" for storey in range(1, STOREYS + 1) for k in (0, bays)]
        return [f"  - {{between: [{end}, wall], gap: {FAR if apart else 0.0}, {contact}}}" for end in ends]
    return [
        f"  - {{between: [t{a[0]}{a[1]}, t{b[0]}{b[1]}], floors: all, points: 2, gap: {FAR if apart else ACROSS if axis else 0.0}, "
        f"{contact}}}"
        for a, b, axis in neighbours(count)
    ]


def model(count, bays, rigid, apart=False, stiff=False, reduction="none", longer=1):
    """YAML of the towers, for this multiple of the duration of the timed steps."""
    along, across = ROWS[count]
    gaps = (FAR, FAR) if apart else (0.0, ACROSS)
    lines = [f"title: {count} towers", "structures:"]
    for k in range(across):
        for i in range(along):
            bending = stiffer(i, k)
            lines.append(f"""\
  t{i}{k}:
    frame:
      dimension: 3
      origin: [{i * (bays * BAY + gaps[0])!r}, {k * (bays * BAY + gaps[1])!r}]
      material: {{E: {ELASTICITY!r}, G: {ELASTICITY / 2.4!r}}}
      sections:
        column: {{area: {COLUMN[0]!r}, inertia_y: {COLUMN[1] * bending!r}, inertia_z: {COLUMN[1] * bending!r}, torsion: {0.141 * 0.55**4!r}}}
        beam: {{area: {BEAM[0]!r}, inertia_y: {BEAM[1] * bending!r}, inertia_z: {0.5 * 0.6 * 0.3**3 / 12!r}, torsion: {0.2 * 0.3**3 * 0.6!r}}}
      grid: {{storeys: {STOREYS}, bays: [{bays}, {bays}], storey_height: {HEIGHT}, bay_width: {BAY}, columns: column, beams: beam,
             floor_mass: {FLOOR_MASS * bays * bays!r}, rigid_floors: {str(rigid).lower()}}}
    initial_velocity: {speed(count, i)!r}
    damping: 5 %""")
    if count == 1:
        lines.append("  wall: {wall: {}}")
    lines += ["links:", *links(count, bays, apart, stiff)]
    lines.append(
        f"analysis: {{duration: {longer * STEPS[count] * STEP!r}, max_step: {STEP}, tolerance: 0.01, output_step: {STEP}, "
        f"integrator: generalized_alpha, reduction: {reduction}}}"
    )
    return "\n".join(lines) + "\n"


def process(command, ranks=1):
    """{"seconds", "memory_mb", "steps"} of a process: the wall time, the memory of the largest process, and for each
    line of the monitor (length of the step [s], wall time since the previous line [s])."""
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-n", ranks, *command]
    steps, start = [], time.perf_counter()
    with tempfile.TemporaryFile() as errors:
        child = subprocess.Popen(
            [str(c) for c in command], stdout=subprocess.PIPE, stderr=errors, env=ONE_THREAD, text=True
        )
        last = start
        for line in child.stdout:
            if found := re.match(r"\s*\d+ TS (?:\(pounding_\) )?dt ([\d.e+-]+) time", line):
                now = time.perf_counter()
                steps.append((float(found[1]), now - last))
                last = now
        status, usage = os.wait4(child.pid, 0)[1:]
        child.returncode = os.waitstatus_to_exitcode(status)
        seconds = time.perf_counter() - start
        errors.seek(0)
        if child.returncode:
            raise RuntimeError((errors.read().decode().strip().splitlines() or ["no message"])[-1])
    return {"seconds": seconds, "memory_mb": usage.ru_maxrss / 1024, "steps": steps}


def logged(file):
    """{"solve", "factor"}: seconds of the slowest process by -log_view."""
    seconds = {"solve": 0.0, "factor": 0.0}
    places = {"KSPSolve": "solve", "KSPMatSolve": "solve", "PCSetUp": "factor"}
    for line in Path(file).read_text().splitlines():
        if (found := re.match(r"(\w+)\s+\d+\s+\S+\s+([\d.e+-]+)\s", line)) and found[1] in places:
            seconds[places[found[1]]] += float(found[2])
    return seconds


def quarter(values):
    """Lower quartile."""
    return sorted(values)[len(values) // 4]


def run(program, folder, case, ranks=1, **how):
    """One run of the program."""
    import h5py  # imported here, so that models can be written without it

    yaml, results, log = folder / "model.yaml", folder / "results.h5", folder / "log.txt"
    yaml.write_text(model(*CASES[case], **how))
    seen = process([program, "run", yaml, "-o", results, "-q", "-pounding_ts_monitor", "-log_view", f":{log}"], ranks)
    with h5py.File(results) as file:
        solver = {name: float(value[()]) for name, value in file["solver"].items()}
        pressed = [len(link["force"]) > 0 and link["force"][-1] > 0 for link in file["links"].values()]
    # A line has the length of the next step, and the line after it its time.
    taken = {}
    for (length, _), (_, spent) in zip(seen["steps"], seen["steps"][1:]):
        taken.setdefault(f"{length:.9f}", []).append(spent)
    whole = max(taken.values(), key=len)
    log = logged(log)
    return {
        "seconds_per_step": quarter(whole),
        "steps": solver["steps"] + solver["rejected"],
        "whole_steps": len(whole),
        "events": solver["events"],
        "seconds": solver["wall_solve"],
        "seconds_setup": solver["wall_setup"],
        "solve_share": log["solve"] / seen["seconds"],
        "factor_share": log["factor"] / seen["seconds"],
        "memory_mb": seen["memory_mb"],
        "links": len(pressed),
        "pressed": int(sum(pressed)),
    }


def unknowns(case):
    """Number of unknowns of the frames without their links."""
    count, bays, rigid = CASES[case]
    nodes = (bays + 1) ** 2
    return count * STOREYS * (3 * nodes + 3 if rigid else 6 * nodes)


def pounding(program, folder, case, ranks):
    row = {"program": "pounding", "case": case, "ranks": ranks, "unknowns": unknowns(case)}
    try:
        row["apart"] = run(program, folder, case, ranks, apart=True)
        row["seconds_reading"] = process([program, "check", folder / "model.yaml"])["seconds"]
        row["pressed"] = run(program, folder, case, ranks)
        if CASES[case][0] == 2 and ranks == 1:
            row["stiff"] = run(program, folder, case, ranks, stiff=True)
    except RuntimeError as error:
        row["failed"] = str(error)
    return row


def model_steps(program):
    """Path of the program that times single steps."""
    found = Path(program).resolve().parent / "tests/benchmarks/model_steps"
    if not found.exists():
        sys.exit(f"no program {found}: type cmake --build {found.parents[2]} --target benchmarks")
    return found


def reduced(program, folder, case):
    """One row: the towers of a case, reduced."""
    import h5py

    row = {"program": "reduced", "case": case, "unknowns": unknowns(case)}
    alone = model_steps(program)
    yaml, results = folder / "model.yaml", folder / "results.h5"
    for name, apart in ("apart", True), ("pressed", False):
        yaml.write_text(model(*CASES[case], apart=apart, reduction=REDUCED_WORDS, longer=LONGER))
        seen = process([program, "run", yaml, "-o", results, "-q"])
        with h5py.File(results) as file:
            solver = {key: float(value[()]) for key, value in file["solver"].items() if isinstance(value, h5py.Dataset)}
            told = {
                key: float(value[()])
                for key, value in file["solver/reduction/t00"].items()
                if value.shape == () and value.dtype.kind in "if"
            }
        steps = solver["steps"] + solver["rejected"]
        row[name] = {
            "seconds_per_step": solver["wall_solve"] / steps,
            "steps": steps,
            "events": solver["events"],
            "seconds_setup": solver["wall_setup"],
            "seconds": solver["wall_solve"],
            "memory_mb": seen["memory_mb"],
            "told": told,
        }
        yaml.write_text(model(*CASES[case], apart=apart, reduction=REDUCED_WORDS, longer=ALONE[case]))
        sorts = run_json([alone, yaml], timeout=600)["sorts"]
        row[name]["alone"] = max(
            sorts, key=lambda sort: (-sort["pressed"] if apart else sort["pressed"], sort["count"])
        )
    return row


def main(out, program, quick):
    rows, load = [], os.getloadavg()[0]
    model_steps(program)  # now, not after many minutes
    with tempfile.TemporaryDirectory() as name:
        for case in CASES:
            if quick and (case.startswith("8") and case != "8 rigid"):
                continue
            for ranks in (1,) if case.startswith("1") or quick else (1, 2):
                rows.append(pounding(program, Path(name), case, ranks))
                print(
                    "towers",
                    case,
                    f"ranks {ranks}",
                    rows[-1].get("failed") or f"{1e3 * rows[-1]['pressed']['seconds_per_step']:.3g} ms a step",
                    flush=True,
                )
        for case in REDUCED[:1] if quick else REDUCED:
            rows.append(reduced(program, Path(name), case))
            print(
                "towers", case, "reduced", f"{1e3 * rows[-1]['pressed']['seconds_per_step']:.3g} ms a step", flush=True
            )
    for case, systems in OPENSEES.items():
        for system in systems[-1:] if quick else systems:
            if quick and case.startswith("8"):
                continue
            row = run_json(
                [sys.executable, FOLDER / "opensees_frames.py", "towers", case, system, OPENSEES_STEPS[case]],
                timeout=1200,
            )
            rows.append({"program": "opensees", "case": case, "system": system, **row})
            print(
                "towers",
                case,
                system,
                row.get("failed") or row.get("failed_at") or f"{row['seconds_per_step']:.3g} s",
                flush=True,
            )
    about = f"Load average {load:.1f} before, {os.getloadavg()[0]:.1f} after, {os.cpu_count()} cores."
    Path(out).write_text(json.dumps({"about": about, "rows": rows, "quick": quick}, indent=1))


if __name__ == "__main__":
    words = [w for w in sys.argv[1:] if not w.startswith("--")]
    if words[0] == "yaml":
        print(model(*CASES[words[1]], "--apart" in sys.argv, "--stiff" in sys.argv), end="")
    else:
        main(words[0], words[1], "--quick" in sys.argv)
