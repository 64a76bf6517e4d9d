"""Scenes drawn as lines and masses on plane axes, at rest or in motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.markers import MarkerStyle

from pounding._pictures.geometry import outline
from pounding._pictures.style import YELLOW, structure_colour

if TYPE_CHECKING:
    from pounding._pictures.scene import Motion, Scene

#: Two rows of factors of x, y and z: to the right and up in the picture. `oblique` is a parallel projection, seen from
#: the front right and 25 degrees from above.
VIEWS = {
    "elevation": np.array([[1.0, 0, 0], [0, 0, 1.0]]),
    "side": np.array([[0, 1.0, 0], [0, 0, 1.0]]),
    "plan": np.array([[1.0, 0, 0], [0, 1.0, 0]]),
    "oblique": np.array(
        [[np.cos(0.6), np.sin(0.6), 0], [-np.sin(0.44) * np.sin(0.6), np.sin(0.44) * np.cos(0.6), np.cos(0.44)]]
    ),
}


#: Number of structures above which names overlap, colours repeat, and views from above need hidden lines.
FEW = 12


def are_many(scene: Scene) -> bool:
    """True above the number of structures at which views are drawn back to front, with small marks and few names."""
    return len(scene.line_models) > FEW


def project(points: np.ndarray, view: str) -> np.ndarray:
    """[.., 2] of points [.., 3]."""
    return points @ VIEWS[view].T


class Drawing:
    """Drawing of all structures of a scene, with a mark at each link."""

    def __init__(self, axes: Axes, scene: Scene, view: str, marks: bool = True) -> None:
        self.scene, self.view = scene, view
        self.lines: dict[str, LineCollection] = {}
        self.boxes: dict[str, PolyCollection] = {}
        #: White areas under the lines of each structure, which hide the structures behind it.
        self.bodies: dict[str, PolyCollection] = {}
        hides = view == "oblique" and are_many(scene)
        nearer = _from_behind(scene) if hides else {}
        for number, (name, model) in enumerate(scene.line_models.items()):
            colour = "0.25" if scene.run.structures[name].is_wall else structure_colour(number)
            many = len(model.members) > 300
            width = 3.0 if scene.run.structures[name].is_wall else 0.6 if many else 1.3 if model.has_place else 2.0
            self.lines[name] = LineCollection(
                [], colors=colour, linewidths=width, capstyle="round", zorder=3 + nearer.get(name, 0), label=name
            )
            self.boxes[name] = PolyCollection([], facecolors=colour, edgecolors="white", linewidths=0.5, zorder=4)
            if hides:
                self.bodies[name] = PolyCollection(
                    [], facecolors="white", edgecolors="none", zorder=3 + nearer[name] - 1e-4
                )
                axes.add_collection(self.bodies[name])
            axes.add_collection(self.lines[name])
            axes.add_collection(self.boxes[name])
            self._set(name, scene.at_rest(name))
        points = np.array([project(face, view) for face in scene.faces.values()]).reshape(-1, 2)
        small = are_many(scene)
        size, width = (3, 0.4) if small else (22, 0.8)
        style: dict[str, Any] = {"marker": "D", "facecolor": "white", "edgecolor": "black", "zorder": 6}
        self.marks = axes.scatter(
            points[:, 0], points[:, 1], s=size, linewidth=width, visible=marks and not hides, **style
        )
        #: One flash per link, invisible while the link is open.
        style = {"marker": MarkerStyle(star()), "facecolor": YELLOW, "edgecolor": "black", "zorder": 7}
        self.flashes = axes.scatter(points[:, 0], points[:, 1], s=0, linewidth=0.6, **style)

    def artists(self) -> list[Artist]:
        """Artists changed by `move` and `flash`, lowest first."""
        return sorted(
            [*self.bodies.values(), *self.lines.values(), *self.boxes.values(), self.flashes],
            key=lambda artist: artist.get_zorder(),
        )

    def move(self, motion: Motion, frame: int) -> None:
        """Moves the structures to their positions in `motion` at a frame."""
        for name in self.lines:
            self._set(name, motion.nodes(name, frame))

    def flash(self, motion: Motion, frame: int, strengths: np.ndarray) -> None:
        """Shows a flash at each link with a strength, 0 to 1, above zero."""
        links = self.scene.run.links.values()
        points = [project(motion.face(link, frame), self.view) for link in links]
        self.flashes.set_offsets(np.array(points).reshape(-1, 2))
        size = 0.4 if are_many(self.scene) else 1.0
        self.flashes.set_sizes([size * (60 + 500 * strength) if strength > 0 else 0 for strength in strengths])

    def _set(self, name: str, nodes: np.ndarray) -> None:
        model = self.scene.line_models[name]
        points = project(nodes, self.view)
        self.lines[name].set_segments(points[model.members])
        if name in self.bodies:
            self.bodies[name].set_verts([outline(points)])
        corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [model.half_width, model.half_height]
        self.boxes[name].set_verts([corner + corners for corner in points[model.masses]])


def _from_behind(scene: Scene) -> dict[str, float]:
    """Drawing order of structures, from 0 to below 1, increasing towards the viewer of an oblique view."""
    to_eye = np.cross(*VIEWS["oblique"])
    middles = {name: scene.at_rest(name).mean(axis=0)[:2] @ to_eye[:2] for name in scene.line_models}
    order = sorted(middles, key=lambda name: float(middles[name]))
    return {name: 0.9 * place / len(order) for place, name in enumerate(order)}


def star(points: int = 8, inner: float = 0.42) -> np.ndarray:
    """Outline of a flash, as a marker."""
    angles = np.pi * np.arange(2 * points + 1) / points
    radii = np.where(np.arange(2 * points + 1) % 2 == 0, 1.0, inner)
    return np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)


def draw_ground(axes: Axes, scene: Scene, view: str) -> None:
    """A line under everything at rest, or in an oblique view the outline of each structure on the ground."""
    bounds = scene.bounds()
    low, (left, right) = bounds[2, 0], bounds[0 if view == "elevation" else 1]
    if view in ("elevation", "side"):
        low = min(low, 0.0) if not scene.has_places else low
        margin = 0.06 * max(right - left, 0.2 * (bounds[2, 1] - low))
        depth = 0.02 * max(bounds[2, 1] - low, right - left)
        axes.fill_between([left - margin, right + margin], low - depth, low, color="0.82", linewidth=0, zorder=1)
        axes.plot([left - margin, right + margin], [low, low], color="0.25", linewidth=0.9, zorder=2)
    elif view == "oblique":
        for name in scene.line_models:
            corners = scene.at_rest(name)
            x0, y0, z0 = corners.min(axis=0)
            x1, y1, _ = corners.max(axis=0)
            outline = np.array([[x0, y0, z0], [x1, y0, z0], [x1, y1, z0], [x0, y1, z0]])
            axes.fill(*project(outline, view).T, color="0.9", linewidth=0, zorder=1)


def frame_axes(axes: Axes, scene: Scene, view: str, margin: float | np.ndarray = 0.0) -> None:
    """Equal scales on both axes, room for `margin` [m], one or along x, y, z, around the scene."""
    bounds = scene.bounds(margin)
    corners = np.stack(np.meshgrid(*bounds, indexing="ij"), axis=-1).reshape(-1, 3)
    flat = project(corners, view)
    size = max(np.ptp(flat, axis=0).max(), 1.0)
    (left, low), (right, high) = flat.min(axis=0), flat.max(axis=0)
    axes.set(xlim=(left - 0.08 * size, right + 0.08 * size), ylim=(low - 0.04 * size, high + 0.12 * size))
    axes.set_aspect("equal")


def hide_x(axes: Axes) -> None:
    """Hides the coordinates along x, which are not to scale."""
    axes.set(xticks=[], xlabel="")
    axes.spines["bottom"].set_visible(False)


def label_axes(axes: Axes, scene: Scene, view: str) -> None:
    """Labels axes with meaningful coordinates; an oblique view has none."""
    if view == "oblique":
        axes.set_axis_off()
        return
    horizontal, vertical = {"elevation": ("x", "z"), "side": ("y", "z"), "plan": ("x", "y")}[view]
    axes.set_xlabel(f"{horizontal} [m]")
    axes.set_ylabel(f"{vertical} [m]")
    if not scene.has_places and horizontal == "x":
        hide_x(axes)
    if vertical == "z" and not scene.has_heights:
        axes.set(yticks=[], ylabel="Heights are not in the file")
        axes.spines["left"].set_visible(False)
