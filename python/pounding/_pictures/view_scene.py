"""A scene as traces of plotly in three dimensions, and its motions: the film of a run and mode shapes.

Points of a trace are fixed, or follow two nodes of a structure with weights that add up to 1. Displacements are 16-bit
integers in units of a step per structure, so that a film of a row of buildings has some megabytes."""

from __future__ import annotations

import base64
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from pounding._mode_shapes import DRAWN_SIZE
from pounding._pictures.geometry import nearest_on_members
from pounding._pictures.hinge_map import placed_parts
from pounding._pictures.scene import Motion, Scene
from pounding._pictures.style import FORCE_UNITS, MM, YELLOW, engineering, largest, structure_colour
from pounding.results import Link, RunData, Structure

#: Colours of parts by their state at the end of the run: elastic, yielded, beyond ultimate.
STATES = {"elastic": "#ffffff", "yielded": "#E69F00", "beyond ultimate": "#B00020"}
WALL, GROUND, QUIET = "#404040", "#d9d9d9", "#8c8c8c"
#: Surfaces without highlights, which would make faces white.
PLAIN: dict[str, Any] = {
    "flatshading": True,
    "lighting": {"ambient": 0.85, "diffuse": 0.25, "specular": 0.0, "fresnel": 0.0},
}
#: Maximum number of nodes with a text each.
NAMED = 4000
#: Sizes of marks of links, without and with the largest force; plotly draws those of a list smaller than single ones.
SMALL, LARGE = 9.0, 24.0
#: Symbols of parts by kind.
SYMBOLS = {"hinge": "circle", "storey": "square", "isolator": "diamond", "device": "cross"}


@dataclass
class Points:
    """Points of a trace: positions at rest, and the nodes that they follow."""

    rest: list[np.ndarray] = field(default_factory=list)  #: [3] each; NaN interrupts a line
    structure: list[int] = field(default_factory=list)  #: -1 for a fixed point
    nodes: list[tuple[int, int]] = field(default_factory=list)
    share: list[float] = field(default_factory=list)  #: weight of the second node

    def add(self, point: np.ndarray, structure: int = -1, nodes: tuple[int, int] = (0, 0), share: float = 0.0) -> None:
        """Adds a point."""
        self.rest.append(point)
        self.structure.append(structure)
        self.nodes.append(nodes)
        self.share.append(share)

    def interrupt(self) -> None:
        """Ends a line."""
        self.add(np.full(3, np.nan))

    def packed(self) -> dict[str, str]:
        """The arrays for the page."""
        first, second = np.array(self.nodes, np.int32).reshape(-1, 2).T
        return {
            "rest": packed(np.array(self.rest, np.float32).reshape(-1, 3)),
            "structure": packed(np.array(self.structure, np.int32)),
            "first": packed(first),
            "second": packed(second),
            "share": packed(np.array(self.share, np.float32)),
        }


def packed(values: np.ndarray) -> str:
    """The bytes of an array, little endian, in base64."""
    plain = np.ascontiguousarray(values)
    return base64.b64encode(plain.astype(plain.dtype.newbyteorder("<")).tobytes()).decode()


@dataclass
class Trace:
    """A trace of plotly, without coordinates, and its points."""

    shown: dict[str, Any]
    points: Points
    role: str = ""  #: "impacts" for the marks that flash


def traces(scene: Scene) -> list[Trace]:
    """All traces of a scene at rest."""
    numbers = {name: i for i, name in enumerate(scene.run.structures)}
    found = [_ground(scene)]
    for name, structure in scene.run.structures.items():
        found += _structure(scene, structure, numbers[name])
    found += [_supports(scene), *_parts(scene, numbers), *_devices(scene, numbers), *_links(scene, numbers)]
    return [trace for trace in found if trace.points.rest]


