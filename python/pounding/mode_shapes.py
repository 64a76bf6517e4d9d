"""Pictures of mode shapes: `pounding modes MODEL.yaml --plot` calls `python3 -m pounding.mode_shapes MODES.json -o OUT.png`.

The input is one JSON object:

    modes         what `pounding modes --json` prints: name -> list of modes with period [s] (null: infinite),
                  damping_ratio, participation, effective_mass [kg], shape [unknown]
    geometry      name -> {dimension, nodes [[x, y, z]] [m], members [[a, b]]} of the structures that have one
    node_shapes   name -> [mode][node][x, y, z], displacements of the nodes of `geometry` in each mode, to any scale
    elevations    name -> [floor] [m]; of structures without geometry; optional

A bare `pounding modes --json` is read too: its structures are drawn as profiles, their unknowns floors from the ground up.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from pounding.drawing import project
from pounding.style import QUIET, STYLE, BadRequest, Picture, head, structure_colour, write_picture

#: Modes of one structure in a picture.
MOST = 5
#: Width of a panel [in].
PANEL = 1.7
#: Largest displacement of a drawn mode over the size of the frame.
DRAWN_SIZE = 0.12


def plot_modes(modes: dict[str, Any], title: str = "Mode shapes") -> Figure:
    """One row a structure, one panel for each of its first modes: a profile over the height, or the deformed frame.

    `modes` is the object above. Raises BadRequest when there is no mode or what is given does not fit together."""
    whole = modes if isinstance(modes.get("modes"), dict) else {"modes": modes}
    names = [name for name, found in whole["modes"].items() if found]
    if not names:
        raise BadRequest("there is no mode to draw: no structure of this model moves against the ground")
    columns = max(2, max(min(MOST, len(whole["modes"][name])) for name in names))
    heights = [_height(whole.get("geometry", {}).get(name)) for name in names]
    with rc_context(STYLE):
        figure = Picture(figsize=(max(3.8, PANEL * columns + 0.4), 0.4 + sum(heights)), layout="constrained")
        grid = figure.subplots(len(names), columns, squeeze=False, height_ratios=heights)
        for number, (name, row) in enumerate(zip(names, grid)):
            _draw_structure(row, name, whole, structure_colour(list(whole["modes"]).index(name)))
        head(figure, title)
        return figure


def _height(geometry: dict[str, Any] | None) -> float:
    """Of a row of panels with their titles [in]: a frame fills its panel."""
    if not geometry or not geometry.get("nodes"):
        return 2.9
    nodes = np.asarray(geometry["nodes"], float)
    (width, height), room = np.ptp(project(nodes, _view(nodes)), axis=0), DRAWN_SIZE * np.ptp(nodes, axis=0).max()
    return 0.5 + float(np.clip(PANEL * (height + 1.3 * room) / (width + 2 * room), 0.8, 3.4))


def _view(nodes: np.ndarray) -> str:
    return "oblique" if np.ptp(nodes[:, 1]) > 0 else "elevation"


def _draw_structure(row: np.ndarray, name: str, whole: dict[str, Any], colour: str) -> None:
    found = whole["modes"][name][:len(row)]
    geometry = whole.get("geometry", {}).get(name)
    shapes = whole.get("node_shapes", {}).get(name)
    for axes in row[len(found):]:
        axes.set_axis_off()
    for number, (axes, mode) in enumerate(zip(row, found)):
        if geometry and geometry.get("nodes"):
            if shapes is None or len(shapes) <= number:
                raise BadRequest(f"{name}: node_shapes of mode {number + 1} are missing")
            draw_deformed(axes, name, geometry, np.asarray(shapes[number], float), colour)
        else:
            draw_profile(axes, mode["shape"], whole.get("elevations", {}).get(name), colour)
            axes.tick_params(labelleft=number == 0)
            if number:
                axes.set_ylabel("")
        axes.set_title(f"{name}, mode {number + 1}\n{_words(mode)}", fontsize=7.5, fontweight="normal")


def draw_profile(axes: Axes, shape: np.ndarray, elevations: Sequence[float | None] | None, colour: str) -> None:
    """Amplitudes over the height, zero at the ground; over the numbers of the floors without elevations."""
    levels = [level for level in elevations or () if level is not None]
    known = elevations is not None and len(elevations) == len(levels) == len(shape)
    heights = np.array([0.0, *levels]) if known else np.arange(len(shape) + 1.0)
    axes.axvline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.plot([0, *shape], heights, color=colour, marker="o", markersize=3, linewidth=1.4)
    size = 1.25 * max(np.max(np.abs(shape)), 1e-300)
    axes.set(xlim=(-size, size), xlabel="Amplitude", ylabel="Elevation [m]" if known else "Floor")
    axes.xaxis.set_major_locator(MaxNLocator(3))
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=10))


def draw_deformed(axes: Axes, name: str, geometry: dict[str, Any], shape: np.ndarray, colour: str) -> None:
    """Members at rest in grey and displaced by `shape` [node, 3] in colour, members as straight lines."""
    nodes = np.asarray(geometry["nodes"], float)
    members = np.asarray(geometry["members"], int).reshape(-1, 2)
    if shape.shape != nodes.shape:
        raise BadRequest(f"{name}: node_shapes are {shape.shape} numbers for {len(nodes)} nodes, they should be "
                         f"{nodes.shape}")
    view = _view(nodes)
    moved = np.abs(shape).max()
    size = np.ptp(nodes, axis=0).max()
    displaced = nodes + (DRAWN_SIZE * size / moved if moved > 0 else 0) * shape
    many = len(members) > 300
    for points, line_colour, width in ((nodes, QUIET, 0.5), (displaced, colour, 0.6 if many else 1.2)):
        axes.add_collection(LineCollection(project(points, view)[members], capstyle="round",
                                         color=line_colour, linewidth=width))
    # All modes of a frame have the same scale, whichever way they move.
    room = DRAWN_SIZE * size
    flat = project(nodes, view)
    (left, low), (right, high) = flat.min(axis=0), flat.max(axis=0)
    axes.set(xlim=(left - room, right + room), ylim=(low - 0.3 * room, high + room))
    axes.set_aspect("equal")
    axes.set_axis_off()


def _words(mode: dict[str, Any]) -> str:
    period = "no period" if mode.get("period") is None else f"T = {mode['period']:.4g} s"
    return f"{period}, {100 * mode['damping_ratio']:.3g} % damping"


def main(arguments: list[str] | None = None) -> int:
    """Command line. Returns 0, or 2 after a message when the modes cannot be read or the picture not written."""
    parser = argparse.ArgumentParser(prog="python3 -m pounding.mode_shapes", description="Draw mode shapes.")
    parser.add_argument("modes", help="file with the JSON object; - for standard input")
    parser.add_argument("-o", "--output", required=True, help="picture to write: .png, .pdf or .svg")
    parser.add_argument("--title", default="Mode shapes", help="title of the picture")
    options = parser.parse_args(arguments)
    try:
        if options.modes == "-":
            modes = json.load(sys.stdin)
        else:
            with open(options.modes, encoding="utf-8") as file:
                modes = json.load(file)
        figure = plot_modes(modes, options.title)
    except BadRequest as error:
        print(error, file=sys.stderr)
        return 2
    except (OSError, ValueError) as error:
        print(f"cannot read {options.modes}: {error}", file=sys.stderr)
        return 2
    return write_picture(figure, options.output)


if __name__ == "__main__":
    sys.exit(main())
