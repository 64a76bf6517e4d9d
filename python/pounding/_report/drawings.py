"""Drawings of a report, each in a box of a figure: the model, the ground motion with its spectrum, and bars."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pounding._pictures.drawing import project
from pounding._pictures.hinge_map import placed_parts
from pounding._pictures.model_picture import TITLES, draw_model, spread_scene
from pounding._pictures.panels import label_time, plot_time
from pounding._pictures.profiles import DASHED, SOLID, draw_drift, height_label
from pounding._pictures.scene import Scene
from pounding._pictures.style import BLUE, GREEN, ORANGE, VERMILION
from pounding._pictures.worst import draw_worst, ranked
from pounding._spectra import GRAVITY, Spectrum
from pounding.results import RunData

Box = tuple[float, float, float, float]
#: Colours of directions.
COLOURS = {"x": BLUE, "y": VERMILION, "z": GREEN}
LETTERS = 7  #: [points]
#: Largest number of structures in a picture of drifts, and of letters in a name.
MOST_DRIFTS, MOST_LETTERS = 8, 22


def axes_in(figure: Figure, box: Box, margins: tuple[float, float, float, float]) -> Axes:
    """Axes in a box of a figure, with margins left, bottom, right and top [in]."""
    width, height = figure.get_size_inches()
    left, bottom, right, top = margins
    axes = figure.add_axes(
        (
            box[0] + left / width,
            box[1] + bottom / height,
            max(box[2] - (left + right) / width, 0.01),
            max(box[3] - (bottom + top) / height, 0.01),
        )
    )
    axes.tick_params(labelsize=LETTERS)
    return axes


def model_drawing(figure: Figure, box: Box, run: RunData) -> None:
    """The model at rest: an elevation; in space also a plan. Diamonds are links, triangles supports, circles hinges,
    squares isolators, dashed lines devices. On the right are the drifts, if the structures have storeys."""
    if has_drifts(run):
        _draw_drifts(figure, (box[0] + 0.68 * box[2], box[1], 0.32 * box[2], box[3]), run)
        box = (box[0], box[1], 0.68 * box[2], box[3])
    scene = Scene(run)
    if not scene.has_places:
        scene = spread_scene(run, 0.04)
    views = ["elevation", "plan"] if scene.is_spatial else ["elevation"]
    for i, view in enumerate(views):
        part = (box[0] + i * box[2] / len(views), box[1], box[2] / len(views), box[3])
        axes = axes_in(figure, part, (0.45, 0.38, 0.3, 0.14))
        draw_model(axes, scene, view)
        left, right = axes.get_xlim()
        axes.set_xlim(left - 0.06 * (right - left), right + 0.06 * (right - left))  # room for labels of floors
        for text in axes.texts:
            text.set_fontsize(LETTERS)
            text.set_text(_short(text.get_text()))
        if len(views) > 1:
            axes.set_title(TITLES[view], fontsize=LETTERS)
        _draw_parts(axes, scene, view)
        axes.xaxis.label.set_fontsize(LETTERS)
        axes.yaxis.label.set_fontsize(LETTERS)


def has_drifts(run: RunData) -> bool:
    """True if the structures of the run have storeys, and are few enough for a picture of their drifts."""
    moving = [one for one in run.envelopes.values() if one.drift is not None]
    return 0 < len(moving) <= MOST_DRIFTS


def _draw_drifts(figure: Figure, box: Box, run: RunData) -> None:
    """Extreme drifts over the height, dashed without links."""
    axes = axes_in(figure, box, (0.42, 0.4, 0.08, 0.16))
    runs = [(run, SOLID)]
    if run.no_pounding is not None:
        runs.append((run.no_pounding, DASHED))
    draw_drift(axes, runs)
    axes.set_title("", fontsize=LETTERS)
    axes.set_ylabel(height_label([one for one in run.structures.values() if one.floors]))
    _small(axes, 1)


def _draw_parts(axes: Axes, scene: Scene, view: str) -> None:
    """Supports, hinges, isolators and devices."""
    marks: dict[str, list[np.ndarray]] = {"^": [], "o": [], "s": []}
    for name, structure in scene.run.structures.items():
        nodes = scene.at_rest(name)
        if structure.reactions is not None and structure.geometry is not None and view != "plan":
            names = structure.geometry.node_names
            marks["^"] += [nodes[names.index(node)] for node in structure.reactions.names if node in names]
    for _, springs, i, points in placed_parts(scene):
        if springs.is_hinge(i):
            marks["o"].append(points[0])
        elif springs.isolates(i):
            marks["s"].append(points.mean(axis=0))
    for marker, found in marks.items():
        if found:
            at = project(np.array(found), view)
            face = {"^": "0.25", "o": "white", "s": ORANGE}[marker]
            axes.scatter(
                at[:, 0], at[:, 1], s=12, marker=marker, facecolor=face, edgecolor="0.25", linewidth=0.5, zorder=5
            )
    for device in scene.run.devices.values():
        if ends := scene.device_ends(device):
            axes.plot(
                *project(np.array(ends), view).T, color="black", linestyle=(0, (3, 1.5)), linewidth=1.0, zorder=5.5
            )


def motion_drawing(figure: Figure, box: Box, run: RunData, spectra: Sequence[Spectrum]) -> None:
    """Ground acceleration over time, and its spectrum if available."""
    share = 0.58 if spectra else 1.0
    axes = axes_in(figure, (box[0], box[1], share * box[2], box[3]), (0.5, 0.4, 0.12, 0.1))
    motions = {"x": run.ground_acceleration, **run.ground_across}
    shaking = {axis: values for axis, values in motions.items() if np.any(values)}
    for axis, values in shaking.items():
        plot_time(axes, run, run.time, values / GRAVITY, color=COLOURS[axis], linewidth=0.6, label=f"along {axis}")
    label_time(axes, run)
    axes.set_ylabel("Ground [g]")
    _small(axes, len(shaking))
    if spectra:
        axes = axes_in(figure, (box[0] + share * box[2], box[1], (1 - share) * box[2], box[3]), (0.5, 0.4, 0.12, 0.1))
        for spectrum in spectra:
            axes.plot(
                spectrum.period,
                spectrum.psa / GRAVITY,
                color=COLOURS.get(spectrum.name, BLUE),
                label=f"along {spectrum.name}",
            )
        axes.set(xlim=(0, spectra[0].period[-1]), xlabel="Period [s]", ylabel="Spectrum [g]")
        axes.set_ylim(bottom=0)
        _small(axes, len(spectra))


def _short(name: str) -> str:
    return name if len(name) <= MOST_LETTERS else f"{name[: MOST_LETTERS - 1]}…"


def _small(axes: Axes, curves: int) -> None:
    axes.xaxis.label.set_fontsize(LETTERS)
    axes.yaxis.label.set_fontsize(LETTERS)
    if curves > 1:
        axes.legend(fontsize=LETTERS, loc="upper right")


def worst_drawing(figure: Figure, box: Box, summary: Mapping[str, Any]) -> None:
    """Bars of the members and yielding parts with the largest increases by contact."""
    panels = ranked(summary)
    width = box[2] / max(len(panels), 1)
    for i, (label, rows) in enumerate(panels.items()):
        axes = axes_in(figure, (box[0] + i * width, box[1], width, box[3]), (1.5, 0.4, 0.12, 0.06))
        draw_worst(axes, rows, label)
        _small(axes, 1)
