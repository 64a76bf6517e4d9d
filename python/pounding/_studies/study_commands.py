"""`pounding study` and its subcommands."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from pounding._checked_file import STUDY
from pounding._native import core
from pounding._outputs import destination
from pounding._studies.batches import STATUSES, Batch, Done, side_by_side
from pounding._studies.engines import ENGINES, KERNEL, run_batch
from pounding._studies.execution import available_cores, batch_of
from pounding._studies.kernel_engine import KernelEngine
from pounding._studies.options import add_shared, at_least, shard, table_name, warn
from pounding._studies.plan import Plan, read_plan
from pounding._studies.progress import duration_text
from pounding._studies.quantities import COLLAPSED_COLUMN, OF_GAPS
from pounding._studies.reading import shortened
from pounding._studies.study import records_folder, run_plan
from pounding._studies.study_table import Study
from pounding._studies.summary import PERCENTS, percentile_table, summary
from pounding._studies.table import COPIES, Table, report_lines, require_room, rows_to_check, size_of, size_text
from pounding.errors import InputError

#: Subcommands that write no rows.
READING = ("check", "show", "plot", "export")
#: Number of rows timed by `check`.
TIMED = 20


def study(words: list[str]) -> int:
    """Runs `pounding study`, by default with the subcommand run."""
    parser = argparse.ArgumentParser(
        prog="pounding study",
        usage="pounding study STUDY.yaml [options of run]\n       pounding study SUBCOMMAND ... [options]",
        description="Run a model many times.",
        epilog="Options of a subcommand: pounding study run --help, pounding study show --help and so on.",
    )
    verbs = parser.add_subparsers(title="subcommands", metavar="")

    def verb(name: str, act: Callable[[Any], int], meaning: str, *shared: str) -> argparse.ArgumentParser:
        one = verbs.add_parser(
            name, prog=f"pounding study {name}", help=meaning, description=f"{meaning}.".capitalize()
        )
        one.set_defaults(act=act)
        add_shared(one, *shared)
        return one

    one = verb(
        "run",
        _run,
        "run all rows (also without this name); the same command resumes a stopped study",
        *("study", "--workers", "--quiet"),
    )
    one.add_argument(
        "-o", "--output", help="table to write (default: the study's name with .h5, in the current folder)"
    )
    one.add_argument(
        "--executor",
        choices=("mpi",),
        help="mpi: the processes of mpirun -n N python3 -m mpi4py.futures -m pounding study ...",
    )
    one.add_argument(
        "--shard",
        type=shard,
        default=(1, 1),
        metavar="K/N",
        help="run only the K-th of N equal shares of the rows; combine the tables with merge",
    )
    one.add_argument("--chunk", type=at_least(1), help="rows per chunk (default: half a second of run time)")
    verb("check", _check, "count the rows, and estimate the run time from some of them", "study", "--workers")
    one = verb(
        "show",
        _show,
        "print counts and percentiles of a table, or the values and the model of one row",
        *("table", "--limit", "--percentile", "--where", "--json"),
    )
    one.add_argument("--row", type=int, help="index of a row, from 0: prints its model")
    one.add_argument("--column", help="column of a fragility curve, with --json; collapsed for that of collapse")
    one = verb("merge", _merge, "merge the tables of shards", "study")
    one.add_argument("tables", nargs="+", help="tables of the shards")
    one.add_argument("-o", "--output", required=True, help="table to write")
    one = verb(
        "plot",
        _plot,
        "draw a table: fragility, ida, gap, map or tornado",
        *("table", "--limit", "--percentile", "--where"),
    )
    one.add_argument("--picture", required=True, choices=("fragility", "ida", "gap", "map", "tornado"))
    one.add_argument("--column", help="column to draw; collapsed is 1 in rows that collapsed")
    one.add_argument(
        "--by", help="factor with one fragility curve per value (default: that of a single list; none: pool all rows)"
    )
    one.add_argument("--across", help="factor along the horizontal axis of a map")
    one.add_argument("--along", help="factor along the vertical axis of a map")
    one.add_argument(
        "-o", "--output", help="picture: .png, .pdf or .svg (default: TABLE-PICTURE.png in the current folder)"
    )
    one = verb("export", _export, "write a table as CSV or Parquet", "table", "--where")
    one.add_argument("-o", "--output", required=True, help=".csv or .parquet")
    if not words or words[0] in ("-h", "--help"):
        parser.print_help()
        return 0 if words else 2
    options = parser.parse_args(words if words[0] in verbs.choices else ["run", *words])
    return int(options.act(options))


def _run(options: Any) -> int:
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


def _check(options: Any) -> int:
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
    checked = len(rows_to_check(plan.count)) if (done.engine == KERNEL).any() else 0
    lines.append(
        f"all rows take about {duration_text(float(np.mean(done.seconds)) * plan.count / workers)} on {workers} processes"
        + (f"; {checked} of them also run with the solver" if checked else "")
    )
    return lines


def _merge(options: Any) -> int:
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


def _show(options: Any) -> int:
    done = Study.open(options.table)
    if (options.column is None) != (options.limit is None) and options.column != COLLAPSED_COLUMN:
        raise InputError(
            "--column and --limit belong together: the curve is of exceedance of the limit; only --column collapsed has no limit"
        )
    percent = tuple(options.percentile or PERCENTS)
    where = dict(options.where)
    if options.json:
        print(json.dumps(summary(done, options.column, options.limit, percent, where)))
        return 0
    if options.row is None:
        print(report_of(done))
        print(percentile_table(done, percent, where))
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


def _plot(options: Any) -> int:
    from pounding._pictures.style import write_picture

    chosen = {key: value for key in ("limit", "by", "across", "along") if (value := getattr(options, key)) is not None}
    needed = {"fragility": () if options.column == COLLAPSED_COLUMN else ("limit",), "map": ("across", "along")}.get(
        options.picture, ()
    )
    for key in needed:
        if key not in chosen:
            raise InputError(f"--picture {options.picture} needs --{key}")
    if options.percentile:
        if options.picture not in ("ida", "map"):
            raise InputError(f"--percentile belongs to ida and map; {options.picture} has none")
        if options.picture == "map" and len(options.percentile) > 1:
            raise InputError("--percentile: a map shows one percentile; type it once")
        chosen["percent"] = options.percentile if options.picture == "ida" else options.percentile[0]
    figure = Study.open(options.table).plot(options.picture, options.column, **chosen, **dict(options.where))
    return write_picture(
        figure, f"{Path(options.table).stem}-{options.picture}.png" if options.output is None else options.output
    )


def _export(options: Any) -> int:
    ways = {".csv": Study.to_csv, ".parquet": Study.to_parquet}
    if (suffix := Path(options.output).suffix) not in ways:
        raise InputError(f'{options.output}: writes .csv or .parquet, not "{suffix}"')
    ways[suffix](Study.open(options.table), options.output, **dict(options.where))
    return 0


def report_of(done: Study) -> str:
    """Counts of rows, reasons of failures, and warnings."""
    lines = [", ".join(f"{count} {word}" for word, count in done.counts.items() if count)]
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
    lines += report_lines(done.check, values, columns)
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
