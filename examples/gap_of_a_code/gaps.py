"""Writes pairs.csv: pairs of periods in four ranges, with gaps of 50, 70 and 100 % of a code's rule.

    python3 gaps.py [PAIRS]     PAIRS of each range, 40 unless given

The rule is that of ASCE 7 and Eurocode 8 inside a property: the root of the sum of squares of both largest
displacements, here those of the mean elastic spectrum of the study's 25 motions."""

import sys

import numpy as np

import pounding

RANGES = ((0.1, 0.5), (0.5, 1.0), (1.0, 2.0), (2.0, 3.0))  #: of both periods [s]
SHARES = (0.5, 0.7, 1.0)
MOTIONS = {"synthetic": {"count": 25, "duration": "15 s", "pga": "0.35 g", "soil": "firm"}}


def mean_spectrum(model, periods):
    """Mean of the largest displacements [m] of an oscillator that touches nothing."""
    alone = pounding.study(
        model,
        {
            "T": {"of": "structures.left.oscillator.period", "list": periods.tolist()},
            "far": {"of": "links.*.gap", "list": [1000]},
        },
        records=MOTIONS,
        keep=["displacement"],
        workers=0,
        progress=False,
    )
    return alone["displacement.left"].reshape(-1, len(periods)).mean(axis=0)


def main(pairs):
    periods = np.geomspace(RANGES[0][0], RANGES[-1][-1], 200)
    spectrum = mean_spectrum("model.yaml", periods)
    lines = ["T1,T2,gap,share"]
    draw = np.random.default_rng(2018)
    for low, high in RANGES:
        for left, right in draw.uniform(low, high, (pairs, 2)):
            code = np.hypot(*np.interp([left, right], periods, spectrum))
            lines += [f"{left:.17g},{right:.17g},{share * code:.17g},{share}" for share in SHARES]
    with open("pairs.csv", "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 40)
