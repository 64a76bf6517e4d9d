"""Tables of the results of a run: with and without links, impacts, energies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from pounding._comparison import WORST, measure, worst
from pounding._report.blocks import NONE, Paragraph, Table, column, number, ratio

#: Rows of the table of floors, of links, and of impacts.
FLOORS, LINKS, IMPACTS = 24, 10, 5
PAIR = ["with", "without", "ratio"]

Rows = list[dict[str, Any]]


def floors_table(summary: dict[str, Any]) -> Table:
    """Drifts, accelerations and storey shears of all floors, with and without links if the run has both."""
    comparison = summary.get("comparison") or {}
    places: list[tuple[str, int]] = []
    values: list[list[tuple[float | None, float | None, float | None]]] = [[], [], []]
    for name, one in (comparison or summary.get("structures", {})).items():
        quantities = _compared(one) if comparison else _alone(one)
        for floor in range(max(map(len, quantities)), 0, -1):
            places.append((name, floor))
            for found, column_values in zip(quantities, values):
                column_values.append(found.get(floor, (None, None, None)))
    # Rows with the largest changes are kept.
    kept, note = list(range(len(places))), ""
    if len(places) > FLOORS:
        changes = [max((abs((v[i][2] or 1) - 1) for v in values), default=0) for i in range(len(places))]
        order = sorted(range(len(places)), key=lambda i: -changes[i])[:FLOORS]
        kept = sorted(order)
        which = "with smaller changes " if comparison else ""
        note = f"{len(places) - FLOORS} more floors {which}in the results file"
    columns: list[list[str]] = []
    for pairs, scale in zip(values, (1e-3, 1.0, 1e3)):
        chosen = [pairs[i] for i in kept]
        both = column([v for pair in chosen for v in pair[:2]], scale)
        columns.append(both[::2])
        if comparison:
            columns += [both[1::2], [ratio(pair[2]) for pair in chosen]]
    rows = [[places[i][0], str(places[i][1]), *(cells[row] for cells in columns)] for row, i in enumerate(kept)]
    names = ["drift (mm)", "acceleration (m/s²)", "storey shear (kN)"]
    if not comparison:
        return Table(["structure", "floor", *names], rows, "Largest responses", note=note)
    return Table(
        ["structure", "floor", *PAIR * 3],
        rows,
        "Largest responses with and without links",
        [("", 2), *((name, 3) for name in names)],
        note=note,
    )


Pair = tuple[float | None, float | None, float | None]


def _compared(one: dict[str, Any]) -> list[dict[int, Pair]]:
    """Drift, acceleration and shear by floor; in space the larger of the two shears."""
    found: list[dict[int, Pair]] = []
    for quantity in ("drift", "acceleration", "storey_shear"):
        rows: dict[int, Pair] = {}
        for row in one[quantity]:
            if row["floor"] not in rows or row["with"] > (rows[row["floor"]][0] or 0):
                rows[row["floor"]] = (row["with"], row["without"], row["ratio"])
        found.append(rows)
    return found


def _alone(one: dict[str, Any]) -> list[dict[int, Pair]]:
    shears: dict[int, Pair] = {}
    if shear := one["envelope"].get("storey_shear"):
        for floor, (low, high) in enumerate(zip(shear["min"], shear["max"]), 1):
            ends = [*low, *high] if isinstance(low, list) else [low, high]
            shears[floor] = (max(abs(v) for v in ends), None, None)
    peaks: list[dict[int, Pair]] = [
        {i: (v, None, None) for i, v in enumerate(one[key], 1)} for key in ("peak_drift", "peak_acceleration")
    ]
    return [*peaks, shears]


def members_tables(summary: dict[str, Any]) -> list[Table]:
    """The five members with the largest increases, and with the largest demands."""
    captions = {"ratio": "Members with the largest increases by contact", "demand": "Members with the largest forces"}
    return _ranked(summary, "members", _members, captions)


def _ranked(
    summary: dict[str, Any], kind: str, make: Callable[[Rows, str], Table], captions: dict[str, str]
) -> list[Table]:
    """A table for each order in which a member or a part can be ranked."""
    rankings = {by: worst(summary, kind, by) for by in captions}
    return [
        make(rows, captions[by]) for by, rows in rankings.items() if any(measure(row, by) is not None for row in rows)
    ]


def _members(rows: Rows, caption: str) -> Table:
    cells = column([v for row in rows for v in (row["with"], row["without"])], 1e3)
    return Table(
        ["structure", "member", "force", *PAIR],
        [
            [
                row["structure"],
                row["member"],
                f"{row['component']} ({'kN m' if row['component'][0] in 'MT' else 'kN'})",
                cells[2 * i],
                cells[2 * i + 1],
                ratio(row["ratio"]),
            ]
            for i, row in enumerate(rows)
        ],
        caption,
        texts=3,
    )


def parts_tables(summary: dict[str, Any]) -> list[Table]:
    """The five hinges, storeys or isolators with the largest increases of ductility, and with the largest ductility."""
    captions = {
        "ratio": "Yielding parts with the largest increases by contact",
        "demand": "Yielding parts with the largest ductilities",
    }
    tables = _ranked(summary, "hinges", _parts, captions)
    if tables or summary.get("comparison"):
        return tables
    alone = [
        (name, part)
        for name, one in summary.get("structures", {}).items()
        for part in (one.get("yielding") or {}).get("springs", [])
    ]
    alone = sorted(alone, key=lambda one: -(one[1]["ductility"] or 0))[:WORST]
    if not alone:
        return []
    ductility = column([part["ductility"] for _, part in alone])
    plastic = column([part["plastic"] for _, part in alone], 1e-3)
    return [
        Table(
            ["structure", "part", "ductility", "plastic (mm, mrad)"],
            [[name, part["name"], ductility[i], plastic[i]] for i, (name, part) in enumerate(alone)],
            "Yielding parts with the largest ductilities",
            texts=2,
        )
    ]


def _parts(rows: Rows, caption: str) -> Table:
    columns = []
    for key, scale in (("ductility", 1.0), ("plastic", 1e-3)):
        cells = column([v for row in rows for v in (row[key]["with"], row[key]["without"])], scale)
        columns += [cells[::2], cells[1::2], [ratio(row[key]["ratio"]) for row in rows]]
    return Table(
        ["structure", "part", *PAIR * 2],
        [[row["structure"], row["part"], *(cells[i] for cells in columns)] for i, row in enumerate(rows)],
        caption,
        [("", 2), ("ductility", 3), ("plastic deformation (mm, mrad)", 3)],
        texts=2,
    )


def links_table(summary: dict[str, Any]) -> Table:
    """Impacts per link, the hardest hit first, with the gap that would have been enough."""
    needed = {one["link"]: one for one in (summary.get("no_pounding") or {}).get("separations", [])}
    links = sorted(summary.get("links", []), key=lambda one: (-(one["peak_force"] or 0), -one["impacts"]))
    links, note = links[:LINKS], f"{len(links) - LINKS} more links in the results file" if len(links) > LINKS else ""
    gaps = {one["name"]: one["gap"] for one in (summary.get("model") or {}).get("links", [])}
    cells = [
        column([gaps.get(one["name"]) for one in links], 1e-3),
        column([(needed.get(one["name"]) or {}).get("enough") for one in links], 1e-3),
        [str(one["impacts"]) for one in links],
        [
            NONE if one["peak_force"] is None else text
            for one, text in zip(links, column([one["peak_force"] for one in links], 1e3))
        ],
        column([one["peak_penetration"] for one in links], 1e-3),
        column([one["energy_lost"] for one in links], 1e3),
    ]
    if any(one["peak_force"] is None for one in links):
        note = "; ".join(filter(None, [note, "rigid impacts have no finite force"]))
    return Table(
        [
            "link",
            "gap (mm)",
            "sufficient gap (mm)",
            "impacts",
            "peak force (kN)",
            "penetration (mm)",
            "energy lost (kJ)",
        ],
        [[one["name"], *(column_cells[i] for column_cells in cells)] for i, one in enumerate(links)],
        "Links",
        note=note,
    )


def impacts_table(summary: dict[str, Any]) -> Table:
    """The strongest impacts."""
    impacts = sorted(summary.get("impacts", []), key=lambda one: (-(one["peak_force"] or 0), -(one["impulse"] or 0)))
    count = len(impacts)
    impacts = impacts[:IMPACTS]
    cells = [
        column([one["t_start"] for one in impacts], 1.0, 5),
        column([one["peak_force"] for one in impacts], 1e3),
        column([one["v_approach"] for one in impacts]),
        column([one["restitution"] for one in impacts]),
        column([one["impulse"] for one in impacts], 1e3),
    ]
    return Table(
        ["link", "time (s)", "peak force (kN)", "approach (m/s)", "restitution", "impulse (kN s)"],
        [[one["link"], *(column_cells[i] for column_cells in cells)] for i, one in enumerate(impacts)],
        "Strongest impacts",
        note=f"{count - IMPACTS} more impacts in the results file" if count > IMPACTS else "",
    )


def energy_table(summary: dict[str, Any]) -> Table:
    """Energies at the end of the run, with their balance."""
    energy = summary.get("energy", {})
    terms = [
        key for key in ("input", "kinetic", "strain", "damping", "hysteretic", "impact", "devices") if key in energy
    ]
    return Table(
        [f"{key} (kJ)" for key in terms] + ["largest imbalance (% of input)"],
        [[*(number(energy[key], 1e3, 4) for key in terms), number(energy.get("error"), 1e-2)]],
        "Energy at the end of the run",
        texts=0,
    )


def warnings_paragraph(summary: dict[str, Any]) -> Paragraph:
    """All warnings of the run; the first eight."""
    warnings = summary.get("warnings", [])
    if not warnings:
        return Paragraph("Warnings: none.")
    more = f" {len(warnings) - 8} more warnings in the results file." if len(warnings) > 8 else ""
    return Paragraph("Warnings: " + " ".join(f"({i}) {text}." for i, text in enumerate(warnings[:8], 1)) + more)
