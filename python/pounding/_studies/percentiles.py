"""Evaluations of tables: percentiles over records, maps over two factors, Sobol indices with SALib, and the swings of
tornado diagrams."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from pounding._arguments import number, takes
from pounding._studies.sampling import saltelli_problem
from pounding.errors import InputError

if TYPE_CHECKING:
    from pounding._studies.rows import Rows


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


@dataclass(frozen=True)
class Indices:
    """Sobol indices of the factors for the mean over records and levels."""

    names: tuple[str, ...]
    first: np.ndarray  #: fraction of the variance due to the factor alone
    total: np.ndarray  #: including interactions with other factors
    first_band: np.ndarray  #: half-width of the 95 % band, from SALib's bootstrap
    total_band: np.ndarray

    def __str__(self) -> str:
        return "\n".join(
            f"{name:<16} first {a:7.4f} +- {b:.4f}   total {c:7.4f} +- {d:.4f}"
            for name, a, b, c, d in zip(self.names, self.first, self.first_band, self.total, self.total_band)
        )


def sobol_indices(study: Rows, column: str) -> Indices:
    """The indices of a study with sampling: {saltelli: n}. Raises InputError for another sampling or failed rows,
    which unbalance the sample, and ImportError without SALib."""
    if study.description["sampling"]["way"] != "saltelli":
        raise InputError("indices need a Saltelli sample; write sampling: {saltelli: 256} and run the study again")
    if not study.finished.all():
        raise InputError(
            f"{int((~study.finished).sum())} of {len(study)} rows have no numbers, and indices need all of them; see study.failed"
        )
    without = int((~np.isfinite(study[column])).sum())
    if without:
        raise InputError(
            f"{column} is infinite or undefined in {without} of {len(study)} rows, as after a collapse, and indices need numbers; take those of the "
            'probability of collapse: indices("collapsed")'
        )
    names = tuple(factor["name"] for factor in study.description["factors"] if factor["distribution"] is not None)
    sample = study.description["sampling"]["count"]
    if study["point"].max() + 1 != sample:
        raise InputError(
            "indices need a study whose factors are all distributed; give the lists and ranges as distributions, or one value each"
        )
    try:
        from SALib.analyze import sobol
    except ModuleNotFoundError as error:
        raise ImportError("indices need SALib: type python3 -m pip install SALib") from error
    means = np.bincount(study["point"], weights=study[column], minlength=sample) / np.bincount(
        study["point"], minlength=sample
    )
    found = sobol.analyze(saltelli_problem(len(names)), means, calc_second_order=False, seed=1)
    return Indices(names, *(np.asarray(found[key]) for key in ("S1", "ST", "S1_conf", "ST_conf")))


def swings(study: Rows, column: str, share: float = 0.1, **chosen: float | str) -> list[tuple[str, float, float]]:
    """Median of a column in the rows with the lowest and with the highest tenth of each factor, largest swing first.
    All other factors vary in both groups, except those with a chosen value."""
    found = []
    finished = study.choose(**chosen) if chosen else study.finished
    for name in study.factors:
        values = study[name] if not chosen else np.where(finished, study[name], study[name][finished][0])
        low, high = (
            np.quantile(values, share, method="inverted_cdf"),
            np.quantile(values, 1 - share, method="inverted_cdf"),
        )
        if low == high:
            continue
        found.append(
            (
                name,
                order_statistic(study[column][finished & (values <= low)], 50),
                order_statistic(study[column][finished & (values >= high)], 50),
            )
        )
    if not found:
        raise InputError("no factor varies")
    # Two infinite medians do not differ.
    return sorted(found, key=lambda one: -abs(one[2] - one[1]) if one[1] != one[2] else 0.0)
