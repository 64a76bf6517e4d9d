"""Curves of pushed structures, and pictures of them: `pounding pushover MODEL.yaml --plot` calls
`python3 -m pounding._pushover_curve CURVE.json -o OUT.png` with the object that `pounding pushover --json` prints."""

from __future__ import annotations

import json
import sys
import textwrap
from dataclasses import dataclass, field, fields
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _arguments as arguments
from pounding import _printing as printing
from pounding._arguments import optional, require_package, takes
from pounding._checked_file import NotResults, require_whole
from pounding._ended import exit_code
from pounding.errors import InputError

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class PushoverEvent:
    """Events of one kind at one point of the path."""

    point: int  #: index of the point
    displacement: float  #: of the roof [m]
    base_shear: float  #: [N]
    kind: str  #: "yields", "softens" or "unloads"
    first: bool  #: the parts had never yielded before
    parts: list[str]  #: their names


@dataclass(frozen=True, repr=False)
class Pushover(printing.ReportLines):
    """Results of a pushover. The path is straight between points if the laws of the parts are piecewise linear."""

    structure: str
    direction: str  #: "x" or "y"
    status: str  #: "done", or "collapse: " and the reason
    displacement: np.ndarray  #: [point] of the roof [m]
    base_shear: np.ndarray  #: [point] [N]
    floor_displacement: np.ndarray  #: [point, floor], from the ground up [m]
    parts: list[str]  #: names of the parts that can yield
    deformation: np.ndarray  #: [point, part] [m] or [rad]
    force: np.ndarray  #: [point, part] [N] or [N m]
    events: list[PushoverEvent]
    mechanism: int | None  #: index of the point at which yielding parts form a mechanism
    overstrength: float  #: largest base shear over that at the first yield
    summary: dict[str, Any] = field(default_factory=dict)  #: the object of `pounding pushover --json`

    @property
    def bilinear(self) -> dict[str, float] | None:
        """Bilinear idealisation by EN 1998-1, annex B: yield_displacement, displacement [m], base_shear [N]; None for
        cycles."""
        return self.summary.get("bilinear")

    @property
    def equivalent(self) -> dict[str, float] | None:
        """Equivalent oscillator by annex B: mass [kg], participation, period [s]; None for cycles."""
        return self.summary.get("equivalent")

    @classmethod
    def from_json(cls, found: dict[str, Any]) -> Pushover:
        """The pushover in an object that `pounding pushover --json` prints.

        Parameters
        ----------
        found : dict
            The object.

        Returns
        -------
        Pushover
            The curve.

        Raises
        ------
        InputError
            The object is another one.
        """
        try:
            points = {name: np.array(values, float) for name, values in found["points"].items()}
            return cls._of({name: value for name, value in found.items() if name != "points"}, points)
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            raise InputError(f"this is not an object of a pushover: {error}") from error

    @classmethod
    def _of(cls, summary: dict[str, Any], points: dict[str, np.ndarray]) -> Pushover:
        mechanism = summary["mechanism"]
        return cls(
            structure=summary["structure"],
            direction=summary["direction"],
            status=summary["status"],
            **points,
            parts=[part["name"] for part in summary["parts"]],
            events=[PushoverEvent(**event) for event in summary["events"]],
            mechanism=None if mechanism is None else mechanism["point"],
            overstrength=summary["overstrength"]["largest"],
            summary=summary,
        )

    def to_pandas(self) -> dict[str, pandas.DataFrame]:
        """Tables of the curve, its events and its parts.

        Returns
        -------
        dict of str to pandas.DataFrame
            "curve" with one row per point (displacement and floors [m], base_shear [N]), "events", and "parts" with the
            largest deformation [m] or [rad] and force [N] or [N m] of each.

        Raises
        ------
        ImportError
            pandas is missing.
        """
        require_package("pandas")
        import pandas

        floors = {f"floor {i + 1}": values for i, values in enumerate(self.floor_displacement.T)}
        curve = {"displacement": self.displacement, "base_shear": self.base_shear, **floors}
        events = pandas.DataFrame(self.events, columns=[each.name for each in fields(PushoverEvent)])
        parts = {
            "deformation": np.abs(self.deformation).max(axis=0, initial=0.0),
            "force": np.abs(self.force).max(axis=0, initial=0.0),
        }
        return {
            "curve": pandas.DataFrame(curve, pandas.Index(range(len(self.displacement)), name="point")),
            "events": events.assign(parts=events["parts"].map(", ".join)),
            "parts": pandas.DataFrame(parts, pandas.Index(self.parts, name="part")),
        }

    @takes(title=optional(arguments.text), size=optional(arguments.size))
    def plot(self, title: str | None = None, size: tuple[float, float] | None = None) -> Figure:
        """A picture of the curve with numbered events and the bilinear idealisation.

        Parameters
        ----------
        title : str, optional
            Title instead of the default one.
        size : tuple of float, optional
            Width and height [in].

        Returns
        -------
        matplotlib.figure.Figure
            The picture.

        Raises
        ------
        ImportError
            matplotlib is missing.
        """
        return pushover_figure(self, f"Pushover of {self.structure}" if title is None else title, size)


