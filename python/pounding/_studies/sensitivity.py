"""Sensitivities of a table: Sobol indices with SALib, and the swings of tornado diagrams."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from pounding._studies.percentiles import finite, order_statistic
from pounding._studies.rows import Rows
from pounding._studies.sampling import saltelli_problem
from pounding.errors import InputError


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
