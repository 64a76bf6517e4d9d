"""Results of a run as numpy arrays, and their HDF5 file. Needs numpy and h5py only; every array is in SI units."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import h5py
import numpy as np

from pounding import _arguments as arguments
from pounding import _printing as printing
from pounding._arguments import takes
from pounding._checked_file import BLOCK, RESULTS, HoldsPushover, NotResults, require_whole, require_whole_image
from pounding._comparison import worst
from pounding._data import Data, DataArray, read_fields, to_datatree
from pounding._envelopes import Extremes, StructureEnvelope, read_envelopes
from pounding._outputs import replaced
from pounding._springs import Device, Springs, read_devices
from pounding._structures import FloorMotion, Geometry, MemberForces, NodeMotion, Reactions, Structure, read_structure
from pounding.errors import InputError, excerpt

if TYPE_CHECKING:
    import xarray

__all__ = [
    "Data",
    "DataArray",
    "Device",
    "Extremes",
    "FloorMotion",
    "Geometry",
    "Link",
    "MemberForces",
    "NodeMotion",
    "NotResults",
    "Reactions",
    "RunData",
    "Springs",
    "Structure",
    "StructureEnvelope",
    "worst",
]

Contents = TypeVar("Contents", bound="RunData")


@dataclass(frozen=True, repr=False)
class Link(printing.ReportLines, lines=printing.link):
    """A link. Its output times are dense within contacts."""

    name: str
    law: str
    gap: float  #: opening at rest [m]
    left: str  #: name of the structure on the left
    left_floor: int  #: counted from 1 at the lowest; 0 for none
    right: str
    right_floor: int
    time: np.ndarray  #: [s]
    penetration: np.ndarray  #: [m], negative when open
    velocity: np.ndarray  #: [m/s], positive when closing
    force: np.ndarray  #: [N], positive when it pushes apart
    energy: np.ndarray  #: work done on the link [J]
    position: np.ndarray | None = None  #: x, y, z [m]; None if the structures have no position
    direction: np.ndarray = field(default_factory=lambda: np.array([1.0, 0, 0]))  #: unit, from left to right
    left_end: str = ""  #: "floor 3", "node b", "10.5 m up"
    right_end: str = ""
    friction: np.ndarray | None = None  #: [time, 1 or 2] along the contact [N]; None without friction
    #: Largest relative displacement that opens the joint, from the undeformed state [m], and its time [s]; NaN in files
    #: of earlier versions.
    largest_opening: float = math.nan
    t_opening: float = math.nan
    seat: float = math.nan  #: length of the seat [m]; NaN for none

    @property
    def unseated(self) -> bool:
        """True if the opening exceeds the seat."""
        return self.largest_opening > self.seat


@dataclass(frozen=True, repr=False)
class RunData(printing.ReportLines, lines=printing.run):
    """Contents of the results file of a run. `pounding.Run` adds pictures and tables."""

    title: str
    status: str  #: running, done, done: collapse ..., or failed: reason
    time: np.ndarray  #: [time] output times [s]
    ground_acceleration: np.ndarray  #: [time] along x [m/s^2]
    structures: dict[str, Structure]  #: in the order of the input
    links: dict[str, Link]  #: in the order of the input
    #: Structured array with one row per impact, by start time: `link` (its name, str), t_start, t_end,
    #: t_release [s], v_approach, v_separation [m/s], restitution, peak_force [N] (NaN for a rigid impact), t_peak [s],
    #: peak_penetration [m], impulse [N s], energy_lost, energy_stored [J]. t_end and t_release are NaN for an
    #: unfinished contact.
    impacts: np.ndarray
    #: time [s]; input, kinetic, strain, damping, hysteretic, impact, error [J]; with devices also devices [J].
    energy: dict[str, np.ndarray]
    summary: dict[str, Any]  #: the object of `pounding run --json`
    solver: dict[str, float]  #: steps, rejected, events, iterations, wall seconds
    model_yaml: str  #: the input as typed
    resolved_yaml: str  #: with every default and calibrated parameter
    source: Path | bytes = field(default_factory=bytes)  #: the file, or its bytes
    #: Extremes of every structure over all steps; empty in files of version 0.1.
    envelopes: dict[str, StructureEnvelope] = field(default_factory=dict)
    devices: dict[str, Device] = field(default_factory=dict)  #: bars and dampers in the order of the input
    #: By reduced structure: coordinates, blocks (links, ground), inputs (links with friction and devices, yielding parts,
    #: ground), frequency [Hz], and three times the estimated error_force, error_displacement, error_acceleration and
    #: error_members relative to the peaks; NaN without an estimate. With `check: true` also checked_windows, check_force
    #: and check_displacement, from all unknowns in the strongest impacts.
    reduction: dict[str, dict[str, Any]] = field(default_factory=dict)
    #: y, z -> [time] ground acceleration along the other axes [m/s^2]
    ground_across: dict[str, np.ndarray] = field(default_factory=dict)
    created: str = ""  #: time at which the run began, such as 2026-01-31T12:00:00Z; empty if not known
    version: str = ""  #: of the program; empty if not known
    #: The complete run without links (`compare: no_pounding`), with the same source; None if it was not requested.
    no_pounding: RunData | None = field(default_factory=lambda: None)
    group: str = "/"  #: group of the file with this run
    header: bytes = b""  #: first bytes of the file, with its checksum

    @classmethod
    @takes(path=arguments.file, checked=arguments.flag)
    def read(cls: type[Contents], path: str | PathLike[str], *, checked: bool = True) -> Contents:
        """The results in a file, after a check of the checksum.

        Parameters
        ----------
        path : str or os.PathLike
            Name of the file.
        checked : bool
            False skips the check, for files from an earlier version or with additions; HDF5 may hang on a damaged one.

        Returns
        -------
        RunData
            The results.

        Raises
        ------
        OSError
            The file cannot be opened.
        NotResults
            The file is of another kind or damaged.
        """
        if checked:
            require_whole(path)
        elif not Path(path).is_file():
            raise FileNotFoundError(f"no such file: {path}")
        with _opened(path, str(path)) as file:
            return cls._of(file, str(path), Path(path))

    @classmethod
    def from_image(cls: type[Contents], image: bytes) -> Contents:
        """The results in the bytes of a results file.

        Parameters
        ----------
        image : bytes
            The bytes.

        Returns
        -------
        RunData
            The results.

        Raises
        ------
        NotResults
            The bytes are of another file, or damaged.
        """
        if not isinstance(image, bytes):
            raise arguments.refuse("image", "the bytes of a results file", image)
        require_whole_image(image)
        with _opened(image, "what was given") as file:
            return cls._of(file, "what was given", image)

    @classmethod
    def _of(cls: type[Contents], file: h5py.File, name: str, source: Path | bytes) -> Contents:
        data = Data(file)
        if "pushover" in data and "structures" not in data:
            raise HoldsPushover(
                f"{name} holds a pushover and no run; draw it by pounding plot, or read it by pounding.read_pushover"
            )
        given: dict[str, Any] = {"source": source, "header": _header(source)}
        # An unchecked file may lack datasets or have other types.
        try:
            if "no_pounding" in data:
                without = cls(**_contents(data["no_pounding"]), **given, group="/no_pounding")
                return cls(**_contents(data), **given, no_pounding=without)
            return cls(**_contents(data), **given)
        except Exception as error:
            raise NotResults(f"{name} is not a results file of pounding: {error}") from error

    @cached_property
    def data(self) -> xarray.DataTree | Data:
        """All groups and arrays of the file, with named dimensions, coordinates, `units` and `long_name` from the file.

        A tree of xarray, or without xarray an object with the same basic access. Arrays are read when their values are
        used, and the file stays open.

        Raises
        ------
        NotResults
            The file has changed since it was read.

        Examples
        --------
        >>> results.data["links/left-right/force"].attrs["units"]
        'N'
        """
        data = self._groups()
        try:
            return to_datatree(data)
        except ModuleNotFoundError:
            return data

    def _groups(self) -> Data:
        """Groups of `data`, without xarray. Raises NotResults if the file has changed since it was read."""
        name = "what was given" if isinstance(self.source, bytes) else str(self.source)
        if _header(self.source) != self.header:
            raise NotResults(f'{name} has changed since it was read; read it again: pounding.read("{name}")')
        return Data(_opened(self.source, name)[self.group])

    def __getstate__(self) -> dict[str, Any]:
        # An open file cannot be copied.
        return {name: value for name, value in vars(self).items() if name != "data"}

    @takes(link=arguments.text)
    def impacts_of(self, link: str) -> np.ndarray:
        """The impacts of one link.

        Parameters
        ----------
        link : str
            Name of the link.

        Returns
        -------
        numpy.ndarray
            Rows of `impacts`.

        Raises
        ------
        InputError
            The link is unknown.
        """
        if link not in self.links:
            raise InputError(f"unknown link {excerpt(link)}; known: {', '.join(self.links) or 'none'}")
        return self.impacts[self.impacts["link"] == link]

    @takes(path=arguments.file)
    def save(self, path: str | PathLike[str]) -> None:
        """Writes the results file.

        Parameters
        ----------
        path : str or os.PathLike
            File to write; an existing one must be a results file.

        Raises
        ------
        InputError
            The file may not be replaced.
        OSError
            The file cannot be written.
        """
        with replaced(path, RESULTS) as temporary:
            if isinstance(self.source, bytes):
                temporary.write_bytes(self.source)
            else:
                shutil.copyfile(self.source, temporary)


def _header(source: Path | bytes) -> bytes:
    if isinstance(source, bytes):
        return source[:BLOCK]
    with open(source, "rb") as file:
        return file.read(BLOCK)


def _opened(source: str | PathLike[str] | bytes, name: str) -> h5py.File:
    """The HDF5 file, open for reading. Raises NotResults if it is not HDF5, OSError if it cannot be opened."""
    try:
        return h5py.File(h5py.h5f.open_file_image(source) if isinstance(source, bytes) else source, "r")
    except OSError as error:
        if not isinstance(source, bytes):
            open(source, "rb").close()
        raise NotResults(f"{name} is not a results file of pounding: {error}") from error


def _contents(file: Data) -> dict[str, Any]:
    """The fields of RunData except those of the file."""

    def given(path: str) -> str:
        return str(file[path].values) if path in file else ""

    solver, reduction = ({}, {}) if "solver" not in file else (file["solver"].data_vars, file["solver"].children)
    axes = {axis: f"ground/acceleration_{axis}" for axis in "yz"}
    return {
        **{key: file.attrs[key] for key in ("title", "status")},
        **{key: file.attrs.get(key, "") for key in ("created", "version")},
        "time": file["time" if "time" in file else "ground/time"].values,
        "ground_acceleration": file["ground/acceleration"].values,
        "ground_across": {axis: file[path].values for axis, path in axes.items() if path in file},
        "structures": {name: read_structure(name, group) for name, group in file["structures"].children.items()},
        "links": {name: _link(name, group) for name, group in file["links"].children.items()},
        "impacts": _rows(file["impacts"].data_vars),
        "energy": {name: data.values for name, data in {**file["energy"].coords, **file["energy"].data_vars}.items()},
        "summary": json.loads(given("summary") or "{}"),
        "solver": {name: data.values[()] for name, data in solver.items()},
        "reduction": {
            name: {key: data.values[()] for key, data in group.data_vars.items()}
            for name, group in (reduction["reduction"].children if "reduction" in reduction else {}).items()
        },
        "model_yaml": given("input/model.yaml"),
        "resolved_yaml": given("input/resolved.yaml"),
        "envelopes": read_envelopes(file),
        "devices": read_devices(file),
    }


def _rows(columns: Mapping[str, DataArray]) -> np.ndarray:
    """A structured array of these columns."""
    values = {name: column.values for name, column in columns.items()}
    table = np.empty(len(values["link"]), dtype=[(name, each.dtype) for name, each in values.items()])
    for name, each in values.items():
        table[name] = each
    return table


def _link(name: str, group: Data) -> Link:
    ends = {}
    for side in ("left", "right"):
        if f"{side}_end" not in group.attrs:
            floor = group.attrs[f"{side}_floor"]
            ends[f"{side}_end"] = f"floor {floor}" if floor else ""
    # NaN: the structures have no position.
    position = np.asarray(group.attrs.get("position", np.full(3, np.nan)), dtype=float)
    known = position if np.isfinite(position).all() else None
    return read_fields(Link, group, name=name, position=known, **ends)
