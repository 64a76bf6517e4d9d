"""Tables and texts as HTML, for notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

#: A long text is scrolled.
_TEXT = "max-height:24em;overflow:auto;margin:0;white-space:pre"


def text_html(text: str) -> str:
    """A text in fixed width, in a scrolled box if it is long."""
    return f'<pre style="{_TEXT}">{html.escape(text)}</pre>'


def table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table of texts and numbers as HTML, `head` its first row."""
    lines = ["".join(f"<th>{html.escape(one)}</th>" for one in head)]
    lines += ["".join(f"<td>{html.escape(str(one))}</td>" for one in row) for row in rows]
    return f"<table>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"


def run_html(title: str, status: str, summary: Mapping[str, Any]) -> str:
    """Largest values of links and structures, and where the energy went, from the object of `pounding run --json`."""
    units = {"peak_force": 1e3, "peak_penetration": 1e-3, "impulse": 1e3, "energy_lost": 1e3}
    links = [
        [
            one["name"],
            one["impacts"],
            *(_number(one[key], size) for key, size in units.items()),
            f"{_number(one['energy_stored'], 1e3)} kJ stored" if one.get("presses") else "no",
        ]
        for one in summary.get("links", [])
    ]
    motion = {"peak_displacement": 1e-3, "peak_drift": 1e-3, "peak_acceleration": 1.0}
    structures = _largest(summary, motion)
    torsion = _largest(summary, {"peak_rotation": 1e-3, "peak_edge_displacement": 1e-3})
    words = ["link", "impacts", "peak force [kN]", "penetration [mm]", "impulse [kN s]", "energy lost [kJ]"]
    parts = [f"<b>{html.escape(title)}</b>" + ("" if status == "done" else f": {html.escape(status)}")]
    if links:
        parts.append(table([*words, "still pressed"], links))
    if structures:
        parts.append(table(["structure", "displacement [mm]", "drift [mm]", "acceleration [m/s²]"], structures))
    if torsion:
        parts.append(table(["structure", "rotation [mrad]", "edge displacement [mm]"], torsion))
    energy = summary.get("energy", {})
    if energy:
        terms = " + ".join(
            f"{name} {_number(energy[name], 1e3)}"
            for name in ("kinetic", "strain", "damping", "hysteretic", "impact", "devices")
            if name in energy
        )
        parts.append(
            f"energy [kJ]: input {_number(energy['input'], 1e3)} = {terms}; "
            f"largest imbalance {energy['error']:.1e} of the input"
        )
    return "".join(f"<div>{part}</div>" for part in parts)


def _largest(summary: Mapping[str, Any], units: Mapping[str, float]) -> list[list[str]]:
    """Names of the structures with the first of these quantities, and the maximum of each over the floors."""
    return [
        [
            name,
            *(_number(max((v for v in one[key] if v is not None), default=None), size) for key, size in units.items()),
        ]
        for name, one in summary.get("structures", {}).items()
        if one.get(next(iter(units)))
    ]


def _number(value: float | None, size: float) -> str:
    return "-" if value is None else f"{value / size:.4g}"
