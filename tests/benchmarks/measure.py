"""Shared by the benchmarks: running a program, its error against a reference, and the time at an error."""

import json
import math
import os
import subprocess
import time
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent
ERRORS = (1e-3, 1e-4, 1e-6)
# CHOLMOD uses four threads for any OMP_NUM_THREADS; only a thread limit prevents it.
ONE_THREAD = {
    **os.environ,
    "OMP_NUM_THREADS": "1",
    "OMP_THREAD_LIMIT": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
}


def reference(name):
    return json.loads((FOLDER / "reference" / f"{name}.json").read_text())


def run_json(command, timeout=3600):
    """The JSON object printed by a program, with `process_seconds`; or `failed` with the reason."""
    start = time.perf_counter()
    try:
        done = subprocess.run(
            [str(c) for c in command], capture_output=True, text=True, env=ONE_THREAD, timeout=timeout
        )
    except subprocess.TimeoutExpired:
        return {"failed": f"stopped after {timeout} s"}
    seconds = time.perf_counter() - start
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode or not lines:
        return {"failed": (done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1]}
    return json.loads(lines[-1]) | {"process_seconds": seconds}


def displacement_error(u, truth):
    """Largest difference relative to the largest displacement [-]."""
    return float(np.abs(np.asarray(u) - np.asarray(truth)).max() / np.abs(truth).max())


def peak_error(peaks, truth):
    """Largest relative error of the impacts' peak forces; 1 if the number of impacts differs."""
    if len(peaks) != len(truth):
        return 1.0
    return max((abs(p / t - 1) if t else float(p != 0) for p, t in zip(peaks, truth)), default=0.0)


def at_error(points, error, key="seconds"):
    """Time at which a work-precision curve reaches `error`: {"seconds", "bound", "best"}.

    points: {"error", key} each. Linear interpolation in logarithms between the last point above the error and the first
    one at or below it. `bound` is true if the cheapest measured point already reaches it, so that the time is an upper
    bound. If no point does, seconds is None and best is the point with the smallest error.
    """
    before = None
    for point in sorted(points, key=lambda p: p[key]):
        if point["error"] <= error:
            if before is None:
                return {"seconds": point[key], "bound": True}
            part = math.log(before["error"] / error) / math.log(before["error"] / max(point["error"], 1e-300))
            return {"seconds": before[key] * (point[key] / before[key]) ** part, "bound": False}
        if before is None or point["error"] <= before["error"]:
            before = point
    return {"seconds": None, "best": before}


def factor(peer, ours):
    """(number, text, sense): OpenSees' time over pounding's; sense "=", ">" (a lower bound), "<" (an upper bound) or
    "?".

    If OpenSees misses the error, its best run is used, which gives a lower bound on the ratio; so does a pounding curve
    whose cheapest point already reaches the error. Such an OpenSees curve gives an upper bound.
    """
    if ours["seconds"] is None or (peer["seconds"] is None and not peer.get("best")):
        return None, "-", "?"
    missed = peer["seconds"] is None
    value = (peer["best"]["seconds"] if missed else peer["seconds"]) / ours["seconds"]
    above, below = missed or ours["bound"], not missed and peer["bound"]
    sense = "?" if above and below else ">" if above else "<" if below else "="
    return value, {"=": "", ">": "more than ", "<": "at most ", "?": "about "}[sense] + f"{value:.3g}", sense


def verdict(value, sense, wanted):
    """yes, no, or open if the ratio is only bounded on the wrong side."""
    if value is None:
        return "-"
    if value >= wanted:
        return "yes" if sense in "=>" else "open"
    return "no" if sense in "=<" else "open"
