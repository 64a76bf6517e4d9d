#!/usr/bin/env python3
"""The cost of hinges that never yield: the frames of yielding_frames.py with hinges too strong to yield, compared with
the same frames without hinges.

    python3 tests/benchmarks/never_yielding.py PROGRAM [--repeats 15] [--models frame,pair,towers]

One line of JSON per model: hinges, quartiles of the wall-clock time of whole runs with and without them, run
alternately [s], their ratio, and the numbers of datasets that are bitwise identical in both results files, and that
differ.
"""

import argparse
import json
import re
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import h5py

import yielding_frames
from yielding import records

STRONG = 1e12  # [N m]
RIGID = f"      hinges:\n        beams: {{at: both, yield_moment: {STRONG!r}, hardening: 0.003}}\n        columns: {{at: feet, yield_moment: {STRONG!r}, hardening: 0.003}}\n"


def models(name, folder):
    """The YAML with and without hinges."""
    if name == "towers":
        return yielding_frames.towers(STRONG), yielding_frames.towers(None)
    text = getattr(yielding_frames, name)("1e-3", records(folder)[name], "esdirk4")
    return tuple(re.sub(r"      hinges:\n.*\n.*\n", hinges, text) for hinges in (RIGID, ""))


def equal(first, second):
    """Numbers of datasets that are bitwise identical in both files, and that differ, without times, texts and the
    input."""
    counts = [0, 0]

    def visit(name, one):
        if (
            isinstance(one, h5py.Dataset)
            and name in second
            and one.dtype.kind == "f"
            and not name.startswith(("solver", "input"))
        ):
            counts[one[()].tobytes() != second[name][()].tobytes()] += 1

    first.visititems(visit)
    return counts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--repeats", type=int, default=15)
    parser.add_argument("--models", default="frame,pair,towers")
    given = parser.parse_args()
    for name in given.models.split(","):
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            both = {"with": [], "without": []}
            for which, text in zip(both, models(name, folder)):
                (folder / f"{which}.yaml").write_text(text)
            for _ in range(given.repeats):
                for which, seconds in both.items():
                    start = time.perf_counter()
                    subprocess.run(
                        [given.program, "run", folder / f"{which}.yaml", "-q", "-o", folder / f"{which}.h5"],
                        check=True,
                        stderr=subprocess.DEVNULL,
                    )
                    seconds.append(time.perf_counter() - start)
            quartile = {which: statistics.quantiles(seconds, n=4)[0] for which, seconds in both.items()}
            with h5py.File(folder / "without.h5") as without, h5py.File(folder / "with.h5") as strong:
                hinges = sum(
                    len(structure["springs/names"])
                    for structure in strong["structures"].values()
                    if "springs/names" in structure
                )
                same, other = equal(without, strong)
        print(
            json.dumps(
                {
                    "model": name,
                    "hinges": hinges,
                    **quartile,
                    "ratio": quartile["with"] / quartile["without"],
                    "equal": same,
                    "different": other,
                }
            ),
            flush=True,
        )


if __name__ == "__main__":
    main()
