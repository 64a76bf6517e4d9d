"""Panels of displacements along one direction, offset by the gaps, and of the rotations of floors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from pounding._pictures.geometry import levels
from pounding._pictures.panels import NO_LINK, legend_beside, plot_time, time_unit
from pounding._pictures.style import MM, STRUCTURE_COLOURS, BadRequest, structure_colour
from pounding.results import Link, RunData, Structure

#: Maximum number of displacements in one panel.
MAX_STRUCTURES = len(STRUCTURE_COLOURS)
#: Line of a structure that no link along the panel's direction joins to another: its distance to others is meaningless.
APART: dict[str, Any] = {"linewidth": 0.6, "alpha": 0.8}
#: Place on a structure: the number of a floor, from 1, or the end of a link such as "node b" and "10.5 m up".
Place = int | str


@dataclass(frozen=True)
class _View:
    """Structures of a run along one direction."""

    direction: np.ndarray  #: horizontal, unit
    drawn: list[Structure]
    colours: dict[str, str]
    places: dict[str, Place]
    facing: list[Link]  #: links along the direction that join two of these places
    offsets: dict[str, float]  #: of each structure at rest [m]
    apart: set[str]  #: structures without such a link, if others have one


def directions_of(run: RunData) -> list[np.ndarray]:
    """Directions with a panel each: x; in space x, y and those of oblique links."""
    if not is_spatial(run):
        return [np.array([1.0, 0, 0])]
    found = [np.array([1.0, 0, 0]), np.array([0, 1.0, 0])]
    for link in run.links.values():
        if np.hypot(*link.direction[:2]) > 1e-9 and not any(_sign(link, known) for known in found):
            found.append(np.sign(link.direction[np.flatnonzero(np.abs(link.direction[:2]) > 1e-9)[0]]) * link.direction)
    return found


def is_spatial(run: RunData) -> bool:
    """True if a structure moves in space."""
    return any(structure.dimension == 3 for structure in run.structures.values())


def draw_displacements(
    axes: Axes, run: RunData, chosen: dict[str, int] | None = None, direction: np.ndarray | None = None
) -> None:
    """Displacements of up to six structures at their highest links, each offset by the gap to its left neighbour, so
    that two lines meet when the structures touch.

    A roof above the links is drawn thin. `chosen` maps names of structures to indices of floors, from 0, to draw
    instead; structures with a chosen floor come first. The gap between two lines is shaded if a link joins the floors
    drawn. The end of a link between floors follows from the floor at its other end and the opening of the link.

    `direction` is one of directions_of(), by default that of the first link. Links along other directions are not part
    of the panel; structures joined by such links only are drawn thin, about zero. In space, displacements are those of
    the centres of floors; the corners of rotating floors may touch before the lines meet."""
    chosen = chosen or {}
    view = _view(run, chosen, _direction(run) if direction is None else direction)
    moved = _displacements(run, view)
    sides = {name: MM * (view.offsets[name] + moved[name]) for name in view.places}
    axis = _axis_words(view.direction)
    draw = partial(plot_time, axes, run, run.time)
    for structure in view.drawn:
        name, top = structure.name, len(structure.floors)
        place, colour = view.places[name], view.colours[name]
        if name in view.apart:
            draw(sides[name], color=colour, label=f"{_label(structure, place)}{NO_LINK} {axis})", **APART)
            continue
        axes.axhline(MM * view.offsets[name], color=colour, linewidth=0.5, linestyle=(0, (4, 4)))
        draw(sides[name], color=colour, label=_label(structure, place))
        if place != top and top and name not in chosen:
            roof = MM * (view.offsets[name] + _of_floor(run, name, top, view.direction))
            draw(roof, color=colour, linewidth=0.5, alpha=0.7, label=f"{name}, top")
    sizes = ", ".join(f"{MM * link.gap:.4g}" for link in view.facing)
    for i, link in enumerate(view.facing):
        left, right = (sides[name] for name in _ordered(link, view.direction))
        axes.fill_between(
            run.time / time_unit(run)[0],
            left,
            right,
            where=right >= left,
            color="0.55",
            alpha=0.22,
            linewidth=0,
            label=f"gap, {sizes} mm at rest" if i == 0 else None,
        )
    more = len(run.structures) - len(view.drawn)
    title = "Displacements" if not more else f"Displacements of {len(view.drawn)} of {len(run.structures)}"
    axes.set_title(f"{title} along {axis}" if is_spatial(run) else title)
    axes.set_ylabel("Displacement\n[mm]")
    legend_beside(axes)


def drawn_displacements(
    run: RunData, other: RunData, chosen: dict[str, int] | None = None, direction: np.ndarray | None = None
) -> list[tuple[np.ndarray, str]]:
    """Displacements [mm] in another run of the structures of draw_displacements, with the same positions and colours.

    Links give the motion between floors in the run; in the other run it is interpolated over the height."""
    view = _view(run, chosen or {}, _direction(run) if direction is None else direction)
    return [
        (MM * (view.offsets[name] + _at_place(run, other, name, view)), view.colours[name])
        for name in (structure.name for structure in view.drawn)
    ]


def draw_rotations(axes: Axes, run: RunData) -> None:
    """Rotation of the highest rigid floor of each structure in space."""
    for rotation, colour, label in drawn_rotations(run, run):
        plot_time(axes, run, run.time, rotation, color=colour, label=label)
    axes.set_title("Rotation of floors about z")
    axes.set_ylabel("Rotation\n[mrad]")
    legend_beside(axes)


def drawn_rotations(run: RunData, other: RunData) -> Iterator[tuple[np.ndarray, str, str]]:
    """Rotations [mrad] in another run of the floors of draw_rotations, with their colours and labels."""
    for name in turning(run):
        rotation, floors = other.structures[name].rotation, run.structures[name].floors
        assert rotation is not None
        highest = int(np.flatnonzero(np.isfinite(rotation).all(axis=0))[-1])
        yield (
            MM * rotation[:, highest],
            structure_colour(list(run.structures).index(name)),
            f"{name}, floor {floors[highest]}",
        )


def turning(run: RunData) -> list[str]:
    """Names of the structures with rigid floors in space, at most MAX_STRUCTURES."""
    return [name for name, structure in run.structures.items() if structure.rotation is not None][:MAX_STRUCTURES]


def _view(run: RunData, chosen: dict[str, int], direction: np.ndarray) -> _View:
    along = [link for link in run.links.values() if _sign(link, direction)]
    linked = {name for link in along for name in (link.left, link.right)}
    moving = [
        structure
        for structure in run.structures.values()
        if structure.name in linked
        or any(
            abs(factor) > 1e-9 and axis in structure.along and structure.floors for axis, factor in zip("xy", direction)
        )
    ]
    # Structures with a chosen floor come first, then those that links along the direction join.
    drawn = sorted(moving, key=lambda structure: (structure.name not in chosen, structure.name not in linked))[
        :MAX_STRUCTURES
    ]
    drawn = [structure for structure in moving if any(structure is one for one in drawn)]
    names = [structure.name for structure in drawn]
    places, facing = _places(run, names, {name: floor + 1 for name, floor in chosen.items()}, along)
    numbers = {name: number for number, name in enumerate(run.structures)}
    few = len(run.structures) <= MAX_STRUCTURES
    colours = {name: structure_colour(numbers[name] if few else i) for i, name in enumerate(names)}
    offsets, apart = _offsets(along, names, direction), set(names) - linked if linked else set()
    return _View(direction, drawn, colours, places, facing, offsets, apart)


def chosen_floors(run: RunData, labels: dict[str, str]) -> dict[str, int]:
    """Indices of the floors, from 0, by structure."""
    chosen = {}
    for name, label in labels.items():
        if name not in run.structures:
            raise BadRequest(f"unknown structure {name}; known: {', '.join(run.structures)}")
        floors = run.structures[name].floors
        if label not in floors:
            raise BadRequest(f"{name} has no floor {label}; it has {', '.join(floors) or 'none'}")
        chosen[name] = floors.index(label)
    return chosen


def _places(
    run: RunData, names: list[str], chosen: dict[str, Place], along: list[Link]
) -> tuple[dict[str, Place], list[Link]]:
    """Floor or link end at which each structure is drawn, and the links between them: for each pair of neighbours the
    highest link of `along` compatible with earlier choices. A structure without such a link is drawn at its roof; a
    wall has 0."""
    places: dict[str, Place] = {name: 0 for name in names if run.structures[name].is_wall}
    places.update({name: place for name, place in chosen.items() if name in names})
    facing: list[Link] = []
    pairs: dict[tuple[str, str], list[Link]] = {}
    for link in along:
        if link.left in names and link.right in names:
            pairs.setdefault((link.left, link.right), []).append(link)
    for links in pairs.values():
        # The motion of one end follows from that of the other, which must be a floor.
        fitting = [
            link
            for link in links
            if any(_is_known(run, *end) for end in _ends(run, link))
            and all(places.get(name, place) == place for name, place in _ends(run, link))
        ]
        if fitting:
            facing.append(max(fitting, key=lambda link: _height(run, link)))
            places.update(_ends(run, facing[-1]))
    return {name: places.get(name, len(run.structures[name].floors)) for name in names}, facing


def _ends(run: RunData, link: Link) -> list[tuple[str, Place]]:
    ends = ((link.left, link.left_floor or link.left_end or 0), (link.right, link.right_floor or link.right_end or 0))
    return [(name, 0 if run.structures[name].is_wall else place) for name, place in ends]


def _is_known(run: RunData, name: str, place: Place) -> bool:
    """True if the file has the motion of this floor or wall."""
    return isinstance(place, int) and (place > 0 or run.structures[name].is_wall)


def _height(run: RunData, link: Link) -> float:
    """Height of a link [m]; without one, the number of its floor."""
    has_place = any(run.structures[name].geometry is not None for name in (link.left, link.right))
    if has_place and link.position is not None:
        return float(link.position[2])
    for name, place in _ends(run, link):
        elevations = run.structures[name].elevations
        if isinstance(place, int) and 0 < place <= elevations.size and np.isfinite(elevations[place - 1]):
            return float(elevations[place - 1])
    return float(max(link.left_floor, link.right_floor))


def _label(structure: Structure, place: Place) -> str:
    if len(structure.floors) <= 1 and isinstance(place, int):
        return structure.name
    return f"{structure.name}, {place if isinstance(place, str) else f'floor {structure.floors[place - 1]}'}"


def _displacements(run: RunData, view: _View) -> dict[str, np.ndarray]:
    """Displacement of each structure at its place, relative to the ground, in the direction of the view [time]
    [m]."""
    moved = {
        name: _of_floor(run, name, place, view.direction)
        for name, place in view.places.items()
        if isinstance(place, int)
    }
    for _ in view.facing:
        for link in view.facing:
            widened = _sign(link, view.direction) * (np.interp(run.time, link.time, -link.penetration) - link.gap)
            if link.left in moved:
                moved.setdefault(link.right, moved[link.left] + widened)
            elif link.right in moved:
                moved[link.left] = moved[link.right] - widened
    return moved


def _at_place(run: RunData, other: RunData, name: str, view: _View) -> np.ndarray:
    """Displacement [m] of a structure at its place in another run."""
    place = view.places[name]
    if isinstance(place, int):
        return _of_floor(other, name, place, view.direction, other.time)
    structure = run.structures[name]
    link = next(link for link in view.facing if name in (link.left, link.right))
    nodes = other.structures[name].nodes
    if nodes is not None and place.removeprefix("node ") in nodes.names:
        i = nodes.names.index(place.removeprefix("node "))
        return sum(
            (
                factor * nodes.displacement[:, i, nodes.directions.index(axis)]
                for axis, factor in zip("xy", view.direction)
                if axis in nodes.directions
            ),
            np.zeros(other.time.size),
        )
    heights = levels(structure)
    motion = np.stack(
        [_of_floor(other, name, floor, view.direction, other.time) for floor in range(len(heights))], axis=1
    )
    height = link.position[2] if link.position is not None else _height(run, link)
    above = int(np.clip(np.searchsorted(heights, height), 1, len(heights) - 1))
    share = np.clip((height - heights[above - 1]) / (heights[above] - heights[above - 1]), 0, 1)
    return (1 - share) * motion[:, above - 1] + share * motion[:, above]


def _sign(link: Link, direction: np.ndarray) -> int:
    """Sign of a link along a direction: 1 if parallel, -1 if antiparallel, else 0."""
    share = float(link.direction[:2] @ direction[:2])
    return int(np.sign(share)) if abs(share) > (1 - 1e-6) * np.hypot(*link.direction[:2]) > 0 else 0


def _ordered(link: Link, direction: np.ndarray) -> tuple[str, str]:
    """The two structures of a link in their order along the direction."""
    return (link.left, link.right) if _sign(link, direction) > 0 else (link.right, link.left)


def _direction(run: RunData) -> np.ndarray:
    """The direction of the first link, towards positive x or y; x without links."""
    first = next((link for link in run.links.values() if np.hypot(*link.direction[:2]) > 1e-9), None)
    return next(
        (each for each in directions_of(run) if first is not None and _sign(first, each)), np.array([1.0, 0, 0])
    )


def _axis_words(direction: np.ndarray) -> str:
    x, y = direction[:2]
    for words, value, other in (("x", x, y), ("y", y, x)):
        if abs(other) < 1e-9:
            return words if value > 0 else f"\N{MINUS SIGN}{words}"
    return f"({x:.2g}, {y:.2g})"


def _of_floor(run: RunData, name: str, floor: int, direction: np.ndarray, time: np.ndarray | None = None) -> np.ndarray:
    """Displacement of a floor, from 1, relative to the ground, in a direction; a wall moves with the ground, and so
    does floor 0."""
    along = run.structures[name].along
    still = np.zeros((run.time if time is None else time).size)
    if floor == 0:
        return still
    return sum(
        (factor * along[axis].displacement[:, floor - 1] for axis, factor in zip("xy", direction) if axis in along),
        still,
    )


def _offsets(along: list[Link], names: list[str], direction: np.ndarray) -> dict[str, float]:
    """Offset of each structure at rest, by the gaps along the direction; 0 for the first of linked structures [m]."""
    offsets: dict[str, float] = {}
    for first in names:
        offsets.setdefault(first, 0.0)
        for _ in names:
            for link in along:
                back, front = _ordered(link, direction)
                if back in offsets and front in names:
                    offsets.setdefault(front, offsets[back] + link.gap)
                elif front in offsets and back in names:
                    offsets.setdefault(back, offsets[front] - link.gap)
    return offsets
