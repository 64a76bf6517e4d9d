"""Panel of the displacements: structures beside each other, a gap apart."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from pounding.pictures.panels import legend_beside, plot_time, time_unit
from pounding.pictures.style import MM, STRUCTURE_COLOURS, BadRequest
from pounding.results import RunData, Structure

#: More displacements than these in one panel cannot be told apart.
MOST_STRUCTURES = 4


def draw_displacements(axes: Axes, run: RunData, chosen: dict[str, int] | None = None) -> None:
    """Displacements of up to four structures where their links are, each a gap away from its left neighbour, so that
    two lines meet when the structures touch. A top above the links is drawn thin. `chosen` maps names of structures to
    numbers of floors, from 0, that are drawn instead; structures with a chosen floor come first.

    In space the displacements are those of the middle of the floors in the direction of the first link; where a floor
    turns, its ends may touch before the lines meet."""
    chosen = chosen or {}
    drawn, floors, offsets = _drawn(run, chosen)
    sides = {name: MM * (offsets[name] + _displacement(run, name, floors[name], _direction(run))) for name in offsets}
    for structure, colour in zip(drawn, STRUCTURE_COLOURS):
        name, floor, top = structure.name, floors[structure.name], len(structure.floors) - 1
        axes.axhline(MM * offsets[name], color=colour, linewidth=0.5, linestyle=(0, (4, 4)))
        label = name if top <= 0 else f"{name}, floor {structure.floors[floor]}"
        plot_time(axes, run, run.time, sides[name], color=colour, label=label)
        if floor != top and name not in chosen:
            plot_time(axes, run, run.time, MM * (offsets[name] + _displacement(run, name, top, _direction(run))), color=colour,
                       linewidth=0.5, alpha=0.7, label=f"{name}, top")
    facing = _facing(run, floors)
    sizes = ", ".join(f"{MM * gap:.4g}" for _, _, gap in facing)
    for i, (left, right, _) in enumerate(facing):
        axes.fill_between(run.time / time_unit(run)[0], sides[left], sides[right], where=sides[right] >= sides[left],
                          color="0.55", alpha=0.22, linewidth=0, label=f"gap, {sizes} mm at rest" if i == 0 else None)
    more = len(run.structures) - len(drawn)
    title = "Displacements" if not more else f"Displacements of {len(drawn)} of {len(run.structures)}"
    if any(structure.dimension == 3 for structure in drawn):
        title += f" along {_axis_words(_direction(run))}"
    axes.set_title(title)
    axes.set_ylabel("Displacement\n[mm]")
    legend_beside(axes)


def drawn_displacements(run: RunData, other: RunData, chosen: dict[str, int] | None = None) -> list[tuple[np.ndarray, str]]:
    """Displacements [mm] in another run of the floors that draw_displacements shows, at their places, with the colours there."""
    drawn, floors, offsets = _drawn(run, chosen or {})
    direction = _direction(run)
    return [(MM * (offsets[structure.name] + _displacement(other, structure.name, floors[structure.name], direction)), colour)
            for structure, colour in zip(drawn, STRUCTURE_COLOURS)]


def _drawn(run: RunData, chosen: dict[str, int]) -> tuple[list[Structure], dict[str, int], dict[str, float]]:
    """The structures that are drawn, the floor of each, from 0, and where each rests [m]."""
    drawn = sorted(run.structures.values(), key=lambda structure: structure.name not in chosen)[:MOST_STRUCTURES]
    drawn = [structure for structure in run.structures.values() if any(structure is one for one in drawn)]
    floors = {structure.name: chosen.get(structure.name, _linked_floor(run, structure)) for structure in drawn}
    return drawn, floors, _offsets(run, [structure.name for structure in drawn])


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


def _linked_floor(run: RunData, structure: Structure) -> int:
    """Index of the highest linked floor; the top when no link names a floor; -1 for a wall, which has no floor."""
    numbers = [link.left_floor for link in run.links.values() if link.left == structure.name]
    numbers += [link.right_floor for link in run.links.values() if link.right == structure.name]
    top = len(structure.floors)
    return min(max(numbers, default=0) or top, top) - 1


def _direction(run: RunData) -> np.ndarray:
    """Horizontal direction in which the first link opens; x without links."""
    return next((link.direction for link in run.links.values()), np.array([1.0, 0, 0]))


def _axis_words(direction: np.ndarray) -> str:
    x, y = direction[:2]
    for words, value, other in (("x", x, y), ("y", y, x)):
        if abs(other) < 1e-9:
            return words if value > 0 else f"\N{MINUS SIGN}{words}"
    return f"({x:.2g}, {y:.2g})"


def _displacement(run: RunData, name: str, floor: int, direction: np.ndarray) -> np.ndarray:
    """Displacement of a floor relative to the ground, in the direction of the links; a wall moves with the ground."""
    along = run.structures[name].along
    parts = [(along[axis].displacement, factor) for axis, factor in zip("xy", direction) if axis in along]
    if floor < 0:
        return np.zeros_like(run.time)
    return sum(factor * displacement[:, floor] for displacement, factor in parts)


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


def _facing(run: RunData, floors: dict[str, int]) -> list[tuple[str, str, float]]:
    """Drawn pairs (left, right, gap) that one link joins at the floors that are drawn."""
    pairs: dict[tuple[str, str], float] = {}
    for link in run.links.values():
        if link.left not in floors or link.right not in floors:
            continue
        ends = ((link.left, link.left_floor), (link.right, link.right_floor))
        if all(number in (0, floors[name] + 1) for name, number in ends):
            pairs.setdefault((link.left, link.right), link.gap)
    return [(left, right, gap) for (left, right), gap in pairs.items()]
