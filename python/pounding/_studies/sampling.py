"""Points of the factors: a grid of lists and ranges, times a sample of the distributions or a table of samples."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from pounding._studies import reading
from pounding._studies.distributions import stats
from pounding._studies.factors import Factor, check_units, find
from pounding.errors import InputError

_DECIMAL = re.compile(
    r"[ \t\r]*[-+]?(?:(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|nan|inf)[ \t\r]*", re.IGNORECASE | re.ASCII
)


@dataclass(frozen=True)
class Points:
    """Values of all factors. The sample is the same at every grid point, so that differences between grid points
    contain no sampling noise, and their confidence bands are not independent."""

    factors: tuple[Factor, ...]
    grid: tuple[int, ...]  #: lengths of the lists, in the order of their factors
    sample: np.ndarray  #: [point, sampled factor]; one point without columns if no factor is sampled
    way: str  #: "grid", or the method of `sampling:`

    @property
    def count(self) -> int:
        """Number of points: grid times sample."""
        return math.prod(self.grid) * len(self.sample)

    def columns(self, points: np.ndarray) -> dict[str, np.ndarray]:
        """Values of the factors at some points, by name."""
        grid_point, sample_point = np.divmod(points, len(self.sample))
        on_grid = np.unravel_index(grid_point, self.grid) if self.grid else ()
        found, i, j = {}, 0, 0
        for factor in self.factors:
            if factor.values is not None:
                found[factor.name] = np.asarray(factor.values)[on_grid[i]]
                i += 1
            else:
                found[factor.name] = self.sample[sample_point, j]
                j += 1
        return found


def read_points(factors: Sequence[Factor], sampling: Any, seed: int, model: Mapping[str, Any], folder: Path) -> Points:
    """The points of `sampling:`, a dict with its method or "grid". Relative names of files start from `folder`. Raises
    InputError."""
    columns = [factor for factor in factors if factor.column]
    if columns or "table" in sampling:
        return _from_table(factors, sampling, model, folder)
    distributed = [factor for factor in factors if factor.distribution is not None]
    grid = tuple(len(factor.values) for factor in factors if factor.values is not None)
    if sampling == "grid":
        if distributed:
            raise InputError(
                f"study.factors.{distributed[0].name} has a distribution, and the number of samples is missing; type sampling: "
                "{sobol: 128} or {latin_hypercube: 100}"
            )
        return Points(tuple(factors), grid, np.empty((1, 0)), "grid")
    ((way, count),) = sampling.items()
    if not distributed:
        raise InputError(
            "study.sampling: no factor has a distribution to sample, and lists and ranges form a grid; remove sampling, or "
            "write a factor as uniform: {from: 10 mm, to: 40 mm}"
        )
    if way in ("sobol", "saltelli") and count & (count - 1):
        below = 1 << (count.bit_length() - 1)
        raise InputError(
            f"study.sampling.{way}: a Sobol sequence is balanced for powers of two only; type {below} or {2 * below} instead of {count}"
        )
    uniform = _uniform(way, len(distributed), count, seed)
    sample = np.column_stack(
        [factor.distribution.ppf(uniform[:, j]) for j, factor in enumerate(distributed) if factor.distribution]
    )
    return Points(tuple(factors), grid, sample, way)


def _from_table(factors: Sequence[Factor], sampling: Any, model: Mapping[str, Any], folder: Path) -> Points:
    """Points from a table of samples: a file, or arrays by name, with one sample per row."""
    other = [factor for factor in factors if factor.distribution is not None]
    columns = [factor for factor in factors if factor.column]
    if "table" not in sampling or not columns or other:
        named = f"study.factors.{(columns or other or list(factors))[0].name}" if factors else "study.factors"
        raise InputError(
            f"{named}: a table of samples has the values of all factors without a list: write column: NAME in each of them, and "
            "sampling: {table: FILE.csv}"
        )
    table = sampling["table"]
    found = (
        {name: (_array(values, name), "") for name, values in table.items()}
        if isinstance(table, Mapping)
        else _read_table(folder / table)
    )
    made, sample = [], []
    for factor in factors:
        if factor.column:
            if factor.column not in found:
                raise InputError(
                    f'study.factors.{factor.name}.column: the table has no column "{factor.column}"; it has {", ".join(found)}.'
                    f"{reading.did_you_mean(factor.column, found)}"
                )
            values, unit = found[factor.column]
            if factor.times is not None and unit:
                raise InputError(
                    f"study.factors.{factor.name}: with times it is a ratio, without a unit; its column is in {unit}"
                )
            check_units(
                model,
                [keys for path in factor.of for keys in find(model, path, "")],
                unit,
                f"study.factors.{factor.name}",
            )
            sample.append(values)
            factor = replace(factor, unit=unit)
        made.append(factor)
    if (
        len({values.shape for values in sample}) != 1
        or sample[0].ndim != 1
        or not len(sample[0])
        or not np.isfinite(sample).all()
    ):
        raise InputError("study.sampling.table: takes columns of finite numbers, of one length")
    grid = tuple(len(factor.values) for factor in factors if factor.values is not None)
    return Points(tuple(made), grid, np.column_stack(sample), "table")


def _array(values: Any, name: str) -> np.ndarray:
    """A column given as a list. Raises InputError for values that are not numbers."""
    every = values if isinstance(values, list) else [values]
    numbers = [_number(value) if isinstance(value, str) else None for value in every]
    if None in numbers:
        raise InputError(
            f"study.sampling.table.{name}: takes a list of numbers; {every[numbers.index(None)]!r} was read"
        )
    return np.array(numbers, dtype=float)


def _read_table(path: Path) -> dict[str, tuple[np.ndarray, str]]:
    """Columns in SI and their units, by the names in the first line: `T,gap (mm)`. Raises InputError."""
    if not os.path.isfile(path):
        raise InputError(f"study.sampling.table: no such file: {path}")
    try:
        head, *lines = path.read_text(encoding="utf-8").strip().splitlines() or [""]
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"study.sampling.table: {error}") from None
    names: list[str] = []
    factors, units = [], []
    for cell in head.removeprefix("\ufeff").split(","):
        name, _, unit = cell.strip().removesuffix(")").partition("(")
        factor, si = reading.quantity(f"1 {unit.strip()}" if unit else 1.0, f"{path}:1: {cell.strip()}")
        if name.strip() in names:
            raise InputError(f'{path}:1: two columns are called "{name.strip()}"; give each column its own name')
        names.append(name.strip())
        factors.append(factor)
        units.append(si)
    rows = [[_number(cell) for cell in line.split(",")] for line in lines]
    wrong = next((i for i, row in enumerate(rows) if len(row) != len(names) or None in row), None)
    if wrong is not None:
        bad = next((cell.strip() for cell, number in zip(lines[wrong].split(","), rows[wrong]) if number is None), None)
        raise InputError(
            f"{path}:{wrong + 2}: takes {len(names)} numbers with commas between them, one for each of {', '.join(names)}"
            + (f'; "{bad}" was read' if bad else "")
        )
    values = np.array(rows, dtype=float).reshape(len(lines), len(names))
    return {name: (values[:, j] * factors[j], units[j]) for j, name in enumerate(names)}


def _number(cell: str) -> float | None:
    """A decimal number; None for other texts, including Python's 1_0 and digits of other scripts."""
    return float(cell) if _DECIMAL.fullmatch(cell) else None


def _uniform(way: str, dimensions: int, count: int, seed: int) -> np.ndarray:
    generator = np.random.default_rng(seed)
    if way == "sobol":
        return stats().qmc.Sobol(dimensions, rng=generator).random(count)
    if way == "latin_hypercube":
        return stats().qmc.LatinHypercube(dimensions, rng=generator).random(count)
    if way == "random":
        return generator.random((count, dimensions))
    try:
        from SALib.sample import sobol
    except ModuleNotFoundError as error:
        raise ImportError("sampling: {saltelli: n} needs SALib: type python3 -m pip install SALib") from error
    return np.asarray(
        sobol.sample(saltelli_problem(dimensions), count, calc_second_order=False, seed=seed), dtype=float
    )


def saltelli_problem(dimensions: int) -> dict[str, Any]:
    """SALib's description of factors that are probabilities."""
    return {"num_vars": dimensions, "names": [f"x{i}" for i in range(dimensions)], "bounds": [[0.0, 1.0]] * dimensions}
