#!/usr/bin/env python3
"""A row of bodies whose links touch one after the other, with some hundreds of active contacts: time, memory, impacts,
energy balance.

    python3 tests/benchmarks/many_links.py build/pounding --links 10000 --duration 1e-3 --tolerance 1e-3
"""

import argparse
import json
import os
import random
import resource
import subprocess
import sys
import tempfile
from pathlib import Path


def row(links, duration, tolerance):
    """Random masses, velocities and gaps; an impact takes half a millisecond, in which one link of a hundred comes into
    contact."""
    chance = random.Random(1)
    lines = ["structures:"]
    lines += [
        f"  b{i}: {{body: {{mass: {chance.uniform(1e4, 1e5):.0f}}}, initial_velocity: {chance.uniform(-0.5, 0.5):.4f}}}"
        for i in range(links + 1)
    ]
    lines += ["links:"]
    lines += [
        f"  - {{between: [b{i}, b{i + 1}], gap: {chance.uniform(0.05, 0.5):.4f} mm, law: hertz_damped, stiffness: 1e12, restitution: 0.6}}"
        for i in range(links)
    ]
    return "\n".join(
        [*lines, f"analysis: {{duration: {duration}, tolerance: {tolerance}, output_step: {duration / 10}}}\n"]
    )


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("program")
    words.add_argument("--links", type=int, default=10000)
    words.add_argument("--duration", type=float, default=1e-3, help="[s]")
    words.add_argument("--tolerance", type=float, default=1e-3)
    chosen = words.parse_args()
    program = os.path.abspath(chosen.program)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "model.yaml").write_text(row(chosen.links, chosen.duration, chosen.tolerance))
        done = subprocess.run(
            [program, "run", "model.yaml", "--json", "-o", "out.h5"],
            cwd=folder,
            stdout=subprocess.PIPE,
            text=True,
            check=False,
        )
    if done.returncode != 0:
        sys.exit(done.returncode)
    used, summary = resource.getrusage(resource.RUSAGE_CHILDREN), json.loads(done.stdout)
    energy, solver = summary["energy"], summary["solver"]
    impacts = [link["impacts"] for link in summary["links"]]
    print(
        f"{chosen.links} links, {sum(impacts)} impacts of {sum(count > 0 for count in impacts)} links, {solver['steps']} steps: "
        f"{used.ru_utime + used.ru_stime:.0f} s of a processor, {used.ru_maxrss / 1024:.0f} MB"
    )
    print(
        f"energy (J): input {energy['input']:.6g}, lost in impacts and stored by them {energy['impact']:.6g}, "
        f"largest imbalance {energy['error']:.1e} of the input"
    )
    closes = energy["error"] < 10 * chosen.tolerance and sum(impacts) > 0
    sys.exit(0 if closes else 1)


if __name__ == "__main__":
    main()
