"""Neighbouring structures of a model: floors, masses and gaps, from the resolved model."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from pounding._native import core

#: Maximum difference of floors at equal elevations [m].
SAME_ELEVATION = 0.05


@dataclass(frozen=True)
class Building:
    """A structure of a model."""

    name: str
    masses: tuple[float, ...]  #: of the floors [kg]; empty without floors
    elevations: tuple[float, ...]  #: of the floors [m]; empty if unknown
    rigid: bool = False  #: moves with the ground, as a wall does

    @property
    def height(self) -> float | None:
        """Elevation of the highest floor [m]; None if unknown."""
        return max(self.elevations) if self.elevations else None

    @property
    def storeys(self) -> int | None:
        """Number of floors; None without floors."""
        return len(self.masses) or None


@dataclass(frozen=True)
class End:
    """An end of a link."""

    structure: str
    floor: int | None = None  #: index of the floor; None between floors, at other nodes and at walls
    elevation: float | None = None  #: [m]; None if unknown

    @property
    def between_floors(self) -> bool:
        """True for a point of a column."""
        return self.floor is None and self.elevation is not None


@dataclass(frozen=True)
class Facing:
    """A link."""

    name: str
    left: End
    right: End
    gap: float  #: [m]

    @property
    def elevation(self) -> float | None:
        """Elevation of the link [m], that of the higher end; None if unknown."""
        return max((end.elevation for end in (self.left, self.right) if end.elevation is not None), default=None)


@dataclass(frozen=True)
class Neighbours:
    """Two structures that links connect."""

    left: Building
    right: Building
    links: tuple[Facing, ...]

    @property
    def gap(self) -> float:
        """The smallest gap of the links [m]."""
        return min(link.gap for link in self.links)

    @property
    def lower_height(self) -> float | None:
        """Height of the lower structure [m], walls excluded; None if unknown."""
        heights = [one.height for one in (self.left, self.right) if not one.rigid]
        return min((height for height in heights if height is not None), default=None) if None not in heights else None

    @property
    def offset(self) -> float | None:
        """Largest distance of a floor from the nearest floor of the neighbour, up to the top of the lower structure
        [m]; None if elevations are unknown."""
        top = self.lower_height
        if top is None or self.left.rigid or self.right.rigid:
            return None
        pairs = ((self.left, self.right), (self.right, self.left))
        return max(
            min(abs(level - other) for other in neighbour.elevations)
            for one, neighbour in pairs
            for level in one.elevations
            if level <= top + SAME_ELEVATION
        )

    @property
    def hits_columns(self) -> bool:
        """True if a floor meets the other structure between its floors."""
        ends = [(link.left, link.right) for link in self.links] + [(link.right, link.left) for link in self.links]
        return any(one.floor is not None and other.between_floors for one, other in ends)


@dataclass(frozen=True)
class Site:
    """Structures of a model and the pairs that its links connect."""

    buildings: Mapping[str, Building]
    links: tuple[Facing, ...]
    pairs: tuple[Neighbours, ...]
    #: pair -> axis along which the structures are neighbours, x or y
    axes: Mapping[tuple[str, str], str] = field(default_factory=dict)


def read_site(source: core.Source) -> Site:
    """The site of the text of a model. Raises InputError."""
    parts = core.parse(core.Source(core.check(source)[1], "resolved"))
    buildings = {str(name): _building(str(name), one) for name, one in parts["structures"].items()}
    links = [_facing(one, buildings) for one in parts.get("links") or ()]
    grouped: dict[tuple[str, str], list[Facing]] = {}
    for link in links:
        key = link.left.structure, link.right.structure
        grouped.setdefault(key if key[::-1] not in grouped else key[::-1], []).append(link)
    pairs = tuple(Neighbours(buildings[a], buildings[b], tuple(ones)) for (a, b), ones in grouped.items())
    return Site(buildings, tuple(links), pairs, _axes(source, pairs))


def _numbers(value: Any) -> list[float]:
    return [float(one) for one in (value if isinstance(value, Sequence) and not isinstance(value, str) else [value])]


def _building(name: str, one: Mapping[str, Any]) -> Building:
    if not {"mass", "floor_mass"} & set(one):
        return Building(name, (), (), True)
    masses = _numbers(one["floor_mass"] if "floor_mass" in one else one.get("mass", ()))
    if "height" in one:
        elevations = list(itertools.accumulate(_numbers(one["height"])))
    else:
        elevations = _numbers(one.get("floor_elevation", ()))
    known = any(level > 0 for level in elevations)
    return Building(name, tuple(masses), tuple(elevations) if known else ())


def _facing(one: Mapping[str, Any], buildings: Mapping[str, Building]) -> Facing:
    left, right = (_end(str(text), buildings) for text in one["between"])
    return Facing(str(one["name"]), left, right, float(one["gap"]))


def _end(text: str, buildings: Mapping[str, Building]) -> End:
    """An end as the resolved model writes it: `left.3`, `left, 10.5 m up`, `left, node b` or `wall`."""
    if text in buildings:
        return End(text)
    name = max((name for name in buildings if text.startswith((f"{name}.", f"{name}, "))), key=len)
    rest = text[len(name) :]
    building = buildings[name]
    if rest.startswith("."):
        floor = int(rest[1:]) - 1
        return End(name, floor, building.elevations[floor] if building.elevations else None)
    up = re.fullmatch(r", (\S+) m up", rest)
    return End(name, None, float(up[1]) if up else None)


def _axes(source: core.Source, pairs: Sequence[Neighbours]) -> dict[tuple[str, str], str]:
    """Axis of each pair, from the extents of the frames: that along which they are farther apart; x without
    geometry."""
    if len(pairs) < 2:
        return {(pair.left.name, pair.right.name): "x" for pair in pairs}
    extents = {}
    for structure in core.modes(source, 1):
        if nodes := list(structure.nodes):
            extents[structure.name] = [(min(node[i] for node in nodes), max(node[i] for node in nodes)) for i in (0, 1)]
    axes = {}
    for pair in pairs:
        ends = [extents.get(one.name) for one in (pair.left, pair.right)]
        apart = [-math.inf, -math.inf]
        if ends[0] is not None and ends[1] is not None:
            apart = [max(b[0] - a[1], a[0] - b[1]) for a, b in zip(ends[0], ends[1])]
        axes[pair.left.name, pair.right.name] = "y" if apart[1] > apart[0] else "x"
    return axes
