"""Profiles of a suite over the height, with and without pounding."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator

from pounding import _arguments as arguments
from pounding._pictures import style
from pounding._studies.suite_data import SuiteData
from pounding._studies.suite_report import FLOORS
from pounding.errors import InputError

#: Colours of runs with links, and without them.
WITH, WITHOUT = "#B2182B", "#2166AC"
#: Percentile that is drawn in addition to the mean.
PERCENT = 84.0
#: Quantities of a wide figure.
DEFAULT = ("displacement", "drift_ratio", "acceleration", "storey_shear")
SHORT = {"displacement": "displ.", "acceleration": "accel.", "storey_shear": "shear", "residual_drift": "resid. drift"}


def profiles_figure(
    suite: SuiteData,
    quantities: Sequence[str] | None = None,
    *,
    percent: float = PERCENT,
    compare: bool | None = None,
    size: tuple[float, float] | None = None,
    title: str | None = None,
) -> Figure:
    """Profiles of all structures, one row of panels per structure and one panel per quantity.

    Records are thin lines; the mean is a thick line, and the percentile a thick dashed one. The run without links has
    another colour, unless `compare` is False. Figures narrower than 4.5 in have one panel per structure. Collapsed records end
    at the edge of the panel. Raises InputError."""
    percent = arguments.number(0, 100)("percent", percent)
    names = [name for name in suite.structures if suite.structure(name)["floors"]]
    if not names:
        raise InputError("no profiles to draw: no structure of this suite has floors")
    if compare and not suite.has_comparison:
        raise InputError("the suite has no run without links; add compare: no_pounding to the model")
    is_narrow = size is not None and arguments.size("size", size)[0] < style.NARROW
    known = list(dict.fromkeys(each for name in names for each in suite.structure(name)["quantities"]))
    chosen = [each for each in DEFAULT if each in known] if quantities is None else list(quantities)
    for each in chosen:
        if each not in known:
            raise InputError(f'unknown quantity "{each}"; known: {", ".join(known)}')
    if is_narrow and quantities is None:
        chosen = ["drift_ratio" if "drift_ratio" in chosen else chosen[0]]
    rows, columns = (1, len(names)) if len(chosen) == 1 else (len(names), len(chosen))
    width, height = size or (max(3.3, 1.9 * columns), 0.8 + 2.6 * rows)
    has_alone = suite.has_comparison and compare is not False
    with style.picture(
        (width, height), suite.description["model"].get("title", "") if title is None else title
    ) as figure:
        every = figure.subplots(rows, columns, squeeze=False)
        places = [(name, each) for name in names for each in chosen]
        for i, (axes, (name, each)) in enumerate(zip(every.flat, places)):
            if each in suite.structure(name)["quantities"]:
                draw_panel(axes, suite, name, each, percent, has_alone, is_narrow)
                if i % columns == 0:
                    axes.set_ylabel(height_label(suite, name))
            else:
                axes.set_axis_off()
        _legend(figure, percent, has_alone, is_narrow)
    return figure


def draw_panel(
    axes: Axes, suite: SuiteData, name: str, quantity: str, percent: float, has_alone: bool, is_narrow: bool = False
) -> None:
    """Profiles of one quantity of a structure; `is_narrow` for small panels."""
    title, unit, size = FLOORS[quantity]
    runs = [(False, WITH)] + ([(True, WITHOUT)] if has_alone else [])
    drawn = [(suite.floors(name, quantity, alone=alone)[suite.finished] / size, colour) for alone, colour in runs]
    finite = np.concatenate([values[np.isfinite(values)] for values, _ in drawn])
    edge = 1.1 * float(finite.max(initial=0)) or 1.0
    if quantity == "storey_shear" and edge > 1e4:
        drawn, edge, unit = [(values / 1e3, colour) for values, colour in drawn], edge / 1e3, "MN"
    heights, storeys = _heights(suite.structure(name))
    of_storeys = quantity in ("drift", "drift_ratio", "storey_shear", "residual_drift")
    at = storeys if of_storeys else heights[1:]
    for values, colour in reversed(drawn):
        for one in values:
            axes.plot(np.where(np.isinf(one), edge, one), at, color=colour, linewidth=0.5, alpha=0.35)
    for values, colour in reversed(drawn):
        found = suite.statistics(_all_rows(suite, values), (percent,))
        for line, dashes in ((found.mean, "-"), (found.percentiles[0], (0, (3, 1.5)))):
            axes.plot(np.where(np.isinf(line), edge, line), at, color=colour, linewidth=1.8, linestyle=dashes)
    axes.set_xlim(0, edge)
    axes.set_ylim(heights[0], heights[-1])
    axes.xaxis.set_major_locator(MaxNLocator(3 if is_narrow else 4))
    axes.yaxis.set_major_locator(MaxNLocator(4 if is_narrow else 6))
    axes.set_xlabel(f"{SHORT.get(quantity, title) if is_narrow else title} [{unit}]")
    axes.set_title(name, fontsize=8)


def height_label(suite: SuiteData, name: str) -> str:
    """Label of the vertical axis of a structure."""
    return "height [m]" if suite.structure(name)["heights"] else "floor"


def _all_rows(suite: SuiteData, finished: np.ndarray) -> np.ndarray:
    """[record, floor] with NaN for unfinished records, as `statistics` expects."""
    found = np.full((len(suite), finished.shape[1]), np.nan)
    found[suite.finished] = finished
    return found


def _heights(one: Any) -> tuple[np.ndarray, np.ndarray]:
    """Heights of base and floors, and those in the middle of storeys [m]; numbers of floors if heights are unknown."""
    steps = np.array(one["heights"]) if one["heights"] else np.ones(one["floors"])
    heights = np.concatenate([[0.0], np.cumsum(steps)])
    return heights, (heights[1:] + heights[:-1]) / 2


def legend_lines(percent: float, has_alone: bool) -> list[Line2D]:
    """Lines of the legend."""
    grey = "0.3"
    handles = [
        Line2D([], [], color=grey, linewidth=0.5, alpha=0.6, label="one record"),
        Line2D([], [], color=grey, linewidth=1.8, label="mean"),
        Line2D([], [], color=grey, linewidth=1.8, linestyle=(0, (3, 1.5)), label=f"{percent:g} %"),
    ]
    if has_alone:
        handles += [Line2D([], [], color=WITH, linewidth=1.8, label="with pounding")]
        handles += [Line2D([], [], color=WITHOUT, linewidth=1.8, label="without")]
    return handles


def _legend(figure: Figure, percent: float, has_alone: bool, is_narrow: bool) -> None:
    handles = legend_lines(percent, has_alone)
    figure.legend(
        handles=handles,
        loc="outside lower center",
        ncols=3 if is_narrow else len(handles),
        fontsize=6 if is_narrow else 7.5,
        frameon=False,
        columnspacing=1.0,
        handlelength=1.8,
    )
