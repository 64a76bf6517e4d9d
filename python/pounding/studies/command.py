"""`pounding study` and `pounding separation`."""

from __future__ import annotations

import argparse
import errno
import json
import re
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from pounding._native import core
from pounding.arguments import is_encodable
from pounding.checked_file import STUDY
from pounding.ended import exit_code
from pounding.errors import ImplausibleWarning, InputError, SolverError
from pounding.outputs import destination
from pounding.studies import cross_check
from pounding.studies.batches import STATUSES, Batch, Done, side_by_side
from pounding.studies.engines import ENGINES, KERNEL, run_batch
from pounding.studies.execution import available_cores, batch_of
from pounding.studies.kernel_engine import KernelEngine
from pounding.studies.plan import Plan, read_plan
from pounding.studies.progress import duration_text
from pounding.studies.quantities import COLLAPSED_COLUMN, OF_GAPS
from pounding.studies.reading import shortened
from pounding.studies.study import Study, records_folder, run_plan
from pounding.studies.summary import summary
from pounding.studies.table import COPIES, Table, require_room, size_of, size_text

VERBS = ("run", "check", "show", "merge", "plot", "export")
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
            warnings.showwarning = _show_warning
            return _separation(rest) if name == "separation" else _study(rest)
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
    verb, rest = (words[0], words[1:]) if words and words[0] in VERBS else ("run", words)
    return {"run": _run, "check": _check, "show": _show, "merge": _merge, "plot": _plot, "export": _export}[verb](rest)


def _parser(verb: str, meaning: str) -> argparse.ArgumentParser:
    return argparse.ArgumentParser(prog=f"pounding study{'' if verb == 'run' else ' ' + verb}", description=meaning)


def _run(words: list[str]) -> int:
    parser = _parser(
        "run",
        "Run all rows of a study. The same command resumes a stopped study. Other subcommands: "
        + ", ".join(f"pounding study {verb}" for verb in VERBS[1:]),
    )
    parser.add_argument("study", help="study file")
    parser.add_argument(
        "-o", "--output", help="table to write (default: the study's name with .h5, in the current folder)"
    )
    parser.add_argument(
        "-j", "--workers", type=_at_least(0), help="processes (default: one per core); 0 runs in this one"
    )
    parser.add_argument(
        "--executor",
        choices=("mpi",),
        help="mpi: the processes of mpirun -n N python3 -m mpi4py.futures -m pounding study ...",
    )
    parser.add_argument(
        "--shard",
        type=_shard,
        default=(1, 1),
        metavar="K/N",
        help="run only the K-th of N equal shares of the rows; combine the tables with merge",
    )
    parser.add_argument("--chunk", type=_at_least(1), help="rows per chunk (default: half a second of run time)")
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing")
    options = parser.parse_args(words)
    output = _table_name(options.study, options.output)
    if options.shard == (1, 1) or not output.is_file():
        destination(output, STUDY)
    if options.executor:
        # PETSc must not start here, where it would wait for the workers.
        core.run_alone()
    plan = read_plan(options.study, records_folder(output))
    _warn(plan)
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
        print(_report(done), f"{duration_text(time.monotonic() - begin)}; {output}", sep="\n")
    return 0


def _check(words: list[str]) -> int:
    parser = _parser("check", "Read a study, count its rows and estimate its run time.")
    parser.add_argument("study", help="study file")
    parser.add_argument("-j", "--workers", type=_at_least(0), help="processes of the study (default: one per core)")
    options = parser.parse_args(words)
    plan = read_plan(options.study, records_folder(_table_name(options.study, None)))
    _warn(plan)
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


def _show(words: list[str]) -> int:
    parser = _parser("show", "Show the contents of a table, or the values and the model of one row.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("--row", type=int, help="index of a row, from 0: prints its model")
    parser.add_argument("--column", help="column of a fragility curve, with --json; collapsed for that of collapse")
    parser.add_argument("--limit", help="limit of a fragility curve, with a unit or in the unit of the column: 5 MN")
    parser.add_argument(
        "--json", action="store_true", help="print one JSON object: counts, and percentiles of the columns"
    )
    options = parser.parse_args(words)
    done = Study.open(options.table)
    if (options.column is None) != (options.limit is None) and options.column != COLLAPSED_COLUMN:
        raise InputError(
            "--column and --limit belong together: the curve is of exceedance of the limit; only --column collapsed has no limit"
        )
    if options.json:
        print(json.dumps(summary(done, options.column, options.limit)))
        return 0
    if options.row is None:
        print(_report(done))
        return 0
    if not 0 <= options.row < len(done):
        raise InputError(f"no row {options.row}; rows count from 0 to {len(done) - 1}")
    for name, values in done.columns.items():
        value = values[options.row]
        names = {"status": STATUSES, "engine": [*done.engines, "none"], "record": done.records["name"]}.get(name)
        print(f"# {name}: {f'{value:.10g}' if names is None else names[value]} {done.units.get(name, '')}".rstrip())
    if options.row in done.reasons:
        print(f"# {done.reasons[options.row]}")
    print(done.model_of(options.row), end="")
    return 0


def _merge(words: list[str]) -> int:
    parser = _parser("merge", "Merge the tables of shards.")
    parser.add_argument("study", help="study file")
    parser.add_argument("tables", nargs="+", help="tables of the shards")
    parser.add_argument("-o", "--output", required=True, help="table to write")
    options = parser.parse_args(words)
    output = _table_name(options.study, options.output)
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
        _report(Study.of(table))
        + (
            f"\n{left} rows are in none of the tables; type pounding study {options.study} -o {options.output} to run them"
            if left
            else ""
        )
    )
    return 0


