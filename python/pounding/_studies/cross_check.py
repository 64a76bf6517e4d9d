"""Cross-check of the engines: a sample of the rows of the kernel also runs with the solver."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

#: Interval of checked rows, and their minimum number.
ONE_IN, MIN_ROWS = 1000, 3
#: Relative difference above which a row is listed.
LARGE = 1e-3


def rows_to_check(count: int) -> np.ndarray:
    """Indices of the rows of a plan that run with both engines, evenly spaced."""
    return np.unique(np.linspace(0, count - 1, min(count, max(MIN_ROWS, count // ONE_IN))).astype(np.int64))


def differences(kernel: np.ndarray, solver: np.ndarray) -> np.ndarray:
    """|a - b| relative to the larger absolute value; 0 if both are equal or both are NaN."""
    larger = np.maximum(np.abs(kernel), np.abs(solver))
    with np.errstate(invalid="ignore", divide="ignore"):
        apart = np.abs(kernel - solver) / larger
    apart = np.where(np.isnan(kernel) != np.isnan(solver), np.inf, apart)
    return np.where((kernel == solver) | (np.isnan(kernel) & np.isnan(solver)), 0.0, apart)


def report_lines(check: Mapping[int, np.ndarray], values: np.ndarray, columns: Sequence[str]) -> list[str]:
    """Lines of the report: number of compared rows and their differences. `values` are those of the table."""
    if not check or not columns:
        return []
    rows = sorted(check)
    apart = differences(values[rows], np.array([check[row] for row in rows]))
    worst, where = apart.max(axis=1), apart.argmax(axis=1)
    lines = [
        f"{len(rows)} rows run by both engines: they differ by {np.median(worst):.1e} in the median row, {worst.max():.1e} at most"
    ]
    far = [f"{rows[i]} ({columns[where[i]]} by {worst[i]:.1e})" for i in np.flatnonzero(worst > LARGE)]
    if far:
        lines.append(
            f"  beyond {LARGE:g}: rows {', '.join(far[:5])}{f' and {len(far) - 5} more' if len(far) > 5 else ''}; grazing impacts cause such "
            "differences, and so do errors: run these rows with a tenth of the tolerance"
        )
    return lines