def _ground(scene: Scene) -> Trace:
    (x0, x1), (y0, y1), (low, high) = scene.bounds()
    room = 0.08 * max(x1 - x0, y1 - y0, high - low)
    points = Points()
    for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)):
        away = np.array([-room if x == x0 else room, -room if y == y0 else room])
        points.add(np.array([x + (away[0] if x1 > x0 else 0), y + away[1], low]))
    # A plane of zero width has both corners at the same y.
    points.rest[0][1] = points.rest[1][1] = y0 - room
    points.rest[2][1] = points.rest[3][1] = y1 + room
    points.rest[0][0] = points.rest[3][0] = x0 - room
    points.rest[1][0] = points.rest[2][0] = x1 + room
    shown = {"type": "mesh3d", "i": [0, 0], "j": [1, 2], "k": [2, 3], "color": GROUND, "opacity": 0.5}
    return Trace({**shown, "hoverinfo": "skip", "name": "ground", "showlegend": False}, points)


def _structure(scene: Scene, structure: Structure, number: int) -> Iterator[Trace]:
    """Members as lines, masses of sticks as boxes."""
    name, model, rest = structure.name, scene.line_models[structure.name], scene.at_rest(structure.name)
    colour = WALL if structure.is_wall else structure_colour(number)
    geometry = structure.geometry
    names = geometry.node_names if geometry is not None else _level_names(structure, len(rest))
    points, texts = Points(), []
    for member, ends in enumerate(model.members):
        for node in ends:
            points.add(rest[node], number, (int(node), int(node)))
            texts.append(f"{name}, {names[node]}")
        points.interrupt()
        texts.append("")
    many = len(model.members) > 300
    width = 9 if structure.is_wall else 2 if many else 4 if geometry is not None else 6
    shown: dict[str, Any] = {"type": "scatter3d", "mode": "lines", "line": {"color": colour, "width": width}}
    shown |= {"name": name, "legendgroup": name, "hoverinfo": "text"}
    shown["text"] = texts if len(rest) <= NAMED else name
    yield Trace(shown, points)
    boxes, corners = Points(), []
    half = np.array([model.half_width, model.half_height, model.half_height])
    for node in model.masses:
        corners.append(len(boxes.rest))
        for sign in np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1], indexing="ij")).reshape(3, -1).T:
            boxes.add(rest[node] + sign * half, number, (int(node), int(node)))
    triangles = np.concatenate([np.array(BOX) + first for first in corners]) if corners else np.empty((0, 3), int)
    i, j, k = (triangles[:, side].tolist() for side in range(3))
    shown = {"type": "mesh3d", "i": i, "j": j, "k": k, "color": colour, **PLAIN}
    shown |= {"name": name, "legendgroup": name, "hoverinfo": "name", "showlegend": not len(model.members)}
    yield Trace(shown, boxes)


#: Triangles of a box with corners in the order x, y, z, each from low to high.
BOX = (
    *((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)),
    *((2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)),
)


def _level_names(structure: Structure, nodes: int) -> list[str]:
    floors = [f"floor {label}" for label in structure.floors]
    return ["base"] * (nodes - len(floors)) + floors


def _supports(scene: Scene) -> Trace:
    """Pyramids below the supported nodes of frames and the bases of sticks."""
    size = 0.02 * float(np.ptp(scene.bounds(), axis=1).max())
    points, triangles = Points(), []
    for name, structure in scene.run.structures.items():
        rest, model = scene.at_rest(name), scene.line_models[name]
        if structure.geometry is not None:
            held = structure.reactions.names if structure.reactions is not None else []
            tops = [rest[structure.geometry.node_names.index(one)] for one in held]
        else:
            tops = [rest[0]] if len(model.members) and not structure.is_wall else []
        for top in tops:
            first = len(points.rest)
            points.add(top)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                points.add(top + size * np.array([0.6 * x, 0.6 * y, -1.0]))
            triangles += [(first, first + 1 + i, first + 1 + (i + 1) % 4) for i in range(4)]
    i, j, k = (np.array(triangles, int).reshape(-1, 3)[:, side].tolist() for side in range(3))
    shown = {"type": "mesh3d", "i": i, "j": j, "k": k, "color": QUIET, **PLAIN, "name": "supports"}
    return Trace({**shown, "hoverinfo": "name", "showlegend": True}, points)


