"""All that a worker needs to run rows. Workers import this and no more than numpy: they start once a study, each of them."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding.studies.factors import Factor, apply
from pounding.studies.motions import Motion
from pounding.studies.quantities import Kept


@dataclass(frozen=True)
class Template:
    """The model, where the factors go, the motions, and what is kept."""

    model: dict[str, Any]  #: parts of the input in texts
    place: str  #: file that the model stands for in messages
    factors: tuple[Factor, ...]
    motions: tuple[Motion, ...]
    kept: Kept
    engine: str = "auto"  #: the engine of all rows, or "auto"

    def begin(self, values: np.ndarray) -> None:
        """Called before the solver runs a row, with the values of its factors."""

    def case(self, values: list[float], record: int, scale: float) -> dict[str, Any]:
        """The model of one row."""
        made = copy.deepcopy(self.model)
        apply(made, self.factors, values)
        if self.motions[record].words:
            made["ground_motion"] = self.motions[record].scaled(scale)
        return made
