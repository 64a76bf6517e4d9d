"""Moment-curvature and N-M interaction of sections of fibres: `pounding section MODEL.yaml --picture OUT.png` calls
`python3 -m pounding._section_curves SECTIONS.json -o OUT.png` with the object that `pounding section --json` prints."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding._ended import exit_code
from pounding._pictures.style import QUIET, STRUCTURE_COLOURS, BadRequest, draw_object, engineering, largest, picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOMENT_UNITS = ((1e6, "MN m"), (1e3, "kN m"), (1.0, "N m"))
FORCE_UNITS = ((1e6, "MN"), (1e3, "kN"), (1.0, "N"))


@dataclass(frozen=True)
class SectionCurve:
    """Bending of a section under a constant axial force."""

    axial_force: float  #: compression negative [N]
    curvature: np.ndarray  #: [point] [1/m]
    moment: np.ndarray  #: [point] [N m]
    yields_at: tuple[float, float]  #: curvature [1/m] and moment [N m]; zero if it does not yield
    ultimate_curvature: float  #: [1/m]; zero if it is not reached


@dataclass(frozen=True)
class DrawnSection:
    """A section with its curves and its interaction diagram."""

    name: str
    axis: str  #: of bending, "y" or "z"
    curves: list[SectionCurve]
    axial_forces: np.ndarray  #: [point] of the diagram [N]
    moments: np.ndarray  #: [point] of the diagram [N m]


def read_sections(data: dict[str, Any]) -> list[DrawnSection]:
    """The sections of an object that `pounding section --json` prints. Raises BadRequest for another object."""
    try:
        return [
            DrawnSection(
                one["name"],
                one["axis"],
                [
                    SectionCurve(
                        curve["axial_force"],
                        np.array(curve["curvature"], float),
                        np.array(curve["moment"], float),
                        (curve["yield_curvature"], curve["yield_moment"]),
                        curve["ultimate_curvature"],
                    )
                    for curve in one["curves"]
                ],
                np.array(one["interaction"]["axial_force"], float),
                np.array(one["interaction"]["moment"], float),
            )
            for one in data["sections"]
        ]
    except (KeyError, TypeError, ValueError) as error:
        raise BadRequest(f"this is not an object of sections: {error}") from error


def sections_figure(sections: list[DrawnSection], title: str = "") -> Figure:
    """One row per section: moments over curvatures for each axial force, and the interaction diagram.

    Raises BadRequest without sections."""
    if not sections:
        raise BadRequest("no section to draw")
    with picture((6.5, 0.2 + 2.8 * len(sections)), title) as figure:
        for section, (curves, diagram) in zip(sections, figure.subplots(len(sections), 2, squeeze=False)):
            size, unit = engineering(largest([section.moments]), MOMENT_UNITS)
            _draw_curves(curves, section, size)
            _draw_diagram(diagram, section, size)
            curves.set(
                title=f"{section.name}, about {section.axis}", xlabel="Curvature [1/m]", ylabel=f"Moment [{unit}]"
            )
            diagram.set(xlabel=f"Moment [{unit}]")
        return figure


def _draw_curves(axes: Axes, section: DrawnSection, size: float) -> None:
    for number, curve in enumerate(section.curves):
        colour = STRUCTURE_COLOURS[number % len(STRUCTURE_COLOURS)]
        force, unit = engineering(largest([section.axial_forces]), FORCE_UNITS)
        x, y = np.append(0, curve.curvature), np.append(0, curve.moment) / size
        axes.plot(x, y, color=colour, label=f"N = {curve.axial_force / force:.4g} {unit}")
        if curve.yields_at[0] > 0:
            axes.plot(curve.yields_at[0], curve.yields_at[1] / size, "o", color=colour, markersize=3.5)
        if curve.ultimate_curvature > 0:
            moment = np.interp(curve.ultimate_curvature, x, y)
            axes.plot(curve.ultimate_curvature, moment, "x", color=colour, markersize=5)
    axes.plot([], [], "o", color=QUIET, markersize=3.5, label="first yield")
    if any(curve.ultimate_curvature > 0 for curve in section.curves):
        axes.plot([], [], "x", color=QUIET, markersize=5, label="failure")
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend()


def _draw_diagram(axes: Axes, section: DrawnSection, size: float) -> None:
    force, unit = engineering(largest([section.axial_forces]), FORCE_UNITS)
    axes.plot(section.moments / size, section.axial_forces / force, color="0.3")
    for number, curve in enumerate(section.curves):
        colour = STRUCTURE_COLOURS[number % len(STRUCTURE_COLOURS)]
        axes.plot(curve.moment.max(initial=0) / size, curve.axial_force / force, "o", color=colour, markersize=4)
    axes.axhline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.set_xlim(left=0)
    axes.invert_yaxis()  # compression upwards
    axes.set(ylabel=f"Axial force [{unit}], compression upwards", title="Interaction")


def main(arguments: list[str] | None = None) -> int:
    """Command line: draws sections of fibres."""

    def draw(data: Any, title: str | None) -> Figure:
        return sections_figure(read_sections(data), title or "")

    return draw_object("_section_curves", "Draw sections of fibres.", draw, arguments)


if __name__ == "__main__":
    sys.exit(exit_code(main))
