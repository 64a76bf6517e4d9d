#!/usr/bin/env python3
"""Random rows of two to five bodies, all laws: every run ends, closes its energy and lets nobody through.

    python3 tests/program/stress.py build/pounding --seed 1 --count 10000

Mass ratios over three decades, stiffness over four, periods from 0.05 to 3 s, gaps from zero to wide, equal and unequal,
restitutions 0.05 to 1, ground motions or initial velocities or both, walls at the ends. A case that goes wrong is printed
whole, as an input file. Exit code 1 when there is one.
"""
import argparse
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

LINEAR = ["linear_spring", "kelvin_voigt", "kelvin_voigt_no_tension", "komodromos", "modified_linear_viscoelastic", "modified_kelvin"]
HERTZ = ["hertz", "hertz_damped", "jankowski", "bilinear_hertz", "viscous_hertz", "kuwabara_kono", "adams_impact", "limited_damper"]
LOSSLESS = {"linear_spring", "hertz"}
TOLERANCE = 1e-4
#: The balance is a difference of sums over impacts that amplify one another's errors.
LARGEST_IMBALANCE = 10 * TOLERANCE
SECONDS = 60


def link(chance, left, right, gap):
    law = chance.choice(LINEAR + HERTZ + ["stereomechanical"])
    restitution = chance.choice([0.05, 0.1, 0.3, 0.5, 0.65, 0.8, 0.95, 1.0])
    if law == "bilinear_hertz":  # its loop cannot lose more
        restitution = max(restitution, 0.5)
    words = [f"between: [{left}, {right}]", f"gap: {gap:.6g}", f"law: {law}"]
    if law != "stereomechanical":
        words.append(f"stiffness: {10 ** (chance.uniform(6, 9) if law in LINEAR else chance.uniform(7, 11)):.5g}")
    if law not in LOSSLESS:
        words.append(f"restitution: {restitution}")
    if law == "adams_impact":
        words.append(f"depth: {10 ** chance.uniform(-4, -2.5):.3g}")
    return "  - {" + ", ".join(words) + "}\n"


def model(chance):
    count = chance.randint(2, 5)
    text = ""
    if chance.random() < 0.7:
        text += (f"ground_motion: {{harmonic: {{amplitude: {chance.uniform(0.5, 5):.5g}, period: {chance.uniform(0.1, 1.5):.5g}, "
                 f"duration: {chance.uniform(0.5, 3):.5g}}}}}\n")
    text += "structures:\n"
    for k in range(count):
        if count > 2 and k in (0, count - 1) and chance.random() < 0.2:
            text += f"  b{k}: {{wall: {{}}}}\n"
            continue
        mass, speed = 10 ** chance.uniform(3, 6), chance.choice([0, chance.uniform(-1, 1)])
        if chance.random() < 0.8:
            text += (f"  b{k}: {{oscillator: {{mass: {mass:.6g}, period: {10 ** chance.uniform(-1.3, 0.5):.5g}, "
                     f"damping: {chance.choice([0, 2, 5, 10])} %}}, initial_velocity: {speed:.5g}}}\n")
        else:
            text += f"  b{k}: {{body: {{mass: {mass:.6g}}}, initial_velocity: {speed:.5g}}}\n"
    text += "links:\n"
    gap = chance.choice([0, 1e-3, 5e-3, 0.02, 0.1])
    for k in range(count - 1):
        own = gap if chance.random() < 0.5 else gap + chance.choice([1e-6, chance.uniform(0, 0.02)])
        text += link(chance, f"b{k}", f"b{k + 1}", own)
    return text + f"analysis: {{duration: 3, tolerance: {TOLERANCE}}}\n"


def fault(program, path):
    """What is wrong with the run, or nothing."""
    try:
        done = subprocess.run([program, "run", path, "--json"], capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return f"it took more than {SECONDS} s"
    if done.returncode != 0:
        return done.stderr
    energy = json.loads(done.stdout)["energy"]
    if not energy["error"] < LARGEST_IMBALANCE:
        return f"the energies do not close: {energy['error']}"
    return None


def main():
    words = argparse.ArgumentParser()
    words.add_argument("program")
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--count", type=int, default=10000)
    chosen = words.parse_args()
    faults = 0
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.yaml"
        for number in range(chosen.count):
            text = model(random.Random(chosen.seed * 1_000_000 + number))
            path.write_text(text)
            wrong = fault(chosen.program, path)
            if wrong:
                faults += 1
                print(f"case {number}: {wrong}\n{text}", flush=True)
            if sys.stderr.isatty():
                print(f"\r{number + 1} of {chosen.count}, {faults} faults", end="", file=sys.stderr)
    print(f"{chosen.count} cases, {faults} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
