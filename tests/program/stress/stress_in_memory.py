"""Cases of stress.py inside one Python process, without starting a program or MPI for each."""

import concurrent.futures
import json
import sys
import time
import warnings
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path

import h5py
from stress_cases import bounces_of, input_file
from stress_checks import Run

#: Number of cases handed to the processes at a time.
IN_HAND = 32


def package_run(package, case, folder, seconds):
    """(run, message) by the package in this folder: the run is None if it fails or exceeds this processor time, with
    the reason."""
    if package not in sys.path:
        sys.path.insert(0, package)
    import pounding

    results, end, touches = Path(folder) / "results.h5", time.process_time() + seconds, []

    def watch(now, _, impacts):
        touches.extend([now] * (impacts - len(touches)))
        if time.process_time() > end:
            raise TimeoutError(f"it took more than {seconds} s")

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            pounding.run(pounding.Model.from_yaml(input_file(case)), output=results, progress=watch)
    except Exception as error:
        shorter = bounces_of(case, touches) if isinstance(error, TimeoutError) else None
        return package_run(package, shorter, folder, seconds) if shorter else (None, f"{type(error).__name__}: {error}")
    with h5py.File(results) as file:
        summary = json.loads(file["summary"][()])
    return Run(case, results, summary), None


def in_processes(task, arguments, jobs):
    """task(argument) of each, in order of completion. If a process dies, for which a pool of multiprocessing would wait
    forever, the program ends and names the arguments in progress."""
    waiting, left = {}, iter(arguments)
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        while True:
            for argument in left:
                waiting[pool.submit(task, argument)] = argument
                if len(waiting) == IN_HAND:
                    break
            if not waiting:
                return
            done, _ = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
            for one in done:
                try:
                    outcome = one.result()
                except BrokenProcessPool:
                    sys.exit(f"a process died in one of these: {sorted(waiting.values())}")
                del waiting[one]
                yield outcome
