"""Engines: what turns rows into columns. `ENGINES` is the seam where a faster one plugs in."""

from __future__ import annotations

from time import perf_counter
from typing import Protocol

import numpy as np

from pounding.errors import InputError, shortened
from pounding.studies.batches import (
    COLLAPSED,
    COMPLETE,
    DIED,
    DONE,
    EXCEEDED,
    FAILED,
    NOT_RUN,
    REFUSED,
    STATUSES,
    Batch,
    Done,
    nothing_of,
)
from pounding.studies.kernel_engine import KernelEngine
from pounding.studies.prepared import prepared
from pounding.studies.quantities import collapse_of
from pounding.studies.template import Template

__all__ = [
    "COLLAPSED",
    "COMPLETE",
    "DIED",
    "DONE",
    "ENGINES",
    "EXCEEDED",
    "FAILED",
    "KERNEL",
    "NOT_RUN",
    "REFUSED",
    "STATUSES",
    "WORDS",
    "Batch",
    "Done",
    "Engine",
    "SolverEngine",
    "nothing_of",
    "run_batch",
    "run_kernel",
]


class Engine(Protocol):
    """An engine. A row's columns may depend on nothing but the row: on no other row of the batch, and on nothing that
    ran before."""

    name: str

    def takes(self, template: Template) -> bool:
        """Whether it can run rows of this study; False where it is known beforehand that there are none."""

    def run(self, batch: Batch) -> Done:
        """The columns of the rows. A wrong or failed row is a status with a reason, never an exception. Rows that the
        engine does not take stay as they are, with the reason, and the next engine gets them. Raises MemoryError."""


class SolverEngine:
    """Each row is a run of the solver, in memory."""

    name = "solver"

    def takes(self, template: Template) -> bool:
        """It takes every model."""
        return True

    def run(self, batch: Batch) -> Done:
        """One run after the other."""
        done = nothing_of(batch)
        for i, row in enumerate(batch.rows.tolist()):
            begin = perf_counter()
            done.status[i], values, reason = self._row(batch, i)
            done.seconds[i] = perf_counter() - begin
            if values:
                done.values[i] = values
            if reason:
                done.reasons[row] = reason
        return done

    def _row(self, batch: Batch, i: int) -> tuple[int, list[float], str]:
        template = batch.template
        try:
            summary = prepared(template).run(batch.values[i], int(batch.record[i]), float(batch.scale[i]), batch.files)
            values = template.kept.of(summary)
            if undefined := template.kept.undefined_limits(np.array([values])):
                raise InputError(
                    f"study.limits: {', '.join(undefined)} is undefined in this row, so it cannot be compared with its limit"
                )
        except InputError as error:
            return REFUSED, [], str(error)
        except MemoryError:  # of the process, whatever the row
            raise
        except Exception as error:
            return FAILED, [], shortened(str(error)) or type(error).__name__
        if collapse := collapse_of(summary):
            return COLLAPSED, values, collapse
        return (EXCEEDED if template.kept.exceeded(np.array([values]))[0] else DONE), values, ""


#: In the order of preference; a table names its engines in this order.
ENGINES: list[Engine] = [KernelEngine(), SolverEngine()]
KERNEL = 0
#: Words of `engine:` in a study.
WORDS = ("auto", *(engine.name for engine in ENGINES))


def run_kernel(batch: Batch) -> Done:
    """Runs the rows that the kernel takes; the others stay as they are."""
    done = nothing_of(batch)
    done.take(np.arange(len(batch.rows)), ENGINES[KERNEL].run(batch), KERNEL)
    return done


def run_batch(batch: Batch) -> Done:
    """Runs rows in a worker, each by the first engine that takes it; must stay a function of a module, since workers
    get it by its name."""
    done = nothing_of(batch)
    left = np.arange(len(batch.rows))
    for number, engine in enumerate(ENGINES):
        if batch.engine in ("auto", engine.name) and len(left) and engine.takes(batch.template):
            done.take(left, engine.run(batch.part(left)), number)
            left = left[done.status[left] == NOT_RUN]
    for row in batch.rows[left].tolist():
        done.status[batch.rows == row] = REFUSED
        done.reasons[row] = (
            f"engine: {batch.engine} does not take this row: {done.reasons.get(row, 'the study is none for it')}. Leave engine out, and the solver does"
        )
    return done
