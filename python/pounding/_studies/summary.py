"""Summary of a study, for scripts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pounding._studies.percentiles import finite, order_statistic
from pounding._studies.quantities import COLLAPSED_COLUMN
from pounding._studies.rows import Rows
from pounding.errors import InputError

PERCENTS: tuple[float, ...] = (16, 50, 84)


def summary(
    study: Rows,
    column: str | None = None,
    limit: float | str | None = None,
    percent: Sequence[float] = PERCENTS,
    where: Mapping[str, float | str] | None = None,
) -> dict[str, Any]:
    """Counts of rows by status; minimum, mean, maximum, percentiles (order statistics) and the fraction of rows above
    zero of every kept column, in SI; and the fragility curve of a column above a limit, or of collapse.

    `where` selects rows by values of factors for the columns and the curve. Infinite numbers, of collapsed rows, are None and counted in `infinite`. Failed rows are excluded. Raises InputError
    for an unknown column."""
    where = where or {}
    chosen = study.choose(**where) if where else study.finished
    kept: Sequence[str] = study.description["kept"]["columns"]
    found: dict[str, Any] = {
        "rows": len(study),
        "status": study.counts,
        "columns": {name: _of_column(study[name][chosen], percent) for name in kept},
    }
    if where:
        found["where"] = dict(where)
        found["chosen"] = int(chosen.sum())
    if options := study.description.get("options"):
        found["options"] = list(options)
    if study.warnings:
        found["warnings"] = list(study.warnings)
    if column is not None:
        if column not in (*kept, COLLAPSED_COLUMN):
            raise InputError(f'unknown column "{column}"; known: {", ".join(kept)}')
        given: dict[str, Any] = dict(where)
        curve = study.fragility(column, limit, **given)
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


def _of_column(values: np.ndarray, percent: Sequence[float]) -> dict[str, float | None]:
    known = values[~np.isnan(values)]
    if not len(known):
        return {}
    by_rank = {f"{one:g} %": finite(order_statistic(known, one)) for one in percent}
    found: dict[str, float | None] = {
        "min": finite(known.min()),
        "mean": finite(known.mean()),
        "max": finite(known.max()),
        **by_rank,
        "share above 0": float((known > 0).mean()),
    }
    infinite, undefined = int(np.isinf(known).sum()), len(values) - len(known)
    return {**found, **({"infinite": infinite} if infinite else {}), **({"undefined": undefined} if undefined else {})}


def percentile_table(study: Rows, percent: Sequence[float], where: Mapping[str, float | str]) -> str:
    """One line per kept column, in readable units: mean, percentiles (order statistics), smallest and largest value.

    Raises InputError if no row has these values of factors."""
    if not study.finished.any():
        return "no finished rows"
    chosen = study.choose(**where) if where else study.finished
    heads = ["", "min", "mean", *(f"{one:g} %" for one in percent), "max", ""]
    lines = [heads]
    for name in study.description["kept"]["columns"]:
        found = _of_column(study[name][chosen], percent)
        largest = max((abs(value) for key in ("min", "max") if (value := found.get(key)) is not None), default=0.0)
        size, unit = readable_unit(largest, study.units.get(name, ""))
        numbers = [found.get(key, np.nan) for key in ("min", "mean", *(f"{one:g} %" for one in percent), "max")]
        cells = [
            "-" if value is not None and np.isnan(value) else "inf" if value is None else f"{value / size:.4g}"
            for value in numbers
        ]
        notes = [f"{found[key]:.0f} {key}" for key in ("infinite", "undefined") if found.get(key)]
        lines.append([f"{name} [{unit}]" if unit else name, *cells, ", ".join(notes)])
    widths = [max(len(line[j]) for line in lines) for j in range(len(heads))]
    pooled = [name for name in study.factors if name not in where and len(np.unique(study[name][chosen])) > 1]
    about = f"{int(chosen.sum())} finished rows" + "".join(f", {name}={value}" for name, value in where.items())
    if pooled:
        about += f", all values of {', '.join(pooled)} together (choose with --where)"
    return "\n".join(
        [
            about,
            *(
                f"{line[0]:<{widths[0]}}  "
                + "  ".join(f"{cell:>{width}}" for cell, width in zip(line[1:-1], widths[1:]))
                + (f"  {line[-1]}" if line[-1] else "")
                for line in lines
            ),
        ]
    )


def readable_unit(largest: float, unit: str) -> tuple[float, str]:
    """Size in SI and name of the unit of numbers up to `largest`."""
    if unit == "m":
        return (1e-3, "mm") if largest < 1 else (1.0, "m")
    if unit == "rad":
        return (1e-3, "mrad") if largest < 1 else (1.0, "rad")
    if unit in ("N", "N m", "N s", "J"):
        return next(
            ((size, prefix + unit) for size, prefix in ((1e6, "M"), (1e3, "k")) if largest >= 0.5 * size), (1.0, unit)
        )
    return 1.0, unit
