#!/usr/bin/env python3
"""Errors of reduced structures against all natural modes, and their estimates by the runs, for eight pairs of towers in
space.

    python3 tests/benchmarks/reduction.py PROGRAM [--models NAME,...] [--tolerances 1e-3,1e-4] [--words "auto" "{links:
    5, ground: 20}" ...] python3 tests/benchmarks/reduction.py PROGRAM --conditions [--models NAME,...] python3
    tests/benchmarks/reduction.py yaml NAME             # YAML of a pair

The ground moves along x and across the links. Prints one line of JSON per run: errors against all modes at a tenth of
the smallest tolerance, those against all modes at the same tolerance (by_reduction: time-stepping errors nearly
cancel), the reported errors (three times the estimates), coordinates, blocks, seconds. Errors are largest differences
relative to the largest values: of peak forces and impulses of links, of histories of floors along x and y, of extremes
of member forces.

--conditions reports the condition of each model instead: the same differences after a change of an input number,
relative to that change. A run within its tolerance may differ by this number of tolerances.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERTZ = "hertz_damped, stiffness: 2.75e9, restitution: 0.65"


def kelvin(stiffness):
    return f"kelvin_voigt, stiffness: {stiffness}, restitution: 0.65"


# Name -> storeys, bays, rigid floors, points per floor, law, damping.
FIVE = "{rayleigh: {ratio: 5 %, modes: [1, 2]}}"
LIGHT = "{rayleigh: {ratio: 3 %, periods: [1.5, 0.02]}}"
MODELS = {
    "flexible": (10, 4, False, 2, HERTZ, FIVE),
    "rigid": (10, 4, True, 2, kelvin("3e9"), FIVE),
    "points": (10, 4, False, 5, HERTZ, FIVE),
    "kelvin": (10, 4, False, 2, kelvin("1e10"), FIVE),
    "twenty": (20, 5, False, 2, HERTZ, FIVE),
    "light": (10, 4, False, 2, HERTZ, LIGHT),
    "modal": (10, 4, False, 2, HERTZ, "{modal: {ratio: 5 %}}"),
    "friction": (10, 4, False, 2, HERTZ + ", friction: 0.3", FIVE),
}
DURATION, BAY, GAP = 4.0, 6.0, 0.02
#: Input numbers changed by --conditions, and the relative change.
INPUTS, CHANGE = (
    {"gap": f"gap: {GAP}", "amplitude of the ground": "amplitude: 3", "period of the ground": "period: 1.1"},
    1e-5,
)


def model(name, tolerance, words="none", duration=DURATION):
    """YAML of a pair with these values of reduction."""
    storeys, bays, rigid, points, law, damping = MODELS[name]
    lines = [
        "ground_motion: {components: {x: {harmonic: {amplitude: 3, period: 1.1, duration: 4}}, y: {harmonic: {amplitude: 1.5, period: 0.7, duration: 4}}}}",
        "structures:",
    ]
    for i, (tower, bending) in enumerate((("left", 1.0), ("right", 2.0))):
        lines.append(f"""\
  {tower}:
    frame:
      dimension: 3
      origin: [{i * (bays * BAY + GAP)!r}, 0]
      material: {{E: 30 GPa, G: 12.5 GPa}}
      sections:
        column: {{area: 0.36, inertia_y: {0.0108 * bending!r}, inertia_z: {0.0108 * bending!r}, torsion: 0.018}}
        beam: {{area: 0.18, inertia_y: {0.0054 * bending!r}, inertia_z: 0.00135, torsion: 0.0037}}
      grid: {{storeys: {storeys}, bays: [{bays}, {bays}], storey_height: 3.2, bay_width: {BAY}, columns: column, beams: beam,
             floor_mass: {20 * bays * bays} t, rigid_floors: {str(rigid).lower()}}}
    damping: {damping}""")
    lines.append(f"links:\n  - {{between: [left, right], floors: all, points: {points}, gap: {GAP}, law: {law}}}")
    lines.append(f"analysis: {{duration: {duration}, tolerance: {tolerance}, output_step: 0.01, reduction: {words}}}")
    return "\n".join(lines) + "\n"


def run(program, folder, text):
    """(summary, results, seconds) of a run."""
    sys.path.insert(0, str(Path(__file__).parents[2] / "python"))
    import h5py

    (folder / "model.yaml").write_text(text)
    start = time.perf_counter()
    done = subprocess.run(
        [program, "run", folder / "model.yaml", "-o", folder / "out.h5", "--json"], capture_output=True, text=True
    )
    seconds = time.perf_counter() - start
    if done.returncode:
        raise RuntimeError(done.stderr)
    summary = json.loads(done.stdout)
    with h5py.File(folder / "out.h5") as file:
        floors = {
            name: {key: file[f"structures/{name}/{key}"][..., :2] for key in ("displacement", "acceleration")}
            for name in ("left", "right")
        }
    return summary, floors, seconds


def errors(found, exact):
    """{"force", "impulse", "displacement", "acceleration", "members"} of one run against another."""
    import numpy as np

    (a, floors, _), (b, expected, _) = found, exact

    def of_links(key):
        largest = max(link[key] for link in b["links"])
        return max(abs(x[key] - y[key]) for x, y in zip(a["links"], b["links"])) / largest

    def of_floors(key):
        return max(
            float(np.abs(floors[name][key] - expected[name][key]).max() / np.abs(expected[name][key]).max())
            for name in floors
        )

    def of_members():
        worst = 0.0
        for name in b["structures"]:
            x, y = (run["structures"][name]["envelope"] for run in (a, b))
            moment = np.array([component.split()[1][0] in "MT" for component in y["components"]])
            for kind in (moment, ~moment):
                high = [np.array(e["member_force"][end])[:, kind] for e in (x, y) for end in ("min", "max")]
                worst = max(
                    worst,
                    max(np.abs(high[0] - high[2]).max(), np.abs(high[1] - high[3]).max())
                    / max(np.abs(high[2]).max(), np.abs(high[3]).max()),
                )
        return float(worst)

    return {
        "force": of_links("peak_force"),
        "impulse": of_links("impulse"),
        "displacement": of_floors("displacement"),
        "acceleration": of_floors("acceleration"),
        "members": of_members(),
    }


def told(summary):
    """{"force", ...} as reported by the run: the larger of both towers."""
    structures = summary["solver"].get("reduction", {}).values()
    return {
        key: max((s[f"error_{key}"] or 0.0 for s in structures), default=None)
        for key in ("force", "displacement", "acceleration", "members")
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("model", nargs="?")
    parser.add_argument("--models", default=",".join(MODELS))
    parser.add_argument("--tolerances", default="1e-3,1e-4,1e-5")
    parser.add_argument("--words", nargs="+", default=["auto"])
    parser.add_argument("--steps-alike", action="store_true", help="compare with all modes at the same tolerance only")
    parser.add_argument("--conditions", action="store_true", help="sensitivity of the answers to the input")
    parser.add_argument("--duration", type=float, default=DURATION)
    given = parser.parse_args()
    if given.program == "yaml":
        print(model(given.model, 1e-4), end="")
        return
    tolerances = [float(t) for t in given.tolerances.split(",")]
    with tempfile.TemporaryDirectory() as folder:
        for name in given.models.split(","):
            if given.conditions:
                conditions(given, Path(folder), name)
            else:
                compare(given, Path(folder), name, tolerances)


def conditions(given, folder, name):
    """Prints the results, one line per number."""
    text = model(name, CHANGE / 100, given.words[0], given.duration)
    before = run(given.program, folder, text)
    for what, line in INPUTS.items():
        word, number = line.split()
        after = run(given.program, folder, text.replace(line, f"{word} {float(number) * (1 + CHANGE)!r}"))
        print(
            json.dumps(
                {
                    "model": name,
                    "input": what,
                    "conditions": {key: value / CHANGE for key, value in errors(after, before).items()},
                }
            ),
            flush=True,
        )


def compare(given, folder, name, tolerances):
    """Prints the lines of one model."""

    def show(**line):
        print(json.dumps({"model": name, **line}), flush=True)

    exact = (
        None
        if given.steps_alike
        else run(given.program, folder, model(name, min(tolerances) / 10, "all modes", given.duration))
    )
    for tolerance in tolerances:
        whole = run(given.program, folder, model(name, tolerance, "all modes", given.duration))
        show(
            tolerance=tolerance,
            words="all modes",
            errors=exact and errors(whole, exact),
            seconds=whole[2],
            impacts=len(whole[0]["impacts"]),
        )
        for words in given.words:
            found = run(given.program, folder, model(name, tolerance, words, given.duration))
            left = found[0]["solver"].get("reduction", {}).get("left", {})
            show(
                tolerance=tolerance,
                words=words,
                errors=exact and errors(found, exact),
                by_reduction=errors(found, whole),
                told=told(found[0]),
                coordinates=left.get("coordinates"),
                unknowns=left.get("unknowns"),
                blocks=left.get("blocks"),
                seconds=found[2],
                impacts=len(found[0]["impacts"]),
                warnings=found[0]["warnings"],
            )


if __name__ == "__main__":
    main()
