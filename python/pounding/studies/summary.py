"""Summary of a study, for scripts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pounding.errors import InputError
from pounding.studies.batches import STATUSES
from pounding.studies.percentiles import finite, order_statistic
from pounding.studies.quantities import COLLAPSED_COLUMN
from pounding.studies.rows import Rows

PERCENTS = (16, 50, 84)


def summary(study: Rows, column: str | None = None, limit: float | str | None = None) -> dict[str, Any]:
    """Counts of rows by status; minimum, mean, maximum, percentiles (order statistics) and the fraction of rows above
    zero of every kept column, in SI; and the fragility curve of a column above a limit, or of collapse.

    Infinite numbers, of collapsed rows, are None and counted in `infinite`. Failed rows are excluded. Raises InputError
    for an unknown column."""
    status = study["status"]
    kept: Sequence[str] = study.description["kept"]["columns"]
    found: dict[str, Any] = {
        "rows": len(study),
        "status": {word: int((status == i).sum()) for i, word in enumerate(STATUSES)},
        "columns": {name: _of_column(study[name][study.finished]) for name in kept},
    }
    if options := study.description.get("options"):
        found["options"] = list(options)
    if study.warnings:
        found["warnings"] = list(study.warnings)
    if column is not None:
        if column not in (*kept, COLLAPSED_COLUMN):
            raise InputError(f'unknown column "{column}"; known: {", ".join(kept)}')
        curve = study.fragility(column, limit)
        found["fragility"] = {
            "theta": finite(curve.theta),
            "beta": finite(curve.beta),
            "problem": curve.problem,
            "undefined": curve.undefined,
            "share": dict(zip((f"{im:.6g}" for im in curve.im), (curve.exceeded / curve.count).tolist())),
        }
        if curve.is_finite and curve.boot is not None and len(curve.boot):
            found["fragility"] |= dict(
                zip(("theta_low", "theta_high"), np.percentile(curve.boot[:, 0], (5, 95)).tolist())
            )
    return found


def _of_column(values: np.ndarray) -> dict[str, float | None]:
    known = values[~np.isnan(values)]
    if not len(known):
        return {}
    by_rank = {f"{percent} %": finite(order_statistic(known, percent)) for percent in PERCENTS}
    found: dict[str, float | None] = {
        "min": finite(known.min()),
        "mean": finite(known.mean()),
        "max": finite(known.max()),
        **by_rank,
        "share above 0": float((known > 0).mean()),
    }
    infinite, undefined = int(np.isinf(known).sum()), len(values) - len(known)
    return {**found, **({"infinite": infinite} if infinite else {}), **({"undefined": undefined} if undefined else {})}
