"""Loops of yielding parts and devices: force over deformation of storeys, hinges and isolators, tension over
elongation."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from pounding._pictures.panels import legend_beside
from pounding._pictures.style import (
    ENERGY_UNITS,
    FORCE_UNITS,
    MM,
    BadRequest,
    engineering,
    largest,
    picture,
    structure_colour,
)
from pounding._springs import Device, Springs
from pounding.results import RunData, Structure

#: Default number of parts.
SHOWN = 6
#: Minimum width of a figure for two columns, and minimum height of a loop [in].
MIN_OF_TWO, MIN_HEIGHT = 4.2, 1.6
#: Colour of devices, which belong to no structure.
DEVICE = "0.25"
#: Draws one loop.
Loop = Callable[[Axes], None]
#: Labels of force and deformation by kind of part.
LABELS = {
    "hinge": ("Moment", "Rotation [mrad]"),
    "device": ("Tension", "Elongation [mm]"),
    "isolator": ("Force", "Deformation [mm]"),
    "support": ("Force", "Upward displacement [mm]"),
    "storey": ("Shear", "Drift [mm]"),
}
#: Units of moments have the same sizes as those of forces.
MOMENT_UNITS = tuple((size, f"{name} m") for size, name in FORCE_UNITS)


def loops_figure(
    run: RunData,
    title: str | None = None,
    size: tuple[float, float] | None = None,
    parts: list[tuple[str, str]] | None = None,
) -> Figure:
    """Force over deformation at the output times of `parts`, pairs of a structure and a name ("left", "storey 1").

    The default is the six parts and devices with the largest energy losses, in descending order, or as many as fit into
    `size` [in]. A dot marks the end of the run; dashed lines are the yield deformations. Raises BadRequest for a run
    without such parts and for unknown parts."""
    chosen = most_energy(run) if parts is None else [_loop(*_found(run, *part)) for part in parts]
    if not chosen:
        raise BadRequest(
            "no loops to draw: all structures of this run stay elastic, and it has no devices. Give storeys a yield_force"
        )
    width = size[0] if size else 7.5
    columns = min(len(chosen), 3 if width >= 6 else 2 if width >= MIN_OF_TWO else 1)
    rows = -(-len(chosen) // columns)
    if size is not None and parts is None:
        rows = min(rows, max(1, int((size[1] - 0.7) / MIN_HEIGHT)))
        chosen = chosen[: rows * columns]
    with picture(size or (7.5, 0.7 + 2.2 * rows), run.title if title is None else title) as figure:
        grid = figure.subplots(rows, columns, squeeze=False)
        for axes in grid.flat[len(chosen) :]:
            axes.set_axis_off()
        for letter, axes, draw in zip("abcdefghijklmnopqrstuvwxyz", grid.flat, chosen):
            draw(axes)
            axes.set_title(f"({letter}) {axes.get_title(loc='left')}")
        figure.legend(handles=_legend(), loc="outside lower center", ncols=2)
        return figure


def most_energy(run: RunData) -> list[Loop]:
    """The SHOWN parts and devices with the largest energy losses; ties in input order."""
    lost: list[tuple[float, Loop]] = [
        (springs.largest["hysteretic"][part], _loop(number, structure, part))
        for number, structure in enumerate(run.structures.values())
        if (springs := structure.springs) is not None
        for part in range(len(springs))
    ]
    energies = {one["name"]: float(one["energy_lost"]) for one in run.summary.get("devices", [])}
    lost += [
        (energies[name], partial(draw_device, device=device, lost=energies[name]))
        for name, device in run.devices.items()
        if name in energies
    ]
    return [loop for _, loop in sorted(lost, key=lambda one: -one[0])[:SHOWN]]


def _loop(number: int, structure: Structure, part: int) -> Loop:
    return partial(draw_loop, structure=structure, part=part, colour=structure_colour(number))


def draw_device(axes: Axes, device: Device, lost: float) -> None:
    """Loop of a device between two structures, which loses the energy `lost` [J]."""
    size, unit = engineering(largest([device.force]), FORCE_UNITS)
    _draw_curve(axes, MM * device.elongation, device.force / size, DEVICE)
    lost_size, lost_unit = engineering(lost, ENERGY_UNITS)
    axes.set_title(f"{device.name}, {device.left} to {device.right}")
    axes.set_ylabel(f"Tension [{unit}]")
    axes.set_xlabel(f"Elongation [mm]\n{lost / lost_size:.3g} {lost_unit} lost")


def draw_loop(axes: Axes, structure: Structure, part: int, colour: str) -> None:
    """The loop of one part."""
    springs = _springs(structure)
    kind = springs.kind(part)
    deformation, force = MM * springs.deformation[:, part], springs.force[:, part]
    size, unit = engineering(largest([force]), MOMENT_UNITS if kind == "hinge" else FORCE_UNITS)
    limits = (-springs.negative_yield_deformation[part], springs.yield_deformation[part])
    for limit in limits if np.isfinite(limits).all() else ():
        axes.axvline(MM * limit, color="0.5", linewidth=0.6, linestyle=(0, (4, 3)), zorder=1)
    _draw_curve(axes, deformation, force / size, colour)
    lost_size, lost_unit = engineering(springs.largest["hysteretic"][part], ENERGY_UNITS)
    sense, way = LABELS[kind]
    axes.set_title(f"{structure.name}, {springs.names[part]}")
    axes.set_ylabel(f"{sense} [{unit}]")
    axes.set_xlabel(
        f"{way}\nductility {springs.largest['ductility'][part]:.3g}, "
        f"{springs.largest['hysteretic'][part] / lost_size:.3g} {lost_unit} lost"
    )


def _draw_curve(axes: Axes, deformation: np.ndarray, force: np.ndarray, colour: str) -> None:
    axes.axhline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.plot(deformation, force, color=colour, linewidth=0.8)
    if deformation.size:
        axes.plot(deformation[-1], force[-1], marker="o", markersize=4, color="black", linestyle="none", zorder=4)
    axes.xaxis.set_major_locator(MaxNLocator(4))
    axes.yaxis.set_major_locator(MaxNLocator(4))


def _springs(structure: Structure) -> Springs:
    if structure.springs is None:
        raise BadRequest(f"{structure.name} stays elastic and has no loop")
    return structure.springs


def _found(run: RunData, structure: str, part: str) -> tuple[int, Structure, int]:
    names = list(run.structures)
    if structure not in names:
        raise BadRequest(f'unknown structure "{structure}"; known: {", ".join(names)}')
    springs = _springs(run.structures[structure])
    if part not in springs.names:
        raise BadRequest(f'{structure} has no part "{part}"; there is {", ".join(springs.names)}')
    return names.index(structure), run.structures[structure], springs.number(part)


def _legend() -> list[Line2D]:
    return [
        Line2D([], [], color="black", marker="o", markersize=4, linestyle="none", label="end of the run"),
        Line2D([], [], color="0.5", linewidth=0.6, linestyle=(0, (4, 3)), label="first yield"),
    ]


def draw_residuals(axes: Axes, run: RunData) -> None:
    """Residual and peak drifts of each storey of yielding structures."""
    shown = [
        (number, structure) for number, structure in enumerate(run.structures.values()) if structure.springs is not None
    ]
    axes.set_title("Drifts, largest and at the end")
    names: list[str] = []
    for number, structure in shown:
        summary = run.summary["structures"][structure.name]
        residual = MM * np.abs(np.asarray(summary["residual_drift"], dtype=float))
        peak = MM * np.asarray(summary["peak_drift"], dtype=float)
        places = len(names) + np.arange(len(peak))
        axes.bar(
            places,
            peak,
            width=0.7,
            facecolor="none",
            edgecolor=structure_colour(number),
            linewidth=0.9,
            label=f"{structure.name}, largest",
        )
        axes.bar(places, residual, width=0.7, color=structure_colour(number), label=f"{structure.name}, at the end")
        names += structure.floors[: len(peak)]
    axes.set_ylabel("Drift\n[mm]")
    axes.set_xlabel("Storey")
    few = list(range(0, len(names), -(-len(names) // 24))) if names else []
    axes.set_xticks(few, [names[i] for i in few])
    axes.grid(False, axis="x")
    legend_beside(axes)
