"""The part of a plan that workers need: the template of its models, the values that factors set in them, and templates
prepared in the process that runs their rows, so that models and records are read once."""

from __future__ import annotations

import copy
import pickle
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding._studies import reading
from pounding._studies.factors import Factor, at, find, in_order, kept_of_link, put
from pounding._studies.motions import Motion, scaled
from pounding._studies.quantities import Kept

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


Made = TypeVar("Made")
#: Number of cached scaled motions; consecutive rows share a record at all its levels.
KEPT_MOTIONS = 32
KEPT_RECORDS = 4


class Last:
    """A small cache of the most recent items by key."""

    def __init__(self, count: int) -> None:
        self._count = count
        self._kept: OrderedDict[Hashable, Any] = OrderedDict()

    def get(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """The item with this key, created if it is missing."""
        if key not in self._kept:
            self._kept[key] = make()
            if len(self._kept) > self._count:
                self._kept.popitem(last=False)
        self._kept.move_to_end(key)
        found: Made = self._kept[key]
        return found


class Prepared:
    """The rows of one template."""

    def __init__(self, template: Template) -> None:
        self.template = template
        self.kernel: Any = None  #: the template prepared by the kernel
        self.places = Places(template.model, template.factors)
        self._rows = core.RowModel(
            yaml_text.emit(template.model),
            "row",
            [[str(key) for key in keys] for keys in self.places.keys],
            template.files,
        )
        self._motions, self._records = Last(KEPT_MOTIONS), Last(KEPT_RECORDS)
        self._varies_ground = any(keys[0] == "ground_motion" for keys in self.places.keys)

    def motion(self, record: int, scale: float, files: Mapping[str, bytes]) -> core.RowMotion | None:
        """Ground motion of a row; None if it depends on the values of factors, or if there is none. Raises
        InputError."""
        given = self.template.motions[record]
        own = self.template.model.get("ground_motion")
        if self._varies_ground or not given.words and own is None:
            return None
        if given.words and given.is_record:
            unscaled = self._records.get(
                record, lambda: self._read(self.template.ground_motion(own, record, 1.0), files)
            )
            return self._motions.get((record, scale), lambda: unscaled.scaled(scale))
        return self._motions.get(
            (record, scale), lambda: self._read(self.template.ground_motion(own, record, scale), files)
        )

    def _motion_of_row(
        self, values: np.ndarray, record: int, scale: float, files: Mapping[str, bytes]
    ) -> core.RowMotion | None:
        if not self._varies_ground:
            return self.motion(record, scale, files)
        return self._read(self.template.case(values.tolist(), record, scale)["ground_motion"], files)

    def _read(self, ground: Any, files: Mapping[str, bytes]) -> core.RowMotion:
        return core.RowMotion(yaml_text.emit({"ground_motion": ground}), "row", {**self.template.files, **files})

    def put(self, numbers: np.ndarray) -> None:
        """Sets the values of one row, in the order of the places."""
        self.put_texts(self.places.texts(numbers))

    def put_texts(self, texts: list[str]) -> None:
        """Sets texts in the order of the places."""
        self._rows.put(texts)

    def linear(self, motion: core.RowMotion | None, accelerations: bool, alone: bool) -> core.LinearRow:
        """The current row for the kernel. Raises InputError, also for rows that need the solver."""
        return self._rows.linear(motion, accelerations, alone)

    def run(self, values: np.ndarray, record: int, scale: float, files: Mapping[str, bytes]) -> dict[str, Any]:
        """Summary of the run of one row; `files` are those of its motion. Raises InputError, SolverError."""
        self.template.begin(values)
        self.put(self.places.numbers(values[None, :])[0])
        motion = self._motion_of_row(values, record, scale, files)
        return self._rows.run(motion, self.template.kept.needs_whole)


class _OfThread(threading.local):
    """Prepared templates of one thread; models change from row to row and cannot be shared."""

    def __init__(self) -> None:
        self.prepared = Last(2)
        self.key: tuple[Template, bytes] | None = None


_mine = _OfThread()


def prepared(template: Template) -> Prepared:
    """The prepared template, cached per thread because workers receive it with every batch."""
    return _mine.prepared.get(key_of(template), lambda: Prepared(template))


def key_of(template: Template) -> bytes:
    """A key shared by copies of a template."""
    # All rows of a batch share one object.
    if _mine.key is None or _mine.key[0] is not template:
        try:
            _mine.key = template, pickle.dumps(template)
        except (pickle.PicklingError, AttributeError, TypeError):
            # A function that cannot be pickled runs in this process only, where the prepared template keeps its address.
            _mine.key = template, str(id(template)).encode()
    return _mine.key[1]
