"""The run without links, dashed, in panels of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from pounding._pictures.displacements import draw_displacements, draw_rotations, drawn_displacements, drawn_rotations
from pounding._pictures.geometry import on_plate
from pounding._pictures.histories import draw_energies, draw_forces, draw_openings
from pounding._pictures.panels import legend_beside, link_styles, plot_time
from pounding._pictures.style import DASHED, ENERGY_UNITS, MM, BadRequest, engineering, largest
from pounding.results import Link, RunData, Structure

#: Pictures that can show a run without links.
COMPARABLE = ("run", "displacement", "rotation", "gap", "energy", "profiles", "plan", "worst")


def require_comparison(run: RunData, picture: str) -> RunData:
    """The run without links. Raises BadRequest if the file has none, and for a picture that cannot show it."""
    if picture not in COMPARABLE:
        raise BadRequest(
            f"the picture {picture} cannot show a run without links; compare one of {', '.join(COMPARABLE)}"
        )
    if run.no_pounding is None:
        raise BadRequest("this file has no run without links; add compare: no_pounding to the model and run it again")
    return run.no_pounding


def draw_displacements_without_links(
    axes: Axes, run: RunData, chosen: dict[str, int] | None = None, direction: np.ndarray | None = None
) -> None:
    """Adds the displacements of the same floors in the run without links to a panel of draw_displacements."""
    without = require_comparison(run, "displacement")
    _draw(axes, run, without, drawn_displacements(run, without, chosen, direction))


def draw_rotations_without_links(axes: Axes, run: RunData) -> None:
    """Adds the rotations of floors in the run without links to a panel of draw_rotations."""
    without = require_comparison(run, "rotation")
    _draw(axes, run, without, ((rotation, colour) for rotation, colour, _ in drawn_rotations(run, without)))


def draw_openings_without_links(axes: Axes, run: RunData) -> None:
    """Adds the openings between the floors of links in the run without links."""
    without = require_comparison(run, "gap")
    openings = ((_opening(link, without), style) for link, style in link_styles(run))
    _draw(axes, run, without, ((MM * opening, style) for opening, style in openings if opening is not None))


def draw_input_without_links(axes: Axes, run: RunData) -> None:
    """Adds the input energy of the run without links."""
    without = require_comparison(run, "energy")
    size, _ = engineering(largest([run.energy["input"]]), ENERGY_UNITS)
    style = {**DASHED, "color": "black", "label": "input without links"}
    plot_time(axes, run, without.energy["time"], without.energy["input"] / size, **style)
    legend_beside(axes, reverse=True)


#: Panels over time.
OVER_TIME: dict[str, Callable[..., None]] = {
    "displacement": draw_displacements,
    "rotation": draw_rotations,
    "gap": draw_openings,
    "force": draw_forces,
    "energy": draw_energies,
}
#: Panels that can also show the run without links.
WITHOUT_LINKS: dict[str, Callable[..., None]] = {
    "displacement": draw_displacements_without_links,
    "rotation": draw_rotations_without_links,
    "gap": draw_openings_without_links,
    "energy": draw_input_without_links,
}


def _draw(
    axes: Axes, run: RunData, without: RunData, curves: Iterable[tuple[np.ndarray, str | dict[str, Any]]]
) -> None:
    """Dashed curves with a colour or style each, and one entry of the legend."""
    label: str | None = "without links"
    for values, style in curves:
        own = {"color": style} if isinstance(style, str) else style
        plot_time(axes, run, without.time, values, **{**own, "label": label, **DASHED})
        label = None
    legend_beside(axes)


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
    moved = on_plate(structure, floor, link.position[:2] - structure.centre(floor))
    return np.asarray(moved[:, :2] @ link.direction[:2])
