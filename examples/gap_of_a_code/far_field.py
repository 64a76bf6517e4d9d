"""Prints how often gaps of 50, 70 and 100 % of a code's rule are not enough for the recorded motions of FEMA P-695, far
field.

    python3 far_field.py [PAIRS]     PAIRS of periods from 0.1 s to 0.5 s, a power of two, 128 unless given

The rule is the root of the sum of squares of both displacements, which a design spectrum of 1, 1.25 ... 2 times the
mean of the records gives. A linear pair touches if the required gap exceeds its gap, so one run without links covers
every gap."""

import sys

import numpy as np

import pounding

SHARES = (0.5, 0.7, 1.0)
ABOVE_THE_MEAN = (1.0, 1.25, 1.5, 1.75, 2.0)


def not_enough(model, records, pairs):
    """[above, share] part of the rows that need more than the gap."""
    factors = {
        f"T{i}": {"of": f"structures.{side}.oscillator.period", "uniform": {"from": 0.1, "to": 0.5}}
        for i, side in ((1, "left"), (2, "right"))
    }
    found = pounding.study(
        model,
        factors,
        records=records,
        sampling={"sobol": pairs},
        keep=["displacement", "required_gap"],
        without_links=True,
    )
    left, right, needed = (
        found[name].reshape(-1, pairs)
        for name in ("displacement.left.alone", "displacement.right.alone", "required_gap")
    )
    code = np.hypot(left.mean(axis=0), right.mean(axis=0))
    return np.array([[(needed > above * share * code).mean() for share in SHARES] for above in ABOVE_THE_MEAN])


if __name__ == "__main__":
    for factor, row in zip(
        ABOVE_THE_MEAN, not_enough("model.yaml", {"set": "far_field"}, int(sys.argv[1]) if len(sys.argv) > 1 else 128)
    ):
        print(f"{factor:4.2f} times the mean: " + ", ".join(f"{100 * part:.1f} %" for part in row))
