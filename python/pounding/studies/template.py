"""All that a worker needs to run rows. Workers import this and no more than numpy: they start once a study, each of
them."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pounding.studies.factors import Factor, put
from pounding.studies.motions import Motion, scaled
from pounding.studies.places import Places
from pounding.studies.quantities import Kept


@dataclass(frozen=True)
class Template:
    """The model, where the factors go, the motions, and what is kept."""

    #: parts of the input in texts; of a ground motion that records replace only what holds for each of them
    model: dict[str, Any]
    place: str  #: file that the model stands for in messages
    factors: tuple[Factor, ...]
    motions: tuple[Motion, ...]
    kept: Kept
    engine: str = "auto"  #: the engine of all rows, or "auto"
    files: Mapping[str, bytes] = field(default_factory=dict)  #: contents of the files that the model names

    def begin(self, values: np.ndarray) -> None:
        """Called before the solver runs a row, with the values of its factors."""

    def case(self, values: list[float], record: int, scale: float) -> dict[str, Any]:
        """The model of one row."""
        made = copy.deepcopy(self.model)
        places = Places(self.model, self.factors)
        for keys, text in zip(places.keys, places.texts(places.numbers(np.array([values]))[0])):
            put(made, keys, text)
        ground = self.ground_motion(made.get("ground_motion"), record, scale)
        if ground is not None:
            made["ground_motion"] = ground
        return made

    def ground_motion(self, given: Mapping[str, Any] | None, record: int, scale: float) -> dict[str, Any] | None:
        """`ground_motion` of one row, from that of the model with the values of the row; None for a still ground."""
        motion = self.motions[record]
        if motion.words:
            return {**motion.scaled(scale), **(given or {})}
        return None if given is None else dict(given) if scale == 1 else scaled(given, scale)
