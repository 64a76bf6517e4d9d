#!/usr/bin/env python3
"""A city block: growth of reading, set-up, memory, steps and files with the number of buildings.

    python3 tests/benchmarks/city_block.py PROGRAM [--sizes 10,20,40,80] [--short 400]

The block is that of examples/25_city_block: a ring of buildings of 6 to 20 storeys, every pair of neighbours linked at
all common floors by two points, with ground motion along x and y for 4 s. Prints one line of JSON per size: processor
time (less affected by other load than wall-clock time) for reading alone and for the whole run, the peak memory, steps,
events, impacts, and the size of the results file. The sizes after --short run for 20 ms only: reading, set-up and steps
without an impact. Needs the Python package in PYTHONPATH.
"""

import argparse
import json
import os
import runpy
import subprocess
import sys
import tempfile
from pathlib import Path

LESSON = Path(__file__).resolve().parents[2] / "examples/25_city_block/city_block.py"


def used(command):
    """(processor time [s], MB) of a process."""
    with tempfile.TemporaryFile() as errors:
        child = subprocess.Popen(
            [str(word) for word in command],
            stdout=subprocess.DEVNULL,
            stderr=errors,
            env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        )
        status, usage = os.wait4(child.pid, 0)[1:]
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode:
            errors.seek(0)
            raise RuntimeError(errors.read().decode())
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def measure(program, folder, buildings, duration, make):
    import h5py

    across = max(1, round(buildings / 5))
    made = make["model"](make["ring"](buildings // 2 - across, across), f"{buildings} buildings", tolerance="1e-3")
    made.compare, made.analysis = None, {**made.analysis, "duration": duration}
    yaml, results = folder / "block.yaml", folder / "block.h5"
    yaml.write_text(made.to_yaml())
    reading, _ = used([program, "check", yaml])
    seconds, memory = used([program, "run", yaml, "-q", "-o", results])
    with h5py.File(results) as file:
        solver = {name: float(data[()]) for name, data in file["solver"].items() if isinstance(data, h5py.Dataset)}
        impacts, links = len(file["impacts"]), len(file["links"])
    print(
        json.dumps(
            {
                "buildings": len(made.structures),
                "links": links,
                "simulated": duration,
                "seconds_reading": reading,
                "seconds": seconds,
                "memory_mb": memory,
                "steps": solver["steps"] + solver["rejected"],
                "events": solver["events"],
                "impacts": impacts,
                "wall": {name: round(value, 3) for name, value in solver.items() if name.startswith("wall")},
                "file_mb": results.stat().st_size / 1e6,
            }
        ),
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--sizes", default="10,20,40,80")
    parser.add_argument("--short", default="400")
    given = parser.parse_args()
    make = runpy.run_path(str(LESSON))
    print(f"load average {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores", file=sys.stderr)
    with tempfile.TemporaryDirectory() as folder:
        for sizes, duration in ((given.sizes, 4.0), (given.short, 0.02)):
            for buildings in (int(word) for word in sizes.split(",") if word):
                measure(given.program, Path(folder), buildings, duration, make)


if __name__ == "__main__":
    main()
