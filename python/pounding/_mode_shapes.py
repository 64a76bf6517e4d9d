"""Pictures of mode shapes: `pounding modes MODEL.yaml --plot` calls `python3 -m pounding._mode_shapes MODES.json -o
OUT.png`.

The file is one JSON object:

    modes         what `pounding modes --json` prints: name -> list of modes with period [s] (null: infinite),
                  damping_ratio, participation, effective_mass [kg], shape [unknown]
    geometry      name -> {dimension, nodes [[x, y, z]] [m], members [[a, b]]} of the structures that have one
    node_shapes   name -> [mode][node][x, y, z], displacements of the nodes of `geometry` in each mode, to any scale
    elevations    name -> [floor] [m]; of structures without geometry; optional

A bare `pounding modes --json` is read too: its structures are drawn as profiles, their unknowns floors from the ground
up.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from pounding._ended import exit_code
from pounding._pictures.drawing import project
from pounding._pictures.style import QUIET, BadRequest, draw_object, picture, structure_colour

#: Maximum number of modes of one structure in a picture.
MOST = 5
#: Width of a panel [in].
PANEL = 1.7
#: Largest displacement of a drawn mode over the size of the frame.
DRAWN_SIZE = 0.12


@dataclass(frozen=True)
class DrawnMode:
    """One mode of a structure."""

    period: float  #: [s]; infinite for a free body
    damping_ratio: float  #: [-]
    shape: np.ndarray  #: [floor] amplitudes, of a frame [floor, direction]; to any scale


@dataclass(frozen=True)
class DrawnStructure:
    """The modes of one structure, drawn as deformed frames if it has nodes, else as profiles over the floors."""

    name: str
    modes: Sequence[DrawnMode]
    elevations: Sequence[float | None] | None = None  #: [floor] [m]
    nodes: np.ndarray = field(default_factory=lambda: np.empty((0, 3)))  #: [node, 3] x, y, z at rest [m]
    members: np.ndarray = field(default_factory=lambda: np.empty((0, 2), int))  #: [member, 2] indices of nodes
    node_shapes: Sequence[np.ndarray] = ()  #: [mode] of [node, 3] displacements, to any scale


def read_modes(values: dict[str, Any]) -> list[DrawnStructure]:
    """The structures of the JSON object above."""
    whole = values if isinstance(values.get("modes"), dict) else {"modes": values}
    structures = []
    for name, found in whole["modes"].items():
        geometry = whole.get("geometry", {}).get(name) or {}
        periods = [math.inf if one.get("period") is None else one["period"] for one in found]
        structures.append(
            DrawnStructure(
                name,
                [
                    DrawnMode(period, one["damping_ratio"], np.array(one["shape"]))
                    for period, one in zip(periods, found)
                ],
                whole.get("elevations", {}).get(name),
                np.array(geometry.get("nodes", []), float).reshape(-1, 3),
                np.array(geometry.get("members", []), int).reshape(-1, 2),
                [np.array(shape, float) for shape in whole.get("node_shapes", {}).get(name, [])],
            )
        )
    return structures


def plot_modes(structures: Sequence[DrawnStructure], title: str = "Mode shapes") -> Figure:
    """One row per structure and one panel per mode: a profile over the height, or the deformed frame.

    Raises BadRequest without modes, or if shapes do not match the nodes."""
    drawn = [structure for structure in structures if structure.modes]
    if not drawn:
        raise BadRequest("no mode to draw: no structure of this model moves relative to the ground")
    columns = max(2, max(min(MOST, len(structure.modes)) for structure in drawn))
    heights = [_height(structure.nodes) for structure in drawn]
    colours = {structure.name: structure_colour(number) for number, structure in enumerate(structures)}
    with picture((max(3.8, PANEL * columns + 0.4), 0.4 + sum(heights)), title) as figure:
        grid = figure.subplots(len(drawn), columns, squeeze=False, height_ratios=heights)
        for structure, row in zip(drawn, grid):
            _draw_structure(row, structure, colours[structure.name])
        return figure


def _height(nodes: np.ndarray) -> float:
    """Height of a row of panels with their titles [in]: a frame fills its panel."""
    if not len(nodes):
        return 2.9
    (width, height), room = np.ptp(project(nodes, _view(nodes)), axis=0), DRAWN_SIZE * np.ptp(nodes, axis=0).max()
    return 0.5 + float(np.clip(PANEL * (height + 1.3 * room) / (width + 2 * room), 0.8, 3.4))


def _view(nodes: np.ndarray) -> str:
    return "oblique" if np.ptp(nodes[:, 1]) > 0 else "elevation"


def _draw_structure(row: np.ndarray, structure: DrawnStructure, colour: str) -> None:
    for axes in row[len(structure.modes) :]:
        axes.set_axis_off()
    for number, (axes, mode) in enumerate(zip(row, structure.modes)):
        if len(structure.nodes):
            draw_deformed(axes, structure, number, colour)
        else:
            draw_profile(axes, mode.shape, structure.elevations, colour)
            axes.tick_params(labelleft=number == 0)
            if number:
                axes.set_ylabel("")
        axes.set_title(f"{structure.name}, mode {number + 1}\n{_words(mode)}", fontsize=7.5, fontweight="normal")


def draw_profile(axes: Axes, shape: np.ndarray, elevations: Sequence[float | None] | None, colour: str) -> None:
    """Draws amplitudes over the height, zero at the ground; over floor numbers if elevations are unknown."""
    levels = [level for level in elevations or () if level is not None]
    known = elevations is not None and len(elevations) == len(levels) == len(shape)
    heights = np.array([0.0, *levels]) if known else np.arange(len(shape) + 1.0)
    axes.axvline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.plot([0, *shape], heights, color=colour, marker="o", markersize=3, linewidth=1.4)
    size = 1.25 * max(np.max(np.abs(shape)), 1e-300)
    axes.set(xlim=(-size, size), xlabel="Amplitude", ylabel="Elevation [m]" if known else "Floor")
    axes.xaxis.set_major_locator(MaxNLocator(3))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=10))


def draw_deformed(axes: Axes, structure: DrawnStructure, number: int, colour: str) -> None:
    """Draws the frame at rest in grey and in mode `number`, from 0, in colour; members as straight lines."""
    nodes, members = structure.nodes, structure.members
    if len(structure.node_shapes) <= number:
        raise BadRequest(f"{structure.name}: node_shapes of mode {number + 1} are missing")
    shape = structure.node_shapes[number]
    if shape.shape != nodes.shape:
        raise BadRequest(
            f"{structure.name}: node_shapes are {shape.shape} numbers for {len(nodes)} nodes, they should be "
            f"{nodes.shape}"
        )
    view = _view(nodes)
    moved = np.abs(shape).max()
    size = np.ptp(nodes, axis=0).max()
    displaced = nodes + (DRAWN_SIZE * size / moved if moved > 0 else 0) * shape
    many = len(members) > 300
    for points, line_colour, width in ((nodes, QUIET, 0.5), (displaced, colour, 0.6 if many else 1.2)):
        axes.add_collection(
            LineCollection(project(points, view)[members], capstyle="round", color=line_colour, linewidth=width)
        )
    # All modes of a frame have the same scale.
    room = DRAWN_SIZE * size
    flat = project(nodes, view)
    (left, low), (right, high) = flat.min(axis=0), flat.max(axis=0)
    axes.set(xlim=(left - room, right + room), ylim=(low - 0.3 * room, high + room))
    axes.set_aspect("equal")
    axes.set_axis_off()


def _words(mode: DrawnMode) -> str:
    period = "no period" if math.isinf(mode.period) else f"T = {mode.period:.4g} s"
    return f"{period}, {100 * mode.damping_ratio:.3g} % damping"


def main(arguments: list[str] | None = None) -> int:
    """Command line: draws mode shapes."""

    def draw(data: Any, title: str | None) -> Figure:
        return plot_modes(read_modes(data), title or "Mode shapes")

    return draw_object("_mode_shapes", "Draw mode shapes.", draw, arguments)


if __name__ == "__main__":
    sys.exit(exit_code(main))
