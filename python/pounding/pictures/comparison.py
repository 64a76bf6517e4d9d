"""The run without links, dashed, in panels of a run."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from pounding.pictures.displacements import drawn_displacements, drawn_rotations
from pounding.pictures.panels import legend_beside, link_styles, plot_time
from pounding.pictures.style import DASHED, ENERGY_UNITS, MM, BadRequest, engineering, largest
from pounding.results import Link, RunData, Structure

#: Pictures that can show a run without links.
COMPARABLE = ("run", "displacement", "rotation", "gap", "energy", "profiles", "plan")


def require_comparison(run: RunData, picture: str) -> RunData:
    """The run without links. Raises BadRequest if the file has none, and for a picture that cannot show it."""
    if picture not in COMPARABLE:
        raise BadRequest(
            f"a run without links has nothing to show in the picture {picture}; compare one of {', '.join(COMPARABLE)}"
        )
    if run.no_pounding is None:
        raise BadRequest("this file has no run without links; add compare: no_pounding to the model and run it again")
    return run.no_pounding


def draw_displacements_without_links(
    axes: Axes, run: RunData, chosen: dict[str, int] | None = None, direction: np.ndarray | None = None
) -> None:
    """Adds the displacements of the same floors in the run without links to a panel of draw_displacements."""
    without = require_comparison(run, "displacement")
    for number, (displacement, colour) in enumerate(drawn_displacements(run, without, chosen, direction)):
        plot_time(
            axes,
            run,
            without.time,
            displacement,
            color=colour,
            label="without links" if number == 0 else None,
            **DASHED,
        )
    legend_beside(axes)


def draw_rotations_without_links(axes: Axes, run: RunData) -> None:
    """Adds the rotations of floors in the run without links to a panel of draw_rotations."""
    without = require_comparison(run, "rotation")
    for number, (rotation, colour, _) in enumerate(drawn_rotations(run, without)):
        plot_time(
            axes, run, without.time, rotation, color=colour, label="without links" if number == 0 else None, **DASHED
        )
    legend_beside(axes)


def draw_openings_without_links(axes: Axes, run: RunData) -> None:
    """Adds the openings between the floors of links in the run without links."""
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
    plot_time(
        axes,
        run,
        without.energy["time"],
        without.energy["input"] / size,
        color="black",
        label="input without links",
        **DASHED,
    )
    legend_beside(axes, reverse=True)


def _opening(link: Link, run: RunData) -> np.ndarray | None:
    """Gap minus the approach of the two floors along the link [m]; None unless both ends are floors, rigid ones in
    space."""
    opening = np.full(run.time.shape, link.gap)
    for name, floor, sign in ((link.left, link.left_floor, -1), (link.right, link.right_floor, 1)):
        structure = run.structures[name]
        if structure.is_wall:
            continue
        moved = _of_end(structure, floor - 1, link) if floor else None
        if moved is None:
            return None
        opening += sign * moved
    return opening


def _of_end(structure: Structure, floor: int, link: Link) -> np.ndarray | None:
    """Displacement of a floor, from 0, along a link at its position [m]."""
    if structure.dimension != 3:
        return link.direction[0] * structure.displacement[:, floor]
    if (
        structure.plan is None
        or structure.geometry is None
        or link.position is None
        or np.isnan(structure.plan[floor]).any()
    ):
        return None
    centre = structure.centre(floor)
    across = link.position[:2] - centre
    rotation = structure.along["rz"].displacement[:, floor]
    x = structure.along["x"].displacement[:, floor] - rotation * across[1]
    y = structure.along["y"].displacement[:, floor] + rotation * across[0]
    return link.direction[0] * x + link.direction[1] * y
