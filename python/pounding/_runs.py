"""Results of runs with pictures, animations and tables. Needs numpy and h5py; pictures need matplotlib, tables pandas
or xarray."""

from __future__ import annotations

import importlib
import json
from collections.abc import Sequence
from dataclasses import dataclass, fields
from os import PathLike
from typing import TYPE_CHECKING, Any

from pounding import _arguments as arguments
from pounding import _comparison as comparison
from pounding._arguments import flag, number, optional, require_package, takes, text, whole
from pounding._pictures.html import run_html
from pounding._spectra import Spectrum, floor_spectrum, ground_spectra
from pounding.errors import InputError
from pounding.results import RunData

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from pounding._modes import Modes
    from pounding._native import core
    from pounding.animation import Film
    from pounding.view import View


@dataclass(frozen=True, repr=False)
class Run(RunData):
    """Results of a run: the contents of its file, with pictures and tables.

    After `pounding.run` they are in memory: `summary` is available immediately, and histories become arrays on first
    access."""

    @classmethod
    def _of_outcome(cls, ran: core.RunOutcome) -> Run:
        """The results of a run that has just ended."""
        results = cls.__new__(cls)
        results.__dict__["_ran"] = ran
        return results

    def __getattr__(self, name: str) -> Any:
        # Called for attributes that do not exist yet.
        ran = self.__dict__.get("_ran")
        if ran is None or name not in _FIELDS:
            raise AttributeError(f"a run has no {name!r}")
        if name == "summary":
            self.__dict__["summary"] = json.loads(ran.summary or "{}")
        else:
            self._load()
        return self.__dict__[name]

    def _load(self) -> None:
        """Creates all arrays. An already returned summary stays the same object."""
        ran = self.__dict__.get("_ran")
        if ran is not None:
            self.__dict__.update({**vars(Run.from_image(ran.image)), **self.__dict__})
            self.__dict__.pop("_ran", None)

    def __getstate__(self) -> dict[str, Any]:
        self._load()
        return super().__getstate__()

    @takes(picture=text, title=optional(text), size=optional(arguments.size), compare=optional(flag))
    def plot(
        self,
        picture: str = "run",
        title: str | None = None,
        size: tuple[float, float] | None = None,
        *,
        compare: bool | None = None,
    ) -> Figure:
        """A picture of the run. A notebook displays it; `.savefig("NAME.pdf")` saves it.

        Parameters
        ----------
        picture : str
            "run" (histories and impacts), "displacement", "rotation" (of rigid floors in space), "gap", "force",
            "energy", "model" (structures at rest), "profiles" (extremes over the height), "plan" (a map of drifts and
            impacts of frames in space), "hinges" (a map of yielded parts), "worst" (members and yielding parts with the
            largest increases by contact), "loops" (force over deformation of the six parts and devices with the largest
            energy losses, or contact loops if there are none) or "contact_loops" (force over penetration).
        title : str, optional
            Title instead of that of the run; "" omits all titles, for a picture with a caption.
        size : tuple of float, optional
            Width and height [in]: (3.3, 2.4) is for one column of a paper, with 8-point type.
        compare : bool, optional
            True also draws the run without links, dashed; by default profiles and plan do if the run has it.

        Returns
        -------
        matplotlib.figure.Figure
            The picture.

        Raises
        ------
        InputError
            The picture is unknown.
        ImportError
            matplotlib is missing.

        Examples
        --------
        >>> figure = results.plot("gap", size=(3.3, 2.4), title="")
        >>> figure.get_size_inches()
        array([3.3, 2.4])
        """
        return _needing("matplotlib", "pounding._pictures.figures").figure(self, picture, title, size, compare)

    def spectrum(
        self, floor: str, damping: float = 0.05, periods: Sequence[float] | None = None, *, direction: str = "x"
    ) -> Spectrum:
        """Response spectrum of the absolute acceleration of a floor, from the accelerations at the output times.

        With `compare: no_pounding`, `results.no_pounding.spectrum(...)` is that without links.

        Parameters
        ----------
        floor : str
            "left.3" is the third floor from the ground.
        damping : float
            Damping ratio.
        periods : sequence of float, optional
            Periods [s], by default 200 from 0.02 s to 4 s.
        direction : str
            "x" or "y".

        Returns
        -------
        Spectrum
            The spectrum.

        Raises
        ------
        InputError
            The floor is unknown, or the output times are too far apart; the message has the output_step to use.
        """
        return floor_spectrum(self, floor, damping, periods, direction=direction)

    def worst(self, kind: str = "members", *, by: str = "ratio") -> list[dict[str, Any]]:
        """The five worst members or hinges of a run with `compare: no_pounding`; see `pounding.results.worst`.

        Parameters
        ----------
        kind : str
            "members" or "hinges".
        by : str
            "ratio" or "demand".

        Returns
        -------
        list of dict
            The ranking.
        """
        return comparison.worst(self.summary, kind, by)

    @takes(path=arguments.file)
    def report(self, path: str | PathLike[str]) -> None:
        """Writes a report of about two A4 pages: model, assumptions, ground motion with its spectrum, verdict, responses
        with and without links, impacts, energies and warnings.

        Parameters
        ----------
        path : str or os.PathLike
            File to write, .pdf or .html; an existing one must be a report.

        Raises
        ------
        InputError
            The suffix is another one, or the file may not be replaced.
        OSError
            The file cannot be written.
        ImportError
            matplotlib is missing.
        """
        _needing("matplotlib", "pounding._report").write_report(self, path, spectra=ground_spectra(self))

    @takes(
        path=optional(arguments.file),
        frames=optional(whole(1)),
        start=optional(number()),
        end=optional(number()),
        scale=optional(number()),
        title=optional(text),
    )
    def animate(
        self,
        path: str | PathLike[str] | None = None,
        *,
        frames: int | None = None,
        start: float | None = None,
        end: float | None = None,
        scale: float | None = None,
        title: str | None = None,
    ) -> Film:
        """An animation of the run. A notebook plays it.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File to write: .gif, .mp4, or .png for one file per frame.
        frames : int, optional
            Number of frames, by default 15 per second.
        start, end : float, optional
            Times of the first and the last frame [s].
        scale : float, optional
            Magnification of displacements and gaps.
        title : str, optional
            Title instead of that of the run.

        Returns
        -------
        pounding.animation.Film
            The film.

        Raises
        ------
        InputError
            A time is outside the run, or the file may not be replaced.
        ImportError
            matplotlib is missing.
        """
        animation = _needing("matplotlib", "pounding.animation")
        if path is not None:
            animation.check_output(path)
        film = animation.animate(self, animation.frame_times(self, frames, start, end), scale, title)
        if path is not None:
            animation.save(film, path)
        return film

    @takes(
        path=optional(arguments.file),
        modes=whole(0, 1000),
        frames=optional(whole(2)),
        scale=optional(number()),
        title=optional(text),
    )
    def view(
        self,
        path: str | PathLike[str] | None = None,
        *,
        modes: int = 0,
        frames: int | None = None,
        scale: float | None = None,
        title: str | None = None,
    ) -> View:
        """An interactive view in three dimensions: the model, the film of the run, and mode shapes. A notebook shows it.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File to write (.html), which needs no network.
        modes : int
            Number of mode shapes per structure.
        frames : int, optional
            Number of instants of the film, by default as many as suit a file of 20 MB.
        scale : float, optional
            Magnification of displacements and gaps.
        title : str, optional
            Title instead of that of the run.

        Returns
        -------
        pounding.view.View
            The view.

        Raises
        ------
        InputError
            An argument is out of range, or the file may not be replaced.
        ImportError
            Plotly is missing.
        """
        views = _needing("matplotlib", "pounding.view")
        if path is not None:
            views.check_output(path)
        made: View = views.view_of_run(self, self._modes(modes) if modes else None, frames, scale, title)
        if path is not None:
            made.save(path)
        return made

    def _modes(self, count: int) -> Modes:
        """Modes of the structures, from the input in the file. Raises InputError."""
        from pounding.models import Model
        from pounding.models import modes as modes_of

        model = Model.from_yaml(self.model_yaml)
        # Modes do not depend on these, and the record may be elsewhere now.
        model.ground_motion, model.analysis = None, {"duration": "1 s"}
        try:
            return modes_of(model, count)
        except InputError as error:
            raise InputError(
                f"the modes cannot be computed from the input in the results: {error}. Type pounding view MODEL.yaml "
                f"--modes {count}"
            ) from error

    def to_pandas(self) -> dict[str, pandas.DataFrame]:
        """A table for each group of the file, in SI, with its time [s] as index.

        Returns
        -------
        dict of str to pandas.DataFrame
            Keys are the paths of the groups: "impacts", "energy", "ground", "links/NAME", "devices/NAME", and
            "structures/NAME" with columns (quantity, floor, direction, ...). If the input requests them:
            "structures/NAME/nodes" with (quantity, node, direction) and "structures/NAME/members" with (quantity,
            member, component). "envelopes/NAME" has the extremes of all steps by (quantity, item, direction). `attrs`
            has the units and other attributes of each quantity.

        Raises
        ------
        ImportError
            pandas is missing.

        Examples
        --------
        >>> results.to_pandas()["structures/left"]["displacement", "1", "x"].index.name
        'time'
        """
        return _needing("pandas", "pounding._tables").to_pandas(self)

    def to_xarray(self) -> dict[str, xarray.Dataset]:
        """The groups of `data` with arrays.

        Returns
        -------
        dict of str to xarray.Dataset
            Datasets by path, whose arrays are read when they are used.

        Raises
        ------
        ImportError
            xarray is missing.
        """
        return _needing("xarray", "pounding._tables").to_xarray(self)

    def _repr_html_(self) -> str:
        return run_html(self.title, self.status, self.summary)


_FIELDS = frozenset(each.name for each in fields(Run))


@takes(path=arguments.file, checked=flag)
def read(path: str | PathLike[str], *, checked: bool = True) -> Run:
    """The run in a results file, after a check of the checksum.

    Parameters
    ----------
    path : str or os.PathLike
        Name of the file.
    checked : bool
        False skips the check, for files from an earlier version or with additions.

    Returns
    -------
    Run
        The results.

    Raises
    ------
    OSError
        The file cannot be opened.
    NotResults
        The file is of another kind or damaged.

    Examples
    --------
    >>> pounding.read("out.h5").status  # doctest: +SKIP
    'done'
    """
    return Run.read(path, checked=checked)


def _needing(package: str, module: str) -> Any:
    """A module of this package that needs another package; if that is missing, ImportError names the command to
    install it."""
    require_package(package)
    return importlib.import_module(module)
