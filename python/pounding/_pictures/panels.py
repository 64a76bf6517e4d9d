"""Common parts of panels: time axis, lines of links, legends."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Annotation

from pounding._pictures.style import LINK_COLOURS, QUIET, TIME_UNITS, largest
from pounding.results import Link, RunData

#: Start of the suffix of structures without links along the direction of a panel.
NO_LINK = " (no link along"


def time_unit(run: RunData) -> tuple[float, str]:
    """The (size [s], name) of the unit in which the time of a run is drawn."""
    span = run.time[-1] - run.time[0] if run.time.size else 0.0
    return TIME_UNITS[1] if 0 < span < 0.5 else TIME_UNITS[0]


def plot_time(axes: Axes, run: RunData, time: np.ndarray, values: np.ndarray, **style: Any) -> None:
    """Line over the whole time of the run; `time` [s]."""
    axes.plot(time / time_unit(run)[0], values, **style)
    axes.margins(x=0)


def label_time(axes: Axes, run: RunData) -> None:
    """Labels the time axis in the unit of the run, from its start to its end."""
    size, unit = time_unit(run)
    axes.set_xlabel(f"Time [{unit}]")
    if run.time.size > 1:
        axes.set_xlim(run.time[0] / size, run.time[-1] / size)


def link_styles(run: RunData) -> Iterator[tuple[Link, dict[str, Any]]]:
    """Each link with its line style: the hardest hit in colour, the others grey and behind them."""
    peaks = {name: largest([run.impacts_of(name)["peak_force"]]) for name in run.links}
    chosen = sorted(run.links, key=lambda name: -peaks[name])[: len(LINK_COLOURS)]
    chosen = [name for name in run.links if name in chosen]
    others = [name for name in run.links if name not in chosen]
    for i, name in enumerate(others):
        words = f"{len(others)} other link" + ("s" if len(others) > 1 else "")
        yield run.links[name], {"color": QUIET, "linewidth": 0.7, "label": words if i == 0 else None, "zorder": 1}
    for name, colour in zip(chosen, LINK_COLOURS):
        # Weaker spikes stay visible in front of stronger ones of the same moment.
        rank = sum(peaks[other] > peaks[name] for other in chosen)
        yield run.links[name], {"color": colour, "label": name, "zorder": 2 + 0.1 * rank}


def strength_of(run: RunData) -> str:
    """Column of the strength of impacts: the impulse if all are rigid, which have no finite force."""
    return "peak_force" if np.isfinite(run.impacts["peak_force"]).any() else "impulse"


def note(axes: Axes, words: str, at: Any, offset: tuple[float, float], **style: Any) -> Annotation:
    """Text at an offset [points] from a point."""
    return axes.annotate(words, at, offset, textcoords="offset points", **style)


def say(axes: Axes, words: str) -> None:
    """Text at the centre of an empty panel."""
    axes.text(0.5, 0.5, words, transform=axes.transAxes, ha="center", va="center", color="0.35", fontsize=9)
    axes.set_yticks([])


def legend_beside(axes: Axes, reverse: bool = False) -> None:
    """Legend outside the axes on the right."""
    handles, labels = axes.get_legend_handles_labels()
    if handles:
        axes.legend(handles, labels, loc="upper left", bbox_to_anchor=(1.01, 1), reverse=reverse)


def key(label: str, marker: Any, size: float, face: Any, edge: str = "black", **style: Any) -> Line2D:
    """A marker for a legend."""
    style = {"markeredgewidth": 0.5, "markerfacecolor": face, "markeredgecolor": edge, **style}
    return Line2D([], [], linestyle="none", marker=marker, markersize=size, label=label, **style)


def legend_below(figure: Figure, handles: Sequence[Any], labels: Sequence[str], limit: int) -> None:
    """Legend under all panels, in as many columns as fit into the width of the figure, at most `limit`."""
    if not handles:
        return
    canvas: Any = FigureCanvasAgg(figure)
    renderer = canvas.get_renderer()
    for columns in range(min(limit, len(handles)), 0, -1):
        legend = figure.legend(handles, labels, loc="outside lower center", ncols=columns)
        if columns == 1 or legend.get_window_extent(renderer).width <= 0.94 * figure.bbox.width:
            return
        legend.remove()


def gather_legends(figure: Figure, panels: Sequence[Axes]) -> None:
    """One legend below all panels instead of one per panel. A structure that is linked in only one panel has one
    entry."""
    entries: dict[str, Any] = {}
    for axes in panels:
        handles, labels = axes.get_legend_handles_labels()
        entries |= {
            label.split(NO_LINK)[0]: handle
            for label, handle in zip(labels, handles)
            if NO_LINK not in label or label.split(NO_LINK)[0] not in entries
        }
        legend = axes.get_legend()
        if legend is not None:
            legend.remove()
    legend_below(figure, list(entries.values()), list(entries), 3)
