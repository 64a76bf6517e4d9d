"""Picture of the model: frames in elevation, in space from all sides and in plan, with the links as marks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from pounding._pictures.drawing import Drawing, are_many, draw_ground, frame_axes, label_axes, project
from pounding._pictures.geometry import floor_heights
from pounding._pictures.panels import key, legend_below, note
from pounding._pictures.scene import Scene
from pounding._pictures.style import MM, NARROW, picture, structure_colour
from pounding.results import RunData

TITLES = {"oblique": "View", "plan": "Plan", "elevation": "Elevation along x", "side": "Elevation along y"}


def model_figure(run: RunData, title: str | None = None, size: tuple[float, float] | None = None) -> Figure:
    """The structures of a run at rest. One elevation; of a model in space a view, a plan and two elevations, in a
    narrow figure the view alone. `size` [in]."""
    scene = Scene(run)
    if not scene.has_places:
        scene = spread_scene(run, 0.04)
    views: list[Any] = [["oblique", "plan"], ["elevation", "side"]] if scene.is_spatial else [["elevation"]]
    if scene.is_spatial and size is not None and size[0] < NARROW:
        views = [["oblique"]]
    with picture(size or _size(scene), run.title if title is None else title) as figure:
        axes = figure.subplot_mosaic(views)
        for letter, (view, panel) in zip("abcd", axes.items()):
            panel.set_title(f"({letter}) {TITLES[view]}" if len(axes) > 1 else "")
            draw_model(panel, scene, view)
        handles = list(_legend(run))
        legend_below(figure, handles, [str(handle.get_label()) for handle in handles], 4)
        return figure


def spread_scene(run: RunData, part: float) -> Scene:
    """The structures of a run with gaps enlarged so that the widest is this fraction of the picture."""
    scene = Scene(run)
    widest = max((link.gap for link in run.links.values()), default=0.0)
    return Scene(run, part * max(np.ptp(scene.bounds(), axis=1)) / widest) if widest > 0 else scene


def draw_model(axes: Axes, scene: Scene, view: str) -> None:
    """One view of a scene at rest: elevation, side, plan or oblique."""
    axes.grid(False)
    draw_ground(axes, scene, view)
    Drawing(axes, scene, view)
    frame_axes(axes, scene, view)
    label_axes(axes, scene, view)
    if are_many(scene):
        if view == "plan":
            _name_inside(axes, scene)
        return
    name_structures(axes, scene, view)
    if view == "elevation":
        label_floors(axes, scene)


def _name_inside(axes: Axes, scene: Scene) -> None:
    """Names of many structures in plan, in small letters along the longer side of each."""
    for number, name in enumerate(scene.line_models):
        points = scene.at_rest(name)[:, :2]
        x, y = (points.min(axis=0) + points.max(axis=0)) / 2
        axes.annotate(
            name, (x, y), ha="center", va="center", fontsize=4, rotation=45, color=structure_colour(number), zorder=8
        )


def name_structures(axes: Axes, scene: Scene, view: str) -> None:
    """The name of each structure above it."""
    for number, name in enumerate(scene.line_models):
        points = project(scene.at_rest(name), view)
        x, y = (points[:, 0].min() + points[:, 0].max()) / 2, points[:, 1].max() + scene.line_models[name].half_height
        colour = "0.25" if scene.run.structures[name].is_wall else structure_colour(number)
        note(axes, name, (x, y), (0, 4), ha="center", va="bottom", fontweight="bold", color=colour, zorder=8)


def label_floors(axes: Axes, scene: Scene) -> None:
    """Labels the floors of the leftmost structure on the left and of the rightmost on the right, including walls."""
    middles = {name: scene.at_rest(name)[:, 0].mean() for name, s in scene.run.structures.items() if s.floors}
    if not middles:
        return
    first, last = min(middles, key=middles.__getitem__), max(middles, key=middles.__getitem__)
    ends = {first: -1} if first == last else {first: -1, last: 1}
    for name, side in ends.items():
        structure = scene.run.structures[name]
        x = scene.bounds()[0, 1 if side > 0 else 0]
        heights, _ = floor_heights(structure)
        every = -(-len(heights) // 16)
        style = {"va": "center", "ha": "left" if side > 0 else "right", "fontsize": 7, "color": "0.35"}
        for i in range(len(heights) - 1, -1, -every):
            note(axes, structure.floors[i], (x, heights[i] + scene.shifts[name][2]), (5 * side, 0), **style)


def _legend(run: RunData) -> Iterator[Line2D]:
    """The links, one entry for each gap."""
    gaps: dict[str, list[str]] = {}
    for link in run.links.values():
        gaps.setdefault(f"{MM * link.gap:.4g} mm", []).append(link.name)
    for gap, names in gaps.items():
        words = names[0] if len(names) == 1 else f"{len(names)} links"
        yield key(f"{words}, gap {gap}", "D", 4.5, "white", markeredgewidth=1.0)


def _size(scene: Scene) -> tuple[float, float]:
    """Width and height of the figure [in]: those of the scene in proportion, within a page."""
    if scene.is_spatial:
        return 7.5, 6.6
    width, _, height = np.ptp(scene.bounds(), axis=1)
    shape = (height + 0.2 * max(width, height)) / (width + 0.2 * max(width, height))
    return 6.5, float(np.clip(5.6 * shape + 1.0, 3.0, 8.5))
