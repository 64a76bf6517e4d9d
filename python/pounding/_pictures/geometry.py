"""Line models of structures for pictures, animations and exports: nodes, members and their displacements.

A frame is drawn by its nodes and members. A structure without geometry is a stick with a mass at each floor, a body a
single mass, a wall a line. Coordinates are x, y, z [m], z up."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pounding.results import Structure

#: Default storey height [m].
UNKNOWN_STOREY = 3.0


@dataclass(frozen=True)
class LineModel:
    """A structure at rest, at its position in the model or, without geometry, at x = 0."""

    name: str
    nodes: np.ndarray  #: [node, 3]
    members: np.ndarray  #: [member, 2]
    masses: np.ndarray  #: indices of nodes drawn as masses; empty for a frame
    half_width: float  #: of a drawn mass: the distance of the faces of a stick from its axis [m]
    has_place: bool  #: True if coordinates are those of the model
    has_heights: bool  #: True if z is that of the model

    @property
    def half_height(self) -> float:
        """Half the height of a drawn mass [m]."""
        return 0.3 * self.half_width

    @property
    def height(self) -> float:
        """Height of the highest node [m]."""
        return float(self.nodes[:, 2].max())


def line_model(structure: Structure, tallest: float = 2 * UNKNOWN_STOREY) -> LineModel:
    """The line model of a structure. `tallest` [m] is the height of walls and sets the width of masses."""
    if structure.geometry is not None:
        return LineModel(
            structure.name, structure.geometry.nodes, structure.geometry.members, np.empty(0, int), 0.0, True, True
        )
    heights, known = floor_heights(structure)
    half_width = 0.35 * float(np.min(np.diff(heights, prepend=0), initial=0.5 * tallest))
    if half_width <= 0:
        half_width = 0.1 * tallest
    if structure.is_wall:
        nodes, members, masses = [[0, 0, 0], [0, 0, tallest]], [[0, 1]], range(0)
        half_width = 0.0
    elif structure.kind == "body":
        nodes, members, masses = [[0, 0, height] for height in heights], [], range(len(heights))
    else:
        nodes = [[0, 0, 0], *([0, 0, height] for height in heights)]
        members = [[i, i + 1] for i in range(len(heights))]
        masses = range(1, len(nodes))
    return LineModel(
        structure.name,
        np.array(nodes, float),
        np.array(members, int).reshape(-1, 2),
        np.array(masses, int),
        half_width,
        False,
        known,
    )


def floor_heights(structure: Structure) -> tuple[np.ndarray, bool]:
    """(heights of the floors [m], True if they are in the file). Unknown storeys are equally high."""
    known = structure.elevations.size > 0 and bool(np.isfinite(structure.elevations).all())
    heights = structure.elevations if known else UNKNOWN_STOREY * np.arange(1, len(structure.floors) + 1)
    return np.asarray(heights, float), known


def levels(structure: Structure) -> np.ndarray:
    """[floor + 1] heights of the ground and of the floors [m]; the ground is at the lowest node, or at zero."""
    heights, _ = floor_heights(structure)
    ground = structure.geometry.nodes[:, 2].min() if structure.geometry is not None else min(0.0, heights[0])
    return np.array([ground, *heights])


def outline(points: np.ndarray) -> np.ndarray:
    """[corner, 2]: the convex outline of points [n, 2] counter-clockwise."""
    ordered = sorted(set(map(tuple, np.round(points, 6))))
    if len(ordered) < 3:
        return np.array(ordered)

    def half(way: list[tuple[float, ...]]) -> list[tuple[float, ...]]:
        kept: list[tuple[float, ...]] = []
        for x, y in way:
            while len(kept) > 1 and (kept[-1][0] - kept[-2][0]) * (y - kept[-2][1]) <= (kept[-1][1] - kept[-2][1]) * (
                x - kept[-2][0]
            ):
                kept.pop()
            kept.append((x, y))
        return kept[:-1]

    return np.array(half(ordered) + half(ordered[::-1]))


def node_displacements(structure: Structure, model: LineModel) -> np.ndarray:
    """[time, node, 3] displacements of the nodes of the line model relative to the ground [m].

    Reported nodes have their own histories. Other nodes of a floor follow it as a plate that is rigid in its plane and
    rotates about its reference point; nodes between two floors are interpolated over the height."""
    moved = _by_floors(structure, model)
    reported = structure.nodes
    if reported is None or structure.geometry is None:
        return moved
    numbers = {name: i for i, name in enumerate(structure.geometry.node_names)}
    for i, name in enumerate(reported.names):
        for j, axis in enumerate("xyz"):
            if axis in reported.directions:
                moved[:, numbers[name], j] = reported.displacement[:, i, reported.directions.index(axis)]
    return moved


def displaced_at(structure: Structure, time: np.ndarray, times: np.ndarray) -> Structure:
    """The structure with displacements at `times` instead of `time`, without its other histories."""
    along = {
        key: replace(motion, displacement=_at_times(time, motion.displacement, times))
        for key, motion in structure.along.items()
    }
    nodes = structure.nodes
    if nodes is not None:
        nodes = replace(nodes, displacement=_at_times(time, nodes.displacement, times))
    return replace(structure, along=along, nodes=nodes)


def _by_floors(structure: Structure, model: LineModel) -> np.ndarray:
    samples = len(structure.displacement)
    moved = np.zeros((samples, len(model.nodes), 3))
    if not structure.floors:
        return moved
    if structure.geometry is not None:
        floor_of_node = structure.geometry.floor_of_node
    else:
        floor_of_node = np.full(len(model.nodes), -1)
        floor_of_node[model.masses] = np.arange(len(model.masses))
    on_floors = [model.nodes[floor_of_node == floor] for floor in range(len(structure.floors))]
    heights = np.array([nodes[:, 2].mean() if len(nodes) else np.nan for nodes in on_floors])
    if structure.geometry is not None:
        own, known = floor_heights(structure)
        heights = np.where(np.isnan(heights) & known, own, heights)
    order = [i for i in np.argsort(heights) if np.isfinite(heights[i])]
    held = model.nodes[:, 2].min()

    def plate(floor: int, position: np.ndarray) -> np.ndarray:
        nodes = on_floors[floor]
        return on_plate(structure, floor, position[:2] - _centre(structure, nodes, floor) if len(nodes) else None)

    for node, position in enumerate(model.nodes):
        below = [i for i in order if heights[i] <= position[2]]
        above = [i for i in order if heights[i] > position[2]]
        if floor_of_node[node] >= 0:
            moved[:, node] = plate(floor_of_node[node], position)
        elif position[2] > held:
            # Between floors, interpolated over the height; above the roof, the motion of the roof.
            moved[:, node] = plate(below[-1], position) if below else 0.0
            if above:
                z = heights[below[-1]] if below else held
                share = (position[2] - z) / (heights[above[0]] - z)
                moved[:, node] = (1 - share) * moved[:, node] + share * plate(above[0], position)
    return moved


def on_plate(structure: Structure, floor: int, arm: np.ndarray | None) -> np.ndarray:
    """[time, 3] displacement of a point fixed to a floor, at `arm` (x, y) from its reference point; None if unknown."""
    move = np.zeros((len(structure.displacement), 3))
    for j, axis in enumerate("xy"):
        if axis in structure.along:
            move[:, j] = structure.along[axis].displacement[:, floor]
    if "rz" in structure.along and arm is not None:
        move[:, :2] += structure.along["rz"].displacement[:, floor, None] * [-arm[1], arm[0]]
    return move


def _centre(structure: Structure, on_floor: np.ndarray, floor: int) -> np.ndarray:
    """[2] reference point of a floor; the mean of its nodes if the file has no plan of it."""
    if structure.plan is None or structure.geometry is None or np.isnan(structure.plan[floor]).any():
        return on_floor[:, :2].mean(axis=0)
    return structure.centre(floor)


def _at_times(time: np.ndarray, values: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Values [time, ...] at other times, linear between the samples and constant outside."""
    if not len(time):
        return np.zeros((len(times), *values.shape[1:]))
    after = (
        np.clip(np.searchsorted(time, times), 1, max(len(time) - 1, 1)) if len(time) > 1 else np.zeros(len(times), int)
    )
    before = np.maximum(after - 1, 0)
    span = np.where(after > before, time[after] - time[before], 1.0)
    share = np.clip((times - time[before]) / span, 0, 1).reshape(-1, *[1] * (values.ndim - 1))
    return (1 - share) * values[before] + share * values[after]


def nearest_on_members(nodes: np.ndarray, members: np.ndarray, point: np.ndarray) -> list[tuple[int, float]]:
    """[(node, weight)] of the nearest point on all members to `point`; the nearest node without members."""
    if not len(members):
        return [(int(np.argmin(np.linalg.norm(nodes - point, axis=1))), 1.0)]
    start, along = nodes[members[:, 0]], nodes[members[:, 1]] - nodes[members[:, 0]]
    length2 = np.maximum((along**2).sum(axis=1), 1e-30)
    share = np.clip(((point - start) * along).sum(axis=1) / length2, 0, 1)
    best = int(np.argmin(np.linalg.norm(start + share[:, None] * along - point, axis=1)))
    return [(int(members[best, 0]), 1 - share[best]), (int(members[best, 1]), share[best])]
