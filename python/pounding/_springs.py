"""Yielding parts of structures, storeys, hinges and isolators, in results files."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np

from pounding import _printing as printing
from pounding._data import Data, read_fields

#: Names of storeys and hinges, and of isolators: all of a building, or one at a foot of a frame.
_OF_MEMBERS = re.compile(r"storey \d+|.+ (start|end)( [yz])?")
_HINGES = re.compile(r".+ (start|end)( [yz])?")
_SUPPORTS = re.compile(r"support \S+")
_ISOLATORS = re.compile(r"isolators|isolator \S+( [xy])?")


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
        return not _OF_MEMBERS.fullmatch(self.names[part]) and not self.isolates(part) and not self.lifts_off(part)

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
        return _HINGES.fullmatch(self.names[part]) is not None

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
        return _ISOLATORS.fullmatch(self.names[part]) is not None

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
        return self.laws[part] == "uplift" and _SUPPORTS.fullmatch(self.names[part]) is not None

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
    given: dict[str, Any] = {"states": largest.pop("state").tolist(), "largest": largest}
    # Files of earlier versions lack them.
    if "ultimate_rotation" not in group:
        given["ultimate_rotation"] = np.full(group["names"].shape, np.nan)
    if "negative_yield_deformation" not in group:
        given["negative_yield_deformation"] = group["yield_deformation"].values
    return read_fields(Springs, group, **given)
