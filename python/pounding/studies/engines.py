"""Engines: what turns rows into columns. `ENGINES` is the seam where a faster one plugs in."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from pounding import yaml_text
from pounding._native import core
from pounding.errors import InputError
from pounding.studies.template import Template

NOT_RUN, DONE, EXCEEDED, REFUSED, FAILED, DIED = range(6)
#: The fate of a row, by its number in the column `status`.
STATUSES = ("not run", "done", "exceeded a limit", "refused input", "solve failed", "worker died")


@dataclass(frozen=True)
class Batch:
    """Some rows for one worker."""

    template: Template
    rows: np.ndarray  #: [row] their numbers in the plan
    values: np.ndarray  #: [row, factor] in SI
    record: np.ndarray  #: [row] numbers of motions
    scale: np.ndarray  #: [row] factors on the motions
    engine: str  #: the engine for all of them

    def part(self, chosen: Sequence[int]) -> Batch:
        """Some of the rows."""
        return Batch(self.template, self.rows[chosen], self.values[chosen], self.record[chosen], self.scale[chosen], self.engine)


@dataclass
class Done:
    """The columns of some rows."""

    rows: np.ndarray  #: [row] their numbers in the plan
    values: np.ndarray  #: [row, column] NaN where a row has none
    status: np.ndarray  #: [row] one of STATUSES
    engine: str
    seconds: np.ndarray  #: [row] wall time
    reasons: dict[int, str]  #: of rows that are neither done nor exceeded


class Engine(Protocol):
    """An engine. A row's columns may depend on nothing but the row: on no other row of the batch, and on nothing that ran before."""

    name: str

    def takes(self, template: Template) -> bool:
        """Whether it can run the rows of this study; the first engine of ENGINES that takes them does."""

    def run(self, batch: Batch) -> Done:
        """The columns of the rows. A wrong or failed row is a status with a reason, never an exception."""


class SolverEngine:
    """Each row is a run of the solver, in memory."""

    name = "solver"

    def takes(self, template: Template) -> bool:
        """It takes every model."""
        return True

    def run(self, batch: Batch) -> Done:
        """One run after the other."""
        from time import perf_counter

        done = nothing_of(batch)
        for i, row in enumerate(batch.rows):
            begin = perf_counter()
            done.status[i], values, reason = self._row(batch, i)
            done.seconds[i] = perf_counter() - begin
            if values:
                done.values[i] = values
            if reason:
                done.reasons[int(row)] = reason
        return done

    def _row(self, batch: Batch, i: int) -> tuple[int, list[float], str]:
        kept = batch.template.kept
        try:
            summary = self._summary(batch.template, batch.values[i].tolist(), int(batch.record[i]), float(batch.scale[i]))
            values = kept.of(summary)
        except InputError as error:
            return REFUSED, [], str(error)
        except Exception as error:
            return FAILED, [], str(error) or type(error).__name__
        return (EXCEEDED if kept.is_exceeded(values) else DONE), values, ""

    @staticmethod
    def _summary(template: Template, values: list[float], record: int, scale: float) -> dict[str, Any]:
        ran = core.run(core.Source(yaml_text.emit(template.case(values, record, scale)), "row"), "", [], "", None)
        if ran.raised is not None:
            raise ran.raised
        if ran.failure:
            raise RuntimeError(ran.failure)
        found: dict[str, Any] = json.loads(ran.summary)
        return found


#: In the order of preference.
ENGINES: list[Engine] = [SolverEngine()]


def engine_for(template: Template) -> Engine:
    """The first engine that takes the rows of this study."""
    return next(engine for engine in ENGINES if engine.takes(template))


def run_batch(batch: Batch) -> Done:
    """Runs rows in a worker; must stay a function of a module, since workers get it by its name."""
    return next(engine for engine in ENGINES if engine.name == batch.engine).run(batch)


def nothing_of(batch: Batch, status: int = NOT_RUN) -> Done:
    """Rows without columns."""
    count = len(batch.rows)
    return Done(batch.rows, np.full((count, len(batch.template.kept.columns)), np.nan), np.full(count, status, np.int8), batch.engine,
                np.zeros(count), {})
