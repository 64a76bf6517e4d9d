"""Map in plan: structures coloured by peak drift, and pairs of neighbours by their hardest impact; next to it the run
without links."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from pounding._pictures.comparison import require_comparison
from pounding._pictures.drawing import are_many
from pounding._pictures.geometry import levels, outline
from pounding._pictures.panels import note, strength_of
from pounding._pictures.scene import Scene
from pounding._pictures.style import FORCE_UNITS, IMPULSE_UNITS, NARROW, BadRequest, engineering, largest, picture
from pounding.results import RunData, Structure

#: From little to much: drifts of structures, and forces between them.
DRIFTS, FORCES = colormaps["YlOrRd"], colormaps["Blues"]
#: Range of letter sizes [points].
SMALLEST, LARGEST = 4.5, 8.0
#: Width of a letter over its size, with some air.
LETTER = 0.62

#: Height below which a narrow figure has one plan [in].
LOW = 4.0


@dataclass(frozen=True)
class Contact:
    """Contact line of two neighbours in plan."""

    ends: np.ndarray  #: [2, 2]: the two outermost points of contact, in the middle of the gap [m]
    strength: float  #: of the hardest impact at any height [N], or [N s] if all are rigid; 0 for none
    impacts: int


def plan_figure(
    run: RunData, title: str | None = None, size: tuple[float, float] | None = None, compare: bool | None = None
) -> Figure:
    """Plan of the structures of a run, coloured and labelled by the peak drift ratio of all storeys along x and y
    [%].

    Lines between neighbours are coloured by the peak force of the hardest impact at any height; thin and grey without
    impacts. The run without links, if available, is drawn next to it with the same colours, unless `compare` is False or
    `size` [in] is too small. Raises BadRequest for a run without frames in space, and if `compare` is True without a run to
    compare."""
    scene = Scene(run)
    drawn = [
        name
        for name, structure in run.structures.items()
        if structure.dimension == 3 and structure.geometry is not None
    ]
    if not drawn or not run.envelopes:
        raise BadRequest(
            'no plan to draw: no structure of this run is a frame in space. Draw --picture profiles, in Python "profiles"'
        )
    if compare:
        require_comparison(run, "plan")
    # A small picture has room for one plan.
    small = compare is None and size is not None and size[0] < NARROW and size[1] < LOW
    runs = [run] if run.no_pounding is None or compare is False or small else [run, run.no_pounding]
    drifts = [{name: largest_drift(each, each.structures[name]) for name in drawn} for each in runs]
    found = contacts(run)
    rigid = run.impacts.size > 0 and strength_of(run) == "impulse"
    width, depth = np.ptp(scene.bounds()[:2], axis=1)
    narrow = size is not None and size[0] < NARROW
    stacked = len(runs) > 1 and (width > 1.6 * depth or narrow)
    rows, columns = (len(runs), 1) if stacked else (1, len(runs))
    with picture(size or _size(width, depth, rows, columns), run.title if title is None else title) as figure:
        panels = figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True).ravel()
        norm = Normalize(0, max(max(values.values()) for values in drifts) or 1.0)
        hardest = max((contact.strength for contact in found), default=0.0)
        unit, name_of_unit = engineering(hardest, IMPULSE_UNITS if rigid else FORCE_UNITS)
        force_norm = Normalize(0, hardest / unit or 1.0)
        points = 72 * 0.8 * figure.get_figwidth() / columns / (1.16 * max(width, depth, 1e-9))  # of one metre
        for number, (axes, values) in enumerate(zip(panels, drifts)):
            axes.grid(False)
            for name in drawn:
                _draw_structure(axes, name, scene.at_rest(name)[:, :2], values[name], norm, points)
            if number == 0:
                for contact in sorted(found, key=lambda one: one.strength):
                    _draw_contact(axes, contact, contact.strength / unit, force_norm, 0.6 if are_many(scene) else 1.0)
            if len(runs) > 1:
                axes.set_title(f"({'ab'[number]}) {('With its neighbours', 'Each alone')[number]}")
            _frame(axes, scene, first_column=columns == 1 or number == 0, last_row=rows == 1 or number == len(runs) - 1)
        horizontal: dict[str, Any] = (
            {"location": "bottom", "shrink": 0.6, "aspect": 30, "pad": 0.02}
            if narrow
            else {"location": "right", "shrink": 0.75, "aspect": 24, "pad": 0.02}
        )
        figure.colorbar(
            ScalarMappable(norm, DRIFTS), ax=list(panels), label="Largest storey drift [% of height]", **horizontal
        )
        if hardest > 0:
            label = f"{'Impulse' if rigid else 'Peak force'} between neighbours [{name_of_unit}]"
            figure.colorbar(ScalarMappable(force_norm, FORCES), ax=list(panels), label=label, **horizontal)
        return figure


def largest_drift(run: RunData, structure: Structure) -> float:
    """Peak drift ratio of any storey along x or y [%], over all steps of the run."""
    drift = run.envelopes[structure.name].drift
    if drift is None:
        return 0.0
    return 100 * float((drift.peak[:, :2] / np.diff(levels(structure))[:, None]).max())


def contacts(run: RunData) -> list[Contact]:
    """One contact for every linked pair of structures, over all floors."""
    rows = {name: run.impacts_of(name) for name in run.links}
    pairs: dict[tuple[str, str], list[str]] = {}
    for name, link in run.links.items():
        if link.position is not None:
            pairs.setdefault((link.left, link.right), []).append(name)
    found = []
    for names in pairs.values():
        links = [run.links[name] for name in names]
        places = np.array([np.asarray(link.position)[:2] + 0.5 * link.gap * link.direction[:2] for link in links])
        across = np.array([-links[0].direction[1], links[0].direction[0]])
        order = np.argsort(places @ across, kind="stable")
        strongest = largest([rows[name][strength_of(run)] for name in names])
        found.append(Contact(places[order[[0, -1]]], strongest, sum(len(rows[name]) for name in names)))
    return found


def _draw_structure(
    axes: Axes, name: str, points: np.ndarray, drift: float, norm: Normalize, points_of_metre: float
) -> None:
    corners = outline(points)
    colour = DRIFTS(norm(drift))
    axes.fill(*corners.T, facecolor=colour, edgecolor="0.25", linewidth=0.6, zorder=2)
    (x0, y0), (x1, y1) = corners.min(axis=0), corners.max(axis=0)
    room = points_of_metre * np.array([x1 - x0, y1 - y0])
    ink = "white" if norm(drift) > 0.65 else "black"
    value = f"{drift:.{_decimals(norm)}f}"
    size = min(LARGEST, 0.9 * room[0] / (LETTER * len(value)), 0.8 * room[1])
    if size < SMALLEST:
        return
    # Names that do not fit are omitted; others are above the number if both fit.
    name_size = min(LARGEST, 0.9 * room[0] / (LETTER * len(name)), 0.38 * room[1])
    named = name_size >= SMALLEST
    middle = (x0 + x1) / 2, (y0 + y1) / 2
    style: dict[str, Any] = {"ha": "center", "va": "center", "color": ink, "zorder": 5}
    note(axes, value, middle, (0, -0.6 * size if named else 0), fontsize=size, **style)
    if named:
        note(axes, name, middle, (0, 0.65 * name_size), fontsize=name_size, fontweight="bold", **style)


def _decimals(norm: Normalize) -> int:
    """Number of decimals for at least two digits of the largest drift."""
    largest = float(norm.vmax or 1.0)
    return int(np.clip(1 - np.floor(np.log10(largest)), 1, 5)) if largest > 0 else 1


def _draw_contact(axes: Axes, contact: Contact, strength: float, norm: Normalize, scale: float) -> None:
    """Draws a bar in the gap, in order of increasing force."""
    if contact.impacts == 0:
        axes.plot(*contact.ends.T, color="0.45", linewidth=scale, linestyle=(0, (2, 1.5)), zorder=3)
        return
    shorter = contact.ends.mean(axis=0) + 0.92 * (contact.ends - contact.ends.mean(axis=0))
    for colour, width, order in (("black", 4.0, 3.4), (FORCES(norm(strength)), 2.8, 3.5)):
        axes.plot(*shorter.T, color=colour, linewidth=scale * width, solid_capstyle="round", zorder=order)


def _frame(axes: Axes, scene: Scene, first_column: bool, last_row: bool) -> None:
    (x0, x1), (y0, y1), _ = scene.bounds()
    margin = 0.04 * max(x1 - x0, y1 - y0, 1.0)
    axes.set(xlim=(x0 - margin, x1 + margin), ylim=(y0 - margin, y1 + margin))
    axes.set_aspect("equal")
    if last_row:
        axes.set_xlabel("x [m]")
    if first_column:
        axes.set_ylabel("y [m]")


def _size(width: float, depth: float, rows: int, columns: int) -> tuple[float, float]:
    """Width and height of the figure [in]: those of the plan in proportion, within a page."""
    panel = 5.6 / columns
    return 7.5, float(np.clip(rows * panel * depth / max(width, 1e-9) + 1.25, 3.0, 8.5))
