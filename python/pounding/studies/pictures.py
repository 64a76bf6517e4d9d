"""Pictures of a study, from its table only."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import arguments
from pounding.errors import InputError
from pounding.studies.indices import swings

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pounding.studies.rows import Rows

GRAVITY = 9.80665  #: [m/s^2]
PICTURES = ("fragility", "ida", "gap", "map", "tornado")


def study_figure(
    study: Rows, picture: str, column: str | None = None, *, size: tuple[float, float] = (5.0, 3.4), **options: Any
) -> Figure:
    """A picture of a study. Options are those of the data: limit for a fragility, across and along for a map, and
    values of factors except for map and tornado. Raises InputError."""
    if picture not in PICTURES:
        raise InputError(f'unknown picture "{picture}"; known: {", ".join(PICTURES)}')
    if column is None and picture != "gap":
        raise InputError(f"specify a column; known: {', '.join(study.columns)}")
    from pounding.pictures import style

    ways: dict[str, Callable[..., None]] = {
        "fragility": _fragility,
        "ida": _ida,
        "gap": _gap,
        "map": _map,
        "tornado": _tornado,
    }
    arguments.options_of(ways[picture], options, 3)
    size = arguments.size("size", size)
    with style.picture(size) as figure:
        ways[picture](figure.subplots(), study, column or "", **options)
        return figure


def _axis(study: Rows, column: str) -> tuple[float, str]:
    """Scale factor and label of a column in pictures."""
    sizes = np.abs(study[column])
    divisor, unit = _unit(float(sizes[np.isfinite(sizes)].max(initial=0)), study.units.get(column, ""))
    return divisor, f"{column} [{unit}]" if unit else column


def _edge(*values: np.ndarray) -> float:
    """Coordinate of infinite values in pictures, beyond all others."""
    return 1.1 * max((float(each[np.isfinite(each)].max(initial=0)) for each in values), default=0.0) or 1.0


def _drawn(values: np.ndarray, edge: float) -> np.ndarray:
    return np.where(np.isinf(values), edge, values)


def _unit(size: float, unit: str) -> tuple[float, str]:
    from pounding.pictures.style import FORCE_UNITS, engineering

    if unit == "N":
        return engineering(size, FORCE_UNITS)
    return (1e-3, "mm") if unit == "m" and size < 1 else (1.0, unit)


def _im_label(study: Rows) -> str:
    intensity = study.description["intensity"]
    if intensity["measure"] == "sa":
        return f"Sa({intensity['period'][0]:g} s) [g]"
    return "PGA [g]" if intensity["measure"] == "pga" else "average Sa [g]"


def _fragility(axes: Axes, study: Rows, column: str, limit: float | str | None = None, **values: Any) -> None:
    curve = study.fragility(column, limit, **values)
    share = curve.exceeded / curve.count
    condition = column
    if limit is not None:
        value = study.limit_of(column, limit)
        divisor, unit = _unit(abs(value), study.units.get(column, ""))
        condition = f"{column} > {f'{value / divisor:g} {unit}'.strip()}"
    axes.plot(curve.im / GRAVITY, share, "o", color="black", markersize=4, label=f"share of rows, {condition}")
    if curve.is_finite:
        im = np.linspace(1e-3, 1.2 * curve.im.max(), 300)
        axes.plot(
            im / GRAVITY, curve.probability(im), label=f"theta {curve.theta / GRAVITY:.3g} g, beta {curve.beta:.3g}"
        )
        if curve.boot is not None and len(curve.boot):
            axes.fill_between(im / GRAVITY, *curve.band(im), alpha=0.2, label="5 to 95 %, records drawn again")
    else:
        axes.set_title(curve.problem, fontsize=7, wrap=True)
    axes.set(xlabel=_im_label(study), ylabel="probability", ylim=(-0.02, 1.02))
    axes.set_xlim(left=0)
    axes.legend(fontsize=7)


def _ida(axes: Axes, study: Rows, column: str, **values: Any) -> None:
    chosen = study.choose(**values)
    divisor, label = _axis(study, column)
    # Lines join the levels of one record, separately for each point of the factors.
    curves = np.unique(np.column_stack([study["record"][chosen], study["point"][chosen]]), axis=0)
    found = study.percentiles(column, **values)
    edge = _edge(study[column][chosen])
    name: str | None = "a record" if len(np.unique(curves[:, 1])) == 1 else "a record with one set of factors"
    for record, point in curves:
        rows = chosen & (study["record"] == record) & (study["point"] == point)
        order = np.argsort(study["im"][rows])
        axes.plot(
            _drawn(study[column][rows][order], edge) / divisor,
            study["im"][rows][order] / GRAVITY,
            color="0.75",
            linewidth=0.6,
            marker="o",
            markersize=2,
            label=name,
        )
        name = None
    for percent, curve, style in zip(found.percent, found.values, ("--", "-", "--")):
        finite = np.isfinite(curve)
        axes.plot(
            curve[finite] / divisor,
            found.im[finite] / GRAVITY,
            style,
            color="black",
            marker="o",
            markersize=3,
            label=f"{percent:g} %",
        )
    if (infinite := chosen & np.isinf(study[column])).any():
        axes.plot(
            np.full(int(infinite.sum()), edge) / divisor,
            study["im"][infinite] / GRAVITY,
            ">",
            color="tab:red",
            markersize=4,
            label="collapsed",
        )
    axes.set(xlabel=label, ylabel=_im_label(study))
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend()


def _gap(axes: Axes, study: Rows, column: str, **values: Any) -> None:
    curve = study.gaps(**values)
    gap = np.linspace(0, _edge(curve.gap), 200)
    axes.plot(
        1e3 * gap,
        [curve.exceedance(f"{one!r} m") for one in gap.tolist()],
        color="black",
        label="share of rows that need more",
    )
    low, high = np.array([curve.band(f"{one!r} m") for one in gap.tolist()]).T
    axes.fill_between(1e3 * gap, low, high, alpha=0.2, label=f"90 % (Clopper and Pearson, {curve.independent} events)")
    for name, style in zip(curve.rules, ("--", "-.", ":")):
        if not np.isfinite(np.median(curve.rules[name])):
            continue
        axes.axvline(
            1e3 * float(np.median(curve.rules[name])),
            linestyle=style,
            color="tab:red",
            linewidth=1,
            label=f"{name.upper()}, median",
        )
    axes.set(xlabel="gap [mm]", ylabel="probability of contact", ylim=(0, 1))
    axes.set_xlim(left=0)
    axes.legend(fontsize=7)


def _map(axes: Axes, study: Rows, column: str, across: str, along: str, percent: float = 50) -> None:
    from matplotlib import colormaps

    found = study.map(column, across, along, percent)
    (width, xlabel), (height, ylabel), (depth, label) = (_axis(study, each) for each in (across, along, column))
    drawn = np.ma.masked_where(np.isnan(found.values), _drawn(found.values, _edge(found.values)) / depth)
    # Infinite percentiles have the colour above the range.
    infinite = np.isinf(found.values).any()
    low, high = (
        (0, float(found.values[np.isfinite(found.values)].max(initial=0)) / depth or 0.5) if infinite else (None, None)
    )
    colours = colormaps["viridis"].with_extremes(over="tab:red")
    mesh = axes.pcolormesh(
        found.across / width, found.along / height, drawn, shading="nearest", cmap=colours, vmin=low, vmax=high
    )
    axes.figure.colorbar(
        mesh,
        ax=axes,
        label=f"{label}, {percent:g} %{' (red: collapsed)' if infinite else ''}",
        extend="max" if infinite else "neither",
    )
    axes.set(xlabel=xlabel, ylabel=ylabel)


def _tornado(axes: Axes, study: Rows, column: str) -> None:
    from matplotlib.patches import Patch

    found = swings(study, column)
    medians = np.array([median for _, *both in found for median in both])
    edge = _edge(medians)
    found = [(name, *_drawn(np.array(both), edge).tolist()) for name, *both in found]
    divisor, label = _axis(study, column)
    for i, (_, low, high) in enumerate(reversed(found)):
        axes.barh(
            i, (high - low) / divisor, left=low / divisor, height=0.6, color="tab:blue" if high > low else "tab:orange"
        )
    axes.use_sticky_edges = False
    axes.margins(x=0.08)
    axes.legend(
        handles=[
            Patch(color="tab:blue", label="rises with the factor"),
            Patch(color="tab:orange", label="falls with the factor"),
        ],
        fontsize=7,
        loc="lower center",
        bbox_to_anchor=(0.5, 1),
        ncols=2,
    )
    axes.set_yticks(range(len(found)), [name for name, _, _ in reversed(found)])
    beyond = "; the right end is collapse" if np.isinf(medians).any() else ""
    axes.set_xlabel(f"median of {label}{beyond}, lowest against highest tenth of each factor")
