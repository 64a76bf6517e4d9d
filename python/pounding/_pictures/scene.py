"""All structures of a run next to each other, at rest and in motion.

Displacements are enlarged. `Scene` enlarges the gaps by the same factor, so that structures that touch in the run
touch in the picture."""

from __future__ import annotations

import numpy as np

from pounding._pictures.geometry import (
    UNKNOWN_STOREY,
    LineModel,
    displaced_at,
    floor_heights,
    line_model,
    nearest_on_members,
    node_displacements,
)
from pounding._springs import Device
from pounding.results import Link, RunData


class Scene:
    """All structures of a run next to each other, with displacements and gaps enlarged `scale` times.

    line_models: name -> LineModel; shifts: name -> [3], added to its nodes [m]; faces: link name -> [3], position of
    the link on the left structure, in the scene at rest [m]."""

    def __init__(self, run: RunData, scale: float = 1.0) -> None:
        self.run, self.scale = run, scale
        heights = [line_model(s).height for s in run.structures.values() if not s.is_wall]
        tallest = max(heights, default=UNKNOWN_STOREY)
        self.line_models = {name: line_model(structure, tallest) for name, structure in run.structures.items()}
        self.shifts = self._place()
        self.faces = {name: self._face(link) for name, link in run.links.items()}

    @property
    def is_spatial(self) -> bool:
        """True if a structure extends along y."""
        return any(np.ptp(model.nodes[:, 1]) > 0 for model in self.line_models.values())

    @property
    def has_heights(self) -> bool:
        """True if the heights of all floors are known, or follow from links (walls, and bodies next to frames)."""
        beside_frames = any(model.has_place for model in self.line_models.values())
        return all(
            model.has_heights or self.run.structures[name].is_wall or beside_frames and not len(model.members)
            for name, model in self.line_models.items()
        )

    @property
    def has_places(self) -> bool:
        """True if all structures have positions in the model; walls have those of their links."""
        return all(
            model.has_place or self.run.structures[name].is_wall for name, model in self.line_models.items()
        ) and any(model.has_place for model in self.line_models.values())

    def at_rest(self, name: str) -> np.ndarray:
        """[node, 3] in the scene."""
        return self.line_models[name].nodes + self.shifts[name]

    def device_ends(self, device: Device) -> list[np.ndarray]:
        """The two ends of a device at rest; an end on a wall is level with the other one. Empty if both are unknown."""
        left, right = self._device_end(device.left, device.left_end), self._device_end(device.right, device.right_end)
        if left is None and right is None:
            return []
        return [self._level_with(device.left, right, left), self._level_with(device.right, left, right)]

    def _device_end(self, name: str, label: str) -> np.ndarray | None:
        """Position of an end such as "node b" or "floor 3"; None for the end on a wall."""
        structure, rest = self.run.structures[name], self.at_rest(name)
        kind, _, place = label.partition(" ")
        if kind == "node" and structure.geometry is not None:
            return np.array(rest[structure.geometry.node_names.index(place)])
        if kind == "floor" and place in structure.floors:
            floor = structure.floors.index(place)
            if structure.geometry is None:
                return np.array(rest[self.line_models[name].masses[floor]])
            on_floor = structure.geometry.floor_of_node == floor
            return np.array(rest[on_floor].mean(axis=0)) if on_floor.any() else None
        return None

    def _level_with(self, name: str, other: np.ndarray | None, known: np.ndarray | None) -> np.ndarray:
        base = self.at_rest(name)[0]
        return known if known is not None else base if other is None else np.array([*base[:2], other[2]])

    def bounds(self, margin: float | np.ndarray = 0.0) -> np.ndarray:
        """[3, 2] bounds along x, y, z of everything at rest, including masses; `margin` is one or [3] distances added
        [m]."""
        corners = [
            self.at_rest(name) + side * np.array([model.half_width, 0, model.half_height])
            for name, model in self.line_models.items()
            for side in (-1, 1)
        ]
        points = np.concatenate(corners) if corners else np.zeros((1, 3))
        low, high = points.min(axis=0), points.max(axis=0)
        low[2] = (
            max(low[2], min(self.at_rest(name)[:, 2].min() for name in self.line_models)) if self.line_models else 0
        )
        return np.stack([low - margin, high + margin], axis=1)

    def _place(self) -> dict[str, np.ndarray]:
        shifts: dict[str, np.ndarray] = {}
        for name, model in self.line_models.items():
            if name in shifts:
                continue
            if not model.has_place and any(b.has_place for b in self._linked(name)):
                continue  # from its neighbours, below
            shifts[name] = np.zeros(3) if model.has_place or not shifts else self._beside(shifts, model)
            self._place_neighbours(shifts)
        for name, model in self.line_models.items():
            if name not in shifts:
                shifts[name] = self._beside(shifts, model)
        return shifts

    def _linked(self, name: str) -> list[LineModel]:
        """Line models of all structures connected to this one by links, directly or indirectly."""
        found, queue = {name}, [name]
        while queue:
            here = queue.pop()
            for link in self.run.links.values():
                if here in (link.left, link.right):
                    for other in (link.left, link.right):
                        if other not in found:
                            found.add(other)
                            queue.append(other)
        return [self.line_models[other] for other in found]

    def _place_neighbours(self, shifts: dict[str, np.ndarray]) -> None:
        for _ in self.line_models:
            for link in self.run.links.values():
                if link.left in shifts and link.right not in shifts:
                    shifts[link.right] = shifts[link.left] + self._step(link)
                elif link.right in shifts and link.left not in shifts:
                    shifts[link.left] = shifts[link.right] - self._step(link)

    def _step(self, link: Link) -> np.ndarray:
        """Shift of the right structure minus that of the left one."""
        left, right = self.line_models[link.left], self.line_models[link.right]
        if left.has_place and right.has_place:
            return (self.scale - 1) * link.gap * link.direction
        apart = (self.scale * link.gap + left.half_width + right.half_width) * link.direction
        if (left.has_place or right.has_place) and link.position is not None:
            stick = right if left.has_place else left
            # A body without a height is drawn at the height of its link.
            lift = 0.0 if len(stick.members) or stick.has_heights else link.position[2] - stick.nodes[0, 2]
            base = np.array([*link.position[:2], lift])
            return apart + base if left.has_place else apart - base
        return apart

    def _beside(self, shifts: dict[str, np.ndarray], model: LineModel) -> np.ndarray:
        """Shift to the right of all placed structures."""
        right = max(
            (
                self.line_models[name].nodes[:, 0].max() + self.line_models[name].half_width + shift[0]
                for name, shift in shifts.items()
            ),
            default=0.0,
        )
        return np.array(
            [right + 0.3 * max(model.height, UNKNOWN_STOREY) + model.half_width - model.nodes[:, 0].min(), 0, 0]
        )

    def _face(self, link: Link) -> np.ndarray:
        left = self.line_models[link.left]
        if left.has_place and link.position is not None:
            return link.position + self.shifts[link.left]
        if self.line_models[link.right].has_place and link.position is not None:
            return link.position + self.shifts[link.right] - self.scale * link.gap * link.direction
        height = self._height(link)
        return np.array([left.half_width, 0, height]) + self.shifts[link.left]

    def _height(self, link: Link) -> float:
        """Height of a link without a position: that of the floor at one of its ends [m]."""
        for name, floor in ((link.left, link.left_floor), (link.right, link.right_floor)):
            heights, _ = floor_heights(self.run.structures[name])
            if 0 < floor <= len(heights):
                return heights[floor - 1]
        return self.line_models[link.left].height


class Motion:
    """Positions of the nodes of a scene at chosen times."""

    def __init__(self, scene: Scene, times: np.ndarray) -> None:
        """Displacements at `times` [s] are interpolated linearly between output times."""
        run = scene.run
        self.scene, self.times = scene, np.asarray(times, float)
        #: name -> [time, node, 3], as large as in the file [m]
        self.displacements = {
            name: node_displacements(displaced_at(structure, run.time, self.times), scene.line_models[name])
            for name, structure in run.structures.items()
        }

    def nodes(self, name: str, frame: int) -> np.ndarray:
        """[node, 3] in the scene, displacements enlarged."""
        return self.scene.at_rest(name) + self.scene.scale * self.displacements[name][frame]

    def face(self, link: Link, frame: int) -> np.ndarray:
        """[3] position of a link, moving with the nearest point of its left structure."""
        model, moved = self.scene.line_models[link.left], self.displacements[link.left][frame]
        point = self.scene.faces[link.name]
        shares = nearest_on_members(self.scene.at_rest(link.left), model.members, point)
        return point + self.scene.scale * sum(share * moved[node] for node, share in shares)
