"""Functions of a worker process. Imports neither h5py nor scipy, so that workers start quickly."""

from __future__ import annotations

import multiprocessing
import multiprocessing.connection
import os
import signal
import threading

from pounding._native import core
from pounding._studies.batches import Batch, Done
from pounding._studies.engines import run_batch


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
