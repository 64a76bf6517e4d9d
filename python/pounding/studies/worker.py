"""Functions that run in a worker process. It imports neither h5py nor scipy, so that workers start soon."""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import signal
import threading

from pounding._native import core
from pounding.studies.engines import Batch, Done, run_batch


def begin_worker() -> None:
    """Prepares a new process: Ctrl-C and a terminal that closes are for the one that drives the study, whose end ends
    this one, and BLAS stays at one thread."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    threading.Thread(target=_end_with_driver, daemon=True).start()
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")


def _end_with_driver() -> None:
    """Ends this process as soon as its driver is gone, however that ended: nobody would read what it computes."""
    driver = multiprocessing.parent_process()
    if driver is not None:
        multiprocessing.connection.wait([driver.sentinel])
        os._exit(1)


def say_hello() -> str:
    """Shows that a worker has started, with the package in it."""
    return str(core.version)


def run_alone(batch: Batch) -> Done:
    """As run_batch, in a worker that MPI may have started beside others."""
    core.run_alone()
    return run_batch(batch)
