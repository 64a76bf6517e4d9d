"""Panels over time: ground, openings, contact forces, energies."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from pounding._pictures.panels import legend_beside, link_styles, plot_time, say, time_unit
from pounding._pictures.style import (
    BLUE,
    ENERGY_UNITS,
    FORCE_UNITS,
    GREEN,
    IMPULSE_UNITS,
    MM,
    ORANGE,
    PURPLE,
    SKY,
    VERMILION,
    engineering,
    largest,
)
from pounding.results import RunData


def draw_ground(axes: Axes, run: RunData) -> None:
    """Acceleration of the ground, along every axis along which it moves."""
    along = {"x": run.ground_acceleration, **run.ground_across}
    moving = {axis: values for axis, values in along.items() if largest([values]) > 0} or {"x": run.ground_acceleration}
    for (axis, values), colour in zip(moving.items(), ("0.25", SKY, ORANGE)):
        plot_time(axes, run, run.time, values, color=colour, linewidth=0.7, label=f"along {axis}")
    axes.set_title("Ground" if "x" in moving or len(moving) > 1 else f"Ground along {next(iter(moving))}")
    axes.set_ylabel("Acceleration\n[m/s²]")
    if len(moving) > 1:
        legend_beside(axes)


def draw_openings(axes: Axes, run: RunData) -> None:
    """Opening of the links; a mark at each touch."""
    for link, style in link_styles(run):
        plot_time(axes, run, link.time, -MM * link.penetration, **style)
    size, _ = time_unit(run)
    axes.axhline(0, color="black", linewidth=0.6)
    touches = run.impacts["t_start"] / size
    if touches.size:
        axes.plot(
            touches,
            np.zeros_like(touches),
            linestyle="none",
            marker="^",
            markersize=3.5,
            color="black",
            clip_on=False,
            zorder=5,
            label=f"touch ({touches.size})",
        )
    axes.set_title("Opening of the links")
    axes.set_ylabel("Opening\n[mm]")
    legend_beside(axes)


def draw_forces(axes: Axes, run: RunData) -> None:
    """Contact force of each link, or impulses if all contacts are rigid."""
    axes.set_title("Contact forces")
    peak = largest([link.force for link in run.links.values()])
    size, unit = engineering(peak, FORCE_UNITS)
    if peak == 0 and run.impacts.size:
        _draw_impulses(axes, run)
    elif peak == 0:
        say(axes, f"No impact; closest approach {_closest(run)}")
        axes.set_ylabel("Force")
    else:
        for link, style in link_styles(run):
            plot_time(axes, run, link.time, link.force / size, **{**style, "linewidth": 0.9})
        axes.set_ylabel(f"Force\n[{unit}]")
        axes.set_ylim(bottom=min(0, axes.get_ylim()[0]) if _pulls(run) else 0)
        legend_beside(axes)


def draw_energies(axes: Axes, run: RunData) -> None:
    """Energy by kind: dissipated and stored energies stacked, below the line of the input."""
    energy = run.energy
    parts = [
        ("damping", "damping", SKY),
        ("devices", "dampers between", BLUE),
        ("hysteretic", "yielding", ORANGE),
        ("impact", "impact", VERMILION),
        ("strain", "strain", GREEN),
        ("kinetic", "kinetic", PURPLE),
    ]
    parts = [part for part in parts if part[0] in energy and largest([energy[part[0]]]) > 0]
    size, unit = engineering(largest([energy["input"]]), ENERGY_UNITS)
    time_size, _ = time_unit(run)
    if parts:
        axes.stackplot(
            energy["time"] / time_size,
            *[energy[key] / size for key, _, _ in parts],
            labels=[label for _, label, _ in parts],
            colors=[colour for _, _, colour in parts],
            alpha=0.75,
            linewidth=0,
        )
        axes.plot(energy["time"] / time_size, energy["input"] / size, color="black", linewidth=0.8, label="input")
    axes.set_title("Energy")
    axes.set_ylabel(f"Energy\n[{unit}]")
    axes.margins(x=0)
    legend_beside(axes, reverse=True)


def draw_balance_error(axes: Axes, run: RunData) -> None:
    """Error of the energy balance in per cent of the largest input."""
    energy = run.energy
    scale = largest([energy["input"]])
    if scale > 0:
        time_size, _ = time_unit(run)
        axes.plot(energy["time"] / time_size, 100 * energy["error"] / scale, color="black", linewidth=0.7)
    axes.set_title("Error of the energy balance")
    axes.set_ylabel("Error\n[% of input]")
    axes.yaxis.set_major_locator(MaxNLocator(3))
    axes.yaxis.set_major_formatter(lambda value, _: f"{value:.2g}".replace("-", "\N{MINUS SIGN}"))
    axes.margins(x=0)


def _draw_impulses(axes: Axes, run: RunData) -> None:
    size, unit = engineering(largest([run.impacts["impulse"]]), IMPULSE_UNITS)
    time_size, _ = time_unit(run)
    for link, style in link_styles(run):
        impacts = run.impacts_of(link.name)
        if impacts.size:
            axes.vlines(
                impacts["t_start"] / time_size, 0, impacts["impulse"] / size, color=style["color"], label=style["label"]
            )
    axes.set_title("Impulses of rigid contacts")
    axes.set_ylabel(f"Impulse\n[{unit}]")
    axes.set_ylim(bottom=0)
    legend_beside(axes)


def _pulls(run: RunData) -> bool:
    return any(link.force.size and link.force.min() < 0 for link in run.links.values())


def _closest(run: RunData) -> str:
    openings = [-MM * link.penetration.max() for link in run.links.values() if link.penetration.size]
    return f"{min(openings):.4g} mm" if openings else "not recorded"
