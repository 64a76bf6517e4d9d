#!/usr/bin/env python3
"""Time of `pounding.run` compared with its solve, and of a row of a study: minimum of many repeats, in milliseconds of
processor time.

    PYTHONPATH=build/python .venv-test/bin/python3 tests/benchmarks/python_overhead.py
"""

import json
import os
import time
from pathlib import Path

import numpy as np

import pounding
from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding._studies.engines import run_batch
from pounding._studies.execution import batch_of
from pounding._studies.plan import make_plan
from pounding._studies.template import prepared

ROOT = Path(__file__).resolve().parents[2]
TIMES = 40


def best(task):
    """Minimum processor time [ms]."""
    taken = []
    for _ in range(TIMES):
        begin = time.process_time()
        task()
        taken.append(time.process_time() - begin)
    return 1e3 * min(taken)


def frames():
    """Time of a row of lesson 7's frames when only records and levels change, and of the run in it [ms]."""
    model = pounding.Model.from_file(ROOT / "examples/07_plane_frames/model.yaml")
    words = {
        "engine": "solver",
        "records": {"synthetic": {"count": 2, "duration": "1 s", "pga": "0.35 g"}},
        "intensity": {"measure": "pga", "levels": ["0.2 g", "0.4 g"]},
    }
    batch = batch_of(plan := make_plan(model, words, Path()), np.arange(4))
    ready = prepared(plan.template)
    motions = [ready.motion(int(record), float(scale), batch.files) for record, scale in zip(batch.record, batch.scale)]
    return best(lambda: run_batch(batch)) / 4, best(lambda: [ready._rows.run(motion) for motion in motions]) / 4


def main():
    model = pounding.Model.from_file(ROOT / "examples/02_two_oscillators/model.yaml")
    source = model._source()
    native = best(lambda: core.run(source, "", [], "", None))
    reading = best(lambda: core.check(source))
    summary = best(lambda: json.loads(core.run(source, "", [], "", None).summary)) - native
    call = best(lambda: pounding.run(model)) - native
    whole = best(lambda: pounding.run(model).time)
    solve = 1e3 * min(pounding.run(model).summary["solver"]["wall_seconds"] for _ in range(TIMES))
    batch = batch_of(
        plan := make_plan(model, {"factors": {"gap": {"of": "links.*.gap", "list": ["20 mm"]}}}, Path()), np.arange(1)
    )
    row = best(lambda: run_batch(batch))
    case = best(lambda: yaml_text.emit(plan.case(0)))
    print(f"load of the machine {os.getloadavg()[0]:.1f}")
    print(
        f"run in C++, from text to numbers     {native:8.3f} ms, of which set-up and solve by its own clock {solve:.3f} (wall), reading {reading:.3f}"
    )
    print(f"pounding.run of the same model       {call:8.3f} ms; its summary as a dict {summary:.3f} more")
    print(f"pounding.run with all arrays         {whole:8.3f} ms")
    print(f"a row of a study                     {row:8.3f} ms, of which its text {case:.3f}")
    whole, run = frames()
    print(f"a row of two frames                  {whole:8.3f} ms, of which its run in C++ {run:.3f}")


if __name__ == "__main__":
    main()
