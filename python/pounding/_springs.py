"""Yielding parts of structures, storeys, hinges and isolators, and devices between structures, in results files."""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from pounding import _printing as printing
from pounding._data import Data, read_fields

#: Names of parts by kind; isolators are all of a building, or one at a foot of a frame. Others are devices.
_KINDS = {
    "storey": re.compile(r"storey \d+"),
    "hinge": re.compile(r".+ (start|end)( [yz])?"),
    "isolator": re.compile(r"isolators|isolator \S+( [xy])?"),
    "support": re.compile(r"support \S+"),
}


@dataclass(frozen=True, repr=False)
class Springs(printing.ReportLines):
    """Yielding parts and devices of one structure. Deformations are storey drifts and device elongations [m] or hinge
    rotations [rad]; forces are shears and tensions [N] or moments [N m]."""

    names: list[str]  #: "storey 1", from the ground up
    laws: list[str]  #: key of the law in the input, one per part
    stiffness: np.ndarray  #: [part] initial [N/m] or [N m/rad]
    yield_deformation: np.ndarray  #: [part] [m] or [rad]
    negative_yield_deformation: np.ndarray  #: [part] absolute value in the negative direction [m] or [rad]
    deformation: np.ndarray  #: [time, part] at the output times [m] or [rad]
    force: np.ndarray  #: [time, part] [N] or [N m]
    hysteretic: np.ndarray  #: [time, part] cumulative energy lost by yielding [J]
    #: [part] each, over all steps: peak_deformation (signed), peak_time [s], peak_force, ductility (of a hinge:
    #: rotation of the member end over its yield rotation), peak_plastic (largest size of the plastic part of the
    #: deformation), cycles, residual, hysteretic [J], first_yield [s] (NaN where it stayed elastic), damping_shear
    #: (over the yield shear; NaN for hinges).
    largest: dict[str, np.ndarray]
    states: list[str]  #: "elastic", "yielded" or "beyond ultimate", one per part
    ultimate_rotation: np.ndarray  #: [part] plastic rotation capacity of a hinge [rad]; NaN if not given

    def __len__(self) -> int:
        return len(self.names)

    def is_device(self, part: int) -> bool:
        """True if a part is a device, neither a storey, a hinge, an isolator nor a support.

        Parameters
        ----------
        part : int
            Index of the part.

        Returns
        -------
        bool
            Kind of the part.
        """
        return self.kind(part) == "device"

    def is_hinge(self, part: int) -> bool:
        """True if a part is a hinge at the end of a member.

        Parameters
        ----------
        part : int
            Index of the part.

        Returns
        -------
        bool
            Kind of the part.
        """
        return self.kind(part) == "hinge"

    def isolates(self, part: int) -> bool:
        """True if a part is an isolator.

        Parameters
        ----------
        part : int
            Index of the part.

        Returns
        -------
        bool
            Kind of the part.
        """
        return self.kind(part) == "isolator"

    def lifts_off(self, part: int) -> bool:
        """True if a part is a support that acts in compression only.

        Parameters
        ----------
        part : int
            Index of the part.

        Returns
        -------
        bool
            Kind of the part.
        """
        return self.kind(part) == "support"

    def kind(self, part: int) -> str:
        """Kind of a part.

        Parameters
        ----------
        part : int
            Index of the part.

        Returns
        -------
        str
            storey, hinge, isolator, support (one that acts in compression only) or device.
        """
        kind = next((kind for kind, name in _KINDS.items() if name.fullmatch(self.names[part])), "device")
        return "device" if kind == "support" and self.laws[part] != "uplift" else kind

    def number(self, name: str) -> int:
        """Index of a part by name.

        Parameters
        ----------
        name : str
            Name of the part.

        Returns
        -------
        int
            Its index.

        Raises
        ------
        KeyError
            The part is unknown; the message lists the names.
        """
        if name not in self.names:
            raise KeyError(f"no part is named {name!r}; there are {', '.join(self.names)}")
        return self.names.index(name)


def read_springs(structure: Data) -> Springs | None:
    """The yielding parts of a structure; None if it is elastic."""
    if "springs" not in structure.children:
        return None
    group = structure["springs"]
    largest = {key: data.values for key, data in group["summary"].data_vars.items()}
    return read_fields(Springs, group, states=largest.pop("state").tolist(), largest=largest)


@dataclass(frozen=True, repr=False)
class Device(printing.ReportLines):
    """A bar, a damper or both between two structures. Elongation and force are positive in tension."""

    name: str
    left: str  #: name of the structure on the left
    left_end: str  #: "floor 3", "node b"; empty for a wall
    right: str
    right_end: str
    direction: np.ndarray  #: unit, from left to right
    stiffness: float  #: of the bar [N/m]; 0 for none
    coefficient: float  #: of the damper [N (s/m)^exponent]; 0 for none
    exponent: float  #: of the velocity
    elongation: np.ndarray  #: [time] at the output times [m]
    force: np.ndarray  #: [time] [N]
    #: minimum and maximum elongation and force over all steps; elongation_time and force_time [s]
    largest: dict[str, np.ndarray]


def read_devices(file: Data) -> dict[str, Device]:
    """The devices of a results file in the order of the input; empty if there are none."""
    return {
        name: read_fields(
            Device, group, name=name, largest={key: data.values for key, data in group["envelope"].data_vars.items()}
        )
        for name, group in file.children.get("devices", {}).items()
    }
