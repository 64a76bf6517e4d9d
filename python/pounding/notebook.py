"""What a notebook shows of models, results, modes and films at the end of a cell."""

from __future__ import annotations

import base64
import html
import math
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pounding.animation import Film
    from pounding.models import Model
    from pounding.results import Run
    from pounding.vibration import Modes

#: A long text is scrolled.
_TEXT = "max-height:24em;overflow:auto;margin:0;white-space:pre"


def model_html(model: Model) -> str:
    """The text of the input file."""
    return f'<pre style="{_TEXT}">{html.escape(model.to_yaml())}</pre>'


def run_html(run: Run) -> str:
    """The largest values of links and structures and where the energy went, as the program prints them."""
    summary = run.summary
    links = [[one["name"], one["impacts"], _number(one["peak_force"], 1e3), _number(one["peak_penetration"], 1e-3),
              _number(one["impulse"], 1e3), _number(one["energy_lost"], 1e3)] for one in summary.get("links", [])]
    structures = [[name, *(_number(max(one[key], default=None), size) for key, size in
                           (("peak_displacement", 1e-3), ("peak_drift", 1e-3), ("peak_acceleration", 1.0)))]
                  for name, one in summary.get("structures", {}).items() if one.get("peak_displacement")]
    words = ["link", "impacts", "peak force [kN]", "penetration [mm]", "impulse [kN s]", "energy lost [kJ]"]
    parts = [f"<b>{html.escape(run.title)}</b>" + ("" if run.status == "done" else f": {html.escape(run.status)}")]
    if links:
        parts.append(_table(words, links))
    if structures:
        parts.append(_table(["structure", "displacement [mm]", "drift [mm]", "acceleration [m/s²]"], structures))
    energy = summary.get("energy", {})
    if energy:
        terms = " + ".join(f"{name} {_number(energy[name], 1e3)}"
                           for name in ("kinetic", "strain", "damping", "hysteretic", "impact"))
        parts.append(f"energy [kJ]: input {_number(energy['input'], 1e3)} = {terms}; "
                     f"largest imbalance {energy['error']:.1e} of the input")
    return "".join(f"<div>{part}</div>" for part in parts)


def modes_html(modes: Modes) -> str:
    """Period and damping of each mode, a column for each structure."""
    names = [name for name, found in modes.items() if found]
    longest = max((len(modes[name]) for name in names), default=0)
    rows = [[number + 1, *(_mode(modes[name][number]) if number < len(modes[name]) else "" for name in names)]
            for number in range(longest)]
    return _table(["mode", *(f"{name}: T [s], damping" for name in names)], rows)


def film_html(film: Film) -> str:
    """The film, playing."""
    from pounding.animation import save

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "film.gif"
        save(film, path)
        data = base64.b64encode(path.read_bytes()).decode()
    return f'<img alt="film" src="data:image/gif;base64,{data}">'


def _mode(mode: Any) -> str:
    period = "none" if math.isinf(mode.period) else f"{mode.period:.4g}"
    return f"{period}, {100 * mode.damping_ratio:.3g} %"


def _number(value: float | None, size: float) -> str:
    return "-" if value is None else f"{value / size:.4g}"


def _table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    lines = ["".join(f"<th>{html.escape(one)}</th>" for one in head)]
    lines += ["".join(f"<td>{html.escape(str(one))}</td>" for one in row) for row in rows]
    return f"<table>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"
