"""Profiles over the height of the structures: the extreme values of the whole run at every floor and in every storey."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from pounding.results import RunData, Structure
from pounding.pictures.geometry import floor_heights
from pounding.pictures.style import FORCE_UNITS, MM, STYLE, BadRequest, Picture, engineering, head, largest, structure_colour


def profiles_figure(run: RunData, title: str | None = None, size: tuple[float, float] | None = None) -> Figure:
    """Displacement and acceleration of the floors, drift and shear of the storeys: largest and smallest of the run, over
    the height. One row of panels for x, another one for y when a structure has it.

    Raises BadRequest when no structure has floors."""
    structures = [structure for structure in run.structures.values() if structure.floors]
    if not structures or not run.time.size:
        raise BadRequest("there is nothing to draw profiles of: no structure of this run has floors and results")
    rows = [axis for axis in "xy" if any(axis in structure.along for structure in structures)]
    has_storeys = any(_of(structure, axis, "drift").shape[1] for structure in structures for axis in rows)
    panels = [draw_displacement, draw_drift, draw_shear, draw_acceleration]
    if not has_storeys:
        panels = [draw_displacement, draw_acceleration]
    with rc_context(STYLE):
        figure = Picture(figsize=size or (7.5, 0.9 + 3.4 * len(rows)), layout="constrained")
        grid = figure.subplots(len(rows), len(panels), sharey=True, squeeze=False)
        letters = iter("abcdefgh")
        for axis, line in zip(rows, grid):
            for draw, axes in zip(panels, line):
                draw(axes, run, axis)
                along = f" along {axis}" if len(rows) > 1 else ""
                axes.set_title(f"({next(letters)}) {axes.get_title(loc='left')}{along}")
            line[0].set_ylabel(_height_label(structures))
        handles, labels = grid[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside lower center", ncols=6)
        head(figure, run.title if title is None else title)
        return figure


def draw_displacement(axes: Axes, run: RunData, axis: str = "x") -> None:
    """Extreme displacements of the floors; the ground is zero."""
    for structure, style in _styles(run, axis):
        low, high = _extremes(MM * _of(structure, axis, "displacement"))
        heights = _levels(structure, run)
        for values in (low, high):
            axes.plot([0, *values], heights, marker="o", markersize=2.5, **style)
            style.pop("label", None)
    _finish(axes, "Displacement", "mm")


def draw_acceleration(axes: Axes, run: RunData, axis: str = "x") -> None:
    """Extreme absolute accelerations of the floors."""
    for structure, style in _styles(run, axis):
        low, high = _extremes(_of(structure, axis, "acceleration"))
        for values in (low, high):
            axes.plot(values, _levels(structure, run)[1:], marker="o", markersize=2.5, **style)
            style.pop("label", None)
    _finish(axes, "Acceleration", "m/s²")


def draw_drift(axes: Axes, run: RunData, axis: str = "x") -> None:
    """Extreme storey drifts: in per cent of the storey's height where all heights are known."""
    relative = _all_heights_known(run)
    for structure, style in _styles(run, axis):
        drift, heights = _of(structure, axis, "drift"), _levels(structure, run)
        if not drift.shape[1]:
            continue
        _steps(axes, *_extremes(100 * drift / np.diff(heights) if relative else MM * drift), heights, style)
    _finish(axes, "Storey drift", "% of height" if relative else "mm")


def draw_shear(axes: Axes, run: RunData, axis: str = "x") -> None:
    """Extreme storey shears."""
    shears = {structure.name: _of(structure, axis, "storey_shear") for structure, _ in _styles(run, axis)}
    size, unit = engineering(largest(shears.values()), FORCE_UNITS)
    for structure, style in _styles(run, axis):
        _steps(axes, *_extremes(shears[structure.name] / size), _levels(structure, run), style)
    _finish(axes, "Storey shear", unit)


def _styles(run: RunData, axis: str) -> Iterator[tuple[Structure, dict[str, Any]]]:
    for number, structure in enumerate(run.structures.values()):
        if structure.floors and axis in structure.along:
            yield structure, {"color": structure_colour(number), "label": structure.name, "linewidth": 1.2}


def _of(structure: Structure, axis: str, what: str) -> np.ndarray:
    return getattr(structure.along[axis], what) if axis in structure.along else np.empty((0, 0))


def _extremes(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return values.min(axis=0), values.max(axis=0)


def _steps(axes: Axes, low: np.ndarray, high: np.ndarray, heights: np.ndarray, style: dict[str, Any]) -> None:
    """Values that are constant within a storey."""
    if not low.size:
        return
    for values in (low, high):
        axes.plot(np.repeat(values, 2), np.repeat(heights, 2)[1:-1], **style)
        style.pop("label", None)


def _all_heights_known(run: RunData) -> bool:
    return all(floor_heights(structure)[1] for structure in run.structures.values() if structure.floors)


def _levels(structure: Structure, run: RunData) -> np.ndarray:
    """[floor + 1] from the ground: elevations [m], or numbers of the floors where not all are known.

    The ground of a structure is at the lowest of its nodes, or at zero."""
    if not _all_heights_known(run):
        return np.arange(len(structure.floors) + 1.0)
    ground = structure.geometry.nodes[:, 2].min() if structure.geometry is not None else min(0.0, structure.elevations[0])
    return np.array([ground, *structure.elevations])


def _height_label(structures: list[Structure]) -> str:
    return "Elevation [m]" if all(floor_heights(structure)[1] for structure in structures) else "Floor"


def _finish(axes: Axes, title: str, unit: str) -> None:
    axes.axvline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.set_title(title)
    axes.set_xlabel(f"{title} [{unit}]")
    axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=12))
    axes.margins(y=0.02)
