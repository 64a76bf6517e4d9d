"""The standard picture of a run: its histories, and its impacts below them."""

from __future__ import annotations

import textwrap
from collections.abc import Callable
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pounding.pictures.comparison import (draw_displacements_without_links, draw_input_without_links, draw_openings_without_links,
                                          require_comparison)
from pounding.pictures.displacements import chosen_floors, draw_displacements
from pounding.pictures.histories import draw_balance_error, draw_energies, draw_forces, draw_ground, draw_openings
from pounding.pictures.loops import draw_restitution, draw_strongest_loop
from pounding.pictures.panels import label_time
from pounding.pictures.style import STYLE, VERMILION, Picture, head, largest
from pounding.results import RunData

#: Draws one panel.
Panel = Callable[[Axes, RunData], Any]


def standard_figure(run: RunData, title: str | None = None, floors: dict[str, str] | None = None,
                    size: tuple[float, float] | None = None, compare: bool = False) -> Figure:
    """Ground motion, displacements, openings, contact forces, energies and the error of their balance against time;
    below them the loop of the strongest impact and the restitution of all.

    What a run does not have is left out: the ground when it is still, links, impacts.
    A run that is not done says so below the title. `floors` maps names of structures to the labels of the floors whose
    displacements are drawn instead of the linked ones; BadRequest when there are none such. `size` is that of the figure [in]. `compare` draws the run without links too, dashed."""
    chosen = chosen_floors(run, floors or {})
    def also(draw: Panel, added: Panel) -> Panel:
        """The panel, with the run without links where it is compared."""
        return (lambda axes, run: (draw(axes, run), added(axes, run))) if compare else draw

    if compare:
        require_comparison(run, "run")
    over_time: list[tuple[Panel, float]] = [
        (also(lambda axes, run: draw_displacements(axes, run, chosen),
              lambda axes, run: draw_displacements_without_links(axes, run, chosen)), 1.3),
        (also(draw_energies, draw_input_without_links), 1.0), (draw_balance_error, 0.4)]
    over_impacts: list[Panel] = []
    if run.links:
        over_time[1:1] = [(also(draw_openings, draw_openings_without_links), 0.9), (draw_forces, 0.9)]
    if run.impacts.size:
        over_impacts = [draw_strongest_loop, draw_restitution]
    if largest([run.ground_acceleration]) > 0:
        over_time.insert(0, (draw_ground, 0.45))
    heights = [height for _, height in over_time] + [1.6] * bool(over_impacts)

    with rc_context(STYLE):
        figure = Picture(figsize=size or (7.5, 0.7 + 1.5 * sum(heights)), layout="constrained")
        rows = figure.add_gridspec(len(heights), 1, height_ratios=heights)
        histories: list[Axes] = []
        for row, (draw, _) in enumerate(over_time):
            histories.append(figure.add_subplot(rows[row], sharex=histories[0] if histories else None))
            draw(histories[-1], run)
            histories[-1].tick_params(labelbottom=False)
        histories[-1].tick_params(labelbottom=True)
        label_time(histories[-1], run)
        if over_impacts:
            places = rows[-1].subgridspec(1, 2, wspace=0.08)
            for column, draw in enumerate(over_impacts):
                draw(figure.add_subplot(places[column]), run)
        for letter, axes in zip("abcdefgh", figure.axes):
            axes.set_title(f"({letter}) {axes.get_title(loc='left')}")
        _write_heading(figure, run, title)
        figure.align_ylabels(histories)
        return figure


def _write_heading(figure: Figure, run: RunData, title: str | None) -> None:
    title = run.title if title is None else title
    if run.status == "done":
        head(figure, title)
        return
    reached = f"t = {run.time[-1]:.4g} s" if run.time.size else "its start"
    state = f"This run is not complete: it was still running at {reached}."
    if run.status != "running":
        state = f"This run is not complete, it {run.status} (results up to {reached})"
    words = [*textwrap.wrap(title, 80), *textwrap.wrap(state, 85)]
    figure.suptitle("\n".join(words), fontsize=9.5, fontweight="bold", color=VERMILION)
