"""Points of the factors: a grid of those with values, times a sample of those with distributions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding.errors import InputError
from pounding.studies import words
from pounding.studies.factors import Factor
from pounding.studies.scipy_stats import stats

_WAYS = ("sobol", "latin_hypercube", "random", "saltelli")


@dataclass(frozen=True)
class Points:
    """Values of all factors. The sample is the same for every point of the grid: differences between grid points are then no noise,
    and confidence bands of different grid points are not independent."""

    factors: tuple[Factor, ...]
    grid: tuple[int, ...]  #: lengths of the lists, in the order of their factors
    sample: np.ndarray  #: [point, distributed factor]; one point without columns where nothing is distributed
    way: str  #: "grid", or one of those of `sampling:`

    @property
    def count(self) -> int:
        """Number of points: grid times sample."""
        return int(np.prod(self.grid, dtype=np.int64)) * len(self.sample)

    def columns(self, points: np.ndarray) -> dict[str, np.ndarray]:
        """Values of the factors at some points, by their names."""
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


def read_points(factors: Sequence[Factor], given: Any, seed: int) -> Points:
    """The points that `sampling:` asks for. Raises InputError."""
    distributed = [factor for factor in factors if factor.distribution is not None]
    grid = tuple(len(factor.values) for factor in factors if factor.values is not None)
    if given is None or given == "grid":
        if distributed:
            raise InputError(f"study.factors.{distributed[0].name} has a distribution: say how many samples, as in sampling: {{sobol: 128}} or "
                             "{latin_hypercube: 100}")
        return Points(tuple(factors), grid, np.empty((1, 0)), "grid")
    one = words.only(given, _WAYS, "study.sampling")
    if len(one) != 1:
        raise InputError(f"study.sampling: takes one of {', '.join(_WAYS)}, as in {{sobol: 128}}")
    way, count = next((way, words.whole(value, f"study.sampling.{way}")) for way, value in one.items())
    if not distributed:
        raise InputError("study.sampling: no factor has a distribution to take samples from; lists and ranges make a grid by themselves, so leave "
                         "sampling out, or write a factor as uniform: {from: 10 mm, to: 40 mm}")
    if way in ("sobol", "saltelli") and count & (count - 1):
        below = 1 << (count.bit_length() - 1)
        raise InputError(f"study.sampling.{way}: a Sobol sequence is balanced for powers of two only; type {below} or {2 * below} instead of {count}")
    uniform = _uniform(way, len(distributed), count, seed)
    sample = np.column_stack([factor.distribution.ppf(uniform[:, j]) for j, factor in enumerate(distributed) if factor.distribution])
    return Points(tuple(factors), grid, sample, way)


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
    return np.asarray(sobol.sample(saltelli_problem(dimensions), count, calc_second_order=False, seed=seed), dtype=float)


def saltelli_problem(dimensions: int) -> dict[str, Any]:
    """SALib's description of factors that are probabilities."""
    return {"num_vars": dimensions, "names": [f"x{i}" for i in range(dimensions)], "bounds": [[0.0, 1.0]] * dimensions}
