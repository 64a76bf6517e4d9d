"""Models with the keys of input files, built in code or read from a file."""

from __future__ import annotations

import copy
import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pounding import _arguments as arguments
from pounding import _printing as printing
from pounding import _yaml_text as yaml_text
from pounding._arguments import takes, whole
from pounding._modes import Modes
from pounding._native import core
from pounding._pictures.html import text_html
from pounding._records import POUNDING_RECORDS, data_folder
from pounding.errors import ImplausibleWarning

if TYPE_CHECKING:
    from pounding.view import View

__all__ = ["Checked", "Model", "check", "modes"]

#: Sections of an input, in the order of the examples.
PARTS = (
    "title",
    "project",
    "ground_motion",
    "structures",
    "links",
    "devices",
    "analysis",
    "checkpoint",
    "compare",
    "accept",
)


class Model(printing.ReportLines, lines=printing.model):
    """A model with the keys of an input file (README, "Input"): nested dicts and lists whose quantities are texts with
    units ("20 mm") or numbers in SI.

        Model(structures={"left": {"oscillator": {"mass": "100 t", "period": 0.8, "damping": "5 %"}},
                          "right": {"wall": {}}},
              links=[{"between": ["left", "right"], "gap": "20 mm", "law": "hertz", "stiffness": 2.75e9}],
              ground_motion={"harmonic": {"amplitude": 3.0, "period": 0.6, "duration": 3.0}},
              analysis={"duration": 3.0})

    The parts are attributes and may be changed; `check` and `run` read them, with the program's own reader. Relative
    paths start from the working folder, those of a model from a file from the file's."""

    def __init__(
        self,
        structures: Mapping[str, Any],
        links: Sequence[Mapping[str, Any]] = (),
        *,
        ground_motion: Mapping[str, Any] | None = None,
        analysis: Mapping[str, Any] | None = None,
        title: str | None = None,
        compare: str | None = None,
        checkpoint: Mapping[str, Any] | None = None,
        accept: Sequence[str] | None = None,
        devices: Mapping[str, Any] | None = None,
        project: str | None = None,
    ) -> None:
        self.structures = structures
        self.links = links
        self.ground_motion = ground_motion
        self.analysis = analysis
        self.title = title
        self.project = project
        self.compare = compare
        self.checkpoint = checkpoint
        self.accept = accept
        self.devices = devices
        self._file = ""
        self._text = ""
        # contents of files read before, by name
        self._files: Mapping[str, bytes] = {}
        self._parts_of_text: dict[str, Any] | None = None

    @classmethod
    def from_file(cls, path: str | PathLike[str]) -> Model:
        """The model of an input file, with numbers as typed. `check` and `run` check its contents.

        Parameters
        ----------
        path : str or os.PathLike
            Name of the file.

        Returns
        -------
        Model
            The model.

        Raises
        ------
        InputError
            The file cannot be read or is not YAML.
        """
        name = fspath(arguments.file("path", path))
        return cls._from_text(core.read_file(name), name)

    @classmethod
    def from_yaml(cls, text: str) -> Model:
        """The model of the text of an input file.

        Parameters
        ----------
        text : str
            Text in YAML.

        Returns
        -------
        Model
            The model.

        Raises
        ------
        InputError
            The text is not YAML.
        """
        return cls._from_text(arguments.text("text", text), "model")

    @classmethod
    def _from_text(cls, text: str, name: str) -> Model:
        parts = core.parse(core.Source(text, name))
        model = cls({})
        # The compiled reader reports unknown sections with their location.
        if isinstance(parts, dict) and set(parts) <= set(PARTS) and None not in parts.values():
            for part in PARTS:
                setattr(model, part, parts.get(part, [] if part == "links" else None))
        model._file, model._text = name, text
        model._parts_of_text = copy.deepcopy(model._parts())
        return model

    def to_yaml(self) -> str:
        """Text of an input file; for an unchanged model from a file, the text of that file.

        Returns
        -------
        str
            Text in YAML.
        """
        parts = self._parts()
        return self._text if parts == self._parts_of_text else yaml_text.emit(parts)

    def view(
        self,
        path: str | PathLike[str] | None = None,
        *,
        modes: int = 0,
        scale: float | None = None,
        title: str | None = None,
    ) -> View:
        """An interactive view of the model at rest in three dimensions. A notebook shows it.

        Parameters
        ----------
        path : str or os.PathLike, optional
            File to write (.html), which needs no network.
        modes : int
            Number of mode shapes per structure.
        scale : float, optional
            Magnification of gaps.
        title : str, optional
            Title instead of that of the model.

        Returns
        -------
        pounding.view.View
            The view.

        Raises
        ------
        InputError
            The model is wrong, or the file cannot be written.
        ImportError
            Plotly is missing.
        """
        from pounding.results import RunData
        from pounding.view import check_output, view_of_run

        if path is not None:
            check_output(path)
        at_rest = RunData.from_image(core.image_at_rest(self._source()))
        found = Modes(core.modes(self._source(), modes), "") if modes else None
        made = view_of_run(at_rest, found, None, scale, title)
        if path is not None:
            made.save(path)
        return made

    def copy(self) -> Model:
        """An independent copy.

        Returns
        -------
        Model
            The copy.
        """
        return copy.deepcopy(self)

    def __eq__(self, other: object) -> bool:
        """True for equal keys and values, regardless of their layout in files."""
        return isinstance(other, Model) and self._parts() == other._parts()

    __hash__ = None  # type: ignore[assignment]

    def _repr_html_(self) -> str:
        return text_html(self.to_yaml())

    def _parts(self) -> dict[str, Any]:
        given = {part: getattr(self, part) for part in PARTS}
        plain = yaml_text.plain({part: value for part, value in given.items() if value is not None})
        # An empty list is the same as no key.
        return {part: value for part, value in plain.items() if part != "links" or value != []}

    def _source(self) -> core.Source:
        """Text and file name for the compiled reader."""
        text = self.to_yaml()
        if "record" in text and not os.environ.get(POUNDING_RECORDS) and (folder := data_folder()):
            os.environ[POUNDING_RECORDS] = str(folder)
        if text is self._text:
            return core.Source(text, self._file, dict(self._files))
        name = str(Path(self._file).with_name("model")) if self._file else "model"
        # The user has not seen this text: messages have the paths of keys, without lines.
        return core.Source(text, name, dict(self._files), generated=True)