def _parts(scene: Scene, numbers: dict[str, int]) -> Iterator[Trace]:
    """Marks of hinges, yielding storeys and isolators, one trace per kind and state."""
    marks: dict[tuple[str, str], tuple[Points, list[str]]] = {}
    for structure, springs, i, ends in placed_parts(scene):
        kind = springs.kind(i)
        points, texts = marks.setdefault((kind, springs.states[i]), (Points(), []))
        _follow(points, scene, structure.name, numbers[structure.name], ends.mean(axis=0))
        texts.append(_part_text(structure, i))
    for kind, state in sorted(marks, key=lambda key: (list(SYMBOLS).index(key[0]), list(STATES).index(key[1]))):
        points, texts = marks[kind, state]
        marker: dict[str, Any] = {"symbol": SYMBOLS[kind], "size": 4 if state == "elastic" else 6}
        marker |= {"color": STATES[state], "line": {"color": "#333333", "width": 1}}
        shown = {"type": "scatter3d", "mode": "markers", "marker": marker, "text": texts, "hoverinfo": "text"}
        yield Trace({**shown, "name": f"{kind}s: {state}"}, points)


def _part_text(structure: Structure, i: int) -> str:
    """State and largest values of a part."""
    springs = structure.springs
    assert springs is not None
    lines = [f"{structure.name}, {springs.names[i]}", f"{springs.laws[i]}: {springs.states[i]}"]
    value = {key: float(values[i]) for key, values in springs.largest.items()}
    if structure.displacement.size:
        plastic = MM * value["peak_plastic"]
        lines.append(
            f"ductility {value['ductility']:.3g}, plastic {plastic:.3g} {'mrad' if springs.is_hinge(i) else 'mm'}"
        )
        if np.isfinite(value["first_yield"]):
            lines.append(f"first yield at {value['first_yield']:.2f} s")
    return "<br>".join(lines)


def _devices(scene: Scene, numbers: dict[str, int]) -> Iterator[Trace]:
    """Bars and dampers between structures as lines between their ends."""
    points, texts = Points(), []
    for device in scene.run.devices.values():
        ends = scene.device_ends(device)
        if not ends:
            continue
        parts = [f"bar {device.stiffness:.4g} N/m"] if device.stiffness else []
        parts += [f"damper {device.coefficient:.4g}, exponent {device.exponent:g}"] if device.coefficient else []
        text = f"{device.name}<br>{', '.join(parts)}"
        if device.force.size:
            size, unit = engineering(float(np.abs(device.largest["force"]).max()), FORCE_UNITS)
            text += f"<br>at most {np.abs(device.largest['force']).max() / size:.3g} {unit}"
        for name, end in zip((device.left, device.right), ends):
            _follow(points, scene, name, numbers[name], end)
            texts.append(text)
        points.interrupt()
        texts.append("")
    shown = {"type": "scatter3d", "mode": "lines+markers", "line": {"color": "#009E73", "width": 6}}
    marker = {"size": 3, "color": "#009E73", "symbol": SYMBOLS["device"]}
    yield Trace({**shown, "marker": marker, "text": texts, "hoverinfo": "text", "name": "devices"}, points)


def _links(scene: Scene, numbers: dict[str, int]) -> Iterator[Trace]:
    """The gaps as thin lines, and a mark per link with its impacts."""
    lines, marks, texts, sizes, colours = Points(), Points(), [], [], []
    force = {name: largest([scene.run.impacts_of(name)["peak_force"]]) for name in scene.run.links}
    # In a plane, marks are in front of lines, hinges and masses.
    depth = max(
        [0.01 * float(np.ptp(scene.bounds(), axis=1).max()), *(1.2 * m.half_height for m in scene.line_models.values())]
    )
    front = np.zeros(3) if scene.is_spatial else np.array([0, -depth, 0])
    strongest = max(force.values(), default=0.0)
    for link in scene.run.links.values():
        face = scene.faces[link.name]
        _follow(lines, scene, link.left, numbers[link.left], face)
        _follow(lines, scene, link.right, numbers[link.right], face + scene.scale * max(link.gap, 0.0) * link.direction)
        lines.interrupt()
        _follow(marks, scene, link.left, numbers[link.left], face)
        marks.rest[-1] = marks.rest[-1] + front
        texts.append(_link_text(scene.run, link))
        struck = len(scene.run.impacts_of(link.name)) > 0
        share = force[link.name] / strongest if strongest > 0 else 0.0
        sizes.append(SMALL + (LARGE - SMALL) * (0.3 + 0.7 * share) if struck else SMALL)
        colours.append(YELLOW if struck else "#ffffff")
    shown: dict[str, Any] = {"type": "scatter3d", "mode": "lines", "line": {"color": "#000000", "width": 2}}
    yield Trace({**shown, "hoverinfo": "skip", "showlegend": False, "name": "gaps"}, lines)
    marker = {"symbol": "diamond", "size": sizes, "color": colours, "line": {"color": "#000000", "width": 1}}
    shown = {"type": "scatter3d", "mode": "markers", "marker": marker, "text": texts, "hoverinfo": "text"}
    yield Trace({**shown, "name": "links"}, marks, "impacts")


