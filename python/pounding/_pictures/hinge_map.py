"""Map of yielded parts: structures at rest with their hinges and storeys, and the impacts between them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle

from pounding._pictures.drawing import Drawing, draw_ground, frame_axes, hide_x, label_axes, project, star
from pounding._pictures.model_picture import TITLES, label_floors, name_structures, spread_scene
from pounding._pictures.panels import key, legend_below, note, strength_of
from pounding._pictures.scene import Scene
from pounding._pictures.style import (
    ENERGY_UNITS,
    FORCE_UNITS,
    NARROW,
    YELLOW,
    BadRequest,
    engineering,
    largest,
    picture,
)
from pounding._springs import Springs
from pounding.results import RunData, Structure

#: Colour map.
COLOURS = colormaps["YlOrRd"]
#: Areas of circles, and widths of storeys, from no energy to the largest [points^2], [points].
AREAS, WIDTHS = (14.0, 150.0), (4.0, 12.0)
#: Area of a hinge that stayed elastic [points^2].
ELASTIC = 7.0
#: Width of the widest gap as a fraction of the picture, with room for hinges and impacts.
APART = 0.08
#: Distance of a hinge from its node as a fraction of the member; larger for hinges about z.
OFF_NODE, OFF_NODE_Z = 0.07, 0.13


@dataclass(frozen=True)
class Measure:
    """Quantity that a map colours."""

    label: str
    lowest: float  #: label of the colour scale
    least_top: float  #: minimum upper end of the scale
    of: Callable[[Springs, int], float]  #: of one part


#: For hinges that all have an ultimate rotation, for other hinges, and for runs with other parts that yield.
OVER_ULTIMATE = Measure(
    "Plastic rotation over ultimate",
    0,
    1.0,
    lambda springs, i: springs.largest["peak_plastic"][i] / springs.ultimate_rotation[i],
)
ROTATION = Measure("Plastic rotation (mrad)", 0, 0.1, lambda springs, i: 1e3 * springs.largest["peak_plastic"][i])
DUCTILITY = Measure("Ductility", 1, 1.5, lambda springs, i: springs.largest["ductility"][i])


@dataclass(frozen=True)
class Mark:
    """A part that can yield, as drawn."""

    structure: str
    name: str
    points: np.ndarray  #: [1 or 2, 3]: of a hinge, or the two ends of a storey, in the scene [m]
    value: float  #: of the measure of the map
    energy: float  #: lost [J]
    state: str  #: "elastic", "yielded" or "beyond ultimate"

    @property
    def is_storey(self) -> bool:
        """True for a storey, drawn as a line between floors."""
        return len(self.points) == 2


def hinges_figure(run: RunData, title: str | None = None, size: tuple[float, float] | None = None) -> Figure:
    """The structures of a run at rest with all parts that can yield.

    Circles are hinges, coloured by plastic rotation, or by its ratio to the ultimate rotation if all hinges have one.
    Thick lines are storeys, coloured by ductility, as are all parts of a run with storeys. Their size grows with the
    lost energy; elastic parts are small and white. Stars are links with impacts, larger for larger forces. One
    elevation; for a model in space a view and an elevation, in a narrow figure the view only. `size` [in]. Raises
    BadRequest for a run without parts that can yield."""
    scene = spread_scene(run, APART)
    measure = measure_of(run)
    marks = list(_marks(scene, measure))
    if not marks:
        raise BadRequest(
            "nothing to map: all structures of this run stay elastic. Give frames hinges, or storeys a yield_force"
        )
    narrow = size is not None and size[0] < NARROW
    views = ["elevation"] if not scene.is_spatial else ["oblique"] if narrow else ["oblique", "elevation"]
    with picture(size or _size(scene, len(views)), run.title if title is None else title) as figure:
        panels = figure.subplots(1, len(views), squeeze=False)[0]
        norm = Normalize(measure.lowest, max([measure.least_top, *(mark.value for mark in marks)]))
        for letter, panel, view in zip("ab", panels, views):
            panel.set_title(f"({letter}) {TITLES[view]}" if len(views) > 1 else "")
            draw_hinges(panel, scene, view, marks, norm, min(1.0, figure.get_figwidth() / (5.5 * len(views))))
        where: dict[str, Any] = {"ax": list(panels), "fraction": 0.04, "pad": 0.02, "shrink": 0.8, "panchor": False}
        figure.colorbar(ScalarMappable(norm, COLOURS), label=measure.label, **where)
        handles = list(_legend(run, marks))
        legend_below(figure, handles, [str(handle.get_label()) for handle in handles], 2 if narrow else 4)
        return figure


def draw_hinges(axes: Axes, scene: Scene, view: str, marks: list[Mark], norm: Normalize, scale: float = 1.0) -> None:
    """One view of a scene with its marks, smaller for a `scale` below 1. If they fit, numbers show the largest value
    of each structure and the number of impacts of each link."""
    numbers = scale > 0.75
    axes.grid(False)
    draw_ground(axes, scene, view)
    drawing = Drawing(axes, scene, view, marks=False)
    for lines in drawing.lines.values():
        lines.set_alpha(0.45)
    most = max((mark.energy for mark in marks), default=0.0)
    for mark in sorted(marks, key=lambda one: one.energy):
        _draw_mark(axes, mark, view, norm, mark.energy / most if most > 0 else 0.0, scale)
    _draw_impacts(axes, scene, view, numbers, scale)
    frame_axes(axes, scene, view)
    label_axes(axes, scene, view)
    if view == "elevation" and scene.scale != 1:
        hide_x(axes)
    name_structures(axes, scene, view)
    if view == "elevation":
        label_floors(axes, scene)
    if numbers:
        _number_largest(axes, marks, view)


def measure_of(run: RunData) -> Measure:
    """The quantity that the map of a run colours."""
    found = [
        springs for structure in run.structures.values() if (springs := structure.springs) is not None and len(springs)
    ]
    if found and all(np.isfinite(springs.ultimate_rotation).all() for springs in found):
        return OVER_ULTIMATE
    return (
        ROTATION if found and all(springs.is_hinge(i) for springs in found for i in range(len(springs))) else DUCTILITY
    )


def _marks(scene: Scene, measure: Measure) -> Iterator[Mark]:
    for structure, springs, i, points in placed_parts(scene):
        value, energy = float(measure.of(springs, i)), float(springs.largest["hysteretic"][i])
        yield Mark(structure.name, springs.names[i], points, value, energy, springs.states[i])


def placed_parts(scene: Scene) -> Iterator[tuple[Structure, Springs, int, np.ndarray]]:
    """The yielding parts of all structures that have a position: structure, its parts, index of the part, and its
    position at rest in the scene, [1 or 2, 3], two ends of a storey [m]."""
    for structure in scene.run.structures.values():
        springs = structure.springs
        if springs is None:
            continue
        for i, part in enumerate(springs.names):
            points = _part_points(scene, structure, part)
            if points is not None:
                yield structure, springs, i, points


def _part_points(scene: Scene, structure: Structure, part: str) -> np.ndarray | None:
    """[1 or 2, 3] position of a yielding part at rest in the scene [m], two ends of a storey; None if it has none in the
    line model."""
    nodes = scene.at_rest(structure.name)
    kind, _, number = part.partition(" ")
    if structure.geometry is None:
        model = scene.line_models[structure.name]
        if part == "isolators":  # below the slab, which is the lowest floor
            return nodes[model.members[0]]
        if kind != "storey" or not number.isdigit() or int(number) > len(model.members):
            return None
        return nodes[model.members[int(number) - 1]]
    words = part.split(" ")
    if words[0] == "isolator" and words[1] in structure.geometry.node_names:
        return nodes[structure.geometry.node_names.index(words[1])][None]
    off = OFF_NODE
    if words[-1] in ("y", "z"):
        off = OFF_NODE_Z if words.pop() == "z" else OFF_NODE
    member = " ".join(words[:-1])
    if words[-1] not in ("start", "end") or member not in structure.geometry.member_names:
        return None
    start, end = nodes[structure.geometry.members[structure.geometry.member_names.index(member)]]
    if words[-1] == "end":
        start, end = end, start
    return (start + off * (end - start))[None]


def _draw_mark(axes: Axes, mark: Mark, view: str, norm: Normalize, share: float, scale: float) -> None:
    points = project(mark.points, view)
    elastic = mark.state == "elastic"
    face = "white" if elastic else COLOURS(norm(mark.value))
    edge = "0.45" if elastic else "black"
    if mark.is_storey:
        # Short of the masses at its ends; the wider line behind is its edge.
        low, high = points[0] + 0.12 * (points[1] - points[0]), points[0] + 0.88 * (points[1] - points[0])
        width = scale * (2.5 if elastic else WIDTHS[0] + (WIDTHS[1] - WIDTHS[0]) * share)
        for colour, more, order in ((edge, 1.2, 4.5), (face, 0.0, 4.6)):
            axes.plot(
                *np.array([low, high]).T, color=colour, linewidth=width + more, solid_capstyle="butt", zorder=order
            )
        return
    area = scale**2 * (ELASTIC if elastic else AREAS[0] + (AREAS[1] - AREAS[0]) * share)
    beyond = mark.state == "beyond ultimate"
    axes.scatter(
        points[:, 0], points[:, 1], s=area, facecolor=[face], edgecolor=edge, linewidth=0.5, zorder=4 if elastic else 5
    )
    if beyond:
        axes.scatter(points[:, 0], points[:, 1], s=area, marker="x", color="black", linewidth=1.0, zorder=5.5)


def _draw_impacts(axes: Axes, scene: Scene, view: str, numbers: bool, scale: float) -> None:
    """A star at every link with impacts, with their number; a diamond at the others."""
    impacts = scene.run.impacts
    strength = strength_of(scene.run)
    most = largest([impacts[strength]])
    for name, face in scene.faces.items():
        link = scene.run.links[name]
        x, y = project(face + 0.5 * scene.scale * link.gap * link.direction, view)
        rows = scene.run.impacts_of(name)
        if not rows.size:
            axes.scatter(
                x, y, s=12 * scale**2, marker="D", facecolor="white", edgecolor="black", linewidth=0.6, zorder=6
            )
            continue
        area = scale**2 * (50 + 200 * (largest([rows[strength]]) / most if most > 0 else 0.0))
        axes.scatter(
            x, y, s=area, marker=MarkerStyle(star()), facecolor=YELLOW, edgecolor="black", linewidth=0.5, zorder=6
        )
        if numbers:
            axes.annotate(str(rows.size), (x, y), ha="center", va="center_baseline", fontsize=6, zorder=7)


def _number_largest(axes: Axes, marks: list[Mark], view: str) -> None:
    """Numbers the largest value of each structure, or of each storey for at most sixteen."""
    for name in dict.fromkeys(mark.structure for mark in marks):
        own = [mark for mark in marks if mark.structure == name and mark.state != "elastic"]
        shown = own if own and own[0].is_storey and len(own) <= 16 else sorted(own, key=lambda one: -one.value)[:1]
        for mark in shown:
            offset = (3 + WIDTHS[1] / 2, 0) if mark.is_storey else (6, 7)
            at = project(mark.points, view).mean(axis=0)
            note(axes, f"{mark.value:.3g}", at, offset, ha="left", va="center", fontsize=6.5, zorder=8)


def _legend(run: RunData, marks: list[Mark]) -> Iterator[Line2D]:
    most = max(marks, key=lambda one: one.energy)
    size, unit = engineering(most.energy, ENERGY_UNITS)
    circles = any(not mark.is_storey for mark in marks)
    yielded = sum(mark.state != "elastic" for mark in marks)
    middle = COLOURS(0.55)
    if most.energy > 0:
        words = f"{yielded} of {len(marks)} yielded, the largest lost {most.energy / size:.3g} {unit}"
        yield key(words, "o", 8, middle) if circles else Line2D([], [], color=middle, linewidth=6, label=words)
    if any(mark.state == "elastic" for mark in marks):
        words = "stayed elastic"
        yield key(words, "o", 3, "white", "0.45") if circles else Line2D([], [], color="0.45", linewidth=2, label=words)
    if any(mark.state == "beyond ultimate" for mark in marks):
        yield key("beyond its ultimate rotation", "x", 6, "black", markeredgewidth=1.0)
    if run.impacts.size:
        force = largest([run.impacts["peak_force"]])
        size, unit = engineering(force, FORCE_UNITS)
        words = f"impacts, at most {force / size:.3g} {unit}" if force > 0 else "impacts"
        yield key(words, MarkerStyle(star()), 9, YELLOW)


def _size(scene: Scene, views: int) -> tuple[float, float]:
    """Width and height of the figure [in]: those of the scene in proportion, within a page."""
    if views > 1:
        return 7.5, 4.6
    width, _, height = np.ptp(scene.bounds(), axis=1)
    return float(np.clip(2.2 + 3.8 * width / height, 4.8, 7.5)), float(np.clip(1.4 + 5.0 * height / width, 3.6, 5.2))