def _plot(words: list[str]) -> int:
    from pounding.pictures.style import write_picture

    parser = _parser("plot", "Draw a table.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("--picture", required=True, choices=("fragility", "ida", "gap", "map", "tornado"))
    parser.add_argument("--column", help="column to draw; collapsed is 1 in rows that collapsed")
    parser.add_argument("--limit", help="limit of a fragility, with a unit or in the unit of the column: 5 MN")
    parser.add_argument("--across", help="factor along the horizontal axis of a map")
    parser.add_argument("--along", help="factor along the vertical axis of a map")
    parser.add_argument(
        "-o", "--output", help="picture: .png, .pdf or .svg (default: TABLE-PICTURE.png in the current folder)"
    )
    options = parser.parse_args(words)
    chosen = {key: value for key in ("limit", "across", "along") if (value := getattr(options, key)) is not None}
    needed = {"fragility": () if options.column == COLLAPSED_COLUMN else ("limit",), "map": ("across", "along")}.get(
        options.picture, ()
    )
    for key in needed:
        if key not in chosen:
            raise InputError(f"--picture {options.picture} needs --{key}")
    figure = Study.open(options.table).plot(options.picture, options.column, **chosen)
    return write_picture(
        figure, f"{Path(options.table).stem}-{options.picture}.png" if options.output is None else options.output
    )


def _export(words: list[str]) -> int:
    parser = _parser("export", "Export a table to CSV or Parquet.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("-o", "--output", required=True, help=".csv or .parquet")
    options = parser.parse_args(words)
    ways = {".csv": Study.to_csv, ".parquet": Study.to_parquet}
    if (suffix := Path(options.output).suffix) not in ways:
        raise InputError(f'{options.output}: writes .csv or .parquet, not "{suffix}"')
    ways[suffix](Study.open(options.table), options.output)
    return 0


def _separation(words: list[str]) -> int:
    from pounding.studies.separation import read_separation, run_separation, table_of

    parser = argparse.ArgumentParser(
        prog="pounding separation", description="Compute the gap required by records and by the rules of codes."
    )
    parser.add_argument("model", help="model file, with or without study: {records: ...}")
    parser.add_argument("--records", nargs="+", help="files of records, or a folder, instead of the model's motion")
    parser.add_argument("-j", "--workers", type=_at_least(0), help="processes (default: one per core)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(words)
    plan = read_separation(options.model, options.records)
    _warn(plan)
    found = run_separation(plan, options.workers)
    print(json.dumps(found) if options.json else table_of(found))
    return 0


def _table_name(study: str, given: str | None) -> Path:
    """The given table, or the name of the study with .h5 in the current folder."""
    if given is None:
        return Path(Path(study).stem + ".h5")
    if not given:
        raise InputError("the name of the file is empty: -o needs one, such as -o study.h5")
    if Path(given).name in ("", ".."):
        raise InputError(f'cannot write "{given}": it is a directory. Name a file in it')
    if given.endswith("/"):
        destination(given, STUDY)
    return Path(given)


def _at_least(least: int) -> Callable[[str], int]:
    """Type for argparse: integers with a lower bound."""

    def read(text: str) -> int:
        if not re.fullmatch(r"\+?[0-9]{1,18}", text) or int(text) < least:
            raise argparse.ArgumentTypeError(f'takes an integer of at least {least}, not "{text[:40]}"')
        return int(text)

    return read


def _shard(text: str) -> tuple[int, int]:
    number, _, count = text.partition("/")
    if not (number.isdigit() and count.isdigit() and 1 <= int(number) <= int(count)):
        raise argparse.ArgumentTypeError(f'"{text}" is not a shard; type K/N, as in 3/16')
    return int(number), int(count)


def _warn(plan: Plan) -> None:
    for doubt in plan.warnings:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=2)


def _show_warning(message: Warning | str, *_: Any, **__: Any) -> None:
    print(f"warning: {message}", file=sys.stderr)


def _report(done: Study) -> str:
    status = done["status"]
    lines = [", ".join(f"{count} {word}" for i, word in enumerate(STATUSES) if (count := int((status == i).sum())))]
    if collapsed := done.collapsed:
        row = min(collapsed)
        lines.append(
            f"  rows {shortened(list(collapsed))} collapsed and exceed every limit; row {row}: {collapsed[row]}"
        )
    if alone := _collapsed_without_links(done):
        lines.append(
            f"  rows {shortened(alone)} collapsed without links: their columns are infinite, and no gap is sufficient"
        )
    reasons: dict[str, list[int]] = {}
    for row, why in done.failed.items():
        reasons.setdefault(why, []).append(row)
    lines += [f"  rows {shortened(rows)}: {why}" for why, rows in list(reasons.items())[:5]]
    if len(done.engines) > 1:
        lines[0] += "; " + ", ".join(
            f"{count} by the {name}"
            for i, name in enumerate(done.engines)
            if (count := int((done["engine"] == i).sum()))
        )
    columns = done.description["kept"]["columns"]
    values = side_by_side([done[column] for column in columns], len(done))
    lines += cross_check.report_lines(done.check, values, columns)
    if options := done.description.get("options"):
        lines.append(f"options of PETSc for rows of the solver: {' '.join(options)}")
    lines += [f"warning: {doubt}" for doubt in done.warnings]
    return "\n".join(lines)


def _collapsed_without_links(done: Study) -> list[int]:
    """Rows whose run without links collapsed, if a column shows it."""
    columns = [
        column for column in done.description["kept"]["columns"] if column.endswith(".alone") or column in OF_GAPS
    ]
    infinite = [np.isinf(done[column]) for column in columns]
    return np.flatnonzero(np.any(infinite, axis=0)).tolist() if infinite else []


if __name__ == "__main__":
    code = exit_code(main)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the study has ended
    sys.exit(code)