def _link_text(run: RunData, link: Link) -> str:
    """Ends, gap and law of a link, and its impacts."""
    rows = run.impacts_of(link.name)
    ends = " and ".join(
        f"{name}, {end}" if end else name for name, end in ((link.left, link.left_end), (link.right, link.right_end))
    )
    lines = [f"<b>{link.name}</b>", ends, f"gap {MM * link.gap:.4g} mm, {link.law}"]
    if not len(rows):
        return "<br>".join([*lines, "no impact" if run.time.size else ""]).removesuffix("<br>")
    lines.append(f"{len(rows)} impact{'' if len(rows) == 1 else 's'}")
    if np.isfinite(rows["peak_force"]).any():
        worst = rows[int(np.nanargmax(rows["peak_force"]))]
        size, unit = engineering(float(worst["peak_force"]), FORCE_UNITS)
        lines.append(f"peak force {worst['peak_force'] / size:.4g} {unit} at {worst['t_peak']:.3f} s")
    return "<br>".join(lines)


def _follow(points: Points, scene: Scene, name: str, number: int, point: np.ndarray) -> None:
    """Adds a point that moves with the nearest point of a structure."""
    shares = nearest_on_members(scene.at_rest(name), scene.line_models[name].members, point)
    (first, _), (second, share) = (shares * 2)[:2] if len(shares) == 1 else shares
    points.add(point, number, (first, second), share if first != second else 0.0)


@dataclass
class Motions:
    """Displacements of all structures in the instants of a film, or in one mode."""

    step: list[float]  #: [structure] size of one unit [m], with the enlargement of the scene
    values: list[str]  #: [structure] packed 16-bit [instant, node, 3]

    @classmethod
    def of(cls, displacements: Sequence[np.ndarray], scale: float) -> Motions:
        """From displacements [instant, node, 3] of each structure [m]."""
        step, values = [], []
        for moved in displacements:
            largest = float(np.abs(moved).max(initial=0.0)) * scale
            unit = largest / 32767 if largest > 0 else 1.0
            step.append(unit)
            values.append(packed(np.round(scale * moved / unit).astype(np.int16)))
        return cls(step, values)


def film_motions(scene: Scene, times: np.ndarray) -> Motions:
    """The motion of a run at these times [s]."""
    motion = Motion(scene, times)
    return Motions.of([motion.displacements[name] for name in scene.run.structures], scene.scale)


def mode_motions(scene: Scene, shapes: dict[str, np.ndarray]) -> Motions:
    """One mode of each structure: `shapes` are displacements [node, 3], or [floor] along x of sticks, to any scale.

    All are drawn with the same fraction of the size of the structure."""
    moved = []
    for name in scene.run.structures:
        rest, model = scene.at_rest(name), scene.line_models[name]
        shape = np.zeros(rest.shape)
        if name in shapes and shapes[name].ndim == 2 and shapes[name].shape == rest.shape:
            shape = shapes[name]
        elif name in shapes and shapes[name].ndim == 1:
            shape[model.masses, 0] = shapes[name]
        largest, size = np.abs(shape).max(initial=0.0), float(np.ptp(rest, axis=0).max(initial=0.0))
        moved.append((DRAWN_SIZE * (size or model.half_width) / largest * shape if largest > 0 else shape)[None])
    return Motions.of(moved, 1.0)
