"""Rows on an executor: chunks of about half a second, resume, and workers that may die.

Any `concurrent.futures.Executor` runs the chunks: local processes unless another one is given, `mpi4py.futures.MPIPoolExecutor` or
Dask's `Client.get_executor()` likewise. When a local worker dies, the rows that were under way run again one by one, and the row
that kills its worker is told as such; the others are not lost."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, ProcessPoolExecutor, wait
from statistics import median

import numpy as np

from pounding.errors import InputError, SolverError
from pounding.studies.engines import DIED, FAILED, REFUSED, Batch, Done, engine_for, nothing_of, run_batch
from pounding.studies.plan import Plan
from pounding.studies.table import Table
from pounding.studies.worker import begin_worker, run_alone, say_hello

#: Wall time that a chunk shall take [s]; schedulers cost some 0.2 to 1 ms a chunk.
CHUNK_SECONDS = 0.5
#: Rows after which the share of failed ones counts.
ENOUGH_ROWS = 20
#: Called after every chunk with the numbers of rows done, failed, and in all.
Progress = Callable[[int, int, int], None]


def batch_of(plan: Plan, rows: np.ndarray) -> Batch:
    """The rows as a worker gets them."""
    columns = plan.columns(rows)
    values = np.column_stack([columns[factor.name] for factor in plan.points.factors]) if plan.points.factors else np.empty((len(rows), 0))
    return Batch(plan.template, rows, values, columns["record"], columns["scale"], engine_for(plan.template).name)


def run_rows(plan: Plan, table: Table, rows: np.ndarray, workers: int | None = None, executor: Executor | None = None,
             chunk: int | None = None, progress: Progress | None = None) -> None:
    """Runs rows and adds them to the table. `workers` processes, as many as there are cores unless given; 0 runs in this process. `chunk`
    is a number of rows instead of one by time. Raises OSError when a chunk cannot be written, SolverError when too many rows fail."""
    if not len(rows):
        return
    work = _Work(plan, table, rows, chunk, progress)
    if executor is None and workers == 0:
        for batch in work.batches():
            work.finish(run_batch(batch))
    elif executor is not None:
        _run_on(_Given(executor), work, getattr(executor, "_max_workers", None) or os.cpu_count() or 1)
    else:
        count = min(workers or available_cores(), len(rows))
        with _LocalPool(count) as pool:
            _run_on(pool, work, count)


def available_cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class _Work:
    """Rows that wait, and what is known of their time."""

    def __init__(self, plan: Plan, table: Table, rows: np.ndarray, chunk: int | None, progress: Progress | None) -> None:
        self._plan, self._table, self._rows, self._chunk, self._progress = plan, table, rows, chunk, progress
        self._seconds: list[float] = []
        self._done = self._failed = 0

    def batches(self) -> Iterator[Batch]:
        """One batch after the other; each is sized when it is asked for, and rows of one batch follow each other in the plan."""
        begin = 0
        while begin < len(self._rows):
            size = self._chunk or self._size()
            end = min(begin + size, len(self._rows))
            yield batch_of(self._plan, self._rows[begin:end])
            begin = end

    def _size(self) -> int:
        if not self._seconds:
            return 1
        return int(np.clip(CHUNK_SECONDS / max(median(self._seconds[-50:]), 1e-7), 1, 20000))

    def finish(self, done: Done) -> None:
        """Takes finished rows."""
        self._table.add(done)
        self._seconds.append(float(done.seconds.mean()))
        self._done += len(done.rows)
        self._failed += int(np.isin(done.status, (REFUSED, FAILED, DIED)).sum())
        if self._progress is not None:
            self._progress(self._done, self._failed, len(self._rows))
        if self._done >= ENOUGH_ROWS and self._failed > self._plan.stop_after * self._done and self._done < len(self._rows):
            reason = next(iter(self._table.reasons.values()), "")
            raise SolverError(f"{self._failed} of {self._done} rows have failed, more than stop_after ({100 * self._plan.stop_after:g} %); the first because: "
                              f"{reason}\nMend the study, or go on with stop_after: 100 %")


class _Given:
    """An executor of somebody else."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor

    def submit(self, batch: Batch) -> Future[Done]:
        return self._executor.submit(run_alone, batch)

    def survive(self, batches: list[Batch], failure: BaseException) -> list[Done]:
        raise failure


class _LocalPool:
    """Processes on this machine. A pool that breaks is made again."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._pool = _new_pool(workers)

    def __enter__(self) -> _LocalPool:
        try:
            self._pool.submit(say_hello).result()
        except BrokenExecutor:
            self._pool.shutdown(cancel_futures=True)
            raise InputError("the worker processes of the study do not start. In a script put the call under `if __name__ == \"__main__\":`, since every worker "
                             "reads the script, too; or run in this process with workers=0") from None
        return self

    def __exit__(self, *failure: object) -> None:
        self._pool.shutdown(cancel_futures=True)

    def submit(self, batch: Batch) -> Future[Done]:
        return self._pool.submit(run_batch, batch)

    def survive(self, batches: list[Batch], failure: BaseException) -> list[Done]:
        """Runs the rows that were under way when a worker died, each by itself in a pool of one."""
        if not isinstance(failure, BrokenExecutor):
            raise failure
        self._pool.shutdown(cancel_futures=True)
        done = []
        single = _new_pool(1)
        for batch in batches:
            for i in range(len(batch.rows)):
                one = batch.part([i])
                processes: list[multiprocessing.Process] = []
                try:
                    future = single.submit(run_batch, one)
                    processes = list((getattr(single, "_processes", None) or {}).values())
                    done.append(future.result())
                except BrokenExecutor:
                    single.shutdown()
                    done.append(_died(one, processes))
                    single = _new_pool(1)
        single.shutdown()
        self._pool = _new_pool(self._workers)
        return done


def _new_pool(workers: int) -> ProcessPoolExecutor:
    # Forked children would share PETSc and MPI with this process.
    return ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn"), initializer=begin_worker)


def _died(batch: Batch, processes: list[multiprocessing.Process]) -> Done:
    done = nothing_of(batch, DIED)
    codes = [process.exitcode for process in processes if process.exitcode]
    how = f"signal {-codes[0]}" if codes and codes[0] < 0 else f"code {codes[0]}" if codes else "without a code"
    done.reasons = {int(batch.rows[0]): f"worker died: {how}"}
    return done


def _run_on(pool: _Given | _LocalPool, work: _Work, workers: int) -> None:
    """Keeps two chunks a worker under way."""
    waiting = work.batches()
    under_way: dict[Future[Done], Batch] = {}
    more = True
    while True:
        broken: BaseException | None = None
        while more and len(under_way) < 2 * workers and broken is None:
            batch = next(waiting, None)
            more = batch is not None
            if batch is not None:
                try:
                    under_way[pool.submit(batch)] = batch
                except BrokenExecutor as error:
                    broken, under_way[_failed_future(error)] = error, batch
        if not under_way:
            return
        finished, _ = wait(under_way, return_when=FIRST_COMPLETED)
        lost: list[Batch] = []
        for future in finished:
            failure = future.exception()
            if failure is None:
                under_way.pop(future)
                work.finish(future.result())
            else:
                broken = failure
        if broken is not None:
            for future in list(under_way):
                batch = under_way.pop(future)
                if future.done() and future.exception() is None:
                    work.finish(future.result())
                else:
                    lost.append(batch)
            for done in pool.survive(lost, broken):
                work.finish(done)


def _failed_future(error: BaseException) -> Future[Done]:
    future: Future[Done] = Future()
    future.set_exception(error)
    return future
