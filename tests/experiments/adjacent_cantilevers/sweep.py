"""Predicts the response of the adjacent cantilevers with impacts: the tables prediction_*.csv next to this file.

    python3 sweep.py rest > prediction_rest.csv       # one run from rest per frequency
    python3 sweep.py stepped > prediction_stepped.csv # one run per level, damping 0.1 %; the frequency steps upwards

The amplitude is half the range of the displacement of the right beam's tip relative to the base in each of the last
periods at a frequency, divided by the gap: its mean over these periods, its minimum and its maximum.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from itertools import product
from pathlib import Path

import numpy as np
import pounding

HERE = Path(__file__).parent
GAP = 0.17e-3  # [m]
FREQUENCY = 28.2  # [Hz], of the source
LEVELS = (0.020, 0.028, 0.0305)  # base acceleration [m/s^2]
DAMPING = (0.0005, 0.001, 0.003)
RATIOS = np.round(np.arange(0.98, 1.0401, 0.005), 4)
DURATION = 40  # of a run from rest [s]
HOLD = 12  # time at one frequency of a stepped run [s]
STEP = 0.5e-3  # of its record [s]
PERIODS = 100  # at the end of a frequency, of which the amplitude is taken
MOTION = "harmonic: {amplitude: 0.020 m/s^2, period: 35.4609929 ms, duration: 100 s}"
Amplitude = tuple[float, float, float]


def model(motion: str, damping: float, duration: float) -> str:
    """The input with another motion and damping."""
    text = (HERE / "model.yaml").read_text()
    changes = ((MOTION, motion), ("ratio: 0.1 %", f"ratio: {damping}"), ("duration: 1 s", f"duration: {duration}"))
    for old, new in changes:
        if old not in text:
            raise ValueError(f"model.yaml does not contain {old!r}")
        text = text.replace(old, new)
    return text


def run(text: str, folder: Path) -> pounding.Results:
    """Results of a run of the program."""
    path = folder / "model.yaml"
    path.write_text(text)
    command = [os.environ.get("POUNDING_PROGRAM", "pounding"), "run", str(path), "-o", str(folder / "out.h5")]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return pounding.read(folder / "out.h5")


def amplitude(results: pounding.Results, end: float, ratio: float) -> Amplitude:
    """Mean, minimum and maximum over the gap in the periods before `end` [s]."""
    nodes = results.structures["right"].nodes
    motion = nodes.displacement[:, nodes.names.index("tip"), 0]
    number = np.floor((end - results.time) * ratio * FREQUENCY + 1e-9)
    found = [np.ptp(motion[number == k]) / 2 / GAP for k in range(PERIODS)]
    return float(np.mean(found)), float(np.min(found)), float(np.max(found))


def from_rest(level: float, ratio: float, damping: float) -> Amplitude:
    """Amplitude of a run from rest."""
    motion = f"harmonic: {{amplitude: {level}, period: {1 / (ratio * FREQUENCY):.12g}, duration: 100 s}}"
    with tempfile.TemporaryDirectory() as folder:
        return amplitude(run(model(motion, damping, DURATION), Path(folder)), DURATION, ratio)


def stepped(level: float, damping: float) -> Iterator[tuple[float, Amplitude]]:
    """Amplitudes at all frequencies of one run, in which the phase of the motion is continuous."""
    time = np.arange(0, HOLD * len(RATIOS) + STEP / 2, STEP)
    frequency = FREQUENCY * RATIOS[np.minimum((time / HOLD).astype(int), len(RATIOS) - 1)]
    phase = np.concatenate([[0], np.cumsum(2 * np.pi * frequency[:-1] * STEP)])
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        np.savetxt(folder / "motion.txt", np.column_stack([time, level * np.sin(phase)]), fmt=["%.4f", "%.9e"])
        motion = f"record: {folder / 'motion.txt'}\n  units: m/s^2"
        results = run(model(motion, damping, HOLD * len(RATIOS)), folder)
        for i, ratio in enumerate(RATIOS):
            yield ratio, amplitude(results, (i + 1) * HOLD, ratio)


def main() -> None:
    """Prints a table."""
    print("base_acceleration_m_s2,damping_ratio,frequency_over_28.2_Hz,amplitude_over_gap,minimum,maximum")
    for level, damping in product(LEVELS, DAMPING if sys.argv[1] == "rest" else DAMPING[1:2]):
        points = (
            stepped(level, damping)
            if sys.argv[1] == "stepped"
            else ((ratio, from_rest(level, ratio, damping)) for ratio in RATIOS)
        )
        for ratio, (mean, low, high) in points:
            print(f"{level},{damping},{ratio},{mean:.4f},{low:.4f},{high:.4f}", flush=True)


if __name__ == "__main__":
    main()
