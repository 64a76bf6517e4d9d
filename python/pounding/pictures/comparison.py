"""The run without links, dashed, in panels of the run with them."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from pounding.pictures.displacements import drawn_displacements
from pounding.pictures.panels import legend_beside, link_styles, plot_time
from pounding.pictures.style import ENERGY_UNITS, MM, BadRequest, engineering, largest
from pounding.results import Link, RunData

#: Pictures that have something to show of a run without links.
COMPARABLE = ("run", "displacement", "gap", "energy", "profiles", "plan")
DASHED = {"linestyle": (0, (3, 2)), "linewidth": 0.8}


def require_comparison(run: RunData, picture: str) -> RunData:
    """The run without links. Raises BadRequest where the file has none, and for a picture that would show nothing of it."""
    if picture not in COMPARABLE:
        raise BadRequest(f"a run without links has nothing to show in the picture {picture}; compare one of {', '.join(COMPARABLE)}")
    if run.no_pounding is None:
        raise BadRequest("this file has no run without links; add compare: no_pounding to the model and run it again")
    return run.no_pounding


def draw_displacements_without_links(axes: Axes, run: RunData, chosen: dict[str, int] | None = None) -> None:
    """Adds the displacements of the run without links to a panel of draw_displacements, of the same floors and at their places."""
    without = require_comparison(run, "displacement")
    for number, (displacement, colour) in enumerate(drawn_displacements(run, without, chosen)):
        plot_time(axes, run, without.time, displacement, color=colour, label="without links" if number == 0 else None, **DASHED)
    legend_beside(axes)


def draw_openings_without_links(axes: Axes, run: RunData) -> None:
    """Adds the openings that links between floors would have, were they not there."""
    without = require_comparison(run, "gap")
    label: str | None = "without links"
    for link, style in link_styles(run):
        opening = _opening(link, without)
        if opening is not None:
            plot_time(axes, run, without.time, MM * opening, **{**style, "label": label, **DASHED})
            label = None
    legend_beside(axes)


def draw_input_without_links(axes: Axes, run: RunData) -> None:
    """Adds the input energy of the run without links."""
    without = require_comparison(run, "energy")
    size, _ = engineering(largest([run.energy["input"]]), ENERGY_UNITS)
    plot_time(axes, run, without.energy["time"], without.energy["input"] / size, color="black", label="input without links", **DASHED)
    legend_beside(axes, reverse=True)


def _opening(link: Link, run: RunData) -> np.ndarray | None:
    """Gap less the approach of the two floors along the link [m]; None for an end that is no floor, and for floors that turn."""
    opening = np.full(run.time.shape, link.gap)
    for name, floor, sign in ((link.left, link.left_floor, -1), (link.right, link.right_floor, 1)):
        structure = run.structures[name]
        if structure.is_wall:
            continue
        if not floor or structure.dimension == 3:
            return None
        opening += sign * link.direction[0] * structure.displacement[:, floor - 1]
    return opening
