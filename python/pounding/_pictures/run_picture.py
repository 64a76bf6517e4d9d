"""The standard picture of a run: its histories, and its impacts below them."""

from __future__ import annotations

import textwrap
from string import ascii_lowercase
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pounding._pictures.comparison import OVER_TIME, WITHOUT_LINKS, require_comparison
from pounding._pictures.displacements import chosen_floors, directions_of, turning
from pounding._pictures.histories import draw_balance_error, draw_ground
from pounding._pictures.loops import draw_restitution, draw_strongest_loop
from pounding._pictures.panels import gather_legends, label_time
from pounding._pictures.spring_loops import draw_residuals
from pounding._pictures.style import NARROW, STYLE, VERMILION, Picture, head, largest
from pounding.results import RunData

#: Relative heights of the rows, from the top.
HEIGHTS = {
    "ground": 0.45,
    "displacement": 1.3,
    "rotation": 0.8,
    "gap": 0.9,
    "force": 0.9,
    "energy": 1.0,
    "error": 0.4,
    "residuals": 0.8,
    "impacts": 1.6,
}
#: Height of each of several panels of displacements: in space there is one per direction.
OF_SEVERAL = 1.0
#: Rows omitted in small figures, in order.
MIN_WANTED = ("error", "ground", "residuals", "impacts", "gap", "energy", "rotation", "force")
#: Height of a row with relative height 1 [in].
MIN_HEIGHT = 1.1
#: Panels over time.
PANELS = {"ground": draw_ground, **OVER_TIME, "error": draw_balance_error}


def standard_figure(
    run: RunData,
    title: str | None = None,
    floors: dict[str, str] | None = None,
    size: tuple[float, float] | None = None,
    compare: bool = False,
) -> Figure:
    """Ground motion, displacements, openings, contact forces, energies and the error of the energy balance over time;
    below them the loop of the strongest impact and all restitutions.

    In space there is a panel of displacements for each direction, and one of the rotations of rigid floors. Panels
    without data are omitted: a still ground, links, impacts. In figures below about 8 inches, panels are omitted in the
    order of MIN_WANTED. An unfinished run is marked below the title. `floors` maps names of structures to labels of
    floors to draw instead of the linked ones; BadRequest if they do not exist. `size` is that of the figure [in].
    `compare` also draws the run without links, dashed."""
    chosen = chosen_floors(run, floors or {})
    if compare:
        require_comparison(run, "run")
    directions = directions_of(run)
    missing = {
        "ground": largest([run.ground_acceleration, *run.ground_across.values()]) == 0,
        "rotation": not turning(run),
        "gap": not run.links,
        "force": not run.links,
        "impacts": not run.impacts.size,
        "residuals": not _has_residuals(run),
    }
    rows: list[tuple[str, float, dict[str, Any]]] = []
    for name, height in HEIGHTS.items():
        if name == "displacement":
            height = height if len(directions) == 1 else OF_SEVERAL
            rows += [(name, height, {"chosen": chosen, "direction": direction}) for direction in directions]
        elif not missing.get(name):
            rows.append((name, height, {}))
    for name in MIN_WANTED:
        if size is not None and 0.7 + MIN_HEIGHT * sum(height for _, height, _ in rows) > size[1]:
            rows = [row for row in rows if row[0] != name]
    heights = [height for _, height, _ in rows]

    with rc_context(STYLE):
        figure = Picture(figsize=size or (7.5, 0.7 + 1.5 * sum(heights)), layout="constrained")
        grid = figure.add_gridspec(len(rows), 1, height_ratios=heights)
        histories: list[Axes] = []
        residuals: list[Axes] = []
        for i, (name, _, options) in enumerate(rows):
            cell = grid[i]
            if name in PANELS:
                histories.append(figure.add_subplot(cell, sharex=histories[0] if histories else None))
                PANELS[name](histories[-1], run, **options)
                if compare and name in WITHOUT_LINKS:
                    WITHOUT_LINKS[name](histories[-1], run, **options)
                histories[-1].tick_params(labelbottom=False)
            elif name == "residuals":
                residuals.append(figure.add_subplot(cell))
                draw_residuals(residuals[0], run)
            else:
                cells = cell.subgridspec(1, 2, wspace=0.08)
                draw_strongest_loop(figure.add_subplot(cells[0]), run)
                draw_restitution(figure.add_subplot(cells[1]), run)
        histories[-1].tick_params(labelbottom=True)
        label_time(histories[-1], run)
        if size is not None and size[0] < NARROW:
            gather_legends(figure, histories + residuals)
        for letter, axes in zip(ascii_lowercase, figure.axes):
            axes.set_title(f"({letter}) {axes.get_title(loc='left')}")
        _write_heading(figure, run, title)
        figure.align_ylabels(histories + residuals)
        return figure


def _has_residuals(run: RunData) -> bool:
    return any(one.get("residual_drift") for one in run.summary.get("structures", {}).values())


def _write_heading(figure: Figure, run: RunData, title: str | None) -> None:
    title = run.title if title is None else title
    if run.status == "done":
        head(figure, title)
        return
    reached = f"t = {run.time[-1]:.4g} s" if run.time.size else "its start"
    state = f"This run is not complete: it was still running at {reached}."
    if run.status.startswith("done: "):
        state = f"The run ended by {run.status.removeprefix('done: ')}"
    elif run.status != "running":
        state = f"This run is not complete, it {run.status} (results up to {reached})"
    words = [*textwrap.wrap(title, 80), *textwrap.wrap(state, 85)]
    figure.suptitle("\n".join(words), fontsize=9.5, fontweight="bold", color=VERMILION)