@dataclass(frozen=True)
class Checked:
    """A valid model."""

    description: str  #: ground motions, structures, links and devices, one line each
    resolved: str  #: YAML with every default and calibrated parameter, SI
    warnings: tuple[str, ...] = ()  #: about implausible values, except those that the model accepts

    def __str__(self) -> str:
        """The output of `pounding check` for a model without yielding parts."""
        return self.description


def as_model(model: Model | str | PathLike[str]) -> Model:
    """The model itself, or that of an input file."""
    if isinstance(model, Model):
        return model
    if not isinstance(model, (str, PathLike)):
        raise arguments.refuse("model", "a Model or the name of an input file", model)
    return Model.from_file(model)


def check(model: Model | str | PathLike[str]) -> Checked:
    """Reads and validates an input, without a run.

    Parameters
    ----------
    model : Model, str or os.PathLike
        A model, or the name of its file.

    Returns
    -------
    Checked
        Description, defaults and warnings.

    Raises
    ------
    InputError
        The input is wrong; the message has the place.

    Warns
    -----
    ImplausibleWarning
        A value is implausible.

    Examples
    --------
    >>> pounding.check(model).warnings
    ()
    """
    description, resolved, doubts = core.check(as_model(model)._source())
    for doubt in doubts:
        warnings.warn(doubt, ImplausibleWarning, stacklevel=2)
    return Checked(description, resolved, tuple(doubts))


@takes(count=whole(1, 10_000))
def modes(model: Model | str | PathLike[str], count: int = 12) -> Modes:
    """Natural modes of a model or an input file, longest period first.

    Parameters
    ----------
    model : Model, str or os.PathLike
        A model, or the name of its file.
    count : int
        Maximum number of modes of frames. Other structures have all of them, walls have none.

    Returns
    -------
    Modes
        Modes by structure.

    Raises
    ------
    InputError
        The input is wrong.

    Examples
    --------
    >>> round(pounding.modes(model)["left"][0].period, 3)
    0.8
    """
    model = as_model(model)
    return Modes(core.modes(model._source(), count), str(model.title or ""))