@takes(path=arguments.file)
def read_pushover(path: str | PathLike[str]) -> Pushover:
    """The pushover in a results file, after a check of the checksum.

    Parameters
    ----------
    path : str or os.PathLike
        Name of the file.

    Returns
    -------
    Pushover
        The curve.

    Raises
    ------
    OSError
        The file cannot be opened.
    NotResults
        The file is of another kind or damaged.

    Examples
    --------
    >>> pounding.read_pushover("pushover.h5").base_shear.max()  # doctest: +SKIP
    412000.0
    """
    import h5py

    from pounding._data import Data

    require_whole(path)
    with h5py.File(path, "r") as file:
        group = Data(file).get("pushover")
        if group is None:
            raise NotResults(
                f'{path} holds no pushover; results of a run are read by pounding.read("{Path(path).name}")'
            )
        points = {name: array.values for name, array in group.data_vars.items() if array.dims[:1] == ("point",)}
        return Pushover._of(json.loads(str(group["summary"].values)), points)


#: Maximum number of events listed next to the picture.
MOST = 12


def pushover_figure(found: Pushover, title: str = "", size: tuple[float, float] | None = None) -> Figure:
    """The picture of `Pushover.plot`."""
    from pounding._pictures.style import NARROW, picture

    size = size or (6.5, 3.4)
    narrow = size[0] < NARROW
    with picture(size, title) as figure:
        axes = figure.subplots()
        _draw_curve(axes, found)
        # Below a low picture there is room for few events.
        _number_events(axes, found, 38, min(MOST, max(0, int((size[1] - 2.4) / 0.16))) if narrow else MOST)
        # Events are listed below a narrow picture and next to a wide one.
        figure.legend(
            *axes.get_legend_handles_labels(),
            handlelength=1.2,
            loc="outside lower center" if narrow else "outside right center",
        )
        return figure


def _draw_curve(axes: Axes, found: Pushover) -> None:
    from pounding._pictures.style import BLUE, FORCE_UNITS, MM, QUIET, VERMILION, engineering, largest

    size, unit = engineering(largest([found.base_shear]), FORCE_UNITS)
    axes.plot(MM * found.displacement, found.base_shear / size, color=BLUE, linewidth=1.4, zorder=3, label="pushover")
    if found.bilinear:
        way = np.sign(found.displacement[-1])
        x = way * np.array([0, found.bilinear["yield_displacement"], found.bilinear["displacement"]])
        axes.plot(
            MM * x,
            way * np.array([0, 1, 1]) * found.bilinear["base_shear"] / size,
            color=QUIET,
            linestyle="--",
            zorder=2,
            label="two straight lines",
        )
    if found.mechanism is not None:
        axes.plot(
            MM * found.displacement[found.mechanism],
            found.base_shear[found.mechanism] / size,
            "D",
            color=VERMILION,
            markersize=6,
            linestyle="none",
            fillstyle="none",
            zorder=5,
            label="mechanism",
        )
    axes.axhline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.axvline(0, color="0.4", linewidth=0.6, zorder=1)
    axes.set(xlabel="Displacement of the roof [mm]", ylabel=f"Base shear [{unit}]")
    axes.margins(x=0.02)


def _number_events(axes: Axes, found: Pushover, letters: int, most: int) -> None:
    """Numbers every first yield as in the table of events, with the parts of the first `most` in the legend."""
    from pounding._pictures.panels import note
    from pounding._pictures.style import BLUE, FORCE_UNITS, MM, engineering, largest

    size = engineering(largest([found.base_shear]), FORCE_UNITS)[0]
    events = [(number, event) for number, event in enumerate(found.events, 1) if event.first]
    together: list[tuple[float, float, list[int]]] = []
    for place, (number, event) in enumerate(events, 1):
        x, y = MM * event.displacement, event.base_shear / size
        axes.plot(x, y, "o", color=BLUE, markersize=3.5, zorder=4)
        if place <= most:
            words = "\n".join(textwrap.wrap(printing.few(event.parts, 3), letters, subsequent_indent="    "))
            axes.plot([], [], linestyle="none", label=f"{number}  {words}")
        # Overlapping numbers share a position.
        if together and _is_near(axes, together[-1][:2], (x, y)):
            together[-1][2].append(number)
        else:
            together.append((x, y, [number]))
    for x, y, numbers in together:
        several = (
            str(numbers[0])
            if len(numbers) == 1
            else f"{numbers[0]}, {numbers[1]}"
            if len(numbers) == 2
            else f"{numbers[0]} ... {numbers[-1]}"
        )
        # On the side away from the curve.
        up = 1 if y >= 0 else -1
        note(
            axes,
            several,
            (x, y),
            (4 * up, -3 * up),
            ha="left" if y >= 0 else "right",
            va="top" if y >= 0 else "bottom",
            fontsize=7.5,
            zorder=6,
        )
    if len(events) > most:
        words = f"and {len(events) - most} more" if most else f"numbers of {len(events)} events"
        axes.plot([], [], linestyle="none", label=words)


def _is_near(axes: Axes, one: tuple[float, float], other: tuple[float, float]) -> bool:
    # Numbers are wider than high.
    rooms = (0.1 * np.ptp(axes.get_xlim()), 0.06 * np.ptp(axes.get_ylim()))
    return all(abs(a - b) < room for a, b, room in zip(one, other, rooms))


def main(arguments: list[str] | None = None) -> int:
    """Command line: draws the curve of a pushover."""
    from pounding._pictures.style import draw_object

    def draw(data: Any, title: str | None) -> Figure:
        found = Pushover.from_json(data)
        return found.plot(title and f"{title}: pushover of {found.structure}")

    return draw_object("_pushover_curve", "Draw the curve of a pushover.", draw, arguments)


if __name__ == "__main__":
    sys.exit(exit_code(main))
