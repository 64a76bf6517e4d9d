"""Templates prepared in the process that runs their rows: models and records are read once."""

from __future__ import annotations

import pickle
import threading
from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping
from typing import Any, TypeVar

import numpy as np

from pounding import _yaml_text as yaml_text
from pounding._native import core
from pounding._studies.places import Places
from pounding._studies.template import Template

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
