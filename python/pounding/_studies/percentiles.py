"""Percentiles over records: curves of incremental dynamic analysis, and maps over two factors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pounding._arguments import number, takes
from pounding.errors import InputError


@dataclass(frozen=True)
class Percentiles:
    """Percentiles of one quantity at every level."""

    im: np.ndarray  #: [level]
    percent: tuple[float, ...]
    values: np.ndarray  #: [percent, level]; infinite if that many rows exceed a limit
    count: np.ndarray  #: [level] rows

    @takes(value=number(), percent=number(0, 100))
    def im_at(self, value: float, percent: float) -> float:
        """Intensity at which a percentile of the quantity first reaches a value, interpolated between levels;
        infinite if it never does. The p-th percentile of the quantity given im corresponds to the (100 - p)-th of im
        given the quantity."""
        if percent not in self.percent:
            raise InputError(f"unknown percentile {percent:g}; known: {', '.join(f'{one:g}' for one in self.percent)}")
        curve = self.values[self.percent.index(percent)]
        above = np.flatnonzero(curve >= value)
        if not above.size:
            return float("inf")
        i = int(above[0])
        if i == 0 or not np.isfinite(curve[i]):
            return float(self.im[i])
        return float(np.interp(value, curve[i - 1 : i + 1], self.im[i - 1 : i + 1]))


@dataclass(frozen=True)
class Map:
    """A percentile over two factors."""

    names: tuple[str, str]
    across: np.ndarray  #: values of the first factor
    along: np.ndarray  #: values of the second factor
    values: np.ndarray  #: [along, across]; NaN without finished rows
    percent: float


def finite(value: float) -> float | None:
    """The number for JSON; None for infinite numbers and NaN."""
    return float(value) if np.isfinite(value) else None


def order_statistic(values: np.ndarray, percent: float) -> float:
    """The smallest value that at least `percent` % of the values do not exceed; infinite values count as values."""
    ordered = np.sort(values[~np.isnan(values)])
    if not ordered.size:
        return float("nan")
    return float(ordered[max(0, int(np.ceil(percent / 100 * ordered.size - 1e-9)) - 1)])


def at_levels(im: np.ndarray, values: np.ndarray, percent: Sequence[float]) -> Percentiles:
    """Percentiles of the rows at every level."""
    # NaN, of a study without an intensity, is one level.
    levels, which = np.unique(im, return_inverse=True, equal_nan=True)
    found = np.array([[order_statistic(values[which == i], p) for i in range(len(levels))] for p in percent])
    return Percentiles(levels, tuple(float(p) for p in percent), found, np.bincount(which, minlength=len(levels)))


def over_two(
    across: np.ndarray,
    along: np.ndarray,
    values: np.ndarray,
    finished: np.ndarray,
    percent: float,
    names: tuple[str, str],
) -> Map:
    """A percentile of the finished rows for every pair of values of two factors."""
    x, i = np.unique(across, return_inverse=True)
    y, j = np.unique(along, return_inverse=True)
    found = np.full((len(y), len(x)), np.nan)
    for a in range(len(x)):
        for b in range(len(y)):
            found[b, a] = order_statistic(values[(i == a) & (j == b) & finished], percent)
    return Map(names, x, y, found, percent)
