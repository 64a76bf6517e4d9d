#!/usr/bin/env python3
"""The synthetic ground motion of the frames: 20 s, 0.4 g, every 0.005 s.

    python3 tests/benchmarks/motion.py FILE       # two columns, time [s] and acceleration [m/s^2]

White noise (seed 2025) through a Kanai-Tajimi filter (15.7 rad/s, 0.6) and a Clough-Penzien high-pass (1.57 rad/s,
0.6), an envelope (t/2)^2 to 2 s, 1 to 9 s, exp(-0.3 (t-9)) after, and a Butterworth high-pass at 0.1 Hz.
"""

import sys

import numpy as np
from scipy.signal import bilinear, butter, lfilter, sosfiltfilt

STEP = 0.005


def motion(seed=2025, peak=0.4 * 9.81, duration=20.0):
    """Times [s] and accelerations [m/s^2]."""
    count = round(duration / STEP) + 1
    t = np.arange(count) * STEP
    a = np.random.default_rng(seed).standard_normal(count)
    for numerator, w, z in (([2 * 0.6 * 15.7, 15.7**2], 15.7, 0.6), ([1, 0, 0], 1.57, 0.6)):
        a = lfilter(*bilinear(numerator, [1, 2 * z * w, w * w], fs=1 / STEP), a)
    a *= np.where(t < 2, (t / 2) ** 2, np.where(t < 9, 1.0, np.exp(-0.3 * (t - 9))))
    a = sosfiltfilt(butter(2, 0.1, "highpass", fs=1 / STEP, output="sos"), a)
    a[0] = 0.0
    return t, a * (peak / np.abs(a).max())


if __name__ == "__main__":
    np.savetxt(sys.argv[1], np.column_stack(motion()), fmt="%.15e")
