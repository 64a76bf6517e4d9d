"""Pictures of a study, from its table only."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _arguments as arguments
from pounding._studies.sensitivity import swings
from pounding._studies.summary import readable_unit
from pounding.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pounding._studies.rows import Rows

GRAVITY = 9.80665  #: [m/s^2]
#: Maximum number of fragility curves in a picture.
MAX_CURVES = 6
#: Maximum number of ticks of an axis of a map, all at values that were run.
MAX_TICKS = 8
PICTURES = ("fragility", "ida", "gap", "map", "tornado")


def study_figure(
    study: Rows, picture: str, column: str | None = None, *, size: tuple[float, float] = (5.0, 3.4), **options: Any
) -> Figure:
    """A picture of a study. Options are those of the data: limit and by for a fragility, percent for ida and map,
    across and along for a map, and values of factors. Raises InputError."""
    if picture not in PICTURES:
        raise InputError(f'unknown picture "{picture}"; known: {", ".join(PICTURES)}')
    if column is None and picture != "gap":
        raise InputError(f"specify a column; known: {', '.join(study.columns)}")
    from pounding._pictures import style

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
    divisor, unit = readable_unit(float(sizes[np.isfinite(sizes)].max(initial=0)), study.units.get(column, ""))
    name = _name(column)
    return divisor, f"{name} [{unit}]" if unit else name


def _edge(*values: np.ndarray) -> float:
    """Coordinate of infinite values in pictures, beyond all others."""
    return 1.1 * max((float(each[np.isfinite(each)].max(initial=0)) for each in values), default=0.0) or 1.0


def _drawn(values: np.ndarray, edge: float) -> np.ndarray:
    return np.where(np.isinf(values), edge, values)


def _im_label(study: Rows) -> str:
    intensity = study.description["intensity"]
    if intensity["measure"] == "sa":
        return f"Sa({intensity['period'][0]:g} s) [g]"
    return "PGA [g]" if intensity["measure"] == "pga" else "average Sa [g]"


def _name(column: str) -> str:
    """A readable name of a column: "drift of left, floor 3, with / without links"."""
    quantity, _, rest = column.partition(".")
    about = quantity.replace("_", " ")
    for suffix, text in ((".ratio", " with / without links"), (".alone", " without links")):
        if rest.endswith(suffix):
            rest, about = rest.removesuffix(suffix), about + text
    return f"{about}, {rest.replace('.', ' ')}" if rest else about


def _value_text(study: Rows, name: str, value: float) -> str:
    """A value of a factor with its unit, or its name."""
    labels = next((one["labels"] for one in study.description["factors"] if one["name"] == name), None)
    if labels:
        return str(labels[int(value)])
    divisor, unit = readable_unit(
        float(np.abs(study[name][np.isfinite(study[name])]).max(initial=0)), study.units.get(name, "")
    )
    return f"{value / divisor:.4g} {unit}".strip()


def _curves_by(study: Rows, by: str | None, values: dict[str, Any]) -> tuple[str, list[float]]:
    """The factor with one fragility curve per value, and its values; empty to pool all rows."""
    lists = {
        one["name"]: np.unique(study[one["name"]]).tolist()
        for one in study.description["factors"]
        if one["values"] is not None and one["name"] not in values
    }
    several = {name: found for name, found in lists.items() if len(found) > 1}
    if by == "none":
        return "", []
    if by is None:
        few = [name for name, found in several.items() if len(found) <= MAX_CURVES]
        return (few[0], several[few[0]]) if len(several) == 1 and few else ("", [])
    if by not in several:
        known = f"known: {', '.join(several)}" if several else "no factor has a list of values"
        raise InputError(f'by: takes a factor with several values, or none to pool all rows; "{by}" was read; {known}')
    if len(several[by]) > MAX_CURVES:
        raise InputError(
            f"by: {by} has {len(several[by])} values, and a picture shows at most {MAX_CURVES} curves; choose a value, as in {by}="
            f"{_value_text(study, by, several[by][0])}"
        )
    return by, several[by]


def _fragility(
    axes: Axes, study: Rows, column: str, limit: float | str | None = None, by: str | None = None, **values: Any
) -> None:
    name, levels = _curves_by(study, by, values)
    condition = _name(column)
    if limit is not None:
        value = study.limit_of(column, limit)
        divisor, unit = readable_unit(abs(value), study.units.get(column, ""))
        condition = f"{condition} > {f'{value / divisor:g} {unit}'.strip()}"
    one = [(f"{name} {_value_text(study, name, level)}", {**values, name: level}) for level in levels] or [("", values)]
    is_narrow = _width(axes) < 4.5
    problems, unfitted = [], []
    for i, (label, chosen) in enumerate(one):
        try:
            curve = study.fragility(column, limit, **chosen)
        except InputError as error:
            if not levels:
                raise
            problems.append(f"{label}: {error}")
            continue
        colour = f"C{i}" if levels else "black"
        at: dict[str, Any] = {"color": colour, "markersize": 3 if levels else 4}
        axes.plot(
            curve.im / GRAVITY, curve.exceeded / curve.count, "o", label=None if levels else "fraction of rows", **at
        )
        if not curve.is_finite:
            if not levels:
                problems.append(curve.problem)
            else:
                unfitted.append(label)
                axes.plot([], [], "o", label=f"{label}, no fit", **at)
            continue
        im = np.linspace(1e-3, 1.2 * curve.im.max(), 300)
        fitted = f"theta {curve.theta / GRAVITY:.3g} g, beta {curve.beta:.3g}"
        axes.plot(
            im / GRAVITY,
            curve.probability(im),
            color=colour if levels else "C0",
            label=label if label and is_narrow else f"{label}: {fitted}" if label else fitted,
        )
        if curve.boot is not None and len(curve.boot):
            axes.fill_between(
                im / GRAVITY,
                *curve.band(im),
                alpha=0.12 if levels else 0.2,
                color=colour if levels else "C0",
                linewidth=0,
                label=None if levels else "5 to 95 %, records drawn again",
            )
    if unfitted:
        problems.append(f"no finite fit of {', '.join(unfitted)}: add levels or records")
    _head(axes, [condition, _pooled(study, [name, *values]), *problems])
    axes.set(xlabel=_im_label(study), ylabel="probability of exceedance", ylim=(-0.02, 1.02))
    axes.set_xlim(left=0)
    axes.legend(fontsize=6 if is_narrow else 7)


def _pooled(study: Rows, chosen: list[str]) -> str:
    """Factors whose values are taken together, for the title."""
    others = [
        one["name"]
        for one in study.description["factors"]
        if one["values"] is not None and one["name"] not in chosen and len(np.unique(study[one["name"]])) > 1
    ]
    return f"all values of {', '.join(others)} together" if others else ""


def _width(axes: Axes) -> float:
    """Width of the figure of a panel [in]."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    return float(figure.get_figwidth())


