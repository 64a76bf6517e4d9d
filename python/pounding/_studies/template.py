"""The part of a plan that workers need. It imports numpy only, because every worker imports it."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from pounding._studies.factors import Factor, at, find, kept_of_link, put
from pounding._studies.motions import Motion, scaled
from pounding._studies.places import Places
from pounding._studies.quantities import Kept


@dataclass(frozen=True)
class Template:
    """The model, the factors and their places, the motions, and the kept columns."""

    #: sections of the input as typed; if records replace the ground motion, only the keys that apply to all of them
    model: dict[str, Any]
    place: str  #: file name of the model in messages
    factors: tuple[Factor, ...]
    motions: tuple[Motion, ...]
    kept: Kept
    engine: str = "auto"  #: the engine of all rows, or "auto"
    files: Mapping[str, bytes] = field(default_factory=dict)  #: contents of files named by the model

    def begin(self, values: np.ndarray) -> None:
        """Called with the values of the factors before each run of the solver."""

    @property
    def alternatives(self) -> list[int]:
        """Indices of the factors that replace maps of the model."""
        return [j for j, factor in enumerate(self.factors) if factor.alternatives]

    def variant(self, labels: Sequence[float]) -> Template:
        """The template with one label of each factor with alternatives, without these factors."""
        made = copy.deepcopy(self.model)
        for j, label in zip(self.alternatives, labels):
            factor = self.factors[j]
            given = factor.alternatives[int(label)]
            for keys in (keys for path in factor.of for keys in find(self.model, path, factor.name)):
                put(
                    made,
                    keys,
                    {**kept_of_link(at(self.model, keys)), **copy.deepcopy(given)}
                    if keys[0] == "links"
                    else copy.deepcopy(given),
                )
        others = tuple(factor for factor in self.factors if not factor.alternatives)
        return replace(self, model=made, factors=others)

    def case(self, values: list[float], record: int, scale: float) -> dict[str, Any]:
        """The model of one row."""
        if chosen := self.alternatives:
            others = [value for j, value in enumerate(values) if j not in chosen]
            return self.variant([values[j] for j in chosen]).case(others, record, scale)
        made = copy.deepcopy(self.model)
        places = Places(self.model, self.factors)
        for keys, text in zip(places.keys, places.texts(places.numbers(np.array([values]))[0])):
            put(made, keys, text)
        ground = self.ground_motion(made.get("ground_motion"), record, scale)
        if ground is not None:
            made["ground_motion"] = ground
        return made

    def ground_motion(self, given: Mapping[str, Any] | None, record: int, scale: float) -> dict[str, Any] | None:
        """`ground_motion` of one row, with the values of its factors; None for a still ground."""
        motion = self.motions[record]
        if motion.words:
            return {**motion.scaled(scale), **(given or {})}
        return None if given is None else dict(given) if scale == 1 else scaled(given, scale)
