"""Extremes of a run: minimum and maximum of every quantity, with their times.

They are tracked in every step and within the steps, so they do not depend on the output times."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from pounding import _printing as printing
from pounding._data import Data, read_fields

#: Edges of a rigid floor in space in the order of `edge_displacement`: displacements along x at both ends of the plan
#: along y, then along y.
EDGES = ("x at smallest y", "x at largest y", "y at smallest x", "y at largest x")


def section_signs(components: list[str]) -> np.ndarray:
    """[component] -1 for the start of a member and 1 for its end, to convert end forces into internal forces."""
    return np.array([-1.0 if component.startswith("start") else 1.0 for component in components])


@dataclass(frozen=True, repr=False)
class Extremes(printing.ReportLines):
    """Minima and maxima of a quantity, signed, along the last axis of both arrays."""

    values: np.ndarray  #: [..., 2]
    times: np.ndarray  #: [..., 2] [s]

    @property
    def min(self) -> np.ndarray:
        """[...] minima."""
        return self.values[..., 0]

    @property
    def max(self) -> np.ndarray:
        """[...] maxima."""
        return self.values[..., 1]

    @property
    def peak(self) -> np.ndarray:
        """[...] maximum absolute values."""
        return np.abs(self.values).max(axis=-1)


@dataclass(frozen=True, repr=False)
class StructureEnvelope(printing.ReportLines):
    """Extremes of one structure. Missing quantities are None."""

    name: str
    floors: list[str]  #: labels from the ground up
    directions: list[str] = field(default_factory=list)  #: of the floors: x; in space x, y, rz
    displacement: Extremes | None = None  #: [floor, direction] relative to the ground [m], [rad]
    #: [floor, edge] in the order of EDGES [m]; NaN for floors that are not rigid in space
    edge_displacement: Extremes | None = None
    acceleration: Extremes | None = None  #: [floor, direction] absolute [m/s^2], [rad/s^2]
    drift: Extremes | None = None  #: [floor, x or x and y] floor minus the floor below [m]
    storey_shear: Extremes | None = None  #: [floor, x or x and y] of the storey below the floor [N]
    base_shear: Extremes | None = None  #: [1, x or x and y] of the lowest storey [N]
    members: list[str] = field(default_factory=list)  #: names of all members of a frame
    components: list[str] = field(default_factory=list)  #: "start N", "start Vz", "start My", "end N" ...
    member_force: Extremes | None = None  #: [member, component] on the ends of members, local axes [N], [N m]
    supports: list[str] = field(default_factory=list)  #: names of the supported nodes
    support_directions: list[str] = field(default_factory=list)  #: x, z, ry; in space x, y, z, rx, ry, rz
    #: [support, direction] reactions on a frame [N], [N m]; along z negative in uplift
    reaction: Extremes | None = None
    #: whether member_force and reaction include the weights of the masses; None if not known
    gravity_included: bool | None = None
    included: str = ""  #: what else they include: "gravity, P-Delta"

    @property
    def section_force(self) -> Extremes | None:
        """[member, component] internal forces at both ends of members, on the face towards the end of the member [N],
        [N m]. N > 0 is tension at either end."""
        if self.member_force is None:
            return None
        starts = np.array([component.startswith("start") for component in self.components])[:, None]
        values, times = self.member_force.values, self.member_force.times
        return Extremes(np.where(starts, -values[..., ::-1], values), np.where(starts, times[..., ::-1], times))

    @property
    def axial_force(self) -> Extremes | None:
        """[member] axial force over both ends, positive in tension [N]; the minimum is the largest compression."""
        sections = self.section_force
        if sections is None:
            return None
        ends = [i for i, component in enumerate(self.components) if component.endswith(" N")]
        values, times = sections.values[:, ends], sections.times[:, ends]
        at = np.stack([values[..., 0].argmin(axis=1), values[..., 1].argmax(axis=1)], axis=-1)[:, None]
        return Extremes(np.take_along_axis(values, at, axis=1)[:, 0], np.take_along_axis(times, at, axis=1)[:, 0])

    def member(self, name: str) -> dict[str, tuple[float, float]]:
        """Extremes of the end forces of a member. The axial force has opposite signs at both ends; see `section`.

        Parameters
        ----------
        name : str
            Name of the member.

        Returns
        -------
        dict of str to tuple
            Minimum and maximum by component, such as "start My" [N], [N m].

        Raises
        ------
        KeyError
            The member is unknown.
        """
        return self._of_member(name, self.member_force)

    def section(self, name: str) -> dict[str, tuple[float, float]]:
        """Extremes of the internal forces of a member: "start N" and "end N" are positive in tension.

        Parameters
        ----------
        name : str
            Name of the member.

        Returns
        -------
        dict of str to tuple
            Minimum and maximum by component [N], [N m].

        Raises
        ------
        KeyError
            The member is unknown.
        """
        return self._of_member(name, self.section_force)

    def _of_member(self, name: str, forces: Extremes | None) -> dict[str, tuple[float, float]]:
        if forces is None or name not in self.members:
            raise KeyError(f"{self.name} has no member {name}; it has {', '.join(self.members) or 'none'}")
        return {
            component: (float(low), float(high))
            for component, (low, high) in zip(self.components, forces.values[self.members.index(name)])
        }


def read_envelopes(file: Data) -> dict[str, StructureEnvelope]:
    """The envelopes of all structures in a results file, or in its group of the run without links; empty for files of
    version 0.1."""
    place = "envelopes/structures"
    return {name: _envelope(name, group) for name, group in file[place].children.items()} if place in file else {}


def _envelope(name: str, group: Data) -> StructureEnvelope:
    arrays = group.data_vars
    found: dict[str, Any] = {
        one.name: Extremes(arrays[one.name].values, arrays[f"{one.name}_time"].values)
        for one in fields(StructureEnvelope)
        if one.type == "Extremes | None" and one.name in arrays
    }
    # Attributes of several arrays have these names.
    for field_, array, attribute in (
        ("directions", "displacement", "directions"),
        ("components", "member_force", "components"),
        ("support_directions", "reaction", "directions"),
    ):
        found[field_] = arrays[array].attrs[attribute] if array in arrays else []
    return read_fields(StructureEnvelope, group, name=name, **found)
