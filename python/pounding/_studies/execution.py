"""Execution of rows in chunks of about half a second, with resumption and recovery from dead workers.

Any `concurrent.futures.Executor` runs the chunks: local processes by default, or `mpi4py.futures.MPIPoolExecutor` and
Dask's `Client.get_executor()`. After the death of a local worker, its rows run again one by one; the row that kills
its worker is reported as such."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from contextlib import ExitStack, contextmanager, nullcontext
from dataclasses import dataclass
from statistics import median

import numpy as np

from pounding._studies.batches import (
    COLLAPSED,
    DIED,
    DONE,
    EXCEEDED,
    FAILED,
    NOT_RUN,
    REFUSED,
    Batch,
    Done,
    nothing_of,
    side_by_side,
)
from pounding._studies.engines import ENGINES, KERNEL, begin_worker, run_alone, run_batch, run_kernel, say_hello
from pounding._studies.plan import Plan
from pounding._studies.table import Table, rows_to_check
from pounding.errors import InputError, SolverError

#: Target run time of a chunk [s]; schedulers have an overhead of 0.2 to 1 ms per chunk.
CHUNK_SECONDS = 0.5
LARGEST_CHUNK = 20000
#: Maximum number of processes.
MAX_WORKERS = 4096
#: Number of rows before stop_after applies.
ENOUGH_ROWS = 20
#: Called after every chunk with the numbers of finished, failed and all rows.
Progress = Callable[[int, int, int], None]


def batch_of(plan: Plan, rows: np.ndarray, engine: str = "") -> Batch:
    """The batch of some rows; `engine` overrides that of the plan."""
    columns = plan.columns(rows)
    values = side_by_side([columns[factor.name] for factor in plan.points.factors], len(rows))
    record, files = columns["record"], plan.files_of(columns["record"])
    return Batch(plan.template, rows, values, record, columns["scale"], engine or plan.template.engine, files)


def run_rows(
    plan: Plan,
    table: Table,
    rows: np.ndarray,
    workers: int | None = None,
    executor: Executor | None = None,
    chunk: int | None = None,
    progress: Progress | None = None,
) -> None:
    """Runs rows and adds them to the table, then repeats a sample of the kernel's rows with the solver.

    `workers` is the number of processes; 0 runs in this process. By default, rows of the kernel run on threads, and
    other rows in one process per core. `chunk` is the number of rows per chunk, by default half a second of run time.
    Raises OSError if a chunk cannot be written, SolverError if too many rows fail."""
    count = workers or available_cores()
    begun = 0
    if (
        workers is None
        and executor is None
        and plan.template.engine != "solver"
        and ENGINES[KERNEL].takes(plan.template)
    ):
        kernel = _KernelWork(plan, table, rows, chunk, progress, count)
        # Threads start quickly and need no guard in scripts; the kernel releases the GIL.
        threads = ThreadPoolExecutor(count)
        try:
            _run_on(_Given(threads, run_kernel), kernel, count)
        finally:
            threads.shutdown(cancel_futures=True)
        begun, rows = len(rows) - len(kernel.left), np.array(sorted(kernel.left), dtype=np.int64)
    with ExitStack() as stack:
        pool: _Given | _LocalPool | None = None
        if executor is not None:
            pool, count = _Given(executor, run_alone), getattr(executor, "_max_workers", None) or os.cpu_count() or 1
        elif workers != 0 and len(rows):
            count = min(count, len(rows))
            pool = stack.enter_context(_LocalPool(count))
        _run(_Work(plan, table, rows, chunk, progress, count, begun), pool, count)
        _run(_Check(plan, table, _to_check(plan, table), 1, None, count), pool, count)


def _run(work: _Work, pool: _Given | _LocalPool | None, count: int) -> None:
    if pool is not None:
        _run_on(pool, work, count)
        return
    for batch in work.batches():
        work.finish(run_batch(batch))


def _to_check(plan: Plan, table: Table) -> np.ndarray:
    """Finished rows of the kernel that also run with the solver."""
    rows = rows_to_check(plan.count)
    rows = rows[(table.engine[rows] == KERNEL) & np.isin(table.status[rows], (DONE, EXCEEDED))]
    return rows[~np.isin(rows, list(table.check))]


def available_cores() -> int:
    """Number of cores available to this process."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@dataclass