def _head(axes: Axes, lines: list[str]) -> None:
    """Small title of a panel, wrapped to its width."""
    width = max(30, int(14 * _width(axes)))
    axes.set_title("\n".join(part for line in lines if line for part in textwrap.wrap(line, width)), fontsize=7)


def _ida(axes: Axes, study: Rows, column: str, percent: Sequence[float] = (16, 50, 84), **values: Any) -> None:
    study._im()
    chosen = study.choose(**values)
    divisor, label = _axis(study, column)
    # Lines join the levels of one record, separately for each point of the factors.
    curves = np.unique(np.column_stack([study["record"][chosen], study["point"][chosen]]), axis=0)
    found = study.percentiles(column, percent, **values)
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
    middle = found.percent[len(found.percent) // 2]
    for one, curve in zip(found.percent, found.values):
        style = "-" if one == middle else "--"
        finite = np.isfinite(curve)
        axes.plot(
            curve[finite] / divisor,
            found.im[finite] / GRAVITY,
            style,
            color="black",
            marker="o",
            markersize=3,
            label=f"{one:g} %",
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
    _head(axes, [_pooled(study, list(values))])
    axes.set(xlabel="gap [mm]", ylabel="probability of contact", ylim=(0, 1))
    axes.set_xlim(left=0)
    axes.legend(fontsize=7)


def _map(axes: Axes, study: Rows, column: str, across: str, along: str, percent: float = 50, **values: Any) -> None:
    from matplotlib import colormaps
    from matplotlib.colors import CenteredNorm, Normalize

    found = study.map(column, across, along, percent, **values)
    (width, xlabel), (height, ylabel), (depth, label) = (_axis(study, each) for each in (across, along, column))
    drawn = np.ma.masked_where(np.isnan(found.values), _drawn(found.values, _edge(found.values)) / depth)
    # Infinite percentiles have the colour above the range.
    infinite = np.isinf(found.values).any()
    finite = found.values[np.isfinite(found.values)] / depth
    is_ratio = column.endswith(".ratio")
    if is_ratio:
        # White is 1: the links change nothing.
        half = max(float(np.abs(finite - 1).max(initial=0)), 1e-3)
        colours = colormaps["RdBu_r"].with_extremes(over="black")
        norm: Normalize = CenteredNorm(1, half)
    else:
        low, high = (0.0, float(finite.max(initial=0)) or 0.5) if infinite else (None, None)
        colours = colormaps["viridis"].with_extremes(over="tab:red")
        norm = Normalize(low, high)
    mesh = axes.pcolormesh(
        found.across / width, found.along / height, drawn, shading="nearest", cmap=colours, norm=norm
    )
    is_narrow = _width(axes) < 4.5
    bar = axes.figure.colorbar(mesh, ax=axes, extend="max" if infinite else "neither")
    about = f"{label}, {'median' if percent == 50 else f'{percent:g} %'}"
    if infinite:
        about += f" ({'black' if is_ratio else 'red'}: collapsed)"
    bar.set_label("\n".join(textwrap.wrap(about, 30 if is_narrow else 44)), fontsize=6.5 if is_narrow else 8)
    for axis, name, levels, size in (
        (axes.xaxis, across, found.across, width),
        (axes.yaxis, along, found.along, height),
    ):
        shown = levels[:: -(-len(levels) // (MAX_TICKS // 2 if is_narrow else MAX_TICKS))]
        labels = next((one["labels"] for one in study.description["factors"] if one["name"] == name), None)
        axis.set_ticks(shown / size, [labels[int(one)] if labels else f"{one / size:.3g}" for one in shown])
    _head(axes, [_pooled(study, [across, along, *values])])
    axes.grid(False)
    axes.set(xlabel=xlabel, ylabel=ylabel)


def _tornado(axes: Axes, study: Rows, column: str, **values: Any) -> None:
    from matplotlib.patches import Patch

    found = swings(study, column, **values)
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
    text = f"median of {label}{beyond}, lowest against highest tenth of each factor"
    axes.set_xlabel("\n".join(textwrap.wrap(text, max(30, int(13 * _width(axes))))))
