"""Profiles over the height: extremes of a run at every floor and storey."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from string import ascii_lowercase
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from pounding._envelopes import EDGES
from pounding._pictures.comparison import require_comparison
from pounding._pictures.geometry import floor_heights, levels
from pounding._pictures.style import FORCE_UNITS, MM, BadRequest, engineering, largest, picture, structure_colour
from pounding.results import RunData, Structure

#: Lines of the run and of the run without links.
SOLID: dict[str, Any] = {"linewidth": 1.2}
DASHED: dict[str, Any] = {"linewidth": 1.0, "linestyle": (0, (3, 2))}
#: Below this width four panels are in two rows [in].
NARROW = 5.0
#: Extremes of a quantity that a structure does not have.
NOTHING = np.empty((0, 0))
#: Minimum height of a row of panels [in].
LOWEST = 0.95


def profiles_figure(
    run: RunData, title: str | None = None, size: tuple[float, float] | None = None, compare: bool | None = None
) -> Figure:
    """Minima and maxima of displacement and acceleration of floors and of drift and shear of storeys over the height,
    tracked in every step.

    A small `size` [in] has room for the first panels only. One row of panels for x, one for y if a structure moves along it, and one for rotations and edge displacements of
    rigid floors in space. The run without links, if available, is dashed unless `compare` is False. Raises BadRequest
    if no structure has floors, for a file of version 0.1, which has no extremes, and if `compare` is True without a run
    to compare."""
    structures = [structure for structure in run.structures.values() if structure.floors]
    if not structures:
        raise BadRequest("no profiles to draw: no structure of this run has floors")
    if not run.envelopes:
        raise BadRequest(
            "this file was written before version 0.2, which tracks extremes in every step; run the model again"
        )
    if compare:
        require_comparison(run, "profiles")
    runs = [(run, SOLID)]
    if run.no_pounding is not None and compare is not False:
        runs.append((run.no_pounding, DASHED))
    rows = [axis for axis in "xy" if any(axis in structure.along for structure in structures)]
    panels = [draw_displacement, draw_drift, draw_shear, draw_acceleration]
    if all(run.envelopes[structure.name].drift is None for structure in structures):
        panels = [draw_displacement, draw_acceleration]
    columns = len(panels) if size is None or size[0] >= NARROW else 2
    drawn = [(axis, draw) for axis in rows for draw in panels]
    if any(run.envelopes[structure.name].edge_displacement is not None for structure in structures):
        drawn += [("rz", draw_rotation), *((axis, draw_edges) for axis in rows)]
    lines = -(-len(drawn) // columns)
    if size is not None:
        # A small figure has the first panels only.
        lines = min(lines, max(1, int((size[1] - 0.9) / LOWEST)))
        drawn = drawn[: lines * columns]
    width, height = size or (7.5, 0.9 + 3.4 * lines)
    with picture((width, height), run.title if title is None else title) as figure:
        grid = figure.subplots(lines, columns, sharey=True, squeeze=False)
        for axes in grid.flat[len(drawn) :]:
            axes.set_visible(False)
        for letter, (axis, draw), axes in zip(ascii_lowercase, drawn, grid.flat):
            draw(axes, runs, axis)
            along = "" if len(rows) == 1 or axis == "rz" else f" along {axis}" if width >= NARROW else f", {axis}"
            axes.set_title(f"({letter}) {axes.get_title(loc='left')}{along}")
        for line in grid:
            line[0].set_ylabel(height_label(structures))
            line[0].yaxis.set_major_locator(
                MaxNLocator(integer=True, nbins=int(np.clip(4 * (height - 0.9) / lines, 2, 12)))
            )
        figure.legend(handles=_legend(run, len(runs) > 1), loc="outside lower center", ncols=max(1, int(width / 1.25)))
        return figure


Runs = list[tuple[RunData, dict[str, Any]]]


def draw_displacement(axes: Axes, runs: Runs, axis: str = "x") -> None:
    """Extreme displacements of the floors; the ground is zero."""
    _draw_floors(axes, runs, axis, lambda run, one: MM * _extremes(run, one, "displacement", ["xy".index(axis)]))
    _finish(axes, "Displacement", "mm")


def draw_rotation(axes: Axes, runs: Runs, axis: str = "rz") -> None:
    """Extreme rotations of rigid floors about z."""

    def of_rigid_floors(run: RunData, one: Structure) -> np.ndarray:
        if one.plan is None:
            return NOTHING
        turned = _extremes(run, one, "displacement", [one.directions.index(axis)])
        return MM * np.where(np.isnan(one.plan[:, 0]), np.nan, turned)

    _draw_floors(axes, runs, axis, of_rigid_floors)
    _finish(axes, "Rotation", "mrad")


def draw_edges(axes: Axes, runs: Runs, axis: str = "x") -> None:
    """Extreme displacements of the two parallel edges of rigid floors along an axis, the larger of both."""
    edges = [number for number, name in enumerate(EDGES) if name.startswith(axis)]
    _draw_floors(axes, runs, axis, lambda run, one: MM * _extremes(run, one, "edge_displacement", edges))
    _finish(axes, "Edge displacement", "mm")
    axes.set_title("Edges")


def draw_acceleration(axes: Axes, runs: Runs, axis: str = "x") -> None:
    """Extreme absolute accelerations of the floors."""
    _draw_floors(axes, runs, axis, lambda run, one: _extremes(run, one, "acceleration", ["xy".index(axis)]), ())
    _finish(axes, "Acceleration", "m/s²")


def draw_drift(axes: Axes, runs: Runs, axis: str = "x") -> None:
    """Extreme storey drifts, in per cent of the storey height if all heights are known."""
    relative = _all_heights_known(runs[0][0])
    for run, structure, style in _structures(runs, axis):
        heights = _levels(structure, run)
        for values in _extremes(run, structure, "drift", ["xy".index(axis)]):
            _draw_steps(axes, 100 * values / np.diff(heights) if relative else MM * values, heights, style)
    _finish(axes, "Storey drift", "% of height" if relative else "mm")


def draw_shear(axes: Axes, runs: Runs, axis: str = "x") -> None:
    """Extreme storey shears."""
    drawn = list(_structures(runs, axis))
    shears = [_extremes(run, structure, "storey_shear", ["xy".index(axis)]) for run, structure, _ in drawn]
    size, unit = engineering(largest(shears), FORCE_UNITS)
    for (run, structure, style), pair in zip(drawn, shears):
        for values in pair:
            _draw_steps(axes, values / size, _levels(structure, run), style)
    _finish(axes, "Storey shear", unit)


def _draw_floors(
    axes: Axes,
    runs: Runs,
    axis: str,
    extremes: Callable[[RunData, Structure], np.ndarray],
    ground: Sequence[float] = (0.0,),
) -> None:
    """Minima and maxima at the floors, and the value of the ground."""
    for run, structure, style in _structures(runs, axis):
        heights = _levels(structure, run)[1 - len(ground) :]
        for values in extremes(run, structure):
            axes.plot([*ground, *values], heights, marker="o", markersize=2.5, **style)


def _structures(runs: Runs, axis: str) -> Iterator[tuple[RunData, Structure, dict[str, Any]]]:
    """Structures that move along an axis, with their lines; the last run first, so that the first is in front."""
    for run, style in reversed(runs):
        for number, structure in enumerate(run.structures.values()):
            if structure.floors and axis in structure.along:
                yield run, structure, {"color": structure_colour(number), **style}


def _extremes(run: RunData, structure: Structure, what: str, columns: list[int]) -> np.ndarray:
    """[2, floor] minima and maxima over these columns; without rows if the structure does not have the quantity."""
    found = getattr(run.envelopes[structure.name], what)
    return (
        NOTHING if found is None else np.stack([found.min[:, columns].min(axis=1), found.max[:, columns].max(axis=1)])
    )


def _draw_steps(axes: Axes, values: np.ndarray, heights: np.ndarray, style: dict[str, Any]) -> None:
    """Values that are constant within a storey."""
    axes.plot(np.repeat(values, 2), np.repeat(heights, 2)[1:-1], **style)


def _legend(run: RunData, compared: bool) -> list[Line2D]:
    handles = [
        Line2D([], [], color=structure_colour(number), label=structure.name, **SOLID)
        for number, structure in enumerate(run.structures.values())
        if structure.floors
    ]
    return handles + [Line2D([], [], color="0.35", label="without links", **DASHED)] * compared


def _all_heights_known(run: RunData) -> bool:
    return all(floor_heights(structure)[1] for structure in run.structures.values() if structure.floors)


def _levels(structure: Structure, run: RunData) -> np.ndarray:
    """[floor + 1] from the ground: elevations [m], or floor numbers if any is unknown. The ground is at the lowest
    node, or at zero."""
    return levels(structure) if _all_heights_known(run) else np.arange(len(structure.floors) + 1.0)


def height_label(structures: list[Structure]) -> str:
    """Label of the vertical axis: elevations if all are known."""
    return "Elevation [m]" if all(floor_heights(structure)[1] for structure in structures) else "Floor"


def _finish(axes: Axes, title: str, unit: str) -> None:
    axes.axvline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.set_title(title)
    axes.set_xlabel(f"{title} [{unit}]")
    axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.margins(y=0.02)
