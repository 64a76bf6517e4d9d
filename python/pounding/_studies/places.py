"""Values of a model that factors set: their paths are found once for all rows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from pounding._studies import reading
from pounding._studies.factors import Factor, at, find, in_order

Keys = tuple[str | int, ...]


class Places:
    """Values that the rows of a study set in their model, for many rows together."""

    def __init__(self, model: Mapping[str, Any], factors: Sequence[Factor]) -> None:
        self.keys: list[Keys] = []  #: [place]
        self.factor: list[int] = []  #: [place] index of the factor
        self._factors = factors
        self._base: list[int | float | None] = []  # [place] base of a ratio: the index of a place, or a number
        self._held: list[Any] = []  # [place] value in the model
        # Each ratio comes after the factor that sets its base.
        for j in in_order(model, factors):
            base = self._base_of(model, factors[j])
            for path in factors[j].of:
                for keys in find(model, path, factors[j].name):
                    self.keys.append(keys)
                    self.factor.append(j)
                    self._base.append(base)
                    self._held.append(at(model, keys))

    def _base_of(self, model: Mapping[str, Any], factor: Factor) -> int | float | None:
        if factor.times is None:
            return None
        keys = find(model, factor.times, factor.name)[0]
        return self.keys.index(keys) if keys in self.keys else reading.quantity(at(model, keys), factor.times)[0]

    def numbers(self, values: np.ndarray) -> np.ndarray:
        """[row, place] in SI, from the [row, factor] of a batch; indices of labels."""
        found = np.empty((len(values), len(self.keys)))
        for i, (j, base) in enumerate(zip(self.factor, self._base)):
            found[:, i] = (
                values[:, j] if base is None else values[:, j] * (found[:, base] if isinstance(base, int) else base)
            )
            slope, shift = self._factors[j].slope, self._factors[j].shift
            if (slope, shift) != (1.0, 0.0):
                found[:, i] = slope * found[:, i] + shift
        return found

    def texts(self, numbers: np.ndarray) -> list[str]:
        """Texts for the model from the numbers of one row."""
        return [
            self._factors[j].word(number, held) for j, number, held in zip(self.factor, numbers.tolist(), self._held)
        ]
