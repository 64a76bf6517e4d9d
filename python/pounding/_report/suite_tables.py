"""Tables of the report of a suite, from the numbers of `pounding suite --json`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from pounding._report.blocks import Paragraph, Table, column, number, ratio
from pounding._studies.suite_report import FLOORS, GRAVITY

#: Rows of the tables of records, of all floors, and of links, and number of structures with a table.
RECORDS, ROWS, LINKS, STRUCTURES = 24, 24, 8, 6
#: Largest number of quantities in a table of floors.
QUANTITIES = 5
#: End of notes on omitted rows.
TABLE = "in the table of the suite"

Found = Mapping[str, Any]


def records_table(found: Found) -> Table:
    """Factor, peak acceleration, impacts, largest force, required gap and status of each record."""
    rows, more = found["records"][:RECORDS], len(found["records"]) - RECORDS
    columns = {
        "factor": column([one["factor"] for one in rows]) if rows[0]["factor"] is not None else [],
        "peak (g)": column([one["pga"] for one in rows], GRAVITY, 3),
        "impacts": [number(one.get("impacts")) for one in rows],
    }
    for title, key, scale in (("largest force (kN)", "force", 1e3), ("required gap (mm)", "required_gap", 1e-3)):
        if any(key in one for one in rows):
            columns[title] = column([one.get(key) for one in rows], scale)
    columns["status"] = [one["status"] for one in rows]
    columns = {title: cells for title, cells in columns.items() if cells}
    return Table(
        ["record", *columns],
        [[one["name"], *(cells[i] for cells in columns.values())] for i, one in enumerate(rows)],
        last_text=True,
        note=f"{more} more records {TABLE}" if more > 0 else "",
    )


def floors_tables(found: Found, rank: str) -> Iterator[Table | Paragraph]:
    """A table of floors per structure, with and without links in turn; the floors with the largest means."""
    keys = ["mean", rank, "max"]
    structures = {name: one for name, one in found["structures"].items() if any(each in one for each in FLOORS)}
    limit = max(ROWS // max(len(structures), 1), 4)
    for name, one in list(structures.items())[:STRUCTURES]:
        known = [each for each in FLOORS if each in one]
        # The ratio contains the same as the drift.
        known = [each for each in known if each != "drift" or len(known) <= QUANTITIES]
        runs = {"with": one, **({"without": one["without_links"]} if "without_links" in one else {})}
        count = len(one[known[0]]["mean"])
        largest = np.argsort(-np.array(one["drift" if "drift" in one else known[0]]["mean"]), kind="stable")[:limit]
        floors = sorted(largest.tolist(), reverse=True)
        places = [(i, label) for i in floors for label in runs]
        groups, cells = [("", len(runs) > 1 and 2 or 1)], []
        for each in known:
            title, unit, size = FLOORS[each]
            groups.append((f"{title} ({unit})", len(keys)))
            digits = 3 if each in ("drift_ratio", "acceleration") else 4
            every = column([runs[label][each][key][i] for key in keys for i, label in places], size, digits)
            cells += [every[k * len(places) : (k + 1) * len(places)] for k in range(len(keys))]
        heads = [[str(i + 1) if label == "with" else "", label][: groups[0][1]] for i, label in places]
        yield Table(
            [*["floor", "links"][: groups[0][1]], *keys * len(known)],
            [[*head, *(column_cells[row] for column_cells in cells)] for row, head in enumerate(heads)],
            name,
            groups,
            texts=groups[0][1],
            note=f"{count - limit} more floors {TABLE}" if count > limit else "",
        )
    if len(structures) > STRUCTURES:
        yield Paragraph(f"{len(structures) - STRUCTURES} more structures {TABLE}.")


def _statistics(
    rows: Sequence[Found], place: str, keys: Sequence[str], scale: float = 1.0, digits: int = 4
) -> list[list[str]]:
    """[key][row] cells of the statistics in `place` of rows, with the same number of decimals."""
    every = column([one[place][key] if place in one else None for key in keys for one in rows], scale, digits)
    return [every[i * len(rows) : (i + 1) * len(rows)] for i in range(len(keys))]


def members_table(found: Found, rank: str) -> Table:
    """The members with the largest increases, or with the largest forces if there is no run without links."""
    rows = found["worst"]["members"]
    has_ratios = any("ratio" in row for row in rows)
    cells = _statistics(rows, "with", ["mean", rank, "max"], 1e3)
    cells += [*_statistics(rows, "without", ["mean"], 1e3), [ratio(row["ratio"]) for row in rows]] if has_ratios else []
    return Table(
        ["structure", "member", "force", "mean", rank, "max", *["mean without", "ratio"] * has_ratios],
        [
            [
                row["structure"],
                row["member"],
                f"{row['component']} ({'kN m' if row['component'][0] in 'MT' else 'kN'})",
                *(column_cells[i] for column_cells in cells),
            ]
            for i, row in enumerate(rows)
        ],
        "Members with the largest increases of the mean by contact"
        if has_ratios
        else "Members with the largest forces",
        texts=3,
    )


def parts_table(found: Found, rank: str) -> Table:
    """The hinges, storeys or isolators with the largest increases of ductility, or with the largest ductilities."""
    rows, keys = found["worst"]["hinges"], ["mean", rank, "max"]
    has_ratios = any("ratio" in row for row in rows)
    cells = _statistics(rows, "with", keys)
    cells += [*_statistics(rows, "without", ["mean"]), [ratio(row["ratio"]) for row in rows]] if has_ratios else []
    groups = [("", 2), ("ductility", len(cells))]
    if any("plastic_rotation" in row for row in rows):
        cells += _statistics(rows, "plastic_rotation", keys, 1e-3)
        groups.append(("plastic rotation (mrad)", len(keys)))
    heads = [*keys, *["mean without", "ratio"] * has_ratios, *keys * (len(groups) - 2)]
    return Table(
        ["structure", "part", *heads],
        [[row["structure"], row["part"], *(one[i] for one in cells)] for i, row in enumerate(rows)],
        "Yielding parts with the largest increases of the mean by contact"
        if has_ratios
        else "Yielding parts with the largest ductilities",
        groups,
        texts=2,
    )


def links_table(found: Found, rank: str) -> Table:
    """Links with the largest mean forces."""
    keys = ["mean", rank, "max"]
    links = [{"name": name, **one} for name, one in found["links"].items()]
    links.sort(key=lambda one: (-(one["force"]["mean"] if "force" in one else 0), -one["impacts"]["mean"]))
    rows, more = links[:LINKS], len(links) - LINKS
    cells, groups = [[number(one["gap"], 1e-3) for one in rows]], [("", 2)]
    for title, key, scale in (
        ("impacts", "impacts", 1),
        ("force (kN)", "force", 1e3),
        ("opening (mm)", "opening", 1e-3),
    ):
        if any(key in one for one in rows):
            cells += _statistics(rows, key, keys, scale, 3 if key == "impacts" else 4)
            groups.append((title, len(keys)))
    return Table(
        ["link", "gap (mm)", *keys * (len(groups) - 1)],
        [[one["name"], *(column_cells[i] for column_cells in cells)] for i, one in enumerate(rows)],
        "Links",
        groups,
        note=f"{more} more links {TABLE}" if more > 0 else "",
    )
