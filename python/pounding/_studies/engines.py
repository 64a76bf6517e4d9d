"""Engines that compute the columns of rows, and functions of a worker process. `ENGINES` is the list to extend with
another engine. Imports neither h5py nor scipy, so that workers start quickly."""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import signal
import threading
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter
from typing import Protocol

import numpy as np

from pounding._native import core
from pounding._studies.batches import COLLAPSED, DONE, EXCEEDED, FAILED, NOT_RUN, REFUSED, Batch, Done, nothing_of
from pounding._studies.kernel_engine import KernelEngine
from pounding._studies.quantities import collapse_of
from pounding._studies.template import Template, prepared
from pounding.errors import InputError, shortened


class Engine(Protocol):
    """An engine. The columns of a row depend only on that row, not on other rows of the batch or on earlier
    batches."""

    name: str

    def takes(self, template: Template) -> bool:
        """True if the engine may run rows of this study; False if it cannot run any of them.

        Parameters
        ----------
        template : Template
            The study without its rows.

        Returns
        -------
        bool
            Whether to try it.
        """

    def run(self, batch: Batch) -> Done:
        """Computes the columns of the rows.

        A wrong or failed row gets a status and a reason, never an exception. Rows that the engine cannot run are
        returned with the reason and run with the next engine.

        Parameters
        ----------
        batch : Batch
            The rows.

        Returns
        -------
        Done
            Columns, status and reasons.

        Raises
        ------
        MemoryError
            The process is out of memory.
        """


class SolverEngine:
    """Runs each row with the solver, in memory."""

    name = "solver"

    def takes(self, template: Template) -> bool:
        """True for every model."""
        return True

    def run(self, batch: Batch) -> Done:
        """Runs the rows one after the other."""
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
        except MemoryError:  # concerns the process, not the row
            raise
        except Exception as error:
            return FAILED, [], shortened(str(error)) or type(error).__name__
        if collapse := collapse_of(summary):
            return COLLAPSED, values, collapse
        return (EXCEEDED if template.kept.exceeded(np.array([values]))[0] else DONE), values, ""


#: In order of preference; tables store the index of the engine.
ENGINES: list[Engine] = [KernelEngine(), SolverEngine()]
KERNEL = 0


def _by_alternatives(batch: Batch, run: Callable[[Batch], Done]) -> Done:
    """Runs rows in groups with the same alternatives, each with a separate template."""
    chosen = batch.template.alternatives
    done = nothing_of(batch)
    labels, which = np.unique(batch.values[:, chosen], axis=0, return_inverse=True)
    others = [j for j in range(batch.values.shape[1]) if j not in chosen]
    for i, one in enumerate(labels):
        mine = np.flatnonzero(which.ravel() == i)
        part = batch.part(mine)
        try:
            variant = batch.template.variant(one.tolist())
        except InputError as error:
            done.status[mine] = REFUSED
            done.reasons.update(dict.fromkeys(part.rows.tolist(), str(error)))
            continue
        found = run(replace(part, template=variant, values=part.values[:, others]))
        for name in ("values", "status", "engine", "seconds"):
            getattr(done, name)[mine] = getattr(found, name)
        done.reasons.update(found.reasons)
    return done


def run_kernel(batch: Batch) -> Done:
    """Runs the rows that the kernel can run; the others are left unchanged."""
    if batch.template.alternatives:
        return _by_alternatives(batch, run_kernel)
    done = nothing_of(batch)
    done.take(np.arange(len(batch.rows)), ENGINES[KERNEL].run(batch), KERNEL)
    return done


def run_batch(batch: Batch) -> Done:
    """Runs rows in a worker, each with the first engine that can run it. A function of the module, as pickling
    requires."""
    if batch.template.alternatives:
        return _by_alternatives(batch, run_batch)
    done = nothing_of(batch)
    left = np.arange(len(batch.rows))
    for number, engine in enumerate(ENGINES):
        if batch.engine in ("auto", engine.name) and len(left) and engine.takes(batch.template):
            done.take(left, engine.run(batch.part(left)), number)
            left = left[done.status[left] == NOT_RUN]
    for row in batch.rows[left].tolist():
        done.status[batch.rows == row] = REFUSED
        done.reasons[row] = (
            f"engine: {batch.engine} cannot run this row: {done.reasons.get(row, 'it does not support the study')}; remove engine to use the solver"
        )
    return done


def begin_worker() -> None:
    """Prepares a worker process: it ignores Ctrl-C and SIGHUP, ends with its parent, and limits BLAS to one
    thread."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    threading.Thread(target=_end_with_driver, daemon=True).start()
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def _end_with_driver() -> None:
    """Ends this process when its parent has ended."""
    driver = multiprocessing.parent_process()
    if driver is not None:
        multiprocessing.connection.wait([driver.sentinel])
        os._exit(1)


def say_hello() -> str:
    """Returns once a worker has started and imported the package."""
    return str(core.version)


def run_alone(batch: Batch) -> Done:
    """Same as run_batch, in a worker that MPI may have started together with others."""
    core.run_alone()
    return run_batch(batch)
