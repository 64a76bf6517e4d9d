"""Text of objects in print(): three lines with names, sizes, units and peak values."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

#: Description of MemberForces.gravity_included.
GRAVITY = {None: "", True: "; gravity is included", False: "; gravity is not included"}


class ReportLines:
    """An object that prints as three lines; its repr is the first of them."""

    _lines: Callable[[Any], list[str]]

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


def floor_motion(motion: Any) -> list[str]:
    """Shape; largest motion; largest drift and shear."""
    return [
        f"{_shape(motion.displacement, 'time', 'floor')}",
        _motion(motion),
        f"storey shear {peak(motion.storey_shear)} N, base shear "
        f"{'not in the file' if motion.base_shear is None else f'{peak(motion.base_shear)} N'}",
    ]


def node_motion(motion: Any) -> list[str]:
    """Shape; names; largest motion."""
    return [
        f"{_shape(motion.displacement, 'time', 'node', 'direction')}",
        f"nodes {few(motion.names)}; directions {', '.join(motion.directions)}",
        f"displacement {peak(motion.displacement)} m or rad; velocity {peak(motion.velocity)} m/s or rad/s; "
        f"acceleration {peak(motion.acceleration)} m/s^2 or rad/s^2",
    ]


def member_forces(forces: Any) -> list[str]:
    """Shape; names; largest force of each component."""
    ends = (
        f"{name} {peak(forces.end_forces[..., i])} {'N m' if name.split()[-1][0] in 'MT' else 'N'}"
        for i, name in enumerate(forces.components)
    )
    return [
        f"{_shape(forces.end_forces, 'time', 'member', 'component')}",
        f"members {few(forces.names)}",
        f"largest {few(ends, 12)}{GRAVITY[forces.gravity_included]}",
    ]


def geometry(one: Any) -> list[str]:
    """Counts; extent; names."""
    low, high = (one.nodes.min(axis=0), one.nodes.max(axis=0)) if len(one.nodes) else (np.zeros(3), np.zeros(3))
    return [
        f"{counted(len(one.nodes), 'node')}, {counted(len(one.members), 'member')}",
        ", ".join(f"{axis} {a:.4g} to {b:.4g} m" for axis, a, b in zip("xyz", low, high)),
        f"nodes {few(one.node_names, 4)}; members {few(one.member_names, 4)}",
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


def springs(parts: Any) -> list[str]:
    """Shape and laws; the part with the largest deformation; energy."""
    ductility = parts.largest["ductility"]
    most = int(np.argmax(ductility))
    yielded = parts.states.count("yielded")
    return [
        f"{_shape(parts.deformation, 'time', 'part')}, {few(sorted(set(parts.laws)))}",
        f"{yielded} of {counted(len(parts.names), 'part')} yielded; largest ductility {ductility[most]:.4g}, {parts.names[most]}",
        f"largest force {peak(parts.largest['peak_force'])} N or N m; {parts.largest['hysteretic'].sum():.4g} J lost by yielding",
    ]


def device(one: Any) -> list[str]:
    """Ends and kind; largest values; samples."""
    left, right = _ends(one)
    parts = [f"bar {one.stiffness:.4g} N/m"] if one.stiffness else []
    if one.coefficient:
        parts.append(f"damper {one.coefficient:.4g} N (s/m)^{one.exponent:g}")
    return [
        f"{one.name}: {', '.join(parts)} between {left} and {right}",
        f"largest force {peak(one.largest['force'])} N, elongation {peak(one.largest['elongation'])} m",
        f"{counted(one.force.size, 'output time')}",
    ]


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


def mode(one: Any) -> list[str]:
    """Period and damping; participation; shape."""
    return [
        f"T = {one.period:.4g} s, damping {100 * one.damping_ratio:.3g} %",
        f"participation {numbers(one.participation)}, effective mass {numbers(one.effective_mass)} kg",
        f"shape {numbers(np.ravel(one.shape))}",
    ]


def free_impact(one: Any) -> list[str]:
    """Restitution and loss; force and penetration; times and impulse."""
    return [
        f"restitution {numbers(one.restitution)}, energy lost {numbers(one.energy_lost)} J",
        f"peak force {numbers(one.peak_force)} N after {numbers(one.time_of_peak)} s, penetration "
        f"{numbers(one.peak_penetration)} m",
        f"duration {numbers(one.duration)} s, impulse {numbers(one.impulse)} N s",
    ]


def film(one: Any) -> list[str]:
    """Frames; duration; how to save it."""
    return [
        f"{counted(one.frames, 'frame')}, {one.speed:.3g} per second",
        f"{one.frames / one.speed:.3g} s long",
        'pounding.animation.save(film, "NAME.gif") writes it',
    ]


def extremes(one: Any) -> list[str]:
    """Number of values; smallest and largest."""
    shape = " x ".join(map(str, one.values.shape[:-1])) or "1"
    if not one.values.size:
        return ["minima and maxima of nothing"]
    return [
        f"minima and maxima of {shape} values",
        f"smallest {np.nanmin(one.min):.4g}, largest {np.nanmax(one.max):.4g}",
        "times of both in .times [s]",
    ]


def envelope(one: Any) -> list[str]:
    """Name and floors; largest values; members and supports."""
    units = {"displacement": "m", "drift": "m", "acceleration": "m/s^2", "storey_shear": "N", "member_force": "N, N m"}
    found = [
        f"{name} {peak(extreme.peak)} {unit}"
        for name, unit in units.items()
        if (extreme := getattr(one, name)) is not None and extreme.values.size
    ]
    others = f"{counted(len(one.members), 'member')}, {counted(len(one.supports), 'support')}"
    return [
        f"extremes of {one.name}: {counted(len(one.floors), 'floor')}, directions {', '.join(one.directions) or 'none'}",
        f"largest in all steps: {', '.join(found) or 'nothing'}",
        f"{others}; arrays in .displacement.min and so on, tables by results.to_pandas()",
    ]


def view(one: Any) -> list[str]:
    """Instants of the film and modes; size; how to save it."""
    return [
        f"interactive view, {counted(one.frames, 'instant')} of a film, {counted(one.modes, 'mode')}",
        f"{len(one.html) / 1e6:.3g} MB, with everything in it",
        '.save("NAME.html") writes it, for any browser',
    ]


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


def numbers(values: Any) -> str:
    """One number, or the first and the last of many."""
    row = np.ravel(values)
    if row.size <= 6:
        return ", ".join(f"{value:.4g}" for value in row) or "none"
    return f"{row[0]:.4g}, {row[1]:.4g} ... {row[-1]:.4g} ({row.size} values)"


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


def _shape(values: np.ndarray, *words: str) -> str:
    return ", ".join(counted(size, word) for size, word in zip(values.shape, words))


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
