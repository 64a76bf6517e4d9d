"""Elastic response spectra of records and of floors, and pictures of them: `python3 -m pounding._spectra SPECTRA.json -o
OUT.png`."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from pounding import _arguments as arguments
from pounding._arguments import number, numbers_above, optional, takes, text
from pounding._ended import exit_code
from pounding.errors import ImplausibleWarning, InputError, excerpt
from pounding.results import RunData

if TYPE_CHECKING:
    from matplotlib.figure import Figure

GRAVITY = 9.80665  #: [m/s^2]
STEPS_IN_A_PERIOD = 10  #: minimum number of output times per period for linear interpolation


@dataclass(frozen=True)
class Spectrum:
    """Peak response of oscillators that are at rest initially, to one motion followed by one period of free
    vibration."""

    name: str  #: for legends
    period: np.ndarray  #: [s]
    damping: float  #: ratio [-]
    sd: np.ndarray  #: largest relative displacement [m]

    @property
    def psv(self) -> np.ndarray:
        """Pseudo-velocity, (2 pi/T) sd [m/s]."""
        return 2 * np.pi / self.period * self.sd

    @property
    def psa(self) -> np.ndarray:
        """Pseudo-acceleration, (2 pi/T)^2 sd [m/s^2]."""
        return (2 * np.pi / self.period) ** 2 * self.sd

    def plot(self, title: str = "", size: tuple[float, float] | None = None) -> Figure:
        """A picture of this spectrum.

        Parameters
        ----------
        title : str
            Title.
        size : tuple of float, optional
            Width and height [in].

        Returns
        -------
        matplotlib.figure.Figure
            The picture.
        """
        return spectra_figure([self], title, size)


@takes(file=arguments.file, damping=number(), periods=optional(numbers_above(0)), units=text, channel=text)
def record_spectrum(
    file: str | PathLike[str],
    damping: float = 0.05,
    periods: Sequence[float] | None = None,
    *,
    units: str = "",
    channel: str = "",
) -> Spectrum:
    """Spectrum of the unscaled record in a file.

    Parameters
    ----------
    file : str or os.PathLike
        Name of the file.
    damping : float
        Damping ratio.
    periods : sequence of float, optional
        Periods [s], by default 200 from 0.02 s to 4 s.
    units, channel : str
        For files that do not state them.

    Returns
    -------
    Spectrum
        The spectrum.

    Raises
    ------
    InputError
        The file is not a record, or a value is out of range.

    Warns
    -----
    ImplausibleWarning
        Peaks or steps are implausible.

    Examples
    --------
    >>> pounding.record_spectrum("record.csv").psa.max()  # doctest: +SKIP
    8.7
    """
    from pounding._native import core

    chosen = _chosen(periods)
    summary, sd, doubts = core.record_spectrum(fspath(file), units, channel, list(chosen), damping)
    for doubt in doubts:
        warnings.warn(f"{fspath(file)}: {doubt}", ImplausibleWarning, stacklevel=2)
    return Spectrum(summary, chosen, damping, np.asarray(sd))


@takes(floor=text, damping=number(), periods=optional(numbers_above(0)), direction=text)
def floor_spectrum(
    run: RunData, floor: str, damping: float = 0.05, periods: Sequence[float] | None = None, *, direction: str = "x"
) -> Spectrum:
    """Spectrum of the absolute acceleration of a floor, "left.3" for the third from the ground, linear between output
    times.

    `periods` [s] are by default 200 from 0.02 s, or ten output steps if that is longer, to 4 s. Raises InputError, with
    the output_step to use, if the output times miss more than 5 % of the tracked peak, and for an unknown floor or
    direction."""
    from pounding._native import core

    name, _, place = floor.rpartition(".")
    if (
        name not in run.structures
        or not place.isdecimal()
        or len(place) > 9
        or not 1 <= int(place) <= len(run.structures[name].floors)
    ):
        known = ", ".join(f"{key}.1 to {key}.{len(one.floors)}" for key, one in run.structures.items() if one.floors)
        raise InputError(f"unknown floor {excerpt(floor)}; known: {known}")
    structure, i = run.structures[name], int(place) - 1
    if direction not in ("x", "y") or direction not in structure.along:
        raise InputError(
            f"{name} moves along {', '.join(axis for axis in structure.along if axis != 'rz')}, not along {excerpt(direction)}"
        )
    accelerations = structure.along[direction].acceleration[:, i]
    if len(run.time) < 2:
        raise InputError("this run holds no results over time yet")
    tracked = run.envelopes[name].acceleration if name in run.envelopes else None
    if tracked is not None:
        peak, seen = tracked.peak[i, "xy".index(direction)], np.abs(accelerations).max()
        if seen < core.enough_of_the_peak * peak:
            step = run.time[1] - run.time[0]
            raise InputError(
                f"the outputs every {step:g} s are too far apart for a spectrum of {floor}: they reach {seen:.4g} m/s^2 of "
                f"the peak of {peak:.4g} m/s^2; run the model again with analysis: {{output_step: {step / 10:g}}}"
            )
    chosen = _chosen(periods, STEPS_IN_A_PERIOD * (run.time[1] - run.time[0]))
    return _of_history(floor, run.time, accelerations, chosen, damping)


def ground_spectra(run: RunData, damping: float = 0.05) -> list[Spectrum]:
    """Spectra of the ground motion of a run at its output times, one per direction in which the ground moves, named x,
    y and z; 200 periods from 0.02 s to 4 s."""
    return [
        _of_history(axis, run.time, values, _chosen(None), damping)
        for axis, values in {"x": run.ground_acceleration, **run.ground_across}.items()
        if len(values) > 1 and values.any()
    ]


def _of_history(name: str, time: np.ndarray, values: np.ndarray, periods: np.ndarray, damping: float) -> Spectrum:
    from pounding._native import core

    return Spectrum(
        name, periods, damping, np.asarray(core.spectrum(time.tolist(), values.tolist(), list(periods), damping))
    )


@takes(title=text, size=optional(arguments.size))
def spectra_figure(spectra: Sequence[Spectrum], title: str = "", size: tuple[float, float] | None = None) -> Figure:
    """Pseudo-acceleration and displacement over the period; the second spectrum is dashed. `size` is width and height
    [in]. Raises InputError without spectra."""
    from pounding._pictures.style import STRUCTURE_COLOURS, picture

    spectra = arguments.listed(_spectrum, "a list of spectra")("spectra", spectra)
    if not spectra:
        raise InputError("no spectrum to draw")
    size = size or (6.5, 3.0)
    narrow = size[0] < 4.5
    with picture(size, title) as figure:
        panels = figure.subplots(2, 1, sharex=True) if narrow else figure.subplots(1, 2)
        drawn = (
            ("Pseudo-acceleration [g]", [spectrum.psa / GRAVITY for spectrum in spectra]),
            ("Displacement [mm]", [1e3 * spectrum.sd for spectrum in spectra]),
        )
        for axes, (label, curves) in zip(panels, drawn):
            for number, (spectrum, values) in enumerate(zip(spectra, curves)):
                axes.plot(
                    spectrum.period,
                    values,
                    color=STRUCTURE_COLOURS[number % len(STRUCTURE_COLOURS)],
                    linestyle="--" if number == 1 else "-",
                    label=spectrum.name,
                )
            axes.set(xlim=(spectra[0].period[0], spectra[0].period[-1]), ylabel=label)
            axes.set_ylim(bottom=0)
            if not narrow or axes is panels[-1]:
                axes.set_xlabel("Period [s]")
        if len(spectra) > 1:
            panels[0].legend()
        return figure


def _spectrum(name: str, value: Any) -> Spectrum:
    if not isinstance(value, Spectrum):
        raise arguments.refuse(name, "a Spectrum", value)
    return value


def _chosen(periods: Sequence[float] | None, shortest: float = 0.02) -> np.ndarray:
    return np.geomspace(min(max(0.02, shortest), 2.0), 4, 200) if periods is None else np.asarray(periods, dtype=float)


def read_spectra(data: dict[str, Any]) -> tuple[str, list[Spectrum]]:
    """Title and spectra of {"title", "damping", "spectra": [{"name", "period", "sd", ...}]}, in SI. Raises
    InputError."""
    try:
        return data["title"], [
            Spectrum(
                one["name"],
                np.asarray(one["period"], dtype=float),
                float(data["damping"]),
                np.asarray(one["sd"], dtype=float),
            )
            for one in data["spectra"]
        ]
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"this is not an object of spectra: {error}") from error


def main(arguments: list[str] | None = None) -> int:
    """Command line: draws response spectra."""
    from pounding._pictures.style import draw_object

    def draw(data: Any, title: str | None) -> Figure:
        own, spectra = read_spectra(data)
        return spectra_figure(spectra, own if title is None else title)

    return draw_object("_spectra", "Draw response spectra.", draw, arguments)


if __name__ == "__main__":
    sys.exit(exit_code(main))
