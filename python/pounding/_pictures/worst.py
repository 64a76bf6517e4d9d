"""Bars of the members and yielding parts with the largest increases by contact, with and without links."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pounding._comparison import worst
from pounding._pictures.comparison import require_comparison
from pounding._pictures.panels import legend_below
from pounding._pictures.style import NARROW, QUIET, VERMILION, BadRequest, picture
from pounding.results import RunData

#: Letters of the name of a structure.
LETTERS = 12


def ranked(summary: Mapping[str, Any]) -> dict[str, list[dict[str, Any]]]:
    """Panels of the picture: label of the axis and rows, those with the largest ratios."""
    members, parts = worst(summary, "members", "ratio"), worst(summary, "hinges", "ratio")
    return {
        label: rows
        for label, rows in {"Force [kN, kN m]": members, "Ductility": parts}.items()
        if any(_pair(row)["ratio"] is not None for row in rows)
    }


def worst_figure(run: RunData, title: str | None = None, size: tuple[float, float] | None = None) -> Figure:
    """The five members and the five yielding parts with the largest increases by contact. `size` [in]. Raises
    BadRequest without a run without links, and if the structures have no members and nothing yields."""
    require_comparison(run, "worst")
    panels = ranked(run.summary)
    if not panels:
        raise BadRequest(
            "nothing to compare: the run has neither members nor parts that yield, or one of the two runs ended early; "
            "draw --picture profiles instead"
        )
    side = 1 if size is not None and size[0] < NARROW else len(panels)
    with picture(size or (3.75 * len(panels) + 0.5, 2.6), run.title if title is None else title) as figure:
        axes = figure.subplots(len(panels) // side, side, squeeze=False).ravel()
        for panel, (label, rows) in zip(axes, panels.items()):
            draw_worst(panel, rows, label)
        handles, labels = axes[0].get_legend_handles_labels()
        legend_below(figure, handles, labels, 2)
        return figure


def draw_worst(axes: Axes, rows: Sequence[Mapping[str, Any]], label: str) -> None:
    """Two bars per row, with and without links, the worst at the top; `label` is that of the axis."""
    places = np.arange(len(rows))[::-1]
    scale = 1e-3 if "force" in label.lower() else 1.0
    for key, offset, colour in (("with", 0.19, VERMILION), ("without", -0.19, QUIET)):
        values = [scale * _pair(row)[key] for row in rows]
        axes.barh(places + offset, values, 0.36, color=colour, label=f"{key} links")
    axes.set_yticks(places, [_name(row) for row in rows])
    axes.grid(False, axis="y")
    axes.margins(y=0.02)
    axes.set_xlabel(label)


def _pair(row: Mapping[str, Any]) -> Mapping[str, Any]:
    return row.get("ductility", row)


def _name(row: Mapping[str, Any]) -> str:
    structure = row["structure"]
    short = structure if len(structure) <= LETTERS else f"{structure[: LETTERS - 1]}…"
    return f"{short}, {row['part']}" if "part" in row else f"{short}, {row['member']} {row['component']}"
