"""`pounding study`, `pounding suite`, `pounding separation` and `pounding screen`."""

from __future__ import annotations

import errno
import signal
import sys
import threading
import time
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

try:
    from pounding._native import core
except ImportError as error:  # the program without the package, as after `make demo`
    if __name__ != "__main__":
        raise
    print(f"pounding: {error}", file=sys.stderr)
    sys.exit(2)

from pounding._arguments import is_encodable
from pounding._checked_file import STUDY
from pounding._ended import exit_code, show_warning
from pounding._outputs import destination
from pounding._studies import cross_check
from pounding._studies.batches import Batch, Done
from pounding._studies.engines import ENGINES, KERNEL, run_batch
from pounding._studies.execution import available_cores, batch_of
from pounding._studies.gap_commands import screening, separation
from pounding._studies.kernel_engine import KernelEngine
from pounding._studies.options import at_least, shard, study_parser, table_name, warn
from pounding._studies.plan import Plan, read_plan
from pounding._studies.progress import duration_text
from pounding._studies.study import Study, records_folder, run_plan
from pounding._studies.suite_command import suite
from pounding._studies.table import COPIES, Table, require_room, size_of, size_text
from pounding._studies.table_commands import export, plot, report_of, show
from pounding.errors import ImplausibleWarning, InputError, SolverError

VERBS = ("run", "check", "show", "merge", "plot", "export")
#: Description of each subcommand, for the help of the command.
_MEANINGS = {
    "run": "run all rows (also without this name); the same command resumes a stopped study",
    "check": "count the rows, and estimate the run time from some of them",
    "show": "print counts and percentiles of a table, or the values and the model of one row",
    "merge": "merge the tables of shards",
    "plot": "draw a table: fragility, ida, gap, map or tornado",
    "export": "write a table as CSV or Parquet",
}
#: Number of rows timed by `check`.
TIMED = 20
#: Error numbers of disks; others concern names.
_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)


class _Terminated(KeyboardInterrupt):
    """Raised for SIGTERM and SIGHUP: the study stops as for Ctrl-C, with the exit code of the signal."""


