"""The results file as numpy arrays. Needs numpy and h5py only; every array is in SI units."""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np


class NotResults(Exception):
    """The file exists but `pounding run` did not write it."""


@dataclass(frozen=True)
class Structure:
    name: str
    floors: list[str]  #: labels from the ground up
    displacement: np.ndarray  #: [time, floor] relative to the ground [m]
    velocity: np.ndarray  #: [time, floor] relative to the ground [m/s]
    acceleration: np.ndarray  #: [time, floor] absolute [m/s^2]
    drift: np.ndarray  #: [time, floor] [m]; no columns in a structure without storeys
    storey_shear: np.ndarray  #: [time, floor] [N]


@dataclass(frozen=True)
class Link:
    """One link. It has its own times, dense inside contacts."""

    name: str
    law: str
    gap: float  #: opening at rest [m]
    left: str  #: name of the structure on the left
    left_floor: int  #: counted from 1 at the lowest; 0 when it has none
    right: str
    right_floor: int
    time: np.ndarray  #: [s]
    penetration: np.ndarray  #: [m], negative when open
    velocity: np.ndarray  #: [m/s], positive when closing
    force: np.ndarray  #: [N], positive when it pushes apart
    energy: np.ndarray  #: work done on the link [J]


@dataclass(frozen=True)
class Run:
    title: str
    status: str  #: running, done, or failed: reason
    time: np.ndarray  #: output times [s]
    ground_acceleration: np.ndarray  #: at the output times [m/s^2]
    structures: dict[str, Structure]  #: in the order of the input
    links: dict[str, Link]  #: in the order of the input
    impacts: np.ndarray  #: structured array, one row an impact; `link` is bytes, NaN the force of a rigid one
    energy: dict[str, np.ndarray]  #: time, input, kinetic, strain, damping, hysteretic, impact, error [s], [J]
    summary: str  #: JSON

    def impacts_of(self, link):
        """The rows of one link."""
        return self.impacts[self.impacts["link"] == link.encode()]


def read(path):
    """The run in the file `path`. Raises OSError when it cannot be opened, NotResults when it is something else."""
    if not Path(path).is_file():
        raise FileNotFoundError(f"there is no file {path}")
    with h5py.File(path) as file:
        try:
            return _read(file)
        except KeyError as error:
            raise NotResults(f"{path} is not a results file of pounding: {error.args[0]}") from error


def _read(file):
    return Run(
        title=file.attrs["title"],
        status=file.attrs["status"],
        time=file["time"][:],
        ground_acceleration=file["ground/acceleration"][:],
        structures={name: _structure(name, group) for name, group in file["structures"].items()},
        links={name: _link(name, group) for name, group in file["links"].items()},
        impacts=file["impacts"][:],
        energy={name: data[:] for name, data in file["energy"].items()},
        summary=file["summary"].asstr()[()],
    )


def _structure(name, group):
    # The frames of today move in one direction, which needs no axis of its own in a picture.
    motion = {key: group[key][:, :, 0] for key in ("displacement", "velocity", "acceleration")}
    return Structure(name=name, floors=list(group.attrs["floors"]), drift=group["drift"][:],
                     storey_shear=group["storey_shear"][:], **motion)


def _link(name, group):
    series = {key: group[key][:] for key in ("time", "penetration", "velocity", "force", "energy")}
    ends = {key: group.attrs[key] for key in ("left", "right")}
    floors = {key: int(group.attrs[key]) for key in ("left_floor", "right_floor")}
    return Link(name=name, law=group.attrs["law"], gap=float(group.attrs["gap"]), **ends, **floors, **series)
