"""Panel of the displacements: structures beside each other, a gap apart."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from pounding.pictures.panels import legend_beside, plot_time, time_unit
from pounding.pictures.style import MM, STRUCTURE_COLOURS, BadRequest
from pounding.results import Link, RunData, Structure

#: More displacements than these in one panel cannot be told apart.
MOST_STRUCTURES = 4
#: A place of a structure: the number of a floor, from 1; else the words for the end of a link, as "node b" and "10.5 m up".
Place = int | str


def draw_displacements(axes: Axes, run: RunData, chosen: dict[str, int] | None = None) -> None:
    """Displacements of up to four structures where their highest links are, each a gap away from its left neighbour, so that
    two lines meet when the structures touch. A top above the links is drawn thin. `chosen` maps names of structures to
    numbers of floors, from 0, that are drawn instead; structures with a chosen floor come first.

    Two lines face each other, with the gap shaded between them, where one link joins them at the places that are drawn. The
    end of a link between floors moves as the floor at its other end and the opening of the link say.

    In space the displacements are those of the middle of the floors in the direction of the first link; where a floor
    turns, its ends may touch before the lines meet."""
    chosen = chosen or {}
    drawn = sorted(run.structures.values(), key=lambda structure: structure.name not in chosen)[:MOST_STRUCTURES]
    drawn = [structure for structure in run.structures.values() if any(structure is one for one in drawn)]
    names = [structure.name for structure in drawn]
    places, facing = _places(run, names, {name: floor + 1 for name, floor in chosen.items()})
    moved = _displacements(run, places, facing)
    offsets = _offsets(run, names)
    sides = {name: MM * (offsets[name] + moved[name]) for name in names}
    for structure, colour in zip(drawn, STRUCTURE_COLOURS):
        name, place, top = structure.name, places[structure.name], len(structure.floors)
        axes.axhline(MM * offsets[name], color=colour, linewidth=0.5, linestyle=(0, (4, 4)))
        plot_time(axes, run, run.time, sides[name], color=colour, label=_label(structure, place))
        if place != top and top and name not in chosen:
            plot_time(axes, run, run.time, MM * (offsets[name] + _of_floor(run, name, top)), color=colour,
                      linewidth=0.5, alpha=0.7, label=f"{name}, top")
    sizes = ", ".join(f"{MM * link.gap:.4g}" for link in facing)
    for i, link in enumerate(facing):
        left, right = sides[link.left], sides[link.right]
        axes.fill_between(run.time / time_unit(run)[0], left, right, where=right >= left, color="0.55", alpha=0.22, linewidth=0,
                          label=f"gap, {sizes} mm at rest" if i == 0 else None)
    more = len(run.structures) - len(drawn)
    title = "Displacements" if not more else f"Displacements of {len(drawn)} of {len(run.structures)}"
    if any(structure.dimension == 3 for structure in drawn):
        title += f" along {_axis_words(_direction(run))}"
    axes.set_title(title)
    axes.set_ylabel("Displacement\n[mm]")
    legend_beside(axes)


def chosen_floors(run: RunData, labels: dict[str, str]) -> dict[str, int]:
    """Numbers of the floors, from 0, by structure."""
    chosen = {}
    for name, label in labels.items():
        if name not in run.structures:
            raise BadRequest(f"there is no structure {name}; there is {', '.join(run.structures)}")
        floors = run.structures[name].floors
        if label not in floors:
            raise BadRequest(f"{name} has no floor {label}; it has {', '.join(floors) or 'none'}")
        chosen[name] = floors.index(label)
    return chosen


def _places(run: RunData, names: list[str], chosen: dict[str, Place]) -> tuple[dict[str, Place], list[Link]]:
    """Where each structure is drawn, and the links that join two of these places: of each pair of neighbours the highest one
    that fits what is decided. A structure without such a link is drawn at its top; a wall has the place 0."""
    places: dict[str, Place] = {name: 0 for name in names if run.structures[name].is_wall}
    places.update(chosen)
    facing: list[Link] = []
    pairs: dict[tuple[str, str], list[Link]] = {}
    for link in run.links.values():
        if link.left in names and link.right in names:
            pairs.setdefault((link.left, link.right), []).append(link)
    for links in pairs.values():
        # One of the two ends has to be a floor: the motion of the other follows from it.
        fitting = [link for link in links if any(_is_known(run, *end) for end in _ends(run, link))
                   and all(places.get(name, place) == place for name, place in _ends(run, link))]
        if fitting:
            facing.append(max(fitting, key=lambda link: _height(run, link)))
            places.update(_ends(run, facing[-1]))
    return {name: places.get(name, len(run.structures[name].floors)) for name in names}, facing


def _ends(run: RunData, link: Link) -> list[tuple[str, Place]]:
    ends = ((link.left, link.left_floor or link.left_end or 0), (link.right, link.right_floor or link.right_end or 0))
    return [(name, 0 if run.structures[name].is_wall else place) for name, place in ends]


def _is_known(run: RunData, name: str, place: Place) -> bool:
    """The file has the motion of this place: of a floor, or of a wall."""
    return isinstance(place, int) and (place > 0 or run.structures[name].is_wall)


def _height(run: RunData, link: Link) -> float:
    """Height of a link [m]; where there is none, the number of its floors."""
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


def _displacements(run: RunData, places: dict[str, Place], facing: list[Link]) -> dict[str, np.ndarray]:
    """Displacement of each place relative to the ground, in the direction of the links [time] [m]."""
    moved = {name: _of_floor(run, name, place) for name, place in places.items() if isinstance(place, int)}
    for _ in facing:
        for link in facing:
            widened = np.interp(run.time, link.time, -link.penetration) - link.gap
            if link.left in moved:
                moved.setdefault(link.right, moved[link.left] + widened)
            elif link.right in moved:
                moved[link.left] = moved[link.right] - widened
    return moved


def _direction(run: RunData) -> np.ndarray:
    """Horizontal direction in which the first link opens; x without links."""
    return next((link.direction for link in run.links.values()), np.array([1.0, 0, 0]))


def _axis_words(direction: np.ndarray) -> str:
    x, y = direction[:2]
    for words, value, other in (("x", x, y), ("y", y, x)):
        if abs(other) < 1e-9:
            return words if value > 0 else f"\N{MINUS SIGN}{words}"
    return f"({x:.2g}, {y:.2g})"


def _of_floor(run: RunData, name: str, floor: int) -> np.ndarray:
    """Displacement of a floor, from 1, relative to the ground, in the direction of the links; a wall moves with the ground."""
    along = run.structures[name].along
    if floor == 0:
        return np.zeros_like(run.time)
    return sum(factor * along[axis].displacement[:, floor - 1] for axis, factor in zip("xy", _direction(run)) if axis in along)


def _offsets(run: RunData, names: list[str]) -> dict[str, float]:
    """Where each structure rests, a gap to the right of its left neighbour [m]."""
    offsets = {names[0]: 0.0} if names else {}
    for _ in names:
        for link in run.links.values():
            if link.left in offsets and link.right in names:
                offsets.setdefault(link.right, offsets[link.left] + link.gap)
            elif link.right in offsets and link.left in names:
                offsets.setdefault(link.left, offsets[link.right] - link.gap)
    return {name: offsets.get(name, 0.0) for name in names}
