"""Panels of the impacts: force over penetration, restitution over closing speed."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.transforms import Transform

from pounding._pictures.panels import legend_beside, link_styles, note, say
from pounding._pictures.style import ENERGY_UNITS, FORCE_UNITS, MM, VERMILION, engineering, largest
from pounding.results import Link, RunData

#: Upper limit of the panel of restitutions.
HIGHEST = 1.5


def draw_strongest_loop(axes: Axes, run: RunData) -> None:
    """Force over penetration of the impact with the largest force."""
    axes.set_title("Strongest impact")
    peak = largest([run.impacts["peak_force"]])
    if peak == 0:
        say(axes, "Rigid contact: no loop" if run.impacts.size else "No impact")
        axes.set(xlabel="Penetration", ylabel="Force")
        return
    impact = run.impacts[np.nanargmax(run.impacts["peak_force"])]
    link = run.links[impact["link"]]
    inside = _inside(link, impact)
    size, unit = engineering(peak, FORCE_UNITS)
    penetration, force = MM * link.penetration[inside], link.force[inside] / size
    axes.fill(penetration, force, color=VERMILION, alpha=0.12, linewidth=0)
    axes.plot(penetration, force, color=VERMILION)
    _arrow(axes, penetration, force)
    lost_size, lost_unit = engineering(abs(impact["energy_lost"]), ENERGY_UNITS)
    out = "still pressed"
    if np.isfinite(impact["t_end"]):
        out = f"{impact['v_separation']:.3g} m/s out,\nrestitution {impact['restitution']:.3f}"
    axes.set_ylabel(f"Force [{unit}]")
    axes.set_xlabel(
        f"Penetration [mm]\n{link.name} at {impact['t_start']:.3f} s: {impact['v_approach']:.3g} m/s in, {out}, "
        f"{impact['energy_lost'] / lost_size:.3g} {lost_unit} lost"
    )


def draw_loops(axes: Axes, run: RunData) -> None:
    """Force over penetration of every impact."""
    axes.set_title("Contact loops")
    size, unit = engineering(largest([run.impacts["peak_force"]]), FORCE_UNITS)
    axes.set(xlabel="Penetration [mm]", ylabel=f"Force [{unit}]")
    if largest([run.impacts["peak_force"]]) == 0:
        say(axes, "Rigid contact: no loop" if run.impacts.size else "No impact")
        return
    for link, style in link_styles(run):
        for impact in run.impacts_of(link.name):
            inside = _inside(link, impact)
            axes.plot(MM * link.penetration[inside], link.force[inside] / size, **{**style, "linewidth": 0.8})
            style["label"] = None
    legend_beside(axes)


def draw_restitution(axes: Axes, run: RunData) -> None:
    """Restitution of each impact over its closing speed, and dashed the design restitutions of the links.

    The motion of storeys accelerates or brakes slow impacts. Values above HIGHEST are drawn at the upper edge, with a
    note of their maximum."""
    axes.set_title("Restitution of each impact")
    axes.set(
        xlabel="Closing speed [m/s]\nOther forces on the bodies during an impact change its restitution",
        ylabel="Restitution",
    )
    moving = run.impacts[np.isfinite(run.impacts["restitution"])]
    if not moving.size:
        say(axes, "No impact")
        return
    for link, style in link_styles(run):
        impacts = moving[moving["link"] == link.name]
        for inside, marker in ((impacts["restitution"] <= HIGHEST, "o"), (impacts["restitution"] > HIGHEST, "^")):
            [marks] = axes.plot(
                impacts["v_approach"][inside],
                np.minimum(impacts["restitution"][inside], HIGHEST),
                linestyle="none",
                marker=marker,
                markersize=3.5,
                markerfacecolor="none",
                markeredgewidth=0.9,
                color=style["color"],
                zorder=style["zorder"],
                clip_on=False,
            )
            marks.set_in_layout(False)
    for value in target_restitutions(run):
        axes.axhline(value, color="0.25", linewidth=0.8, linestyle=(0, (5, 3)), zorder=1.5)
        _note(axes, f"target {value:.4g}", (1, value), axes.get_yaxis_transform(), "bottom")
    highest = moving["restitution"].max()
    if highest > HIGHEST:
        above = int((moving["restitution"] > HIGHEST).sum())
        _note(axes, f"{above} above {HIGHEST:g}, up to {highest:.3g}", (1, 1), axes.transAxes, "top")
    axes.set_xlim(0, 1.05 * moving["v_approach"].max() or 1)
    axes.set_ylim(min(0, moving["restitution"].min()), min(HIGHEST, max(1, 1.05 * highest)))


def _note(axes: Axes, words: str, place: tuple[float, float], coordinates: Transform, side: str) -> None:
    """Text inside a panel at its right edge, ignored by the layout."""
    style: dict[str, Any] = {"xycoords": coordinates, "ha": "right", "va": side, "fontsize": 7, "color": "0.25"}
    note(axes, words, place, (-2, 2 if side == "bottom" else -3), **style).set_in_layout(False)


def target_restitutions(run: RunData) -> list[float]:
    """The distinct target restitutions of links in the input."""
    links = re.search(r"(?ms)^links:\n(.*?)(?=^\S|\Z)", run.resolved_yaml)
    return sorted(
        {float(value) for value in re.findall(r"(?m)^\s+restitution: ([-+.\deE]+)", links.group(1) if links else "")}
    )


def _inside(link: Link, impact: np.void) -> np.ndarray:
    """The samples of one impact, which may last to the end of the run."""
    end = np.inf if np.isnan(impact["t_end"]) else impact["t_end"]
    return (link.time >= impact["t_start"]) & (link.time <= end)


def _arrow(axes: Axes, x: np.ndarray, y: np.ndarray) -> None:
    """Direction of a loop, on its rising branch."""
    if x.size < 4:
        return
    rising = int(np.argmax(y))
    middle = max(1, min(int(np.searchsorted(y[: rising + 1], 0.55 * y[rising])), x.size - 2))
    axes.annotate(
        "",
        (x[middle + 1], y[middle + 1]),
        (x[middle - 1], y[middle - 1]),
        arrowprops={"arrowstyle": "-|>", "color": VERMILION, "linewidth": 0.8},
    )
