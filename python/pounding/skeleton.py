"""Where everything stands and goes: nodes and lines of every structure, for pictures, animations and exports.

A frame is its nodes and members. A structure without geometry becomes a stick with a mass at each floor, a body a mass
alone, a wall a line. Coordinates are x, y, z [m], z up.

Displacements are drawn larger than they are. So that two structures touch in the picture when they touch, `Scene` draws
the gaps between them larger by the same factor.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from pounding.results import Link, Run, Structure

#: Height of a storey [m] where the file has none.
UNKNOWN_STOREY = 3.0


@dataclass(frozen=True)
class Skeleton:
    """One structure at rest, at its own place or, without geometry, at x = 0."""

    name: str
    nodes: np.ndarray  #: [node, 3]
    members: np.ndarray  #: [member, 2]
    masses: np.ndarray  #: numbers of the nodes that are drawn as masses; none in a frame
    half_width: float  #: of a mass: the faces of a stick are this far from its axis [m]
    has_place: bool  #: its coordinates are those of the model
    has_heights: bool  #: its z are those of the model

    @property
    def half_height(self) -> float:
        """Of a mass [m]."""
        return 0.3 * self.half_width

    @property
    def height(self) -> float:
        """Of the highest node [m]."""
        return float(self.nodes[:, 2].max())


def skeleton(structure: Structure, tallest: float = 2 * UNKNOWN_STOREY) -> Skeleton:
    """The skeleton of a structure; `tallest` is the height of a wall, and of what must look well beside it [m]."""
    if structure.geometry is not None:
        return Skeleton(structure.name, structure.geometry.nodes, structure.geometry.members, np.empty(0, int), 0.0, True, True)
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
    return Skeleton(structure.name, np.array(nodes, float), np.array(members, int).reshape(-1, 2), np.array(masses, int),
                    half_width, False, known)


def floor_heights(structure: Structure) -> tuple[np.ndarray, bool]:
    """(heights of the floors [m], whether the file has them). Storeys are taken as equally high where it has not."""
    known = structure.elevations.size > 0 and bool(np.isfinite(structure.elevations).all())
    heights = structure.elevations if known else UNKNOWN_STOREY * np.arange(1, len(structure.floors) + 1)
    return np.asarray(heights, float), known


def node_displacements(structure: Structure, bones: Skeleton) -> np.ndarray:
    """[time, node, 3]: displacements of the nodes of the skeleton relative to the ground [m].

    Those in the file where it has them; the other nodes follow their floor as a plate that is rigid in its plane and
    turns about the mean of its nodes, and nodes between floors what lies between the floor above and the one below."""
    moved = _by_floors(structure, bones)
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
    """The structure with its displacements at `times` instead of `time`; its other histories stay behind."""
    along = {key: replace(motion, displacement=_at_times(time, motion.displacement, times))
             for key, motion in structure.along.items()}
    nodes = structure.nodes
    if nodes is not None:
        nodes = replace(nodes, displacement=_at_times(time, nodes.displacement, times))
    return replace(structure, along=along, nodes=nodes)


def _by_floors(structure: Structure, bones: Skeleton) -> np.ndarray:
    samples = len(structure.displacement)
    moved = np.zeros((samples, len(bones.nodes), 3))
    if not structure.floors:
        return moved
    floor_of_node = _floor_of_node(structure, bones)
    heights = np.array([bones.nodes[floor_of_node == i, 2].mean() if np.any(floor_of_node == i) else np.nan
                        for i in range(len(structure.floors))])
    if structure.geometry is not None:
        own, known = floor_heights(structure)
        heights = np.where(np.isnan(heights) & known, own, heights)
    held = bones.nodes[:, 2].min()
    for node, position in enumerate(bones.nodes):
        floor = floor_of_node[node]
        if floor >= 0:
            moved[:, node] = _plate(structure, bones, floor_of_node, floor, position)
        elif position[2] > held:
            moved[:, node] = _between(structure, bones, floor_of_node, heights, held, position)
    return moved


def _floor_of_node(structure: Structure, bones: Skeleton) -> np.ndarray:
    if structure.geometry is not None:
        return structure.geometry.floor_of_node
    floors = np.full(len(bones.nodes), -1)
    floors[bones.masses] = np.arange(len(bones.masses))
    return floors


def _plate(structure: Structure, bones: Skeleton, floor_of_node: np.ndarray, floor: int, position: np.ndarray) -> np.ndarray:
    """[time, 3] of a point that is fixed to a floor."""
    move = np.zeros((len(structure.displacement), 3))
    for j, axis in enumerate("xy"):
        if axis in structure.along:
            move[:, j] = structure.along[axis].displacement[:, floor]
    on_floor = floor_of_node == floor
    if "rz" in structure.along and np.any(on_floor):
        arm = position - bones.nodes[on_floor].mean(axis=0)
        turn = structure.along["rz"].displacement[:, floor]
        move[:, 0] -= turn * arm[1]
        move[:, 1] += turn * arm[0]
    return move


def _between(structure: Structure, bones: Skeleton, floor_of_node: np.ndarray, heights: np.ndarray, held: float,
             position: np.ndarray) -> np.ndarray:
    """[time, 3] of a point off the floors, in proportion to its height between the next floors; as the top above it."""
    order = [i for i in np.argsort(heights) if np.isfinite(heights[i])]
    below = [i for i in order if heights[i] <= position[2]]
    above = [i for i in order if heights[i] > position[2]]
    low = _plate(structure, bones, floor_of_node, below[-1], position) if below else np.zeros((len(structure.displacement), 3))
    if not above:
        return low
    z = heights[below[-1]] if below else held
    share = (position[2] - z) / (heights[above[0]] - z)
    return (1 - share) * low + share * _plate(structure, bones, floor_of_node, above[0], position)


class Scene:
    """All structures of a run beside each other, displacements and gaps drawn `scale` times as large.

    bones: name -> Skeleton; shifts: name -> [3], what is added to its nodes [m]; faces: link name -> [3], the point of
    the left structure where the link is, in the scene at rest [m]."""

    def __init__(self, run: Run, scale: float = 1.0) -> None:
        self.run, self.scale = run, scale
        heights = [skeleton(s).height for s in run.structures.values() if not s.is_wall]
        tallest = max(heights, default=UNKNOWN_STOREY)
        self.bones = {name: skeleton(structure, tallest) for name, structure in run.structures.items()}
        self.shifts = self._place()
        self.faces = {name: self._face(link) for name, link in run.links.items()}

    @property
    def is_spatial(self) -> bool:
        """Something has a width along y."""
        return any(np.ptp(bones.nodes[:, 1]) > 0 for bones in self.bones.values())

    @property
    def has_heights(self) -> bool:
        """Every structure but walls says how high its floors are."""
        return all(bones.has_heights for name, bones in self.bones.items() if not self.run.structures[name].is_wall)

    @property
    def has_places(self) -> bool:
        """Everything stands where the model has it; a wall stands where its links are."""
        return all(bones.has_place or self.run.structures[name].is_wall for name, bones in self.bones.items()) and any(
            bones.has_place for bones in self.bones.values())

    def at_rest(self, name: str) -> np.ndarray:
        """[node, 3] in the scene."""
        return self.bones[name].nodes + self.shifts[name]

    def bounds(self, margin: float | np.ndarray = 0.0) -> np.ndarray:
        """[3, 2]: least and largest x, y, z of everything at rest, masses included; `margin` is one or [3] more [m]."""
        corners = [self.at_rest(name) + side * np.array([bones.half_width, 0, bones.half_height])
                   for name, bones in self.bones.items() for side in (-1, 1)]
        points = np.concatenate(corners) if corners else np.zeros((1, 3))
        low, high = points.min(axis=0), points.max(axis=0)
        low[2] = max(low[2], min(self.at_rest(name)[:, 2].min() for name in self.bones)) if self.bones else 0
        return np.stack([low - margin, high + margin], axis=1)

    def _place(self) -> dict[str, np.ndarray]:
        shifts: dict[str, np.ndarray] = {}
        for name, bones in self.bones.items():
            if name in shifts:
                continue
            if not bones.has_place and any(b.has_place for b in self._linked(name)):
                continue  # from its neighbours, below
            shifts[name] = np.zeros(3) if bones.has_place or not shifts else self._beside(shifts, bones)
            self._place_neighbours(shifts)
        for name, bones in self.bones.items():
            if name not in shifts:
                shifts[name] = self._beside(shifts, bones)
        return shifts

    def _linked(self, name: str) -> list[Skeleton]:
        """Skeletons of all structures that links join to this one, over others as well."""
        found, queue = {name}, [name]
        while queue:
            here = queue.pop()
            for link in self.run.links.values():
                if here in (link.left, link.right):
                    for other in (link.left, link.right):
                        if other not in found:
                            found.add(other)
                            queue.append(other)
        return [self.bones[other] for other in found]

    def _place_neighbours(self, shifts: dict[str, np.ndarray]) -> None:
        for _ in self.bones:
            for link in self.run.links.values():
                if link.left in shifts and link.right not in shifts:
                    shifts[link.right] = shifts[link.left] + self._step(link)
                elif link.right in shifts and link.left not in shifts:
                    shifts[link.left] = shifts[link.right] - self._step(link)

    def _step(self, link: Link) -> np.ndarray:
        """Shift of the right structure minus that of the left one."""
        left, right = self.bones[link.left], self.bones[link.right]
        if left.has_place and right.has_place:
            return (self.scale - 1) * link.gap * link.direction
        apart = (self.scale * link.gap + left.half_width + right.half_width) * link.direction
        if (left.has_place or right.has_place) and link.position is not None:
            base = np.array([*link.position[:2], 0.0])
            return apart + base if left.has_place else apart - base
        return apart

    def _beside(self, shifts: dict[str, np.ndarray], bones: Skeleton) -> np.ndarray:
        """Shift to the right of all that is placed."""
        right = max((self.bones[name].nodes[:, 0].max() + self.bones[name].half_width + shift[0]
                     for name, shift in shifts.items()), default=0.0)
        return np.array([right + 0.3 * max(bones.height, UNKNOWN_STOREY) + bones.half_width - bones.nodes[:, 0].min(), 0, 0])

    def _face(self, link: Link) -> np.ndarray:
        left = self.bones[link.left]
        if left.has_place and link.position is not None:
            return link.position + self.shifts[link.left]
        if self.bones[link.right].has_place and link.position is not None:
            return link.position + self.shifts[link.right] - self.scale * link.gap * link.direction
        height = self._height(link)
        return np.array([left.half_width, 0, height]) + self.shifts[link.left]

    def _height(self, link: Link) -> float:
        """Of a link without a position: that of the floor that one of its ends names."""
        for name, floor in ((link.left, link.left_floor), (link.right, link.right_floor)):
            heights, _ = floor_heights(self.run.structures[name])
            if 0 < floor <= len(heights):
                return heights[floor - 1]
        return self.bones[link.left].height


class Motion:
    """Where the nodes of a scene are at chosen times."""

    def __init__(self, scene: Scene, times: np.ndarray) -> None:
        """`times` [s] need not be output times: what lies between is taken as linear."""
        run = scene.run
        self.scene, self.times = scene, np.asarray(times, float)
        #: name -> [time, node, 3], as large as in the file [m]
        self.displacements = {name: node_displacements(displaced_at(structure, run.time, self.times), scene.bones[name])
                              for name, structure in run.structures.items()}

    def nodes(self, name: str, frame: int) -> np.ndarray:
        """[node, 3] in the scene, displacements enlarged."""
        return self.scene.at_rest(name) + self.scene.scale * self.displacements[name][frame]

    def face(self, link: Link, frame: int) -> np.ndarray:
        """[3]: where a link is, moved with the nearest point of the structure on its left."""
        bones, moved = self.scene.bones[link.left], self.displacements[link.left][frame]
        point = self.scene.faces[link.name]
        shares = nearest_on_members(self.scene.at_rest(link.left), bones.members, point)
        return point + self.scene.scale * sum(share * moved[node] for node, share in shares)


def _at_times(time: np.ndarray, values: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Values [time, ...] at other times, linear between the samples and constant outside."""
    if not len(time):
        return np.zeros((len(times), *values.shape[1:]))
    after = np.clip(np.searchsorted(time, times), 1, max(len(time) - 1, 1)) if len(time) > 1 else np.zeros(len(times), int)
    before = np.maximum(after - 1, 0)
    span = np.where(after > before, time[after] - time[before], 1.0)
    share = np.clip((times - time[before]) / span, 0, 1).reshape(-1, *[1] * (values.ndim - 1))
    return (1 - share) * values[before] + share * values[after]


def nearest_on_members(nodes: np.ndarray, members: np.ndarray, point: np.ndarray) -> list[tuple[int, float]]:
    """[(node, share)] of the point of all members that is nearest to `point`; of a structure without members, its
    nearest node."""
    if not len(members):
        return [(int(np.argmin(np.linalg.norm(nodes - point, axis=1))), 1.0)]
    start, along = nodes[members[:, 0]], nodes[members[:, 1]] - nodes[members[:, 0]]
    length2 = np.maximum((along**2).sum(axis=1), 1e-30)
    share = np.clip(((point - start) * along).sum(axis=1) / length2, 0, 1)
    best = int(np.argmin(np.linalg.norm(start + share[:, None] * along - point, axis=1)))
    return [(int(members[best, 0]), 1 - share[best]), (int(members[best, 1]), share[best])]