@contextmanager
def _until_terminated() -> Iterator[None]:
    """Raises _Terminated for SIGTERM and SIGHUP; a second signal ends the process immediately. Ignored signals
    (nohup) stay ignored."""

    def end(number: int, _: object) -> None:
        signal.signal(number, signal.SIG_DFL)
        raise _Terminated

    is_main = threading.current_thread() is threading.main_thread()
    before = {number: signal.getsignal(number) for number in (signal.SIGTERM, signal.SIGHUP) if is_main}
    for number, handler in before.items():
        if handler != signal.SIG_IGN:
            signal.signal(number, end)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def main(arguments: list[str] | None = None) -> int:
    """Runs the command line, whose first argument is the name of the command.

    Returns 0, 2 for wrong input, or 3 for failed rows, a full disk and insufficient memory."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    name, rest = (given[0], given[1:]) if given else ("study", [])
    try:
        # The program blocks it during imports.
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        for word in rest:
            if not is_encodable(word):
                raise InputError(f'"{word}" is not valid UTF-8; rename the file, or run in its folder')
        with warnings.catch_warnings(), _until_terminated():
            warnings.simplefilter("always", ImplausibleWarning)
            warnings.showwarning = show_warning
            return {"suite": suite, "separation": separation, "screen": screening}.get(name, _study)(rest)
    except BrokenPipeError:
        raise
    except (InputError, ImportError) as error:
        code, said = 2, str(error)
    except SolverError as error:
        code, said = 3, str(error)
    except MemoryError:
        again = "type the same command again to resume, with fewer processes: -j 1"
        code, said = 3, f"out of memory. Finished rows are kept; {again}"
    except OSError as error:
        writes = name == "study" and not (rest and rest[0] in VERBS and rest[0] not in ("run", "merge"))
        on_disk = error.errno in _DISK and writes
        code, said = 3 if on_disk else 2, str(error)
        if on_disk:
            said += ". Finished rows are kept; make room and type the same command again to resume"
    except _Terminated:
        code, said = 3, "stopped by a signal; finished rows are kept. Type the same command again to resume"
    except KeyboardInterrupt:
        code, said = 3, "stopped; finished rows are kept. Type the same command again to resume"
    print(f"pounding: {said}", file=sys.stderr)
    return code


def _study(words: list[str]) -> int:
    if not words or words[0] in ("-h", "--help"):
        print(_help())
        return 0 if words else 2
    verb, rest = (words[0], words[1:]) if words and words[0] in VERBS else ("run", words)
    return {"run": _run, "check": _check, "show": show, "merge": _merge, "plot": plot, "export": export}[verb](rest)


def _help() -> str:
    """Help of the command, with one line per subcommand."""
    width = max(map(len, _MEANINGS))
    lines = [f"  {verb:<{width}}  {meaning}" for verb, meaning in _MEANINGS.items()]
    return "\n".join(
        [
            "usage: pounding study STUDY.yaml [options of run]",
            "       pounding study SUBCOMMAND ... [options]",
            "",
            "Run a model many times. Subcommands:",
            *lines,
            "",
            "Options of a subcommand: pounding study run --help, pounding study show --help and so on.",
        ]
    )


def _run(words: list[str]) -> int:
    parser = study_parser("run", "Run all rows of a study. The same command resumes a stopped study.")
    parser.add_argument("study", help="study file")
    parser.add_argument(
        "-o", "--output", help="table to write (default: the study's name with .h5, in the current folder)"
    )
    parser.add_argument(
        "-j", "--workers", type=at_least(0), help="processes (default: one per core); 0 runs in this one"
    )
    parser.add_argument(
        "--executor",
        choices=("mpi",),
        help="mpi: the processes of mpirun -n N python3 -m mpi4py.futures -m pounding study ...",
    )
    parser.add_argument(
        "--shard",
        type=shard,
        default=(1, 1),
        metavar="K/N",
        help="run only the K-th of N equal shares of the rows; combine the tables with merge",
    )
    parser.add_argument("--chunk", type=at_least(1), help="rows per chunk (default: half a second of run time)")
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing")
    options = parser.parse_args(words)
    output = table_name(options.study, options.output)
    if options.shard == (1, 1) or not output.is_file():
        destination(output, STUDY)
    if options.executor:
        # PETSc must not start here, where it would wait for the workers.
        core.run_alone()
    plan = read_plan(options.study, records_folder(output))
    warn(plan)
    if options.shard != (1, 1):
        output = output.with_name(f"{output.stem}.{options.shard[0]}-of-{options.shard[1]}{output.suffix}")
    executor: Any = None
    if options.executor:
        from mpi4py.futures import MPIPoolExecutor

        executor = MPIPoolExecutor()
    begin = time.monotonic()
    try:
        done = run_plan(
            plan,
            output,
            workers=options.workers,
            executor=executor,
            chunk=options.chunk,
            progress=False if options.quiet else None,
            shard=options.shard,
        )
    finally:
        if executor is not None:
            executor.shutdown()
    if not options.quiet:
        print(report_of(done), f"{duration_text(time.monotonic() - begin)}; {output}", sep="\n")
    return 0


def _check(words: list[str]) -> int:
    parser = study_parser("check", "Read a study, count its rows and estimate its run time.")
    parser.add_argument("study", help="study file")
    parser.add_argument("-j", "--workers", type=at_least(0), help="processes of the study (default: one per core)")
    options = parser.parse_args(words)
    plan = read_plan(options.study, records_folder(table_name(options.study, None)))
    warn(plan)
    records, points, levels = plan.shape
    print(f"{plan.count} rows: {records} records, {points} points of the factors, {levels} levels")
    for factor in plan.points.factors:
        values = (
            f"{len(factor.values)} values"
            if factor.values is not None
            else factor.distribution.kind
            if factor.distribution
            else f"column {factor.column}"
        )
        print(
            f"  {factor.name}: {values}, {', '.join(factor.of)}{f' = {factor.name} times {factor.times}' if factor.times else ''}"
        )
    print(
        f"table: {size_text(size_of(plan))}, and {size_text(COPIES * size_of(plan))} of memory to write it; columns {', '.join(plan.units())}",
        flush=True,
    )
    require_room(plan)
    rows = np.unique(np.linspace(0, plan.count - 1, min(TIMED, plan.count)).astype(np.int64))
    # The first call also reads records and models.
    run_batch(batch_of(plan, rows))
    batch = batch_of(plan, rows)
    print(*_timed(batch, run_batch(batch), plan, options.workers or available_cores()), sep="\n")
    return 0


def _timed(batch: Batch, done: Done, plan: Plan, workers: int) -> list[str]:
    """Report of some timed rows: engines with reasons, failures, and the estimated time of all rows."""
    lines = []
    for number, engine in enumerate(ENGINES):
        mine = np.flatnonzero(done.engine == number)
        if len(mine):
            why = (
                KernelEngine().why_not(batch.part(mine))
                if engine.name == "solver" and plan.template.engine == "auto"
                else ""
            )
            lines.append(
                f"engine {engine.name}: {len(mine)} of {len(done.rows)} timed rows, {1e3 * done.seconds[mine].mean():.3g} ms each; "
                f"about {len(mine) * plan.count // len(done.rows)} rows of all{f', since {why}' if why else ''}"
            )
    lines += [f"row {row}: {reason}" for row, reason in list(done.reasons.items())[:3]]
    checked = len(cross_check.rows_to_check(plan.count)) if (done.engine == KERNEL).any() else 0
    lines.append(
        f"all rows take about {duration_text(float(np.mean(done.seconds)) * plan.count / workers)} on {workers} processes"
        + (f"; {checked} of them also run with the solver" if checked else "")
    )
    return lines


def _merge(words: list[str]) -> int:
    parser = study_parser("merge", "Merge the tables of shards.")
    parser.add_argument("study", help="study file")
    parser.add_argument("tables", nargs="+", help="tables of the shards")
    parser.add_argument("-o", "--output", required=True, help="table to write")
    options = parser.parse_args(words)
    output = table_name(options.study, options.output)
    destination(output, STUDY)
    plan = read_plan(options.study, records_folder(output))
    table = Table(plan, output)
    try:
        for one in options.tables:
            table.merge(Path(one))
        table.write()
    finally:
        table.close()
    left = len(table.missing())
    print(
        report_of(Study.of(table))
        + (
            f"\n{left} rows are in none of the tables; type pounding study {options.study} -o {options.output} to run them"
            if left
            else ""
        )
    )
    return 0


if __name__ == "__main__":
    code = exit_code(main)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the study has ended
    sys.exit(code)
