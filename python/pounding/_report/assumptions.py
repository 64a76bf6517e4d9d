"""Tables of the assumptions of a run: structures, contacts, devices, ground motions."""

from __future__ import annotations

import re
from typing import Any

from pounding._report.blocks import NONE, Paragraph, Table, column, cut, number, span

#: Rows per table.
ROWS = 12
GRAVITY = 9.80665  #: [m/s^2]


def structures_table(model: dict[str, Any]) -> Table:
    """Masses, periods, damping and loads."""
    structures = model.get("structures", {})
    masses = column([one.get("mass") for one in structures.values()], 1e3)
    rows = []
    for (name, one), mass in zip(structures.items(), masses):
        periods = [number(period) for period in one.get("periods", [])]
        rows.append(
            [
                name,
                one["kind"].replace("_", " "),
                one.get("damping", NONE),
                _loads(one),
                str(one.get("floors", NONE)),
                mass,
                *(periods + [NONE, NONE])[:2],
            ]
        )
    rows, note = cut(rows, ROWS, "structures")
    return Table(
        ["structure", "kind", "damping", "loads", "floors", "mass (t)", "T1 (s)", "T2 (s)"],
        rows,
        "Structures",
        texts=4,
        note=note,
    )


def _loads(one: dict[str, Any]) -> str:
    """Gravity, P-Delta and other loads of a frame."""
    if "gravity" not in one:
        return NONE
    included = one.get("included", "")
    if one["gravity"]:
        return included or "gravity"
    return f"no gravity, {included}" if included else "no gravity"


def contacts_table(model: dict[str, Any]) -> Table:
    """Contact laws and stiffnesses; links with the same law and the same source of the stiffness share a row."""
    groups: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for link in model.get("links", []):
        groups.setdefault((link["law"], re.split(r" of |\d", link["stiffness_from"])[0]), []).append(link)
    rows = []
    for (law, _), links in groups.items():
        first = links[0]
        name = first["name"] if len(links) == 1 else f"{first['name']} and {len(links) - 1} more"
        sources = {link["stiffness_from"] for link in links}
        source = first["stiffness_from"] + (" (first link)" if len(sources) > 1 else "")
        rows.append(
            [
                name,
                law,
                source if "stiffness" in first["parameters"] else NONE,
                f"{span(link['parameters'].get('stiffness') for link in links)} {first['units'].get('stiffness', '')}".strip(),
                span((link["gap"] for link in links), 1e-3),
                span(link["parameters"].get("restitution") for link in links),
                span((link.get("reduced_mass") for link in links), 1e3),
            ]
        )
    rows, note = cut(rows, ROWS, "kinds of links")
    return Table(
        ["link", "law", "stiffness from", "stiffness", "gap (mm)", "restitution", "reduced mass (t)"],
        rows,
        "Contact",
        texts=4,
        note=note,
    )


def devices_table(model: dict[str, Any]) -> Table:
    """Bars and dampers between structures."""
    rows = [[one["name"], " – ".join(one["between"]), one["parts"]] for one in model.get("devices", [])]
    rows += [
        [text.partition(": ")[0], name, text.partition(": ")[2]]
        for name, one in model.get("structures", {}).items()
        for text in one.get("devices", [])
    ]
    rows, note = cut(rows, ROWS, "devices")
    return Table(["device", "between", "parts"], rows, "Devices", texts=3, note=note)


def motions_table(model: dict[str, Any]) -> Table:
    """Ground motions of the model and of single structures, and applied forces."""
    motions = [("all", one) for one in model.get("ground", [])]
    for name, structure in model.get("structures", {}).items():
        motions += [(name, one) for one in structure.get("ground", [])]
    rows = [
        [
            one["source"],
            name,
            one["direction"],
            number(one["peak"]),
            number(one["peak"], GRAVITY),
            number(one["duration"]),
        ]
        for name, one in motions
    ]
    rows, note = cut(rows, ROWS, "motions")
    return Table(
        ["ground motion", "structures", "direction", "peak (m/s²)", "peak (g)", "duration (s)"],
        rows,
        texts=3,
        note=note,
    )


def analysis(summary: dict[str, Any]) -> Paragraph:
    """Integration, tolerance, duration and effort."""
    solver = summary.get("solver", {})
    text = (
        f"Time integration: {solver.get('integrator', NONE)}, relative tolerance {_power(solver.get('tolerance'))}, "
        f"duration {number(solver.get('duration'))} s, {solver.get('steps', 0)} steps, {solver.get('events', 0)} contact events."
    )
    if options := solver.get("options"):
        text += f" Options: {' '.join(options)}."
    model = summary.get("model", {})
    forces = [f"{name}, {text}" for name, one in model.get("structures", {}).items() for text in one.get("forces", [])]
    if forces:
        text += f" Applied forces: {'; '.join(forces[:4])}{' ...' if len(forces) > 4 else ''}."
    return Paragraph(text)


def _power(value: float | None) -> str:
    return NONE if value is None else f"{value:.4g}"
