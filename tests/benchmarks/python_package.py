#!/usr/bin/env python3
"""Cost of the Python package: imports, a law per element of an array of a million, a run compared with the program.

PYTHONPATH=build/python .venv/bin/python3 tests/benchmarks/python_package.py build/pounding ... python_package.py
--imports           only these
"""

import subprocess
import sys
import time
from pathlib import Path

import numpy as np

import pounding

ROOT = Path(__file__).resolve().parents[2]
MODEL = ROOT / "examples/02_two_oscillators/model.yaml"
SIZE = 1_000_000
MASS = 6e4


def best(task, times=7, clock=time.perf_counter):
    """Minimum of several times [s]."""
    taken = []
    for _ in range(times):
        begin = clock()
        task()
        taken.append(clock() - begin)
    return min(taken)


def process(code):
    """Wall time of a Python process, including its start [s]."""
    return best(lambda: subprocess.run([sys.executable, "-c", code], check=True), 5)


def typical(kind):
    given = {p.name: p.typical for p in kind.parameters if p.need in ("required", "optional")}
    if kind.takes_restitution:
        given["restitution"] = 0.65
    return kind(**given, reduced_mass=MASS if kind.takes_reduced_mass else None)


def imports():
    bare = process("pass")
    for words in ("import pounding", "import numpy", "import pounding; pounding.laws", "import pounding; pounding.run"):
        print(f"{words:<40}{process(words) - bare:8.3f} s")


def main():
    imports()
    if "--imports" in sys.argv:
        return
    generator = np.random.default_rng(1)
    penetration, rate = generator.uniform(0, 1e-2, SIZE), generator.uniform(-1, 1, SIZE)
    print(f"\n{'law':<30}{'force':>12}{'with slopes':>14}   ns an element, {SIZE} elements")
    for name, kind in pounding.laws.items():
        if kind.instantaneous:
            continue
        law = typical(kind)
        force, slopes = (
            1e9 / SIZE * best(lambda: ask(penetration, rate, 0.5), 15, time.process_time)
            for ask in (law.force, law.respond)
        )
        print(f"{name:<30}{force:12.2f}{slopes:14.2f}")
    if len(sys.argv) > 1:
        ours = best(lambda: pounding.run(MODEL))
        program = best(lambda: subprocess.run([sys.argv[1], "run", MODEL, "-q"], check=True))
        print(
            f"\npounding.run {1e3 * ours:.1f} ms, the program as a process {1e3 * program:.1f} ms ({MODEL.parent.name})"
        )


if __name__ == "__main__":
    main()