class _Work:
    """Pending rows and their measured run times."""

    plan: Plan
    table: Table
    rows: np.ndarray
    chunk: int | None
    progress: Progress | None
    workers: int
    done: int = 0  #: including rows that ran before

    def __post_init__(self) -> None:
        self.count = len(self.rows) + self.done
        self.failed = 0
        self._seconds: list[float] = []

    def batches(self) -> Iterator[Batch]:
        """Yields batches of consecutive rows, sized by the measured run times."""
        begin = 0
        while begin < len(self.rows):
            size = self.chunk or self._size(len(self.rows) - begin)
            yield batch_of(self.plan, self.rows[begin : begin + size])
            begin += size

    def _size(self, left: int) -> int:
        if not self._seconds:
            return 1
        by_time = int(np.clip(CHUNK_SECONDS / max(median(self._seconds[-50:]), 1e-7), 1, LARGEST_CHUNK))
        # Smaller chunks at the end keep all workers busy.
        return max(1, min(by_time, -(-left // (2 * self.workers))))

    def finish(self, done: Done) -> None:
        """Adds finished rows."""
        self.table.add(done)
        self._seconds.append(float(done.seconds.mean()))
        self.done += len(done.rows)
        self.failed += int(np.isin(done.status, (REFUSED, FAILED, DIED)).sum())
        if self.progress is not None:
            self.progress(self.done, self.failed, self.count)
        if ENOUGH_ROWS <= self.done < self.count and self.failed > self.plan.stop_after * self.done:
            reason = next((why for row, why in self.table.reasons.items() if self.table.status[row] != COLLAPSED), "")
            raise SolverError(
                f"{self.failed} of {self.done} rows failed, more than stop_after ({100 * self.plan.stop_after:g} %); first reason: "
                f"{reason}\nCorrect the study, or resume with stop_after: 100 %"
            )


class _KernelWork(_Work):
    """Rows for the kernel only; rows that it cannot run stay pending."""

    def __post_init__(self) -> None:
        super().__post_init__()
        self.left: list[int] = []

    def finish(self, done: Done) -> None:
        ran = done.status != NOT_RUN
        self.left += done.rows[~ran].tolist()
        if ran.any():
            super().finish(done.part(ran))
        else:
            self._seconds.append(float(done.seconds.mean()))


class _Check(_Work):
    """Rows of the kernel that run with the solver, one by one, for comparison only. Failures are ignored."""

    def batches(self) -> Iterator[Batch]:
        for row in self.rows:
            yield batch_of(self.plan, np.array([row]), "solver")

    def finish(self, done: Done) -> None:
        if done.status[0] in (DONE, EXCEEDED):
            self.table.check[int(done.rows[0])] = done.values[0]


@dataclass
class _Given:
    """An executor passed by the caller, or threads of this process."""

    executor: Executor
    run: Callable[[Batch], Done]

    def submit(self, batch: Batch) -> Future[Done]:
        return self.executor.submit(self.run, batch)

    def survive(self, batches: list[Batch], failure: BaseException) -> list[Done]:
        raise failure


class _LocalPool:
    """Processes on this machine. A broken pool is replaced."""

    def __init__(self, workers: int) -> None:
        self._workers = workers
        self._pool = _new_pool(workers)

    def __enter__(self) -> _LocalPool:
        try:
            with _interrupt_held():
                hello = self._pool.submit(say_hello)
            hello.result()
        except BrokenExecutor:
            self._pool.shutdown(cancel_futures=True)
            raise InputError(
                'the worker processes of the study do not start. In a script put the call under `if __name__ == "__main__":`, since every worker '
                "imports the script; or run in this process with workers=0"
            ) from None
        except BaseException:
            # A worker that is still starting needs files that this process removes at its end.
            self._pool.shutdown(cancel_futures=True)
            raise
        return self

    def __exit__(self, *failure: object) -> None:
        # After the last row this is fast. After a failure the rows in progress, which may take minutes, are not needed.
        with _interrupt_held() if failure[0] is None else nullcontext():
            if failure[0] is not None:
                for process in list((getattr(self._pool, "_processes", None) or {}).values()):
                    process.terminate()
            self._pool.shutdown(cancel_futures=True)

    def submit(self, batch: Batch) -> Future[Done]:
        with _interrupt_held():
            return self._pool.submit(run_batch, batch)

    def survive(self, batches: list[Batch], failure: BaseException) -> list[Done]:
        """Runs the rows in progress at the death of a worker one by one, each in a pool of one process."""
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
                    with _interrupt_held():
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


@contextmanager
def _interrupt_held() -> Iterator[None]:
    """Blocks Ctrl-C, so that workers started meanwhile never receive it; this process receives it afterwards."""
    came: list[int] = []
    handler = signal.getsignal(signal.SIGINT) if threading.current_thread() is threading.main_thread() else None
    if handler is not None:
        # Threads of libraries receive blocked signals, and Python then interrupts its main thread.
        signal.signal(signal.SIGINT, lambda number, _: came.append(number))
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})  # workers inherit it
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
        if handler is not None:
            signal.signal(signal.SIGINT, handler)
        if came:
            signal.raise_signal(signal.SIGINT)


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
    """Keeps two chunks per worker in progress."""
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
