"""`pounding study show`, `plot` and `export`, which read a table."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from pounding._studies import cross_check
from pounding._studies.batches import STATUSES, side_by_side
from pounding._studies.options import add_percentile, add_where, study_parser
from pounding._studies.quantities import COLLAPSED_COLUMN, OF_GAPS
from pounding._studies.reading import shortened
from pounding._studies.study import Study
from pounding._studies.summary import PERCENTS, percentile_table, summary
from pounding.errors import InputError


def show(words: list[str]) -> int:
    """`pounding study show`."""
    parser = study_parser("show", "Show counts and percentiles of a table, or the values and the model of one row.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("--row", type=int, help="index of a row, from 0: prints its model")
    parser.add_argument("--column", help="column of a fragility curve, with --json; collapsed for that of collapse")
    parser.add_argument("--limit", help="limit of a fragility curve, with a unit or in the unit of the column: 5 MN")
    add_percentile(parser, "16, 50 and 84")
    add_where(parser)
    parser.add_argument(
        "--json", action="store_true", help="print one JSON object: counts, and percentiles of the columns"
    )
    options = parser.parse_args(words)
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


def plot(words: list[str]) -> int:
    """`pounding study plot`."""
    from pounding._pictures.style import write_picture

    parser = study_parser("plot", "Draw a table.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("--picture", required=True, choices=("fragility", "ida", "gap", "map", "tornado"))
    parser.add_argument("--column", help="column to draw; collapsed is 1 in rows that collapsed")
    parser.add_argument("--limit", help="limit of a fragility, with a unit or in the unit of the column: 5 MN")
    parser.add_argument(
        "--by", help="factor with one fragility curve per value (default: that of a single list; none: pool all rows)"
    )
    parser.add_argument("--across", help="factor along the horizontal axis of a map")
    parser.add_argument("--along", help="factor along the vertical axis of a map")
    add_percentile(parser, "16, 50 and 84 for ida, 50 for a map, which has one")
    add_where(parser)
    parser.add_argument(
        "-o", "--output", help="picture: .png, .pdf or .svg (default: TABLE-PICTURE.png in the current folder)"
    )
    options = parser.parse_args(words)
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


def export(words: list[str]) -> int:
    """`pounding study export`."""
    parser = study_parser("export", "Export a table to CSV or Parquet.")
    parser.add_argument("table", help="table of a study")
    parser.add_argument("-o", "--output", required=True, help=".csv or .parquet")
    add_where(parser)
    options = parser.parse_args(words)
    ways = {".csv": Study.to_csv, ".parquet": Study.to_parquet}
    if (suffix := Path(options.output).suffix) not in ways:
        raise InputError(f'{options.output}: writes .csv or .parquet, not "{suffix}"')
    ways[suffix](Study.open(options.table), options.output, **dict(options.where))
    return 0


def report_of(done: Study) -> str:
    """Counts of rows, reasons of failures, and warnings."""
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
