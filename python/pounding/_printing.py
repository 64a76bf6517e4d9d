"""Text of objects in print(): names, sizes, units and peak values.

Runs, structures, links and models print three lines, other results a line per array."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import fields
from typing import Any

import numpy as np

#: Longer texts are not printed.
LONGEST = 200


def contents(one: Any) -> list[str]:
    """Names and numbers of a dataclass; then a line per array with its dimensions, unit and largest absolute value."""
    labels: dict[str, str] = vars(one).get("_labels", {})
    plain: list[str] = []
    arrays: dict[str, np.ndarray] = {}
    for name, value in ((each.name, getattr(one, each.name)) for each in fields(one)):
        value = getattr(value, "values", value) if not isinstance(value, dict) else value  # of Extremes
        if isinstance(value, float):
            plain.append(f"{name} {value:.4g}")
        elif isinstance(value, (str, int)) and 0 < len(str(value)) < LONGEST:
            plain.append(f"{name} {value}")
        elif isinstance(value, list) and value and isinstance(value[0], str):
            plain.append(f"{name} {few(value, 3)}")
        elif isinstance(value, (dict, np.ndarray)):
            every = {f"{name}.{key}": item for key, item in value.items()} if isinstance(value, dict) else {name: value}
            arrays |= {key: item for key, item in every.items() if isinstance(item, np.ndarray)}
    lines = [f"{name} {labels.get(name, array.shape)}, at most {peak(array)}" for name, array in arrays.items()]
    return [", ".join(plain)] * bool(plain) + lines


class ReportLines:
    """An object that prints as some lines; its repr is the first of them."""

    _lines: Callable[[Any], list[str]] = staticmethod(contents)

    def __init_subclass__(cls, lines: Callable[[Any], list[str]] | None = None, **options: Any) -> None:
        super().__init_subclass__(**options)
        if lines is not None:
            cls._lines = staticmethod(lines)

    def __str__(self) -> str:
        return "\n".join(type(self)._lines(self))

    def __repr__(self) -> str:
        return f"<pounding.{type(self).__name__} {type(self)._lines(self)[0]}>"


def run(results: Any) -> list[str]:
    """Title and state; structures; links and their impacts."""
    span = f"{results.time[0]:.4g} to {results.time[-1]:.4g} s" if results.time.size else "no time"
    structures = (
        f"{one.name} ({counted(len(one.floors), 'floor') if one.floors else 'wall'})"
        for one in results.structures.values()
    )
    return [
        f'"{results.title}": {results.status}, {span}, {counted(results.time.size, "output time")}',
        f"structures: {few(structures)}",
        f"links: {few(_impacts(results, link.name) for link in results.links.values())}",
    ]


def structure(one: Any) -> list[str]:
    """Kind and floors; largest motion; other contents."""
    place = {1: "along x", 2: "in the plane x z", 3: "in space"}[one.dimension]
    heights = one.elevations[np.isfinite(one.elevations)]
    height = f", {heights.max():.4g} m high" if heights.size else ""
    others = [
        counted(len(part.names), word)
        for part, word in ((one.nodes, "node"), (one.members, "member"))
        if part is not None
    ]
    moved = "; ".join(f"along {axis} {_motion(motion)}" for axis, motion in one.along.items())
    return [
        f"{one.name}: {one.kind or 'structure'} {place}, {counted(len(one.floors), 'floor')}{height}",
        "moves with the ground" if one.is_wall else f"largest at the output times: {moved}",
        f"histories of {counted(len(one.floors), 'floor')}{''.join(f', {part}' for part in others)}, directions {', '.join(one.along)}",
    ]


def link(one: Any) -> list[str]:
    """Ends, law and gap; largest values; samples."""
    left, right = _ends(one)
    span = f"from {one.time[0]:.4g} to {one.time[-1]:.4g} s" if one.time.size else "at no time"
    return [
        f"{one.name}: {one.law}, gap {1e3 * one.gap:.4g} mm, {left} against {right}",
        f"largest force {peak(one.force)} N, penetration {max(0.0, _largest(one.penetration)):.4g} m, work "
        f"{one.energy[-1] if one.energy.size else 0.0:.4g} J{_opening(one)}",
        f"{counted(one.time.size, 'sample')} {span}",
    ]


def _opening(one: Any) -> str:
    """Largest opening and seat; empty for files of earlier versions."""
    if math.isnan(one.largest_opening):
        return ""
    seat = "" if math.isnan(one.seat) else f" of a seat of {1e3 * one.seat:.4g} mm"
    return f", opening {1e3 * one.largest_opening:.4g} mm{seat}"


def law(one: Any) -> list[str]:
    """Parameters; force; meaning."""
    return [repr(one), one.kind.shape, one.kind.summary]


def model(one: Any) -> list[str]:
    """Title and size; structures; links and analysis."""

    def kind(words: Any) -> str:
        return next((str(word) for word in words), "") if isinstance(words, dict) else ""

    def ends(between: Any) -> str:
        return between if isinstance(between, str) else " - ".join(map(str, between))

    structures = one.structures or {}
    links = (
        f"{ends(words.get('between', []))} ({words.get('law', 'no law')}, gap {words.get('gap', 'not given')})"
        for words in one.links or ()
    )
    return [
        f'"{one.title or ""}": {counted(len(structures), "structure")}, {counted(len(one.links or ()), "link")}, '
        f"ground motion {kind(one.ground_motion) or 'none'}",
        f"structures: {few(f'{name} ({kind(words)})' for name, words in structures.items())}",
        f"links: {few(links)}",
    ]


def modes(found: Any) -> list[str]:
    """Count of modes; periods of the first structures."""
    first = {name: modes[:4] for name, modes in found.items() if modes}
    periods = (f"{name}: T = {', '.join(f'{mode.period:.4g}' for mode in modes)} s" for name, modes in first.items())
    ratios = (
        f"{name}: damping {', '.join(f'{100 * mode.damping_ratio:.3g}' for mode in modes)} %"
        for name, modes in first.items()
    )
    counts = (f"{counted(len(modes), 'mode')} of {name}" for name, modes in found.items())
    return [few(counts), few(periods, 4), few(ratios, 4)]


def opensees_link(one: Any) -> list[str]:
    """Element, nodes and gap; law; direction."""
    mass = "" if one.reduced_mass is None else f", reduced mass {one.reduced_mass:.6g} kg"
    return [
        f"{one.tag}: nodes {one.nodes[0]} and {one.nodes[1]}, gap {one.gap:g} m",
        repr(one.law),
        f"along degree of freedom {one.dof}{mass}",
    ]


def few(words: Iterable[str], most: int = 6) -> str:
    """The first items of a list, and the number of the others."""
    every = list(words)
    more = f", and {len(every) - most} more" if len(every) > most else ""
    return (", ".join(every[:most]) + more) or "none"


def counted(number: int, word: str) -> str:
    """ "1 floor", "2 floors"."""
    return f"{number} {word}{'' if number == 1 else 's'}"


def peak(values: np.ndarray) -> str:
    """The largest absolute value."""
    return f"{_largest(np.abs(values)):.4g}"


def _ends(one: Any) -> list[str]:
    """Structures of a link or device with the ends on them."""
    ends = ((one.left, one.left_end), (one.right, one.right_end))
    return [name + (f" ({end})" if end else "") for name, end in ends]


def _largest(values: np.ndarray) -> float:
    finite = values[np.isfinite(values)]
    return float(finite.max()) if finite.size else 0.0


def _motion(motion: Any) -> str:
    drift = f", drift {peak(motion.drift)} m" if motion.drift.size else ""
    return f"displacement {peak(motion.displacement)} m{drift}, acceleration {peak(motion.acceleration)} m/s^2"


def _impacts(results: Any, name: str) -> str:
    rows = results.impacts_of(name)
    if not rows.size:
        return f"{name} (no impact)"
    presses = np.isnan(rows["t_end"][-1]) and np.isnan(rows["t_release"][-1])
    force = f", at most {peak(rows['peak_force'])} N" if np.isfinite(rows["peak_force"]).any() else ", rigid"
    return f"{name} ({counted(rows.size, 'impact')}{force}{', still pressed' if presses else ''})"
