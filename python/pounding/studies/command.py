"""`pounding study` and `pounding separation`."""

from __future__ import annotations

import argparse
import json
import signal
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from pounding._native import core
from pounding.errors import InputError, SolverError
from pounding.studies import cross_check
from pounding.studies.engines import ENGINES, KERNEL, STATUSES, Batch, Done, run_batch
from pounding.studies.execution import available_cores, batch_of
from pounding.studies.kernel_engine import KernelEngine
from pounding.studies.plan import Plan, read_plan
from pounding.studies.progress import duration_text
from pounding.studies.study import Study, records_folder, run_plan
from pounding.studies.summary import summary
from pounding.studies.table import Table

VERBS = ("run", "check", "show", "merge", "plot", "export")
#: Rows that `check` times.
TIMED = 20


def main(arguments: list[str] | None = None) -> int:
    """The command line, with the name of the command first. Returns 0, 2 after wrong input, 3 after failed rows, on a full disk and out of memory."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    name, rest = (given[0], given[1:]) if given else ("study", [])
    try:
        # The program has blocked it while modules were imported.
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
        return _separation(rest) if name == "separation" else _study(rest)
    except (InputError, ImportError) as error:
        print(f"pounding: {error}", file=sys.stderr)
        return 2
    except SolverError as error:
        print(f"pounding: {error}", file=sys.stderr)
        return 3
    except MemoryError:
        print("pounding: out of memory. Rows that were finished are kept; type the same command again to go on, with fewer processes: -j 1", file=sys.stderr)
        return 3
    except OSError as error:
        print(f"pounding: {error}. Rows that were finished are kept; make room and type the same command again to go on", file=sys.stderr)
        return 3
    except KeyboardInterrupt:
        print("pounding: stopped; rows that were finished are kept. Type the same command again to go on", file=sys.stderr)
        return 130


def _study(words: list[str]) -> int:
    verb, rest = (words[0], words[1:]) if words and words[0] in VERBS else ("run", words)
    verbs = {"run": _run, "check": _check, "show": _show, "merge": _merge, "plot": _plot, "export": _export}
    return verbs[verb](rest)


def _parser(verb: str, meaning: str) -> argparse.ArgumentParser:
    return argparse.ArgumentParser(prog=f"pounding study{'' if verb == 'run' else ' ' + verb}", description=meaning)


def _run(words: list[str]) -> int:
    parser = _parser("run", "Run all rows of a study. The same command goes on with one that was stopped. Other verbs: "
                     + ", ".join(f"pounding study {verb}" for verb in VERBS[1:]))
    parser.add_argument("study", help="study file")
    parser.add_argument("-o", "--output", help="table to write (default: the study's name with .h5, in the current folder)")
    parser.add_argument("-j", "--workers", type=int, help="processes (default: one a core); 0 runs in this one")
    parser.add_argument("--executor", choices=("mpi",), help="mpi: the processes of mpirun -n N python3 -m mpi4py.futures -m pounding study ...")
    parser.add_argument("--shard", type=_shard, default=(1, 1), metavar="K/N", help="only the K-th of N equal parts; put them together with merge")
    parser.add_argument("--chunk", type=int, help="rows of a chunk (default: half a second)")
    parser.add_argument("-q", "--quiet", action="store_true", help="print nothing")
    options = parser.parse_args(words)
    output = Path(options.output or Path(options.study).with_suffix(".h5").name)
    if options.executor:
        # The start of PETSc would wait for the workers, which do something else.
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
        done = run_plan(plan, output, workers=options.workers, executor=executor, chunk=options.chunk, progress=False if options.quiet else None,
                        shard=options.shard)
    finally:
        if executor is not None:
            executor.shutdown()
    if not options.quiet:
        print(_told(done), f"{duration_text(time.monotonic() - begin)}; {output}", sep="\n")
    return 0


def _check(words: list[str]) -> int:
    parser = _parser("check", "Read a study, count its rows, and say how long it takes.")
    parser.add_argument("study", help="study file")
    parser.add_argument("-j", "--workers", type=int, help="processes of the study (default: one a core)")
    options = parser.parse_args(words)
    plan = read_plan(options.study, records_folder(Path(Path(options.study).with_suffix(".h5").name)))
    _warn(plan)
    records, points, levels = plan.shape
    print(f"{plan.count} rows: {records} records, {points} points of the factors, {levels} levels")
    for factor in plan.points.factors:
        values = f"{len(factor.values)} values" if factor.values is not None else factor.distribution.kind if factor.distribution else f"column {factor.column}"
        print(f"  {factor.name}: {values}, {', '.join(factor.of)}{f' = {factor.name} times {factor.times}' if factor.times else ''}")
    rows = np.unique(np.linspace(0, plan.count - 1, min(TIMED, plan.count)).astype(np.int64))
    # The first time reads records and models, too.
    run_batch(batch_of(plan, rows))
    batch = batch_of(plan, rows)
    print(*_timed(batch, run_batch(batch), plan, options.workers or available_cores()), sep="\n")
    print(f"table: {plan.count * (8 * len(plan.units()) + 10) / 1e6:.3g} MB; columns {', '.join(plan.units())}")
    return 0


def _timed(batch: Batch, done: Done, plan: Plan, workers: int) -> list[str]:
    """Lines about some timed rows: engines and why, failures, and the time of all rows."""
    lines = []
    for number, engine in enumerate(ENGINES):
        mine = np.flatnonzero(done.engine == number)
        if len(mine):
            why = KernelEngine().why_not(batch.part(mine)) if engine.name == "solver" and plan.template.engine == "auto" else ""
            lines.append(f"engine {engine.name}: {len(mine)} of {len(done.rows)} timed rows, {1e3 * done.seconds[mine].mean():.3g} ms each; "
                         f"about {len(mine) * plan.count // len(done.rows)} rows of all{f', since {why}' if why else ''}")
    lines += [f"row {row}: {reason}" for row, reason in list(done.reasons.items())[:3]]
    checked = len(cross_check.rows_to_check(plan.count)) if (done.engine == KERNEL).any() else 0
    lines.append(f"all rows take about {duration_text(float(np.mean(done.seconds)) * plan.count / workers)} on {workers} processes"
                 + (f"; {checked} of them are run by the solver, too" if checked else ""))
    return lines


def _show(words: list[str]) -> int:
    parser = _parser("show", "What a table holds; of a row, its numbers and its model, which pounding run takes.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("--row", type=int, help="number of a row, from 0: prints its model")
    parser.add_argument("--column", help="column of a fragility curve, with --json")
    parser.add_argument("--limit", help="of a fragility curve, with its unit or in that of the column: 5 MN")
    parser.add_argument("--json", action="store_true", help="print one JSON object: counts, and percentiles of the columns")
    options = parser.parse_args(words)
    done = Study.open(options.table)
    if (options.column is None) != (options.limit is None):
        raise InputError("--column and --limit go together: the curve is that of the column above the limit")
    if options.json:
        print(json.dumps(summary(done, options.column, options.limit)))
        return 0
    if options.row is None:
        print(_told(done))
        return 0
    if not 0 <= options.row < len(done):
        raise InputError(f"there is no row {options.row}; they count from 0 to {len(done) - 1}")
    for name, values in done.columns.items():
        value = values[options.row]
        told = {"status": STATUSES, "engine": [*done.engines, "none"], "record": done.records["name"]}.get(name)
        print(f"# {name}: {f'{value:.10g}' if told is None else told[value]} {done.units.get(name, '')}".rstrip())
    if options.row in done.reasons:
        print(f"# {done.reasons[options.row]}")
    print(done.model_of(options.row), end="")
    return 0


def _merge(words: list[str]) -> int:
    parser = _parser("merge", "Put the tables of shards together.")
    parser.add_argument("study", help="study file")
    parser.add_argument("tables", nargs="+", help="tables of the shards")
    parser.add_argument("-o", "--output", required=True, help="table to write")
    options = parser.parse_args(words)
    plan = read_plan(options.study, records_folder(Path(options.output)))
    table = Table(plan, options.output)
    for one in options.tables:
        table.merge(Path(one))
    table.write()
    left = len(table.missing())
    print(_told(Study.of(table)) + (f"\n{left} rows are in none of the tables; type pounding study {options.study} -o {options.output} to run them" if left else ""))
    return 0


def _plot(words: list[str]) -> int:
    from pounding.pictures.style import write_picture

    parser = _parser("plot", "Draw a table.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("--picture", required=True, choices=("fragility", "ida", "gap", "map", "tornado"))
    parser.add_argument("--column", help="column to draw")
    parser.add_argument("--limit", help="of a fragility, with its unit or in that of the column: 5 MN")
    parser.add_argument("--across", help="of a map: factor along its horizontal axis")
    parser.add_argument("--along", help="of a map: factor along its vertical axis")
    parser.add_argument("-o", "--output", help="picture: .png, .pdf or .svg (default: TABLE-PICTURE.png in the current folder)")
    options = parser.parse_args(words)
    chosen = {key: value for key in ("limit", "across", "along") if (value := getattr(options, key)) is not None}
    needed = {"fragility": ("limit",), "map": ("across", "along")}.get(options.picture, ())
    for key in needed:
        if key not in chosen:
            raise InputError(f"--picture {options.picture} needs --{key}")
    figure = Study.open(options.table).plot(options.picture, options.column, **chosen)
    return write_picture(figure, options.output or f"{Path(options.table).stem}-{options.picture}.png")


def _export(words: list[str]) -> int:
    parser = _parser("export", "Write a table for other programs.")
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

    parser = argparse.ArgumentParser(prog="pounding separation", description="The gap that a model needs, by its records and by rules.")
    parser.add_argument("model", help="model file, with or without study: {records: ...}")
    parser.add_argument("--records", nargs="+", help="files of records, or a folder, instead of the model's motion")
    parser.add_argument("-j", "--workers", type=int, help="processes (default: one a core)")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(words)
    plan = read_separation(options.model, options.records)
    _warn(plan)
    found = run_separation(plan, options.workers)
    print(json.dumps(found) if options.json else table_of(found))
    return 0


def _shard(text: str) -> tuple[int, int]:
    number, _, count = text.partition("/")
    if not (number.isdigit() and count.isdigit() and 1 <= int(number) <= int(count)):
        raise argparse.ArgumentTypeError(f'"{text}" should be a part of several, as in 3/16')
    return int(number), int(count)


def _warn(plan: Plan) -> None:
    for doubt in plan.warnings:
        print(f"warning: {doubt}", file=sys.stderr)


def _told(done: Study) -> str:
    status = done["status"]
    lines = [", ".join(f"{count} {word}" for i, word in enumerate(STATUSES) if (count := int((status == i).sum())))]
    reasons: dict[str, list[int]] = {}
    for row, why in done.failed.items():
        reasons.setdefault(why, []).append(row)
    lines += [f"  rows {_few(rows)}: {why}" for why, rows in list(reasons.items())[:5]]
    if len(done.engines) > 1:
        lines[0] += "; " + ", ".join(f"{count} by the {name}" for i, name in enumerate(done.engines) if (count := int((done["engine"] == i).sum())))
    columns = done.description["kept"]["columns"]
    lines += cross_check.told(done.check, np.column_stack([done[column] for column in columns]) if columns else np.empty((len(done), 0)), columns)
    return "\n".join(lines)


def _few(rows: Sequence[int]) -> str:
    return ", ".join(map(str, rows[:5])) + (f" and {len(rows) - 5} more" if len(rows) > 5 else "")


if __name__ == "__main__":
    code = main()
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # all is said and done
    sys.exit(code)
